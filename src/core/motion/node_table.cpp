#include "core/motion/node_table.h"

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

/// The nodes that a table may prescribe.
class Candidates {
 public:
  /// Throws UsageError for an unknown marker, and for markers without nodes.
  Candidates(const Topology& topology, const std::vector<std::string>& markers)
      : topology_(topology), chosen_(at(topology.node_count()), 0), any_(markers.empty()) {
    if (any_) return;
    of_markers_ = moving_nodes(topology, markers);
    for (const Index node : of_markers_) chosen_[at(node)] = 1;
  }

  /// Nodes of the chosen markers, ascending; empty if none is chosen.
  const std::vector<Index>& of_markers() const { return of_markers_; }
  bool chosen(Index node) const { return chosen_[at(node)] != 0; }

  /// Why the node cannot be prescribed; empty: it can.
  std::string fault(Index node) const {
    if (node < 0 || node >= topology_.node_count())
      return "does not exist: the mesh has nodes 0 to " +
             std::to_string(topology_.node_count() - 1);
    if (!topology_.used(node)) return "belongs to no element";
    if (any_ || chosen(node) || !topology_.on_boundary(node)) return {};
    std::string where = "lies on a boundary without a marker";
    for (std::size_t m = 0; m < topology_.markers().size(); ++m)
      if (std::ranges::binary_search(topology_.markers().nodes(static_cast<Index>(m)), node))
        where = "lies on \"" + topology_.markers()[m].name +
                "\", which does not belong to the chosen markers";
    return where +
           ": choose its marker, too, or no marker at all, to prescribe every node of the "
           "table";
  }

 private:
  const Topology& topology_;
  std::vector<unsigned char> chosen_;
  std::vector<Index> of_markers_;
  bool any_;
};

/// Finds the nodes at a place.
template <int D>
class PlaceFinder {
 public:
  /// extent: of all places that will be looked for.
  PlaceFinder(const Topology& topology, const Coordinates& x, const Candidates& candidates,
              double extent)
      : topology_(topology), x_(x), candidates_(candidates), extent_(extent) {
    if (candidates.of_markers().empty()) return;
    const std::vector<Vec<D>> places = places_of(candidates.of_markers());
    marker_extent_ = Box<D>::around(places).size().maxCoeff();
    markers_ = BoxTree<D>(places);
  }

  /// All nodes at the place of the nearest node: those of the chosen markers if one of them is
  /// meant. Empty: no node is near enough.
  std::vector<Index> find(const Vec<D>& p) {
    if (const auto near = markers_.nearest(p, precision * marker_extent_)) {
      const Index node = candidates_.of_markers()[at(near->item)];
      return at_place_of(node, markers_, candidates_.of_markers());
    }
    if (all_.size() == 0) find_all();
    const auto near = all_.nearest(p, reach_);
    if (!near) return {};
    const Index node = used_[at(near->item)];
    if (!(near->distance <= std::max(precision * extent_, own * shortest_edge(node)))) return {};
    return at_place_of(node, all_, used_);
  }

 private:
  // Files written with six or seven digits must match.
  static constexpr double precision = 1e-6;
  static constexpr double own = 1e-2;  // of the edges around a node: no other node is meant

  std::vector<Vec<D>> places_of(const std::vector<Index>& nodes) const {
    std::vector<Vec<D>> places;
    places.reserve(nodes.size());
    for (const Index node : nodes) places.push_back(x_.get<D>(node));
    return places;
  }

  void find_all() {
    for (Index node = 0; node < topology_.node_count(); ++node)
      if (topology_.used(node)) used_.push_back(node);
    const std::vector<Vec<D>> places = places_of(used_);
    reach_ = Box<D>::around(places).size().norm();
    all_ = BoxTree<D>(places);
  }

  double shortest_edge(Index node) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Index other : topology_.neighbours(node))
      shortest = std::min(shortest, (x_.get<D>(other) - x_.get<D>(node)).norm());
    return shortest;
  }

  /// The nodes of the tree at exactly the place of a node, ascending.
  std::vector<Index> at_place_of(Index node, const BoxTree<D>& tree,
                                 const std::vector<Index>& nodes) const {
    std::vector<Index> found;
    const Vec<D> p = x_.get<D>(node);
    tree.overlapping({p, p}, [&](Index item) { found.push_back(nodes[at(item)]); });
    std::ranges::sort(found);
    return found;
  }

  const Topology& topology_;
  const Coordinates& x_;
  const Candidates& candidates_;
  double extent_, marker_extent_ = 0;
  BoxTree<D> markers_;       // of the nodes of the chosen markers
  std::vector<Index> used_;  // all nodes of elements, found when first needed
  BoxTree<D> all_;           // of used_
  double reach_ = 0;
};

std::string name_of(const DisplacementEntry& entry) {
  if (entry.node) return "node " + std::to_string(*entry.node);
  const GivenVector& p = entry.position;
  std::string text = "position (" + std::to_string(p.x()) + ", " + std::to_string(p.y());
  if (p.numbers(2) == 3) text += ", " + std::to_string(p.z());
  return text + ")";
}
std::string name_of(const PositionEntry& entry) { return "node " + std::to_string(entry.node); }

const char* file_of(const DisplacementTable&) { return "displacements"; }
const char* file_of(const PositionTable&) { return "positions"; }

/// Refuses an entry of a table.
template <class Table>
[[noreturn]] void refuse(const Table& table, std::size_t k, const std::string& why) {
  const auto& entry = table.entries[k];
  const std::string file = table.source.empty() ? file_of(table) : table.source;
  const std::string line = entry.line > 0 ? ":" + std::to_string(entry.line) : "";
  throw UsageError(file + line + ": " + name_of(entry) + " " + why);
}

