#pragma once

#include <array>

#include "core/mesh/mesh.h"
#include "io/format/mesh_file.h"

namespace winslow::io {

/// Corners of an element in the direction of the file.
struct FileCorners {
  std::array<Index, 8> nodes{};
  std::size_t count = 0;

  std::size_t size() const { return count; }
  Index operator[](std::size_t k) const { return nodes[k]; }
  const Index* data() const { return nodes.data(); }
  const Index* begin() const { return nodes.data(); }
  const Index* end() const { return nodes.data() + count; }
};

/// A plane mesh where its file had it, or a volume mesh as it is: what formats with three
/// coordinates write.
class MeshInSpace {
 public:
  /// details: null for a mesh of the plane z = 0. Both have to outlive this.
  MeshInSpace(const Mesh& mesh, const FormatDetails* details) : mesh_(mesh), details_(details) {}

  Vec3 node(Index i) const;
  FileCorners element(Index e) const;
  /// Of a plane mesh: against which elements go round counter-clockwise; a unit vector.
  Vec3 normal() const;

 private:
  const Mesh& mesh_;
  const FormatDetails* details_;
};

/// Where a node is: of a plane mesh, where the file had its plane.
Vec3 place_in_space(const FormatDetails* details, const Coordinates& x, Index node);

}  // namespace winslow::io
