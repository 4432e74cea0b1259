#pragma once

#include <unordered_map>

#include "core/types.h"
#include "io/gmsh/gmsh.h"
#include "io/text/source.h"

namespace winslow::io::gmsh {

/// Reads the numbers of a section from text or binary data, so that one parser serves both.
class ValueReader {
 public:
  ValueReader(Scanner& scan, bool binary) : scan_(scan), binary_(binary) {}

  bool binary() const { return binary_; }
  std::size_t offset() const { return scan_.offset(); }

  /// Start of a record: in text the next line that is not blank.
  std::size_t begin() {
    if (!binary_) scan_.skip_space();
    return scan_.offset();
  }
  void end(const Expected& expected) {
    if (!binary_) scan_.end_line(expected);
  }

  int integer(const Expected& expected) {
    if (binary_) return read_bytes<std::int32_t>(expected);
    const std::size_t start = scan_.offset();
    const auto value = scan_.integer(expected);
    if (value != static_cast<int>(value))
      scan_.source().fail(start, std::to_string(value), expected.text());
    return static_cast<int>(value);
  }
  std::int64_t size(const Expected& expected) {
    return binary_ ? read_bytes<std::int64_t>(expected) : scan_.integer(expected);
  }
  double real(const Expected& expected) {
    return binary_ ? read_bytes<double>(expected) : scan_.number(expected);
  }
  /// A count of items of at least `text_bytes` (in text) or `binary_bytes` bytes each.
  Index count(const Expected& expected, std::size_t text_bytes, std::size_t binary_bytes) {
    const std::size_t start = scan_.offset();
    const auto n = size(expected);
    return checked_count(scan_.source(), start, n, binary_ ? binary_bytes : text_bytes,
                         scan_.bytes_left(), expected);
  }

 private:
  template <class Number>
  Number read_bytes(const Expected& expected) {
    return scan_.bytes<Number>({std::is_floating_point_v<Number>, true, sizeof(Number)}, false,
                               expected);
  }

  Scanner& scan_;
  bool binary_;
};

/// Maps node tags, which may have gaps and any order, to node indices.
class NodeTags {
 public:
  /// Returns the index of the first node whose tag is already used, if any.
  std::optional<Index> build(const std::vector<std::int64_t>& tags);
  /// -1 if no node has the tag.
  Index find(std::int64_t tag) const;

 private:
  std::int64_t first_ = 0;
  std::vector<Index> dense_;  ///< by tag - first_
  std::unordered_map<std::int64_t, Index> sparse_;
};

/// Reads $Entities into Details::entities.
void read_entities(Scanner& scan, Details& details);
/// Reads $PartitionedEntities, the pieces into which Gmsh cut the entities, into Details::parts.
/// Returns the number of partitions.
std::int64_t read_parts(Scanner& scan, Details& details);

/// Reads $Periodic. In MSH 2 this section is text even in binary files.
std::vector<PeriodicLink> read_links(Scanner& scan, bool version_4, bool binary);

/// Makes pairs of markers from the links of `details` between entities of one dimension less than
/// the elements. Links of entities in no physical group are ignored; a link that covers only part
/// of a group becomes a pair with a fault. Nodes that are not in the file (of entities that Gmsh
/// did not save) are left out.
std::vector<GivenPairs> pairs_of(const Source& source, const Details& details, const NodeTags& tags,
                                 const MeshData& data);

/// Makes links from the periodic pairs of a file of another version or format. The mesh must have
/// one entity per marker, numbered from 1. For a mesh in a plane of space, affine transforms are
/// left out.
std::vector<PeriodicLink> links_of(const FormatDetails& source, const Mesh& mesh);

}  // namespace winslow::io::gmsh
