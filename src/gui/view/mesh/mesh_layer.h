#pragma once

#include "core/quality/validity.h"
#include "gui/base/background.h"
#include "gui/document/session/quality_watch.h"
#include "gui/document/session/session.h"
#include "gui/render/color_scale.h"
#include "gui/render/mesh_renderer.h"
#include "gui/settings/view_options.h"
#include "gui/widgets/legend.h"

namespace winslow::gui {

/// Number and size of the elements of a mesh in space that are shown without the others.
struct ShownAlone {
  Index count = 0;
  double size = 0;  ///< volume, in cubed units of the mesh; of a surface its area
};

/// The mesh on screen. The mesh of the session may already be newer.
struct ShownMesh {
  std::uint64_t shape = 0;  ///< LiveMesh::shape()
  Validity validity;
  std::optional<ShownAlone> alone = {};  ///< of a mesh in space; none: all are shown
};

/// One mesh on screen with its colours. A large mesh is prepared in the background; until it is
/// ready, the previous picture stays.
class MeshLayer {
 public:
  /// Call in every frame. shape: grows with every change of the coordinates; generation: with every
  /// other mesh.
  void update(const std::shared_ptr<const Topology>& topology, const Coordinates& coordinates,
              std::uint64_t generation, std::uint64_t shape);
  /// Sets the values to colour by: those of view.color; null: plain elements.
  void color(const std::shared_ptr<const QualityMonitor::Measured>& measured,
             const ViewOptions& view);
  /// Adopts finished work of the background. True if the picture changes.
  bool poll();
  /// The picture is still older than the last update() and color().
  bool busy() const { return builder_.busy() || painter_.busy(); }

  MeshRenderer& renderer() { return renderer_; }
  bool has_mesh() const { return shown_.has_value(); }
  /// None before the first picture of a generation.
  const std::optional<ShownMesh>& shown() const { return shown_; }
  /// The mesh is so small that drawing it is faster than keeping a picture of it.
  bool small() const { return small_; }
  /// Legend of the colours shown; none if elements are plain.
  const std::optional<Legend>& legend() const { return legend_; }

 private:
  /// What the colours depend on.
  struct ColorKey {
    std::shared_ptr<const QualityMonitor::Measured> measured;
    ColorChoice choice;
    Isolation isolation;
    std::optional<Rgb> inverted;  // named in the legend

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
    ShownMesh shown;
    PreparedMesh mesh;
  };
  static Built build(std::uint64_t generation, std::uint64_t shape,
                     const std::shared_ptr<const Topology>& topology,
                     const Coordinates& coordinates, std::shared_ptr<const EdgeGroups> groups);
  static Colors compute(const ColorKey& key, std::uint64_t generation);
  void adopt(Built built);
  void adopt(Colors colors);

  MeshRenderer renderer_;
  std::optional<ShownMesh> shown_;  // mesh of the renderer, if of the present generation
  bool small_ = true;
  std::uint64_t generation_ = 0, shape_ = 0;
  std::optional<ColorKey> painted_;  // key of the colours shown or being computed
  std::optional<Legend> legend_;
  Background<std::shared_ptr<Built>> builder_;
  Background<std::shared_ptr<Colors>> painter_;
};

/// The state with which the present mesh is compared: its nodes and its quality.
class BeforeMesh {
 public:
  /// Call in every frame. view: in a coloured comparison side by side, its field is measured, too.
  void update(const LiveMesh& mesh, const ViewOptions& view);
  /// True if a measurement has finished.
  bool poll() { return monitor_.poll(); }
  bool busy() const { return monitor_.busy(); }

  /// Null without a mesh.
  const Coordinates* coordinates() const { return coordinates_; }
  /// Topology of coordinates(): not the present one if a command in between changed it.
  const std::shared_ptr<const Topology>& topology() const { return topology_; }
  /// Grows with every change of coordinates().
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
