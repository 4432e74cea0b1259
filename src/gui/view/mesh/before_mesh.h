#pragma once

#include <cstdint>

#include "gui/document/jobs/quality_monitor.h"
#include "gui/document/session/session.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// The state with which the present mesh is compared: its nodes and its quality.
class BeforeMesh {
 public:
  /// In every frame. metric: its values are wanted, too, for colours.
  void update(const Session& session, const ViewOptions& view);
  /// True if a measurement has come in.
  bool poll() { return monitor_.poll(); }
  bool busy() const { return monitor_.busy(); }

  /// Null without a mesh.
  const Coordinates* coordinates() const { return coordinates_; }
  /// That coordinates() are of: not the present one if a command in between changed it.
  const std::shared_ptr<const Topology>& topology() const { return topology_; }
  /// Grows whenever coordinates() are others.
  std::uint64_t shape() const { return shape_; }
  /// Null until it is measured.
  const QualityReport* report() const;
  /// Report and values of coordinates(), or null until they are measured.
  std::shared_ptr<const QualityMonitor::Measured> measured() const;

 private:
  QualityMonitor monitor_;
  const Coordinates* coordinates_ = nullptr;  // of the session's history
  std::shared_ptr<const Topology> topology_;
  const Document* document_ = nullptr;
  bool loaded_ = true;  // the mesh as it was opened
  std::uint64_t generation_ = 0, shape_ = 0;
  const void* key_ = nullptr;
};

}  // namespace winslow::gui
