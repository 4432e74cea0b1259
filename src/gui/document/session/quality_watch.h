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

/// Measures the quality of the mesh on screen in the background.
class QualityMonitor {
 public:
  /// Deviation of a surface mesh from the mesh as opened.
  struct Deviation {
    SurfaceChange change;
    std::vector<WorstElement> worst;  ///< elements furthest away
  };
  struct Measured {
    std::uint64_t shape = 0;  ///< LiveMesh::shape() that was measured
    std::shared_ptr<const Topology> topology;
    QualityReport report;
    std::optional<ElementField> field;
    std::vector<double> values;    ///< of field, one per element
    const void* before = nullptr;  ///< identity of Wish::before
    /// For a surface mesh; none while a solver changes it, unless the deviation colours the mesh.
    std::optional<Deviation> deviation;
  };
  /// A mesh, and additional data that fields may need.
  struct Subject {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const VirtualControlVolumes> vcv;
    std::shared_ptr<const LayerStack> layers;
    std::shared_ptr<const SurfaceShape> surface;  ///< of a surface mesh
  };
  /// Quantities to measure in addition to the report.
  struct Wish {
    std::optional<ElementField> field;  ///< measured for every element
    /// Earlier coordinates of the same nodes, for the comparison of first heights; null: none.
    const Coordinates* before = nullptr;
    /// Distances to a surface mesh as opened; null for other kinds of mesh.
    std::shared_ptr<const SurfaceDistance> given = nullptr;

    const void* before_numbers() const { return before ? before->values().data() : nullptr; }
    /// True if `measured` contains these quantities.
    bool met_by(const Measured& measured) const {
      return measured.field == field && measured.before == before_numbers();
    }
  };

  /// True if a request would start a measurement. Ask before copying a mesh for it.
  bool wants(std::uint64_t shape, const Wish& wish, bool live) const;
  /// Requests the quality of a mesh. live: a solver is changing it, so measure only occasionally.
  void request(std::uint64_t shape, const Subject& subject, const Wish& wish, bool live);
  /// Measures synchronously.
  void measure_now(std::uint64_t shape, const Subject& subject, const Wish& wish);
  /// True if there is a newer measurement.
  bool poll();
  /// The latest measurement; null if there is none of the present topology.
  const std::shared_ptr<const Measured>& latest() const { return latest_; }
  /// Forgets everything: another mesh is coming.
  void clear();
  bool busy() const { return worker_.busy(); }

 private:
  Background<std::shared_ptr<const Measured>> worker_;
  std::shared_ptr<const Measured> latest_;
  bool discard_ = false;  // the running measurement is of a closed mesh
  std::chrono::steady_clock::time_point last_start_{};
};

/// The quality of the mesh on screen.
class QualityWatch {
 public:
  explicit QualityWatch(const LiveMesh& mesh) : mesh_(mesh) {}

  /// Measures the mesh on screen in the background, including this field. before: the state with
  /// which first heights are compared.
  void watch(const std::optional<ElementField>& field, BeforeState before = BeforeState::loaded);
  /// Measures it synchronously, for a picture whose colours must match its mesh.
  void measure_now(const std::optional<ElementField>& field,
                   BeforeState before = BeforeState::loaded);
  /// The latest measurement is of the mesh on screen, with this field and comparison.
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
