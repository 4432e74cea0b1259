#pragma once

#include "io/cgns/point_set.h"
#include "io/cgns/sections.h"

namespace winslow::io::cgns {

/// Boundary faces of an unstructured zone: sides by the numbers of their elements, or boundary
/// faces by their vertices. What it is made of has to outlive it.
class UnstructuredBoundary : public ZoneBoundary {
 public:
  UnstructuredBoundary(const MeshData& mesh, const ZoneSides& sides, const ZoneHead& head)
      : sides_(sides),
        vertices_(head.vertex_count),
        dimension_(head.cell_dimension),
        by_nodes_(mesh) {}
  std::vector<Face> faces_of(const PointSet& set,
                             std::vector<std::string>& warnings) const override;

 private:
  const ZoneSides& sides_;
  std::int64_t vertices_;
  int dimension_;  // of the cells
  BoundaryByNodes by_nodes_;
};

}  // namespace winslow::io::cgns
