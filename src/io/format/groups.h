#pragma once

#include <map>
#include <unordered_set>

#include "io/format/mesh_file.h"
#include "io/format/parsed_mesh.h"

namespace winslow::io {

/// Details of a format that mixes the faces of markers with other elements in one list: which
/// elements of less than the mesh's dimension there are, in the order of the file, and which of
/// them make up each marker.
struct BoundaryDetails : FormatDetails {
  std::vector<Index> points;  ///< node of each point element
  /// Nodes of each line element and, where the mesh has volumes, of each triangle and each
  /// quadrilateral.
  std::vector<Face> sides;
  /// Sides of each marker, in its order: s, or ~s (negative) where the marker holds the reversed
  /// side (as Gmsh allows).
  std::vector<std::vector<Index>> marker_sides;
  Index nodes = 0;  ///< sizes of the mesh that this belongs to
  Index elements = 0;

  /// The face that an entry of marker_sides stands for.
  Face face(Index coded) const;
  /// True if this still describes the mesh: as many nodes and elements, the same marker faces.
  bool fits(const Mesh& mesh) const;
};

/// Numbered groups of a file (physical groups, tagged cells): a name for every tag, no name twice.
class GroupIndex {
 public:
  /// A group without a name of its own is called after `prefix` and its tag.
  explicit GroupIndex(std::string prefix) : prefix_(std::move(prefix)) {}

  bool contains(int tag) const { return index_.contains(tag); }
  std::size_t add(int tag, std::string name);
  /// Position of the group in all(); the group is added if it is new.
  std::size_t find(int tag);
  const std::vector<Region>& all() const { return groups_; }

 private:
  std::string prefix_;
  std::map<int, std::size_t> index_;
  std::unordered_set<std::string> names_;
  std::vector<Region> groups_;
};

/// Notes that a side (coded as in BoundaryDetails::marker_sides), found at `offset` in the file,
/// belongs to a marker.
void add_marker_side(std::size_t marker, Index side, std::size_t offset, BoundaryDetails& details,
                     ParsedMesh& mesh);
/// Makes the markers of the mesh from the groups and from the sides that were noted.
void make_markers(const std::vector<Region>& groups, BoundaryDetails& details, ParsedMesh& mesh);

/// Tags to write for groups: their own if those are positive and differ, else 1, 2, ...
std::vector<int> usable_tags(std::vector<int> tags, const char* what,
                             std::vector<std::string>& warnings);
template <class Group>
std::vector<int> tags_of(const std::vector<Group>& groups) {
  std::vector<int> tags;
  for (const Group& group : groups) tags.push_back(group.tag);
  return tags;
}

}  // namespace winslow::io
