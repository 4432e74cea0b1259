#pragma once

#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"

namespace winslow::gui {

/// A line of the table of the paper, before and after side by side.
struct QualityRow {
  std::string name;         ///< "min", or "Normalized Jacobian" above its numbers
  std::string tip;          ///< tooltip of a title
  bool title = false;       ///< names the lines below; has no numbers
  std::string before, now;  ///< as in the table; "-" if not known yet
  std::string change;       ///< with sign; empty if too small to show or unknown
  int verdict = 0;          ///< 1: better than before, -1: worse, 0: neither
  bool alarming = false;    ///< bad for a flow solver
};

/// The reported metrics (minimum, average, maximum) and the number of inverted elements. before:
/// null while it is being measured. shown: of the mesh in the picture, which may be newer than
/// `now`; null: use that of `now`.
std::vector<QualityRow> quality_table(const QualityReport* before, const QualityReport& now,
                                      const Validity* shown = nullptr);
/// The measures of the cells at walls, and changes of first heights. before: as above.
std::vector<QualityRow> wall_table(const WallReport* before, const WallReport& now);
/// The deviation of a surface mesh from the mesh as opened. change: null while it is being
/// measured.
std::vector<QualityRow> deviation_table(const SurfaceChange* change);

}  // namespace winslow::gui
