#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "gui/base/background.h"
#include "gui/document/jobs/quality_monitor.h"
#include "gui/render/mesh_renderer.h"
#include "gui/settings/view_options.h"
#include "gui/widgets/legend.h"

namespace winslow::gui {

/// One mesh on screen with its colours. What takes long for a large mesh is done in the background:
/// until it is done, the picture is the last one.
class MeshLayer {
 public:
  /// In every frame. shape: grows whenever the coordinates are others; generation: with the mesh.
  void update(const std::shared_ptr<const Topology>& topology, const Coordinates& coordinates,
              std::uint64_t generation, std::uint64_t shape);
  /// Values to colour by: those of view.color, or null for plain elements.
  void color(const std::shared_ptr<const QualityMonitor::Measured>& measured,
             const ViewOptions& view);
  /// Takes what the background has done. True if the picture changes.
  bool poll();
  /// The picture is not that of the last update() and color() yet.
  bool busy() const { return builder_.busy() || painter_.busy(); }

  MeshRenderer& renderer() { return renderer_; }
  bool has_mesh() const { return ready_; }
  /// The mesh is drawn faster than a picture of it could be kept.
  bool small() const { return small_; }
  /// Of the colours shown; none if elements are plain.
  const std::optional<Legend>& legend() const { return legend_; }

 private:
  /// What the colours depend on.
  struct ColorKey {
    std::shared_ptr<const QualityMonitor::Measured> measured;
    std::string map;
    int bands = 0;
    std::optional<std::array<double, 2>> range;
    Isolation isolation;

    bool operator==(const ColorKey&) const = default;
  };
  struct Colors {
    std::uint64_t generation = 0;
    std::shared_ptr<const Topology> topology;
    std::vector<std::uint32_t> rgba;
    std::vector<float> opacity;
    Legend legend;
  };
  struct Built {
    std::uint64_t generation = 0;
    PreparedMesh mesh;
  };
  static Colors compute(const ColorKey& key, std::uint64_t generation);
  void take(Built built);
  void take(Colors colors);

  MeshRenderer renderer_;
  bool ready_ = false;  // the renderer has a mesh of the present generation
  bool small_ = true;
  std::uint64_t generation_ = 0, shape_ = 0;
  std::optional<ColorKey> painted_;  // that the colours are, or will be, of
  std::optional<Legend> legend_;
  Background<std::shared_ptr<Built>> builder_;
  Background<std::shared_ptr<Colors>> painter_;
};

}  // namespace winslow::gui
