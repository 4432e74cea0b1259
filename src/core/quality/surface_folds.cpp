#include "core/quality/surface_folds.h"

#include <Eigen/Geometry>
#include <set>

#include "core/geometry/element_normals.h"
#include "core/geometry/surface_features.h"
#include "core/mesh/index_sets.h"

namespace winslow {

namespace {

/// Sets of things of which each is on the same side as the first of its set, or on the other.
class SidedSets {
 public:
  explicit SidedSets(std::size_t count) : parent_(count), other_(count, false) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  struct Place {
    Index set;
    bool other_side;
  };
  Place find(Index i) const {
    bool other = false;
    for (; parent_[at(i)] != i; i = parent_[at(i)]) other ^= other_[at(i)];
    return {i, other};
  }
  /// Puts a and b on opposite sides of one set, unless they are in one set already.
  void oppose(Index a, Index b) {
    const Place p = find(a), q = find(b);
    if (p.set == q.set) return;
    const auto [low, high] = std::minmax(p.set, q.set);
    parent_[at(high)] = low;
    other_[at(high)] = p.other_side == q.other_side;
  }

 private:
  std::vector<Index> parent_;
  std::vector<bool> other_;  // than its parent
};

/// An edge at which the surface turns by about 180 degrees.
struct SharpEdge {
  Topology::Edge edge;
  double cosine;  // of the angle between its two sides
  int ridge;      // 1: seen from the front of the elements a ridge; -1: a groove; 0: flat
  bool thin = false;
  std::array<Index, 2> patches = {};
};

class FoldFinder {
 public:
  explicit FoldFinder(const Mesh& mesh)
      : topology_(*mesh.topology), x_(mesh.coordinates), patches_(at(topology_.element_count())) {}

  SurfaceFolds find() {
    out_.of = topology_.element_count();
    measure_edges();
    if (sharp_.empty()) return out_;
    for (SharpEdge& edge : sharp_)
      for (std::size_t side = 0; side < 2; ++side)
        edge.patches[side] = patches_.find(edge.edge.elements[side]);
    mark_lines();
    mark_strips();
    for (SharpEdge& edge : sharp_) edge.thin |= edge.patches[0] == edge.patches[1];
    find_sides();
    return out_;
  }

 private:
  void measure_edges();
  Vec3 side_of(const Topology::Edge& edge, std::size_t side) const;
  int ridge_of(const Topology::Edge& edge, const Vec3& first, const Vec3& second) const;
  void mark_lines();
  void mark_strips();
  void find_sides();
  void count(const std::vector<double>& areas, const SidedSets& sides);

