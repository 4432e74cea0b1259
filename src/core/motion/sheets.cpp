#include "core/motion/sheets.h"

#include <Eigen/Geometry>
#include <map>

#include "core/motion/outline.h"

namespace winslow {

namespace {

/// A face of the boundary as seen from outside its element: in the plane with the element on the
/// left of its direction.
Face outward(const Topology& topology, Index f) {
  const auto shared = topology.face(f);
  if (topology.cell_dimension() == 3) return shared.nodes;
  const auto [a, b] = shared.nodes.edge();
  const auto corners = topology.element(shared.elements[0]);
  const std::size_t k = index_of(corners, a);
  return corners[(k + 1) % corners.size()] == b ? Face(a, b) : Face(b, a);
}

/// Faces that lie on one another: two of the boundary with their nodes in the same places.
class FoldedFaces {
 public:
  /// Faces with a node of `left_out` are not looked at.
  template <int D>
  static FoldedFaces find(const Topology& topology, const Points<D>& x,
                          std::span<const Index> left_out) {
    FoldedFaces folded;
    std::vector<bool> skip(at(topology.node_count()), false);
    for (const Index node : left_out) skip[at(node)] = true;
    std::vector<Index> faces;
    for (Index f = 0; f < topology.face_count(); ++f) {
      const auto face = topology.face(f);
      if (face.elements[1] < 0 &&
          std::ranges::none_of(face.nodes, [&](Index node) { return skip[at(node)]; }))
        faces.push_back(f);
    }
    folded.find_places(topology, x, faces);
    if (folded.shared_) folded.pair(topology, faces);
    return folded;
  }

  /// Whether another node lies where this one does.
  bool shares_place(Index node) const { return count_[at(place_[at(node)])] > 1; }
  /// The first of the nodes that lie where this one does.
  Index place(Index node) const { return place_[at(node)]; }
  /// Pairs of faces.
  const std::vector<std::array<Index, 2>>& pairs() const { return pairs_; }

 private:
  template <int D>
  void find_places(const Topology& topology, const Points<D>& x, const std::vector<Index>& faces) {
    std::vector<Index> nodes;
    for (const Index f : faces)
      for (const Index node : topology.face(f).nodes) nodes.push_back(node);
    sort_unique(nodes);
    std::ranges::stable_sort(nodes, [&](Index a, Index b) {
      const Vec<D> p = x[a], q = x[b];
      return std::lexicographical_compare(p.data(), p.data() + D, q.data(), q.data() + D);
    });
    place_.assign(at(topology.node_count()), -1);
    count_.assign(at(topology.node_count()), 0);
    Index first = -1;
    for (const Index node : nodes) {
      if (first < 0 || x[first] != x[node]) first = node;
      place_[at(node)] = first;
      if (++count_[at(first)] > 1) shared_ = true;
    }
  }

  void pair(const Topology& topology, const std::vector<Index>& faces) {
    std::vector<std::pair<std::array<Index, 4>, Index>> by_place;
    for (const Index f : faces) {
      std::array<Index, 4> places{-1, -1, -1, -1};
      bool shared = false;
      std::size_t k = 0;
      for (const Index node : topology.face(f).nodes) {
        places[k++] = place(node);
        shared = shared || shares_place(node);
      }
      std::ranges::sort(places);
      if (shared) by_place.emplace_back(places, f);
    }
    std::ranges::sort(by_place);
    for (std::size_t k = 0; k + 1 < by_place.size(); ++k)
      if (by_place[k].first == by_place[k + 1].first)
        pairs_.push_back({by_place[k].second, by_place[k + 1].second});
  }