/// A vector of an entry. Throws UsageError if a component is missing.
template <int D, class Table>
Vec<D> components(const Table& table, std::size_t k, const GivenVector& given, const char* missing,
                  const char* expected) {
  if (given.numbers(D) < D)
    refuse(table, k,
           std::string("has no ") + missing + ": found a table for plane meshes, expected " +
               expected);
  return given.head<D>();
}

/// Where the nodes of a table go, found entry by entry.
template <int D>
class Destinations {
 public:
  explicit Destinations(const Candidates& candidates, Index node_count)
      : candidates_(candidates), nodes_(candidates.of_markers()), row_(at(node_count), -1) {}

  /// Sets the way of one node. Refuses the entry if the node cannot be prescribed or already is.
  template <class Table>
  void set(const Table& table, std::size_t k, Index node, const Vec<D>& way, const Vec<D>& end) {
    if (const std::string fault = candidates_.fault(node); !fault.empty())
      refuse(table, k, of_place(table, k, node) + fault);
    Index& row = row_[at(node)];
    if (row >= 0) refuse(table, k, of_place(table, k, node) + "is given twice");
    row = static_cast<Index>(ways_.size());
    ways_.push_back(way);
    ends_.push_back(end);
    if (!candidates_.chosen(node)) nodes_.push_back(node);
  }

  /// Nodes of the markers without an entry stay.
  std::unique_ptr<Motion> take(const Coordinates& rest) {
    std::ranges::sort(nodes_);
    std::vector<Vec<D>> ways, ends;
    for (const Index node : nodes_) {
      const Index row = row_[at(node)];
      ways.push_back(row < 0 ? Vec<D>(Vec<D>::Zero()) : ways_[at(row)]);
      ends.push_back(row < 0 ? rest.get<D>(node) : ends_[at(row)]);
    }
    return straight_motion<D>(std::move(nodes_), std::move(ways), std::move(ends));
  }

 private:
  /// Which of the nodes at its place an entry is refused for; empty if it gives the node itself.
  static std::string of_place(const DisplacementTable& table, std::size_t k, Index node) {
    if (table.entries[k].node) return {};
    return "is the place of node " + std::to_string(node) + ", which ";
  }
  static std::string of_place(const PositionTable&, std::size_t, Index) { return {}; }

  const Candidates& candidates_;
  std::vector<Index> nodes_;
  std::vector<Index> row_;  // of each node: index into ways_; -1: none
  std::vector<Vec<D>> ways_, ends_;
};

/// The extent of all places that a table names.
template <int D>
double extent_of(const DisplacementTable& table) {
  Box<D> box = Box<D>::empty();
  for (const DisplacementEntry& entry : table.entries)
    if (!entry.node && entry.position.allFinite()) box.add(entry.position.head<D>());
  const double extent = box.size().maxCoeff();
  return extent > 0 ? extent : 0;
}

template <int D>
std::unique_ptr<Motion> motion_of(const Topology& topology, const Coordinates& rest,
                                  const Candidates& candidates, const DisplacementTable& table) {
  constexpr const char* expected = "node,dx,dy,dz or x,y,z,dx,dy,dz";
  PlaceFinder<D> finder(topology, rest, candidates, extent_of<D>(table));
  Destinations<D> destinations(candidates, topology.node_count());
  for (std::size_t k = 0; k < table.entries.size(); ++k) {
    const DisplacementEntry& entry = table.entries[k];
    const Vec<D> way = components<D>(table, k, entry.displacement, "dz", expected);
    if (!way.allFinite()) refuse(table, k, "has a displacement that is not finite");
    std::vector<Index> nodes;
    if (entry.node)
      nodes = {*entry.node};
    else
      nodes = finder.find(components<D>(table, k, entry.position, "z", expected));
    if (nodes.empty())
      refuse(table, k,
             candidates.of_markers().empty()
                 ? "matches no node"
                 : "matches no node of the chosen markers, and none inside the mesh");
    for (const Index node : nodes) {
      const bool there = node >= 0 && node < topology.node_count();
      const Vec<D> place = there ? rest.get<D>(node) : Vec<D>(Vec<D>::Zero());
      destinations.set(table, k, node, way, Vec<D>(place + way));
    }
  }
  return destinations.take(rest);
}

template <int D>
std::unique_ptr<Motion> motion_of(const Topology& topology, const Coordinates& rest,
                                  const Candidates& candidates, const PositionTable& table) {
  Destinations<D> destinations(candidates, topology.node_count());
  for (std::size_t k = 0; k < table.entries.size(); ++k) {
    const auto& [node, position, line] = table.entries[k];
    const Vec<D> end = components<D>(table, k, position, "z", "node,x,y,z");
    if (!end.allFinite()) refuse(table, k, "has a position that is not finite");
    const bool there = node >= 0 && node < topology.node_count();
    destinations.set(table, k, node, there ? Vec<D>(end - rest.get<D>(node)) : end, end);
  }
  return destinations.take(rest);
}

template <class Table>
std::unique_ptr<Motion> motion_of_table(const Topology& topology, const Coordinates& rest,
                                        const std::vector<std::string>& markers,
                                        const Table& table) {
  return in_dimension(topology, file_of(table), [&](auto dim) {
    const Candidates candidates(topology, markers);
    if (table.entries.empty())
      throw UsageError(std::string("the table of ") + file_of(table) + " is empty");
    return motion_of<dim()>(topology, rest, candidates, table);
  });
}

}  // namespace

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const DisplacementTable& table) {
  return motion_of_table(topology, rest, markers, table);
}

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const PositionTable& table) {
  return motion_of_table(topology, rest, markers, table);
}

}  // namespace winslow
