#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/strategy/slide_options.h"

namespace winslow::gui {

/// The other side of the periodic pair that a marker is in; none: it is in no pair.
std::optional<std::string> partner_of(const SlideOptions& slide, const std::string& marker);

/// Periodic pairs, name after name, that a marker is not in.
std::vector<std::string> pairs_without(const std::vector<std::string>& pairs,
                                       const std::string& marker);

}  // namespace winslow::gui
