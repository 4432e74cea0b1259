#pragma once

#include "gui/document/jobs/quality_monitor.h"
#include "gui/document/session/live_mesh.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// The quality of the mesh on screen.
class QualityWatch {
 public:
  explicit QualityWatch(const LiveMesh& mesh) : mesh_(mesh) {}

  /// Measures the mesh on screen in the background, by this field among others. before: the state
  /// with which first heights are compared.
  void watch(const std::optional<ElementField>& field, BeforeState before = BeforeState::loaded);
  /// Measures it before returning: for a picture whose colours must be those of its mesh.
  void measure_now(const std::optional<ElementField>& field,
                   BeforeState before = BeforeState::loaded);
  /// The latest measurement is of the mesh on screen, and of all that.
  bool up_to_date(const std::optional<ElementField>& field, BeforeState before) const;
  /// The latest measurement; null if there is none of the present topology.
  const std::shared_ptr<const QualityMonitor::Measured>& latest() const {
    return monitor_.latest();
  }
  /// Forgets everything: another mesh is coming.
  void clear() { monitor_.clear(); }
  bool poll() { return monitor_.poll(); }
  bool busy() const { return monitor_.busy(); }

 private:
  QualityMonitor::Subject on_screen() const;
  QualityMonitor::Wish wish(const std::optional<ElementField>& field, BeforeState before) const;

  const LiveMesh& mesh_;
  QualityMonitor monitor_;
};

/// Position in the history of the state with which the mesh on screen is compared. Needs a mesh.
std::size_t position_before(const LiveMesh& mesh, BeforeState which);

}  // namespace winslow::gui
