#pragma once

#include <unordered_set>

#include "core/mesh/mesh_data.h"
#include "io/format/mesh_file.h"
#include "io/text/source.h"

namespace winslow::io {

/// Byte offset of each item in the file, so that errors found later can name the place.
struct SourceMap {
  std::vector<std::size_t> nodes;
  std::vector<std::size_t> elements;
  std::vector<std::vector<std::size_t>> marker_edges;  ///< as MeshData::markers[m].faces
};

/// What a reader of one format returns.
struct ParsedMesh {
  MeshData data;
  SourceMap where;
  /// Never null; a format with more to keep sets an object of its own class.
  std::shared_ptr<FormatDetails> details = std::make_shared<FormatDetails>();
  std::vector<std::string> warnings;  ///< without the file's name
};

/// Sets the nodes' coordinates from x, y, z triples: x and y where z is constant, in-plane
/// coordinates (and a warning that says so) in any other plane. Throws InputError for a coordinate
/// that is not finite and for nodes that lie in no plane. Distances below 1e-9 of the extent count
/// as noise. `details` keeps the positions in space, to write them back.
void set_planar_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh);

/// Sets the nodes' coordinates in space, of a surface or volume mesh. Throws InputError for a
/// coordinate that is not finite.
void set_space_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh);
/// Calls set_space_nodes() if the elements have three dimensions or the nodes lie in no plane; else
/// set_planar_nodes(). The mesh must have its elements already.
void set_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh);

/// Reverses all elements of a mesh in a plane other than z = constant if they are clockwise there,
/// since the file then shows the plane from behind. The details record this, so that writing
/// reverses them again.
void turn_to_viewer(ParsedMesh& mesh);

/// Throws InputError "... not finite" at the first node with a NaN or an infinity.
void check_finite(const Source& source, const ParsedMesh& mesh);

/// Details of a format that lists the faces of markers among the other elements: the elements of
/// lower dimension than the mesh, in the order of the file, and those that make up each marker.
struct BoundaryDetails : FormatDetails {
  std::vector<Index> points;  ///< node of each point element
  /// Nodes of each line element and, where the mesh has volumes, of each triangle and each
  /// quadrilateral.
  std::vector<Face> sides;
  /// Sides of each marker, in its order: s, or ~s (negative) where the marker holds the reversed
  /// side (as Gmsh allows).
  std::vector<std::vector<Index>> marker_sides;

  /// The face of an entry of marker_sides.
  Face face(Index coded) const;
  /// True if the details still fit the mesh: the same numbers of nodes and elements, the same
  /// marker faces.
  bool fits(const Mesh& mesh) const;
};

/// Details of a format that holds markers as lists of faces, like Mesh.
struct MarkerDetails : FormatDetails {
  std::vector<Marker> markers;  ///< as they were read
  /// True if the details still fit the mesh: the same numbers of nodes and elements, the same
  /// markers.
  bool fits(const Mesh& mesh) const;
};

/// Name of the sides of elements of that dimension, of which markers consist: "edge" or "face".
constexpr const char* side_name(int cell_dimension) {
  constexpr std::array names{"", "", "edge", "face"};
  return names[at(cell_dimension)];
}
/// True if a face is a side: of one dimension less than the elements.
inline bool is_side(const Face& face, int cell_dimension) {
  const int dimension = face.size() == 2 ? 1 : 2;
  return dimension + 1 == cell_dimension;
}

/// Numbered groups of a file (physical groups, tagged cells). Every tag has a unique name.
class GroupIndex {
 public:
  /// A group without a name gets `prefix` and its tag as its name.
  explicit GroupIndex(std::string prefix) : prefix_(std::move(prefix)) {}

  bool contains(int tag) const { return index_.contains(tag); }
  std::size_t add(int tag, std::string name);
  /// Gives a group another tag besides its own.
  void add_tag(int tag, std::size_t group) { index_[tag] = group; }
  /// Position of the group in all(); the group is added if it is new.
  std::size_t find(int tag);
  const std::vector<Region>& all() const { return groups_; }

 private:
  std::string prefix_;
  std::map<int, std::size_t> index_;
  std::unordered_set<std::string> names_;
  std::vector<Region> groups_;
};

/// Records that a side (coded as in BoundaryDetails::marker_sides) at `offset` in the file belongs
/// to a marker.
void add_marker_side(std::size_t marker, Index side, std::size_t offset, BoundaryDetails& details,
                     ParsedMesh& mesh);
/// Makes the markers of the mesh from the groups and the recorded sides.
void make_markers(const std::vector<Region>& groups, BoundaryDetails& details, ParsedMesh& mesh);

/// Tags to write for groups: the given ones if they are positive and unique, else 1, 2, ...
std::vector<int> usable_tags(std::vector<int> tags, const char* what,
                             std::vector<std::string>& warnings);
template <class Group>
std::vector<int> tags_of(const std::vector<Group>& groups) {
  std::vector<int> tags;
  for (const Group& group : groups) tags.push_back(group.tag);
  return tags;
}

}  // namespace winslow::io
