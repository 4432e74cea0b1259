#pragma once

#include "core/inspect/space/plane_section.h"
#include "core/search/box_tree.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/view.h"

namespace winslow::gui {

/// Most planes by which a scene is clipped.
inline constexpr std::size_t most_clip_planes = 6;
/// Value of clipped_by for clipping by all planes, however many there are.
inline constexpr unsigned by_all_planes = std::numeric_limits<unsigned>::max();

/// A corner of a triangle in the form that the graphics card needs: single precision, relative to
/// the scene's origin.
struct SpaceCorner {
  std::array<float, 3> position, normal;  ///< the normal of either side, of length 1
  std::uint32_t rgba;
};

/// Triangles that are drawn in one way; 3 corners each.
struct SpaceFill {
  std::vector<SpaceCorner> corners;
  std::vector<Index> elements;  ///< one per triangle, for picking with the mouse
  Index marker = -1;            ///< of all of them; -1: none, or several
  /// Strength of the shading by the light, from 0 (colours as given) to 1.
  float shading = 0;
  float opacity = 1;  ///< below 1, only the nearest layer is drawn
  /// Drawn above what is in the same place, and faintly through what hides it.
  bool emphasised = false;
  /// Bit k: what lies in front of the scene's plane k is left out, if it has that many.
  unsigned clipped_by = 0;
};

/// Lines that are drawn in one way.
struct SpaceLines {
  struct End {
    std::array<float, 3> position;
    /// Distance to the next parallel line, units of the mesh: lines that come closer together on
    /// screen fade, see draw_list.h. 0: never.
    float spacing;
  };
  std::vector<End> ends;  ///< 2 each
  Rgba color{0, 0, 0, 1};
  float width = 1;  ///< pixels
  unsigned clipped_by = 0;
  Index marker = -1;  ///< whose border line they are; -1: of none
};

/// A scene in space, in drawing order: fills, then lines; nearer items hide those behind them.
/// Independent of OpenGL.
struct SpaceScene {
  Vec3 origin{0, 0, 0};
  Box<3> extent{};
  std::vector<Plane> planes;  ///< at most most_clip_planes
  std::vector<SpaceFill> fills;
  std::vector<SpaceLines> lines;

  /// Position in the mesh of a corner or an end.
  Vec3 place_of(const std::array<float, 3>& position) const {
    return origin + Eigen::Vector3f(position.data()).cast<double>();
  }
};

/// The visible point at a place of the screen.
struct SpaceHit {
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 1};  ///< of length 1, towards the viewer
  Index element = -1;    ///< the visible element
  Index marker = -1;     ///< of the boundary; -1: none, or a cut through the mesh
};

/// The nearest hit of a ray with triangles of scenes clipped by these planes: only what is drawn
/// can be hit. The ray passes through see-through surfaces.
std::optional<SpaceHit> pick_in_scene(std::span<const std::shared_ptr<const SpaceScene>> parts,
                                      std::span<const Plane> planes, const Ray<3>& ray);

/// A point of a volume mesh on screen.
struct DeepPlace {
  ScreenPoint at;
  double depth = 0;
  bool hidden = false;
};
/// Marks places that a triangle of the picture hides: it lies nearer to the viewer and is neither
/// see-through nor cut away.
void hide_behind(const View& view, std::span<const std::shared_ptr<const SpaceScene>> parts,
                 std::span<const Plane> planes, std::span<DeepPlace> places);

/// True if one of these planes (those whose bits are set in `by`) cuts the point away.
bool cut_away(const Vec3& point, unsigned by, std::span<const Plane> planes);

/// A triangle of a fill on screen.
struct SeenTriangle {
  std::array<Vec3, 3> at;
  std::array<View::Projection, 3> seen;

  SeenTriangle(const SpaceFill& fill, std::size_t first, const SpaceScene& scene,
               const View& view) {
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = scene.place_of(fill.corners[first + k].position);
      seen[k] = view.project(at[k]);
    }
  }
  ScreenVector side(std::size_t k) const { return seen[(k + 1) % 3].at - seen[k].at; }
  double area() const;
  double girth() const { return side(0).norm() + side(1).norm() + side(2).norm(); }
  bool near(const ScreenBox& box) const {
    const auto out = [&](auto&& beyond) { return std::ranges::all_of(seen, beyond); };
    return !(out([&](const auto& p) { return p.at.x() < box.min.x(); }) ||
             out([&](const auto& p) { return p.at.x() > box.max.x(); }) ||
             out([&](const auto& p) { return p.at.y() < box.min.y(); }) ||
             out([&](const auto& p) { return p.at.y() > box.max.y(); }));
  }
  /// Weights of the corners at a place; negative ones outside.
  std::array<double, 3> weights(const ScreenPoint& p) const;
};

}  // namespace winslow::gui
