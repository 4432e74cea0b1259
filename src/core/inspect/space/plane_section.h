#pragma once

#include "core/inspect/space/section_index.h"
#include "core/mesh/index_sets.h"
#include "core/mesh/mesh.h"

/// Cuts through volume meshes: flat ones, and such of whole elements.
namespace winslow {

/// Where a plane cuts the elements of a volume mesh: polygons that tile the section without gaps.
///
/// A corner of a polygon lies where the plane meets an edge, linearly between its ends; a side lies
/// in a face of the element, and is a side of the polygon of the element beyond that face, too. In
/// a quadrilateral whose corners lie in front and behind by turns there are two sides; which two
/// says the sign of the distance at the face's saddle, interpolated bilinearly, which is the same
/// for both elements.
struct PlaneSection {
  std::vector<Vec3> points;     ///< each once
  CompressedRows polygons;      ///< indices into points, counter-clockwise seen from the front of
                                ///< the plane (of inverted elements perhaps the other way round)
  std::vector<Index> elements;  ///< of each polygon; an element may have several
};

/// Nodes nearer to the plane than 1e-10 of the mesh's extent count as on it, and with what lies in
/// front: where the plane runs along faces, the elements behind them are shown. If there are none,
/// as at one end of the mesh, those in front are. index: of this mesh; polygons and points are the
/// same, in another order. Throws UsageError unless it is a volume mesh.
PlaneSection plane_section(const Mesh& mesh, const Plane& plane,
                           const SectionIndex* index = nullptr);

/// 1 for each element (#elements) that a crinkled cut leaves: some part of it lies behind each of
/// the planes. What only touches a plane from in front is not left.
std::vector<unsigned char> elements_behind(const Mesh& mesh, std::span<const Plane> planes);

/// The triangles of a polygon, 3 indices into its corners each, n - 2 triangles; no corner is
/// added. The polygon lies in a plane with this normal and is counter-clockwise about it; one that
/// is not, or crosses itself, is cut up somehow.
std::vector<Index> cut_polygon(std::span<const Vec3> corners, const Vec3& normal);

}  // namespace winslow
