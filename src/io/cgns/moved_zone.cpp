#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "io/cgns/zone_writer.h"
#include "io/format/mesh_in_space.h"

namespace winslow::io::cgns {
namespace {

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// One coordinate of every vertex of a zone.
class MovedCoordinate {
 public:
  MovedCoordinate(const Node& array, const Mesh& mesh, const Details& details, int direction)
      : values_(reals_of(array)), single_(array.type == "R4") {
    const std::vector<double> old = values_;
    std::vector<std::size_t> first(static_cast<std::size_t>(mesh.coordinates.size()), old.size());
    for (std::size_t v = 0; v < old.size(); ++v) {
      const Index node =
          details.node_of_vertex.empty() ? static_cast<Index>(v) : details.node_of_vertex[v];
      if (first[at(node)] == old.size()) first[at(node)] = v;
      const double value = place_in_space(&details, mesh.coordinates, node)[direction];
      // Bits, for -0 is kept, too. Vertices of a closed cut may differ by less than they are told
      // apart by; they keep that while their node stays.
      if (bits(value) == bits(old[first[at(node)]])) continue;
      values_[v] = value;
      moved_ = true;
    }
  }

  bool moved() const { return moved_; }
  bool single() const { return single_; }
  bool fits_single() const {
    for (const double value : values_)
      if (static_cast<double>(static_cast<float>(value)) != value) return false;
    return true;
  }

  NodePtr node(const Node& array, bool as_single) const {
    auto moved = as_single ? make_single_reals(array.name, array.label,
                                               std::vector<float>(values_.begin(), values_.end()),
                                               array.dims)
                           : make_reals(array.name, array.label, values_, array.dims);
    moved->children = array.children;
    return moved;
  }

 private:
  std::vector<double> values_;
  bool single_, moved_ = false;
};

/// Normals are those of the mesh before it moved. Returns null if there are none.
NodePtr without_normals(const Node& zone, std::vector<std::string>& dropped) {
  const NodePtr all = child_labelled(zone, "ZoneBC_t");
  if (!all || all->is_link()) return nullptr;
  auto copy = own_copy(*all);
  bool changed = false;
  for (NodePtr& condition : copy->children) {
    if (const NodePtr normals = child_named(*condition, "InwardNormalList")) {
      dropped.push_back(condition->name);
      condition = with_child(*condition, *normals, nullptr);
      changed = true;
    }
  }
  return changed ? with_child(zone, *all, copy) : nullptr;
}

NodePtr without_stale(NodePtr zone, std::vector<std::string>& warnings) {
  std::vector<std::string> solutions, normals;
  for (const NodePtr& child : zone->children)
    if (child->content().label == "FlowSolution_t") solutions.push_back(child->name);
  if (!solutions.empty()) {
    warnings.push_back(listed_names(solutions) +
                       " of the file was computed before the mesh moved: it is kept as it was, as "
                       "a solution to start from");
  }
  if (const NodePtr clean = without_normals(*zone, normals)) {
    zone = clean;
    warnings.push_back("the normals (InwardNormalList) of " + listed_names(normals) +
                       " were those before the mesh moved: they are not written");
  }
  return zone;
}

}  // namespace

std::string listed_names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) text += k + 1 == names.size() ? " and " : ", ";
    text += '"' + names[k] + '"';
  }
  return text;
}

NodePtr moved_zone(const NodePtr& zone, const Mesh& mesh, const Details& details,
                   std::vector<std::string>& warnings) {
  const NodePtr grid = child_named(zone->content(), "GridCoordinates");
  auto moved_grid = own_copy(*grid);
  std::vector<std::pair<NodePtr, MovedCoordinate>> coordinates;
  bool moved = false, single = true, fits = true;
  constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
  // Nodes that move in a plane z = constant keep their z.
  const bool in_space = details.plane || mesh.coordinates.dimension() == 3;
  const int directions = in_space ? 3 : 2;
  for (int direction = 0; direction < directions; ++direction) {
    const NodePtr array = child_named(*moved_grid, names[at(direction)]);
    coordinates.emplace_back(array, MovedCoordinate(array->content(), mesh, details, direction));
    moved = moved || coordinates.back().second.moved();
    single = single && coordinates.back().second.single();
    fits = fits && coordinates.back().second.fits_single();
  }
  if (!moved) return zone;
  if (single && !fits) {
    warnings.emplace_back(
        "the coordinates were in single precision (R4): they are written in double (R8), for the "
        "new ones need it");
  }
  for (const auto& [array, values] : coordinates) {
    *moved_grid = *with_child(*moved_grid, *array, values.node(*own_copy(*array), single && fits));
  }
  return without_stale(with_child(*zone, *grid, moved_grid), warnings);
}

}  // namespace winslow::io::cgns
