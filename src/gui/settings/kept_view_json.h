#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "gui/settings/kept_view.h"

namespace winslow::gui {

nlohmann::json write_kept_views(const std::vector<KeptView>& views);
/// What makes no sense is left out.
std::vector<KeptView> read_kept_views(const nlohmann::json& list);

}  // namespace winslow::gui
