#pragma once

#include <string>

#include "core/quality/quality_floor.h"

namespace winslow::gui::ui {

/// Limits that a motion keeps, folded away: for each metric that is reported a switch and, where it
/// is on, the value. The fold has the id PREFIX/limits, a switch PREFIX/min_quality_METRIC/on, a
/// value PREFIX/min_quality_METRIC. follows_path: false where the motion is such that no limit can
/// be kept; the form then says what to choose. cell_dimension: of the mesh. True if a limit
/// changed.
bool quality_limits_form(const std::string& prefix, QualityFloor& floor, int cell_dimension,
                         bool follows_path);

}  // namespace winslow::gui::ui
