#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/inspect/element_field.h"
#include "core/mesh/mesh.h"

/// What a picture of a mesh in space tells of its elements (#elements each). given: of a surface
/// mesh, the mesh that it was; null: it is that mesh.
namespace winslow::gui {

/// Which side elements of a surface mesh should face; empty: another kind of mesh.
std::vector<Vec3> normals_of(const Mesh& mesh, const std::shared_ptr<const Mesh>& given);
/// 1 or 0. normals: normals_of().
std::vector<unsigned char> inverted_elements(const Mesh& mesh, std::span<const Vec3> normals);
std::vector<double> values_of(const Mesh& mesh, const ElementField& field,
                              const std::shared_ptr<const Mesh>& given,
                              std::span<const Vec3> normals);
/// 1 for values that are worse than the threshold, or no numbers.
std::vector<unsigned char> worse_than(double threshold, const ElementField& field,
                                      std::span<const double> values);
/// Of those that are not 0.
Index count_of(std::span<const unsigned char> flags);

}  // namespace winslow::gui