  const Topology& topology_;
  SpacePoints x_;
  JoinedSets patches_;  // of elements between which the surface turns by less than 60 degrees
  std::vector<SharpEdge> sharp_;
  SurfaceFolds out_;
};

/// Unit vector in an element, at right angles to one of its edges; zero for a degenerate element.
Vec3 FoldFinder::side_of(const Topology::Edge& edge, std::size_t side) const {
  const Vec3 start = x_[edge.nodes[0]], along = (x_[edge.nodes[1]] - start).normalized();
  Vec3 across = Vec3::Zero();
  for (const Index node : topology_.element(edge.elements[side]))
    if (node != edge.nodes[0] && node != edge.nodes[1]) across += x_[node] - start;
  across -= along.dot(across) * along;
  const double length = across.norm();
  return length > 0 ? Vec3(across / length) : Vec3::Zero();
}

/// first, second: side_of() its elements.
int FoldFinder::ridge_of(const Topology::Edge& edge, const Vec3& first, const Vec3& second) const {
  constexpr double flat = 1e-9;
  const auto nodes = topology_.element(edge.elements[0]);
  const auto here = std::ranges::find(nodes, edge.nodes[0]) - nodes.begin();
  const bool forward = nodes[(static_cast<std::size_t>(here) + 1) % nodes.size()] == edge.nodes[1];
  const Vec3 along = (x_[edge.nodes[1]] - x_[edge.nodes[0]]).normalized();
  const double above = (forward ? 1 : -1) * along.cross(first).dot(second);
  return above > flat ? -1 : above < -flat ? 1 : 0;
}

void FoldFinder::measure_edges() {
  constexpr double smooth = 60;  // degrees
  const double folded = std::cos(radians(180 - SurfaceFolds::turn));
  const double same = -std::cos(radians(smooth));
  for (const Topology::Edge& edge : topology_.edges()) {
    if (edge.elements[1] < 0 || x_[edge.nodes[0]] == x_[edge.nodes[1]]) continue;
    const Vec3 first = side_of(edge, 0), second = side_of(edge, 1);
    const double cosine = first.dot(second);
    if (cosine < same) patches_.join(edge.elements[0], edge.elements[1]);
    if (cosine > folded) sharp_.push_back({edge, cosine, ridge_of(edge, first, second)});
  }
}

/// Marks lines of sharp edges as thin: those of several edges that run on without bends and are
/// ridges, or grooves, all along.
void FoldFinder::mark_lines() {
  constexpr std::size_t shortest = 4;  // edges
  constexpr double bend = 40;          // degrees
  EdgeEnds ends;
  std::map<std::pair<Index, Index>, std::size_t> numbers;
  for (std::size_t k = 0; k < sharp_.size(); ++k) {
    const auto [a, b] = sharp_[k].edge.nodes;
    ends[a].push_back(b);
    ends[b].push_back(a);
    numbers[std::minmax(a, b)] = k;
  }
  const auto runs_on = [&](Index node) {
    const auto& others = ends.at(node);
    if (others.size() != 2) return false;
    const Vec3 in = x_[node] - x_[others[0]], out = x_[others[1]] - x_[node];
    return in.dot(out) >= std::cos(radians(bend)) * in.norm() * out.norm();
  };
  for (const Chain& chain : find_chains(ends, runs_on)) {
    std::vector<std::size_t> line;
    for (std::size_t k = 0; k + 1 < chain.nodes.size() + (chain.closed ? 1 : 0); ++k)
      line.push_back(
          numbers.at(std::minmax(chain.nodes[k], chain.nodes[(k + 1) % chain.nodes.size()])));
    const int ridge = sharp_[line.front()].ridge;
    const bool thin =
        line.size() >= shortest && ridge != 0 &&
        std::ranges::all_of(line, [&](std::size_t k) { return sharp_[k].ridge == ridge; });
    for (const std::size_t k : line) sharp_[k].thin = thin;
  }
}

/// A patch with a ridge on one side and a groove on another is a strip that was folded over: none
/// of these lines is a thin edge.
void FoldFinder::mark_strips() {
  std::set<Index> ridges, grooves;
  for (const SharpEdge& edge : sharp_)
    if (edge.thin)
      (edge.ridge > 0 ? ridges : grooves).insert(edge.patches.begin(), edge.patches.end());
  for (SharpEdge& edge : sharp_)
    for (const Index patch : edge.patches)
      if (ridges.contains(patch) && grooves.contains(patch)) edge.thin = false;
}

/// Finds which patches lie behind folded edges.
void FoldFinder::find_sides() {
  std::vector<const SharpEdge*> folded;
  for (const SharpEdge& edge : sharp_)
    if (!edge.thin) folded.push_back(&edge);
  // The sharpest edges are the most certain.
  std::ranges::stable_sort(folded, std::greater<>(), &SharpEdge::cosine);
  SidedSets sides(at(topology_.element_count()));
  for (const SharpEdge* edge : folded) sides.oppose(edge->patches[0], edge->patches[1]);
  std::vector<double> areas(at(topology_.element_count()), 0.0);
  for (Index e = 0; e < topology_.element_count(); ++e)
    areas[at(patches_.find(e))] += doubled_area_vector(x_, topology_.element(e)).norm();
  count(areas, sides);
}

/// areas: of patches, at their numbers.
void FoldFinder::count(const std::vector<double>& areas, const SidedSets& sides) {
  constexpr double large = 0.2;  // share of the area of a body's side
  constexpr std::size_t listed = 100;
  struct Group {
    std::array<double, 2> area{};
    std::set<Index> patches;
    std::set<int> ridges;
    bool thin_body() const {
      const auto [least, most] = std::minmax(area[0], area[1]);
      return patches.size() == 2 && least > large * (least + most) && ridges.size() == 1 &&
             !ridges.contains(0);
    }
  };
  std::map<Index, Group> groups;
  for (const SharpEdge& edge : sharp_) {
    if (edge.thin) continue;
    Group& group = groups[sides.find(edge.patches[0]).set];
    group.ridges.insert(edge.ridge);
    for (const Index patch : edge.patches)
      if (group.patches.insert(patch).second)
        group.area[sides.find(patch).other_side ? 1 : 0] += areas[at(patch)];
  }
  for (const SharpEdge& edge : sharp_) {
    if (edge.thin || groups.at(sides.find(edge.patches[0]).set).thin_body()) {
      ++out_.thin_edges;
      continue;
    }
    ++out_.edges;
    const auto& nodes = edge.edge.nodes;
    if (out_.places.size() < listed)
      out_.places.push_back({nodes, edge.edge.elements, 0.5 * (x_[nodes[0]] + x_[nodes[1]])});
  }
  for (Index e = 0; e < topology_.element_count(); ++e) {
    const auto [set, other] = sides.find(patches_.find(e));
    const auto group = groups.find(set);
    if (group == groups.end() || group->second.thin_body()) continue;
    const auto& area = group->second.area;
    if (other != (area[1] < area[0])) continue;
    ++out_.elements;
    if (out_.behind.size() < listed) out_.behind.push_back(e);
  }
}

}  // namespace

SurfaceFolds find_folds(const Mesh& mesh) {
  return is_surface(*mesh.topology) ? FoldFinder(mesh).find() : SurfaceFolds();
}

std::string describe(const SurfaceFolds& folds) {
  if (!folds.any()) return {};
  const std::string edges = folds.edges == 1 ? "one edge" : std::to_string(folds.edges) + " edges";
  return "the surface is folded: it turns back on itself at " + edges + ", by more than " +
         std::to_string(static_cast<int>(SurfaceFolds::turn)) + " degrees, and " +
         std::to_string(folds.elements) + " of " + std::to_string(folds.of) +
         (folds.elements == 1 ? " elements lies behind " : " elements lie behind ") +
         (folds.edges == 1 ? "it" : "them");
}

}  // namespace winslow
