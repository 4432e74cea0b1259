#pragma once

#include "io/format/parsed_mesh.h"

/// Mends files that hold no mesh: surfaces and meshes as scanners, CAD and converters leave them.
///
///     ParsedMesh parsed = format.read(source);
///     for (const std::string& done : repair(parsed, source)) std::cout << done << '\n';
///     const Mesh mesh = make_mesh(parsed.data);
namespace winslow::io {

/// Mends a mesh, in this order:
///
/// - points at exactly the same place become one (so cracks and baffles without thickness close);
/// - elements that use a point twice: quadrilaterals become triangles; hexahedra, prisms, pyramids,
///   polygons and polyhedra what is left of them; others are left out;
/// - elements with the points of an earlier one are left out;
/// - triangles without area: the element beyond the longest edge is cut at the middle point, so
///   that no hole stays; at the border they are left out;
/// - surfaces: elements are turned to face as the others of their part; of a closed part outwards;
/// - points that no element uses, and faces of markers that are sides of no element, are left out.
///
/// A mesh in which an element uses a point that does not exist is damaged: nothing is mended.
/// Returns a sentence for each that says how many and where the first one is; none: the mesh is
/// unchanged. Otherwise the details of the format are gone: the mesh is written as one of another
/// format would be.
std::vector<std::string> repair(ParsedMesh& mesh, const Source& source);

/// Leaves out what keeps a mesh from being shown: elements that use a point twice or one that does
/// not exist, elements with the points of an earlier one, those beyond two at an edge or face. A
/// point where parts of a plane or surface mesh only touch becomes one for each part. Returns
/// sentences as repair() does.
std::vector<std::string> leave_out_defects(ParsedMesh& mesh, const Source& source);

}  // namespace winslow::io
