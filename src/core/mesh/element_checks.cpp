#include "core/mesh/element_checks.h"

#include <string>

#include "core/error.h"

namespace winslow {

namespace {

void check_type(const MeshData& data, Index e) {
  const ElementType type = data.types[static_cast<std::size_t>(e)];
  const std::string found =
      "element " + std::to_string(e) + " is a " + std::string(shape_of(type).name);
  if (dimension_of(type) != data.cell_dimension()) {
    throw MeshError(MeshEntity::element, e,
                    found + ", expected elements of dimension " +
                        std::to_string(data.cell_dimension()) + " as element 0 is");
  }
  const std::size_t corners = data.element(e).size();
  if (corners != static_cast<std::size_t>(corner_count(type))) {
    throw MeshError(MeshEntity::element, e,
                    found + " with " + std::to_string(corners) + " corners, expected " +
                        std::to_string(corner_count(type)));
  }
}

void check_corners(const MeshData& data, Index e) {
  const Index nodes = data.node_count();
  const auto corners = data.element(e);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (corners[k] < 0 || corners[k] >= nodes) {
      throw MeshError(MeshEntity::element, e,
                      "element " + std::to_string(e) + " uses node " + std::to_string(corners[k]) +
                          ", expected 0 to " + std::to_string(nodes - 1));
    }
    for (std::size_t m = 0; m < k; ++m) {
      if (corners[m] == corners[k]) {
        throw MeshError(MeshEntity::element, e,
                        "element " + std::to_string(e) + " uses node " +
                            std::to_string(corners[k]) + " twice, expected distinct corners");
      }
    }
  }
}

}  // namespace

void check_elements(const MeshData& data) {
  if (data.element_count() == 0) throw MeshError(MeshEntity::mesh, 0, "the mesh has no elements");
  if (data.cell_dimension() > data.coordinates.dimension()) {
    throw MeshError(MeshEntity::element, 0,
                    "element 0 is a " + std::string(shape_of(data.types.front()).name) +
                        " between points of the plane, expected points of space");
  }
  for (Index e = 0; e < data.element_count(); ++e) {
    check_type(data, e);
    check_corners(data, e);
  }
}

}  // namespace winslow
