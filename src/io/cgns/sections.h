#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh_data.h"
#include "io/cgns/zones.h"

namespace winslow::io::cgns {

/// What an element of a zone is, by its number.
struct ElementPlace {
  enum class Kind : std::uint8_t { none, point, line, cell };
  Kind kind = Kind::none;  ///< none: the zone has no element of that number
  Index index = -1;        ///< among the lines of the zone, or among the elements of the mesh
};

/// What the elements of an unstructured zone are.
class ElementNumbers {
 public:
  ElementPlace find(std::int64_t number) const;
  std::int64_t last() const { return ranges_.empty() ? 0 : ranges_.back().last; }

  struct Range {
    std::int64_t first, last;
    std::vector<ElementPlace> places;  ///< of each number; one alone: of the first, others follow
  };
  /// In ascending order. Places that follow one another are kept as one.
  void add(Range range);

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
