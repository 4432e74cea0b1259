#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/inspect/element_field.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/metric_scale.h"
#include "gui/widgets/legend.h"

/// What pictures of plane and of volume meshes say in the same words and colours.
namespace winslow::gui {

/// "12 345 inverted elements"; empty if there are none.
std::string inverted_text(Index inverted);

/// Throws UsageError for a range without extent and, of a field, an unknown colour map.
void check_colors(const std::optional<ElementField>& field, const ColorChoice& choice);

ColorScale picture_colors(const ElementField& field, ColorChoice choice, bool dark,
                          std::span<const double> values);
/// Has colours take the range and the axis of a scale.
void use_scale(ColorChoice& colors, const ColorScale& scale);
/// The scale of two pictures that are to be compared: from the lower end to the higher one.
ColorScale joined(ColorScale a, const ColorScale& b);

/// with_inverted: there are such elements, which are red.
Legend picture_legend(const ElementField& field, std::span<const double> values,
                      const ColorScale& scale, bool with_inverted);

/// Colour of the lines between coloured elements.
Rgba edges_on_colors(const ElementField& field, const ColorChoice& choice, bool dark);

}  // namespace winslow::gui
