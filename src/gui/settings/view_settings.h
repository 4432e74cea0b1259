#pragma once

#include <nlohmann/json_fwd.hpp>

#include "gui/settings/view_options.h"

/// The part of the view that is kept from one run to the next. What belongs to one mesh (isolated
/// elements, comparison, magnifier, a range of colours) starts anew.
namespace winslow::gui {

/// Adds to an object or replaces what is there.
void write_view(const ViewOptions& view, nlohmann::json& object);
/// Of an object; what is missing or makes no sense is as in ViewOptions().
ViewOptions read_view(const nlohmann::json& object);

nlohmann::json write_kept_views(const std::vector<KeptView>& views);
/// What makes no sense is left out.
std::vector<KeptView> read_kept_views(const nlohmann::json& list);

}  // namespace winslow::gui
