#pragma once

#include <span>
#include <vector>

#include "io/gmsh/gmsh.h"
#include "io/gmsh/node_tags.h"
#include "io/gmsh/value_reader.h"

namespace winslow::io::gmsh {

/// Reads $Elements.
class ElementReader {
 public:
  /// What is read goes into `details` and `mesh`, which outlive this, as do the scanner and the
  /// tags of the nodes.
  ElementReader(Scanner& scan, const NodeTags& node_tags, Details& details, ParsedMesh& mesh)
      : scan_(scan), node_tags_(node_tags), details_(details), mesh_(mesh) {}
  void read();

  /// Where each of Details::items begins in the file.
  const std::vector<std::size_t>& offsets() const { return offsets_; }
  /// Some elements belong to partitions, which are not kept.
  bool partitioned() const { return partitioned_; }

 private:
  struct Record {
    Item item;
    std::size_t offset;
    Expected expected;
  };
  void read_version_2(ValueReader& values);
  void read_version_2_text(ValueReader& values, Index count);
  void read_version_2_binary(ValueReader& values, Index count);
  void read_version_4(ValueReader& values);
  Shape find_shape(int type, std::size_t offset) const;
  void skip_tag(ValueReader& values, int position, Item& item, const Expected& expected);
  void read_element_nodes(ValueReader& values, const Record& record);
  void distribute();
  void place(std::size_t i, std::span<const Index> corners, const Item* last);
  bool repeats(const Item& last, const Item& item, std::span<const Index> corners) const;
  const Source& source() const { return scan_.source(); }

  Scanner& scan_;
  const NodeTags& node_tags_;
  Details& details_;
  ParsedMesh& mesh_;
  std::vector<std::size_t> offsets_;
  std::vector<Index> corners_;  // of all items; which are elements is known at the end
  bool partitioned_ = false;
};

}  // namespace winslow::io::gmsh