  std::vector<Index> place_, count_;  // #nodes; -1 and 0 away from the faces
  bool shared_ = false;               // any place
  std::vector<std::array<Index, 2>> pairs_;
};

/// The nearest point of a facet: its weights at the corners.
std::array<double, 2> nearest_weights(const Vec2& p, const Facet<2>& s) {
  const Vec2 way = s[1] - s[0];
  const double length = way.squaredNorm();
  const double t = length > 0 ? std::clamp(way.dot(p - s[0]) / length, 0.0, 1.0) : 0;
  return {1 - t, t};
}

/// Ericson, Real-Time Collision Detection, section 5.1.5.
std::array<double, 3> nearest_weights(const Vec3& p, const Facet<3>& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp);
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (const double c = d1 * d4 - d3 * d2; c <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  if (const double b = d5 * d2 - d1 * d6; b <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  if (const double a = d3 * d6 - d5 * d4; a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0, 1 - w, w};
  }
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

/// The unit normal of a facet, out of the domain; zero for a facet without extent.
Vec2 normal_of(const Facet<2>& s) {
  const Vec2 way = s[1] - s[0];
  return way.norm() > 0 ? Vec2(Vec2(way.y(), -way.x()) / way.norm()) : Vec2(0, 0);
}
Vec3 normal_of(const Facet<3>& t) {
  const Vec3 area = (t[1] - t[0]).cross(t[2] - t[0]);
  return area.norm() > 0 ? Vec3(area / area.norm()) : Vec3(0, 0, 0);
}

/// The weight of a facet's normal at its corner k.
double weight_at(const Facet<2>&, std::size_t) { return 1; }
double weight_at(const Facet<3>& t, std::size_t k) {
  const Vec3 a = t[(k + 1) % 3] - t[k], b = t[(k + 2) % 3] - t[k];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Faces of one side of a sheet, and those of another side that lie on them.
template <int D>
struct SheetSide {
  std::vector<Index> nodes;                ///< of this side, but those of its rim
  std::vector<Index> markers;              ///< of a face at each of these nodes; -1: none
  std::vector<FacetNodes<D>> opposite;     ///< facets, their normals out of the domain
  std::vector<Index> opposite_markers;     ///< of each facet; -1: none
  std::map<Index, std::vector<Index>> at;  ///< indices into `opposite` of the facets at a node
  std::vector<unsigned char> rim;          ///< of each corner of each facet: on the rim

  /// Finds `at` and `rim` of the opposite facets.
  void connect();
};

/// The corners of a facet that an edge of it has, of a facet in the plane one corner.
template <int D>
std::vector<Index> sorted_edge(const FacetNodes<D>& nodes, std::size_t k) {
  std::vector<Index> edge{nodes[k]};
  if constexpr (D == 3) edge.push_back(nodes[(k + 1) % D]);
  std::ranges::sort(edge);
  return edge;
}

template <int D>
void SheetSide<D>::connect() {
  std::map<std::vector<Index>, int> uses;  // of edges; in the plane of nodes
  for (std::size_t f = 0; f < opposite.size(); ++f)
    for (std::size_t k = 0; k < D; ++k) {
      at[opposite[f][k]].push_back(static_cast<Index>(f));
      ++uses[sorted_edge<D>(opposite[f], k)];
    }
  std::vector<Index> rim_nodes;
  for (const auto& [edge, count] : uses)
    if (count == 1) rim_nodes.insert(rim_nodes.end(), edge.begin(), edge.end());
  sort_unique(rim_nodes);
  for (const FacetNodes<D>& nodes : opposite)
    for (const Index node : nodes)
      rim.push_back(std::ranges::binary_search(rim_nodes, node) ? 1 : 0);
}

/// Where a node has passed through the other side.
struct Passage {
  double depth = 0;  ///< more than is allowed
  Index node = -1;
  Index marker = -1, other = -1;  ///< of the side of the node, of the other side
};

/// A sheet side and those opposite to it at the positions of one moment.
template <int D>
class SheetNow {
 public:
  SheetNow(const SheetSide<D>& side, const Coordinates& rest, const Coordinates& x)
      : side_(side), rest_(rest), x_(x), tree_(tree_of(side.opposite, x)) {}

  /// The deepest passage of a node through the opposite side.
  std::optional<Passage> deepest() const {
    Passage deepest;
    for (std::size_t i = 0; i < side_.nodes.size(); ++i) {
      const Index node = side_.nodes[i];
      const Vec<D> p = x_.get<D>(node);
      const auto near = tree_.nearest(p, std::numeric_limits<double>::infinity(),
                                      [&](Index f) { return (p - nearest_point(p, f)).norm(); });
      if (!near) continue;
      const double depth = depth_behind(p, near->item) - slack(node, near->item);
      if (depth > deepest.depth)
        deepest = {depth, node, side_.markers[i], side_.opposite_markers[at(near->item)]};
    }
    return deepest.node >= 0 ? std::optional(deepest) : std::nullopt;
  }

 private:
  Facet<D> place_of_facet(Index f) const { return facet(side_.opposite[at(f)], x_); }

  Vec<D> nearest_point(const Vec<D>& p, Index f) const {
    const Facet<D> corners = place_of_facet(f);
    const auto weights = nearest_weights(p, corners);
    Vec<D> point = Vec<D>::Zero();
    for (std::size_t k = 0; k < D; ++k) point += weights[k] * corners[k];
    return point;
  }

  /// How far a point lies behind the nearest point of the side, which is in a facet; 0 if it does
  /// not, or if it lies beside the rim.
  double depth_behind(const Vec<D>& p, Index f) const {
    const Vec<D> way = p - nearest_point(p, f);
    const Vec<D> normal = normal_at(nearest_weights(p, place_of_facet(f)), f);
    return way.dot(normal) < 0 ? way.norm() : 0;
  }

  /// The normal at a point of a facet; zero on the rim.
  Vec<D> normal_at(const std::array<double, D>& weights, Index f) const {
    constexpr double round_off = 1e-12;
    std::vector<std::size_t> corners;  // between which the point lies
    for (std::size_t k = 0; k < D; ++k)
      if (weights[k] > round_off) corners.push_back(k);
    if (corners.size() == D) return normal_of(place_of_facet(f));
    const FacetNodes<D>& own = side_.opposite[at(f)];
    Vec<D> sum = Vec<D>::Zero();
    if (corners.size() == 1 && side_.rim[at(f) * D + corners[0]] != 0) return sum;
    int facets = 0;
    for (const Index g : side_.at.at(own[corners[0]])) {
      const FacetNodes<D>& other = side_.opposite[at(g)];
      const bool there = std::ranges::all_of(
          corners, [&](std::size_t k) { return std::ranges::find(other, own[k]) != other.end(); });
      if (!there) continue;
      ++facets;
      const Facet<D> place = place_of_facet(g);
      const double weight =
          corners.size() == 1 ? weight_at(place, index_of(other, own[corners[0]])) : 1;
      sum += weight * normal_of(place);
    }
    return facets > 1 ? sum : Vec<D>(Vec<D>::Zero());
  }

  /// What is no passage yet: numbers of tables are rounded.
  double slack(Index node, Index f) const {
    constexpr double precision = 1e-6;
    const Facet<D> corners = place_of_facet(f);
    double length = 0;
    for (std::size_t k = 1; k < D; ++k)
      length = std::max(length, (corners[k] - corners[k - 1]).norm());
    const Index other = side_.opposite[at(f)][0];
    const double way = (x_.get<D>(node) - rest_.get<D>(node)).norm() +
                       (x_.get<D>(other) - rest_.get<D>(other)).norm();
    return precision * (length + way);
  }

  const SheetSide<D>& side_;
  const Coordinates& rest_;
  const Coordinates& x_;
  BoxTree<D> tree_;  // of the opposite facets
};

/// The sides of all sheets of a mesh.
template <int D>
class Sheets {
 public:
  Sheets(const Topology& topology, const Coordinates& rest, std::span<const Index> left_out)
      : topology_(topology), folded_(FoldedFaces::find<D>(topology, Points<D>(rest), left_out)) {
    if (folded_.pairs().empty()) return;
    for (const auto& [a, b] : folded_.pairs()) {
      twin_[a] = b;
      twin_[b] = a;
    }
    find_markers();
    const std::map<Index, Index> part = parts();
    // At a fork the nodes of three sides lie in one place. Each pair of sides is looked at by
    // itself.
    std::map<std::pair<Index, Index>, std::vector<Index>> pairs;
    for (const auto& [face, twin] : twin_) pairs[{part.at(face), part.at(twin)}].push_back(face);
    for (const auto& [sides, faces] : pairs) add_side(faces);
  }

  const std::vector<SheetSide<D>>& sides() const { return sides_; }

  /// Whether the nodes in one place stay in one place.
  bool stay_together(const SheetSide<D>& side, const Coordinates& x) const {
    std::map<Index, Index> there;  // of each place a node of the opposite side
    for (const FacetNodes<D>& nodes : side.opposite)
      for (const Index node : nodes) there[folded_.place(node)] = node;
    return std::ranges::all_of(side.nodes, [&](Index node) {
      const auto other = there.find(folded_.place(node));
      return other != there.end() && x.get<D>(node) == x.get<D>(other->second);
    });
  }

 private:
  void find_markers() {
    for (std::size_t m = 0; m < topology_.markers().size(); ++m)
      for (const Face& face : topology_.markers()[m].faces)
        if (const auto f = topology_.find_face(face); f && twin_.contains(*f))
          marker_[*f] = static_cast<Index>(m);
  }
  Index marker(Index f) const {
    const auto found = marker_.find(f);
    return found != marker_.end() ? found->second : -1;
  }

  /// The side of each face, by its number. Neighbours across an edge, in the plane across a node,
  /// are of one side, unless they lie on one another: then this is the rim.
  std::map<Index, Index> parts() const {
    std::vector<Index> faces;
    for (const auto& [face, twin] : twin_) faces.push_back(face);
    std::map<std::vector<Index>, std::vector<Index>> around;  // indices into faces, by edge
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const Face nodes = topology_.face(faces[i]).nodes;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        std::vector<Index> edge{nodes[k]};
        if constexpr (D == 3) edge.push_back(nodes[(k + 1) % nodes.size()]);
        std::ranges::sort(edge);
        around[edge].push_back(static_cast<Index>(i));
      }
    }
    JoinedSets sets(faces.size());
    for (const auto& [edge, list] : around)
      for (std::size_t k = 1; k < list.size(); ++k)
        if (twin_.at(faces[at(list[k])]) != faces[at(list[0])]) sets.join(list[0], list[k]);
    std::map<Index, Index> part;
    for (std::size_t i = 0; i < faces.size(); ++i)
      part[faces[i]] = sets.find(static_cast<Index>(i));
    return part;
  }

  void add_side(const std::vector<Index>& faces) {
    SheetSide<D> side;
    std::map<Index, Index> nodes;  // to their markers
    for (const Index f : faces) {
      for (const Index node : topology_.face(f).nodes)
        if (folded_.shares_place(node)) nodes.try_emplace(node, marker(f));
      const Index twin = twin_.at(f);
      for (const FacetNodes<D>& facet : facets(outward(topology_, twin))) {
        side.opposite.push_back(facet);
        side.opposite_markers.push_back(marker(twin));
      }
    }
    for (const auto& [node, of] : nodes) {
      side.nodes.push_back(node);
      side.markers.push_back(of);
    }
    side.connect();
    sides_.push_back(std::move(side));
  }

  /// The facets of a face. The two sides of a sheet divide a quadrilateral alike: from the place
  /// that comes first.
  std::vector<FacetNodes<D>> facets(const Face& face) const {
    if constexpr (D == 2) {
      return {face.edge()};
    } else {
      const std::size_t n = face.size();
      if (n == 3) return {{face[0], face[1], face[2]}};
      std::size_t k = 0;
      for (std::size_t j = 1; j < n; ++j)
        if (folded_.place(face[j]) < folded_.place(face[k])) k = j;
      const auto node = [&](std::size_t j) { return face[(k + j) % n]; };
      std::vector<FacetNodes<D>> facets;
      for (std::size_t j = 1; j + 1 < n; ++j) facets.push_back({node(0), node(j), node(j + 1)});
      return facets;
    }
  }

  const Topology& topology_;
  FoldedFaces folded_;
  std::map<Index, Index> twin_;    // of each face of a sheet
  std::map<Index, Index> marker_;  // of faces of sheets that have one
  std::vector<SheetSide<D>> sides_;
};

template <int D>
class PassageSearch {
 public:
  PassageSearch(const Topology& topology, const Coordinates& rest, const Motion& motion,
                std::span<const Index> yielding)
      : topology_(topology), rest_(rest), motion_(motion), sheets_(topology, rest, yielding) {
    if (sheets_.sides().empty()) return;
    x_ = rest;
    for (const double fraction : {0.25, 0.5, 0.75, 1.0}) {
      motion.apply(rest, fraction, x_);
      for (const SheetSide<D>& side : sheets_.sides())
        if (!sheets_.stay_together(side, x_)) parting_.push_back(&side);
    }
    sort_unique(parting_);
  }

