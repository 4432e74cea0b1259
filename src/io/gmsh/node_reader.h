#pragma once

#include <cstdint>
#include <vector>

#include "io/gmsh/gmsh.h"
#include "io/gmsh/node_tags.h"
#include "io/gmsh/value_reader.h"

namespace winslow::io::gmsh {

/// Reads $Nodes.
class NodeReader {
 public:
  /// What is read goes into `details` and `mesh`, which outlive this, as does the scanner.
  NodeReader(Scanner& scan, Details& details, ParsedMesh& mesh)
      : scan_(scan), details_(details), mesh_(mesh) {}
  void read();

  const NodeTags& tags() const { return tags_; }
  /// x, y, z of each node.
  const std::vector<double>& xyz() const { return xyz_; }
  /// Some nodes have parametric coordinates, which are not kept.
  bool parametric() const { return parametric_; }

 private:
  void read_version_2(ValueReader& values);
  void read_version_4(ValueReader& values);
  void read_block(ValueReader& values, Index block, Index blocks, Index total);
  void add_tag(std::int64_t tag, std::size_t offset);
  void index_nodes();

  Scanner& scan_;
  Details& details_;
  ParsedMesh& mesh_;
  NodeTags tags_;
  std::vector<double> xyz_;
  bool parametric_ = false;
};

}  // namespace winslow::io::gmsh
