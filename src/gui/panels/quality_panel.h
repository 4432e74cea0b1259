#pragma once

#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"

namespace winslow::gui {

/// A line of the table of the paper, before and after side by side.
struct QualityRow {
  std::string name;         ///< "min", or "Normalized Jacobian" above its numbers
  std::string tip;          ///< of a title
  bool title = false;       ///< names the lines below; has no numbers
  std::string before, now;  ///< as written in the table; "-" where not known yet
  std::string change;       ///< with its sign; empty if too small to see or not known
  int verdict = 0;          ///< 1: better than before, -1: worse, 0: neither
  bool alarming = false;    ///< a flow solver will not like what it says
};

/// The reported metrics (minimum, average, maximum) and the number of inverted elements. before:
/// null while it is being measured. shown: of the mesh in the picture, which `now` may be a moment
/// behind; null: that of `now`.
std::vector<QualityRow> quality_table(const QualityReport* before, const QualityReport& now,
                                      const Validity* shown = nullptr);
/// What is measured of the cells at walls, and how first heights have changed. before: as above.
std::vector<QualityRow> wall_table(const WallReport* before, const WallReport& now);
/// How far a surface mesh is from the mesh as opened. change: null while it is being measured.
std::vector<QualityRow> deviation_table(const SurfaceChange* change);

}  // namespace winslow::gui
