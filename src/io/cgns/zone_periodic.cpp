#include "io/cgns/zone_markers.h"

#include <set>

#include "io/format/periodicity.h"

namespace winslow::io::cgns {
namespace {

/// Vertex numbers of a list, or all in a range of one index. Throws InputError for one that the
/// zone does not have.
std::vector<std::int64_t> vertices_of(const NodeView& view, std::int64_t count) {
  std::vector<std::int64_t> numbers = view.integers();
  for (const std::int64_t vertex : numbers)
    if (vertex < 1 || vertex > count)
      view.fail("vertex " + std::to_string(vertex), "1 to " + std::to_string(count));
  if (!view.name().starts_with("PointRange") || numbers.size() != 2) return numbers;
  const std::int64_t step = numbers[0] <= numbers[1] ? 1 : -1;
  std::vector<std::int64_t> all;
  for (std::int64_t n = numbers[0]; n != numbers[1] + step; n += step) all.push_back(n);
  return all;
}

std::optional<NodeView> donor_of(const NodeView& connection) {
  const auto list = connection.child("PointListDonor");
  return list ? list : connection.child("PointRangeDonor");
}

/// A vector of Periodic_t; 0 if it is missing.
Vec3 vector_of(const NodeView& periodic, const char* name) {
  Vec3 vector(0, 0, 0);
  const auto child = periodic.child(name);
  if (!child) return vector;
  const std::vector<double> values = child->reals();
  if (values.size() > 3 ||
      !std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    child->fail(std::to_string(values.size()) + " numbers", "up to three finite ones");
  for (std::size_t k = 0; k < values.size(); ++k) vector[static_cast<Eigen::Index>(k)] = values[k];
  return vector;
}

/// Angles are in radians unless the file says degrees (the fifth of DimensionalUnits_t).
double angle_unit(const NodeView& periodic) {
  const auto angles = periodic.child("RotationAngle");
  const auto units = angles ? angles->first("DimensionalUnits_t") : std::nullopt;
  return units && units->text().find("Degree") != std::string::npos ? radians(1) : 1;
}

RigidImage image_of(const NodeView& periodic) {
  return io::image_of(vector_of(periodic, "RotationCenter"),
                      angle_unit(periodic) * vector_of(periodic, "RotationAngle"),
                      vector_of(periodic, "Translation"));
}

class PairFinder {
 public:
  PairFinder(const ZoneHead& head, const ZoneBoundary& boundary, const VertexPairs& pairs_of,
             const MeshData& mesh, std::vector<std::string>& warnings)
      : indices_(head.vertices.size()),
        boundary_(boundary),
        pairs_of_(pairs_of),
        mesh_(mesh),
        warnings_(warnings) {
    for (const Marker& marker : mesh.markers) nodes_.push_back(nodes_of(marker.faces));
  }

  void add(const NodeView& connection) {
    std::vector<PeriodicPair> pairs = pairs_of_(connection);
    if (pairs.empty()) pairs = by_place(connection);
    const bool any = !pairs.empty() && add(pairs);
    if (!any)
      warnings_.push_back("the periodic connection \"" + connection.name() + "\" is not used: " +
                          (pairs.empty() ? "it does not say which vertices are pairs, and those of "
                                           "its two sides do not match"
                                         : "no two markers lie on its sides"));
  }

  std::vector<GivenPairs> take() {
    hold_shared();
    return std::move(found_);
  }

 private:
  std::vector<PeriodicPair> by_place(const NodeView& connection) {
    const auto set = read_point_set(connection, indices_);
    const auto donor = donor_of(connection);
    if (!set || !donor || indices_ != 1) return {};
    PointSet other = *set;
    other.view = *donor;
    other.values = donor->integers();
    other.range = donor->name().ends_with("RangeDonor");
    if (other.range && other.values.size() != 2)
      donor->fail(std::to_string(other.values.size()) + " numbers", "two");
    const std::vector<Face> side = boundary_.faces_of(*set, warnings_),
                            beyond = boundary_.faces_of(other, warnings_);
    const auto property = connection.first("GridConnectivityProperty_t");
    const RigidImage image = image_of(*property->first("Periodic_t"));
    constexpr double share = 0.05;  // of the shortest edge, as in PeriodicPairs
    const double near = share * shortest_edge(side, mesh_.coordinates);
    // Programs differ in which side they rotate and translate, so both directions are tried.
    for (const RigidImage& way : {image, inverse_of(image)}) {
      auto pairs = matched(way, nodes_of(side), nodes_of(beyond), mesh_.coordinates, near);
      if (!pairs.empty()) return pairs;
    }
    return {};
  }

  /// Splits the pairs of a connection by the markers on its sides. False if there are none.
  bool add(const std::vector<PeriodicPair>& pairs) {
    std::map<Index, Index> image_of_node;
    for (const PeriodicPair& pair : pairs) image_of_node[pair.node] = pair.image;
    bool any = false;
    for (std::size_t a = 0; a < nodes_.size(); ++a) {
      GivenPairs given{mesh_.markers[a].name, {}, {}, {}};
      std::vector<Index> images;
      for (const Index node : nodes_[a]) {
        const auto image = image_of_node.find(node);
        if (image == image_of_node.end()) break;
        given.pairs.push_back({node, image->second});
        images.push_back(image->second);
      }
      if (images.empty() || images.size() != nodes_[a].size()) continue;
      std::ranges::sort(images);
      const auto b = std::ranges::find(nodes_, images);
      if (b == nodes_.end()) continue;
      any = true;
      given.second = mesh_.markers[static_cast<std::size_t>(b - nodes_.begin())].name;
      // The other side usually has a connection of its own.
      if (names_.insert(std::minmax(given.first, given.second)).second)
        found_.push_back(std::move(given));
    }
    return any;
  }

  /// Holds the nodes where periodic sides of two directions meet.
  void hold_shared() {
    std::map<Index, int> count;
    for (const GivenPairs& given : found_)
      for (const PeriodicPair& pair : given.pairs) {
        ++count[pair.node];
        ++count[pair.image];
      }
    for (GivenPairs& given : found_) {
      std::set<Index> held;
      for (const PeriodicPair& pair : given.pairs)
        for (const Index node : {pair.node, pair.image})
          if (count.at(node) > 1) held.insert(node);
      given.held.assign(held.begin(), held.end());
    }
  }

  std::size_t indices_;
  const ZoneBoundary& boundary_;
  const VertexPairs& pairs_of_;
  const MeshData& mesh_;
  std::vector<std::string>& warnings_;
  std::vector<std::vector<Index>> nodes_;  // of each marker, ascending
  std::set<std::pair<std::string, std::string>> names_;
  std::vector<GivenPairs> found_;
};

}  // namespace

std::vector<NodeView> connections_of(const NodeView& zone) {
  std::vector<NodeView> connections;
  for (const NodeView& all : zone.children("ZoneGridConnectivity_t"))
    for (NodeView& view : all.children())
      if (view.label() == "GridConnectivity_t" || view.label() == "GridConnectivity1to1_t")
        connections.push_back(std::move(view));
  return connections;
}

bool is_periodic(const NodeView& connection) {
  const auto property = connection.first("GridConnectivityProperty_t");
  return property && property->first("Periodic_t");
}

bool leads_to(const NodeView& connection, const std::string& zone) {
  const std::string donor = connection.text();
  return donor == zone || donor.ends_with("/" + zone);
}

std::vector<PeriodicPair> listed_pairs(const NodeView& connection, std::int64_t vertices) {
  const auto set = read_point_set(connection, 1);
  const auto donor = donor_of(connection);
  if (!set || !donor || !set->of_vertices()) return {};
  const std::vector<std::int64_t> own = vertices_of(set->view, vertices),
                                  other = vertices_of(*donor, vertices);
  if (own.size() != other.size()) return {};
  std::vector<PeriodicPair> pairs;
  for (std::size_t k = 0; k < own.size(); ++k)
    pairs.push_back({static_cast<Index>(own[k] - 1), static_cast<Index>(other[k] - 1)});
  return pairs;
}

std::vector<GivenPairs> periodic_pairs(const NodeView& zone, const ZoneHead& head,
                                       const ZoneBoundary& boundary, const VertexPairs& pairs_of,
                                       const MeshData& mesh, std::vector<std::string>& warnings) {
  PairFinder finder(head, boundary, pairs_of, mesh, warnings);
  for (const NodeView& connection : connections_of(zone))
    if (is_periodic(connection) && leads_to(connection, zone.name())) finder.add(connection);
  return finder.take();
}

}  // namespace winslow::io::cgns
