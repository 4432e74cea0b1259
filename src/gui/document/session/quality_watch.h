#pragma once

#include "core/command/command.h"
#include "core/inspect/element_field.h"
#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"
#include "gui/base/background.h"
#include "gui/document/session/live_mesh.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// Longest list of worst elements that is kept.
inline constexpr int most_worst = 100;

/// Quality of the mesh on screen, measured behind the frame loop's back.
class QualityMonitor {
 public:
  /// Of a surface mesh: how far it is from the mesh as it was opened.
  struct Deviation {
    SurfaceChange change;
    std::vector<WorstElement> worst;  ///< those furthest away
  };
  struct Measured {
    std::uint64_t shape = 0;  ///< LiveMesh::shape() that was measured
    std::shared_ptr<const Topology> topology;
    QualityReport report;
    std::optional<ElementField> field;
    std::vector<double> values;    ///< of field, one per element
    const void* before = nullptr;  ///< numbers of Wish::before, to know it again
    /// Of a surface mesh; none while a solver changes it, unless it is coloured by the deviation.
    std::optional<Deviation> deviation;
  };
  /// A mesh, and what fields may need beside it.
  struct Subject {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const VirtualControlVolumes> vcv;
    std::shared_ptr<const LayerStack> layers;
    std::shared_ptr<const SurfaceShape> surface;  ///< of a surface mesh
  };
  /// What is to be measured beside the report.
  struct Wish {
    std::optional<ElementField> field;  ///< its value of every element
    /// The same nodes as they were before, that first heights are compared with; null: none.
    const Coordinates* before = nullptr;
    /// Distances to a surface mesh as it was opened; null: another kind of mesh.
    std::shared_ptr<const SurfaceDistance> given = nullptr;

    const void* before_numbers() const { return before ? before->values().data() : nullptr; }
    /// Whether that is what was measured.
    bool met_by(const Measured& measured) const {
      return measured.field == field && measured.before == before_numbers();
    }
  };

  /// Whether a request would start a measurement: ask before a mesh is copied for it.
  bool wants(std::uint64_t shape, const Wish& wish, bool live) const;
  /// Asks for the quality of a mesh. live: a solver is changing it, so measure only now and then.
  void request(std::uint64_t shape, const Subject& subject, const Wish& wish, bool live);
  /// The same, before returning.
  void measure_now(std::uint64_t shape, const Subject& subject, const Wish& wish);
  /// True if a newer measurement has come in.
  bool poll();
  /// The latest measurement; null if there is none of the present topology.
  const std::shared_ptr<const Measured>& latest() const { return latest_; }
  /// Forgets everything: another mesh is coming.
  void clear();
  bool busy() const { return worker_.busy(); }

 private:
  Background<std::shared_ptr<const Measured>> worker_;
  std::shared_ptr<const Measured> latest_;
  bool discard_ = false;  // the measurement under way is of a mesh that is gone
  std::chrono::steady_clock::time_point last_start_{};
};

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