  std::optional<Contact> first() {
    constexpr int steps = 64;
    for (int k = 1; k <= steps && !parting_.empty(); ++k) {
      const double blocked = static_cast<double>(k) / steps;
      if (const auto passage = deepest_at(blocked))
        return refined(static_cast<double>(k - 1) / steps, blocked, *passage);
    }
    return std::nullopt;
  }

 private:
  std::optional<Passage> deepest_at(double fraction) {
    motion_.apply(rest_, fraction, x_);
    std::optional<Passage> deepest;
    for (const SheetSide<D>* side : parting_) {
      const auto found = SheetNow<D>(*side, rest_, x_).deepest();
      if (found && (!deepest || found->depth > deepest->depth)) deepest = found;
    }
    return deepest;
  }

  /// Bisects between a fraction without passage and one with a passage.
  Contact refined(double free, double blocked, Passage passage) {
    constexpr int halvings = 12;
    for (int halving = 0; halving < halvings; ++halving) {
      const double middle = 0.5 * (free + blocked);
      const auto found = deepest_at(middle);
      if (found) passage = *found;
      (found ? blocked : free) = middle;
    }
    motion_.apply(rest_, free, x_);
    const bool moves = std::ranges::binary_search(motion_.nodes(), passage.node);
    const auto name = [&](Index marker) { return Outline<D>::marker_name(topology_, marker); };
    EdgePair edges{name(moves ? passage.marker : passage.other),
                   name(moves ? passage.other : passage.marker), place_of(x_, passage.node)};
    edges.one_sheet = true;
    edges.in_space = D == 3;
    return {free, std::move(edges)};
  }

  const Topology& topology_;
  const Coordinates& rest_;
  const Motion& motion_;
  Sheets<D> sheets_;
  std::vector<const SheetSide<D>*> parting_;  // sides that do not move with the opposite ones
  Coordinates x_;
};

}  // namespace

template <int D>
std::optional<Contact> find_passage(const Topology& topology, const Coordinates& rest,
                                    const Motion& motion, std::span<const Index> yielding) {
  return PassageSearch<D>(topology, rest, motion, yielding).first();
}

template std::optional<Contact> find_passage<2>(const Topology&, const Coordinates&, const Motion&,
                                                std::span<const Index>);
template std::optional<Contact> find_passage<3>(const Topology&, const Coordinates&, const Motion&,
                                                std::span<const Index>);

}  // namespace winslow
