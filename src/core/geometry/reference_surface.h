#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/mesh/face.h"
#include "core/types.h"

namespace winslow {

/// A surface that is given besides a mesh, for the nodes of the mesh to slide on: finer than the
/// mesh as a rule, from CAD or a scan. Lengths in the unit of the mesh.
struct ReferenceSurface {
  std::string source;  ///< name of the file, for messages
  std::vector<Vec3> points;
  std::vector<Face> faces;  ///< triangles and quadrilaterals, of points
};

/// The same, `origin` subtracted from its points.
std::shared_ptr<const ReferenceSurface> moved_to(const ReferenceSurface& surface,
                                                 const Vec3& origin);

}  // namespace winslow
