#pragma once

#include "io/cgns/point_set.h"
#include "io/cgns/sections.h"

namespace winslow::io::cgns {

/// Boundary edges of an unstructured zone: lines by the numbers of their elements, or boundary
/// edges by their vertices. What it is made of has to outlive it.
class UnstructuredBoundary : public ZoneBoundary {
 public:
  UnstructuredBoundary(const MeshData& mesh, const ZoneLines& lines, std::int64_t vertices)
      : lines_(lines), vertices_(vertices), by_nodes_(mesh) {}
  std::vector<Face> faces_of(const PointSet& set,
                             std::vector<std::string>& warnings) const override;

 private:
  const ZoneLines& lines_;
  std::int64_t vertices_;
  BoundaryByNodes by_nodes_;
};

}  // namespace winslow::io::cgns
