#pragma once

#include "core/inspect/space/plane_section.h"
#include "core/mesh/surface_faces.h"
#include "gui/render/space/space_scene.h"

namespace winslow::gui {

/// Puts surfaces and sections of a mesh into the lists of a scene, relative to an origin.
class SceneLists {
 public:
  SceneLists(const Mesh& mesh, const Vec3& origin) : x_(mesh.coordinates), origin_(origin) {}

  /// Colour of a face or of a polygon by its number.
  using Color = std::function<std::uint32_t(std::size_t)>;

  void add_faces(SpaceFill& fill, std::span<const SurfaceFace> faces, const Color& color) const;
  void add_section(SpaceFill& fill, const PlaneSection& section, const Plane& plane,
                   const Color& color) const;

  /// Edges of a surface: those that show its form, and the others.
  struct EdgeLists {
    SpaceLines* feature;
    SpaceLines* other;  ///< null: left out
  };
  void add_edges(const EdgeLists& lists, std::span<const SurfaceFace> faces,
                 double feature_angle) const;
  /// Adds the sides of polygons: as features the outline of the section, and the others.
  void add_sides(const EdgeLists& lists, const PlaneSection& section) const;
  /// Adds edges of the mesh, given by their nodes.
  void add_lines(SpaceLines& lines, std::span<const Face> edges) const;
  /// Adds the intersection of a plane with faces.
  void add_cut(SpaceLines& lines, std::span<const SurfaceFace> faces, const Plane& plane) const;

 private:
  struct TriangleLook {
    Vec3 normal;
    std::uint32_t rgba;
    Index element;
  };
  void add_triangle(SpaceFill& fill, const std::array<Vec3, 3>& corners,
                    const TriangleLook& look) const;
  void add_line(SpaceLines& lines, const Vec3& a, const Vec3& b, double spacing) const;
  std::array<float, 3> relative(const Vec3& p) const;

  SpacePoints x_;
  Vec3 origin_;
};

}  // namespace winslow::gui
