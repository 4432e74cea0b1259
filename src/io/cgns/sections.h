#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh_data.h"
#include "io/cgns/zones.h"

namespace winslow::io::cgns {

/// What the elements of an unstructured zone are, by their numbers in it.
class ElementNumbers {
 public:
  static constexpr Index cell = -1, none = -2;
  /// Place of an element among the lines; `cell`: it is one of the mesh (or a point); `none`: the
  /// zone has none of that number.
  Index find(std::int64_t number) const;
  std::int64_t last() const { return ranges_.empty() ? 0 : ranges_.back().last; }

  struct Range {
    std::int64_t first, last;
    std::vector<Index> lines;  ///< of each number, or `cell`; empty: all are cells
  };
  /// In ascending order.
  void add(Range range) { ranges_.push_back(std::move(range)); }

 private:
  std::vector<Range> ranges_;
};

/// The elements of dimension 1: what markers are made of.
struct ZoneLines {
  struct Section {
    std::string name;
    std::size_t first, count;  ///< of its lines in `faces`
  };
  std::vector<Face> faces;
  std::vector<Section> sections;
  ElementNumbers numbers;
};

/// Reads all sections (Elements_t), in the order of their element numbers: elements of dimension 2
/// into the mesh, lines into the result, points not at all. Throws InputError for elements of other
/// kinds, naming them.
ZoneLines read_sections(const NodeView& zone, const ZoneHead& head, MeshData& mesh);

}  // namespace winslow::io::cgns
