#include "core/vcv/sphere/sphere_link.h"

#include "core/error.h"
#include "core/mesh/element_type.h"

namespace winslow {

namespace {

std::string edge_text(Index a, Index b) {
  return "the edge between vertices " + std::to_string(a) + " and " + std::to_string(b);
}

[[noreturn]] void refuse(const std::string& found) {
  throw UsageError("the link is no triangulated sphere: " + found);
}

}  // namespace

void SphereLink::assign(Index vertices, std::span<const Triangle> triangles) {
  triangles_.assign(triangles.begin(), triangles.end());
  if (vertices < 4) refuse("found " + std::to_string(vertices) + " vertices, expected at least 4");
  collect_outgoing(vertices);
  pair_half_edges();
  check_rings();
  check_whole();
}

void SphereLink::collect_outgoing(Index vertices) {
  first_.assign(at(vertices) + 1, 0);
  ends_.clear();
  for (const Triangle& triangle : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = triangle[k];
      if (v < 0 || v >= vertices) refuse("there is no vertex " + std::to_string(v));
      const Index next = triangle[k == 2 ? 0 : k + 1];
      if (v == next) {
        refuse("a triangle has vertex " + std::to_string(v) + " twice");
      }
      ++first_[at(v) + 1];
      ends_.push_back(next);
    }
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  outgoing_.resize(3 * triangles_.size());
  for (std::size_t t = triangles_.size(); t-- > 0;) {
    for (std::size_t k = 3; k-- > 0;) {
      outgoing_[at(--first_[at(triangles_[t][k]) + 1])] = static_cast<Index>(3 * t + k);
    }
  }
  // Each first_[v + 1] is now the beginning of the row of v.
  std::shift_left(first_.begin(), first_.end(), 1);
  first_.back() = static_cast<Index>(outgoing_.size());
}

void SphereLink::pair_half_edges() {
  twins_.assign(outgoing_.size(), -1);
  for (Index a = 0; a < vertex_count(); ++a) {
    const auto row = outgoing(a);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const Index b = end_of(row[k]);
      for (std::size_t other = 0; other < k; ++other) {
        if (end_of(row[other]) == b) refuse(edge_text(a, b) + " has two triangles on one side");
      }
      for (const Index back : outgoing(b)) {
        if (end_of(back) == a) twins_[at(row[k])] = back;
      }
      if (twins_[at(row[k])] < 0) refuse(edge_text(a, b) + " has a triangle on one side only");
    }
  }
}

void SphereLink::check_rings() const {
  for (Index v = 0; v < vertex_count(); ++v) {
    const auto row = outgoing(v);
    if (row.empty()) refuse("vertex " + std::to_string(v) + " has no triangle");
    Index met = 0;
    Index h = row.front();
    do {
      h = twins_[at(previous_of(h))];
      ++met;
    } while (h != row.front());
    if (met != degree(v)) refuse("two parts meet in vertex " + std::to_string(v));
  }
}

void SphereLink::check_whole() const {
  std::vector<bool> reached(triangles_.size(), false);
  std::vector<Index> todo{0};
  reached[0] = true;
  for (std::size_t head = 0; head < todo.size(); ++head) {
    for (Index k = 0, h = 3 * todo[head]; k < 3; ++k, h = next_of(h)) {
      const Index t = twins_[at(h)] / 3;
      if (reached[at(t)]) continue;
      reached[at(t)] = true;
      todo.push_back(t);
    }
  }
  if (todo.size() != triangles_.size()) refuse("it has several parts");
  // Euler: V - E + F = 2 with E = 3 F / 2.
  if (triangle_count() != 2 * vertex_count() - 4) {
    refuse("found " + std::to_string(triangle_count()) + " triangles for " +
           std::to_string(vertex_count()) + " vertices, expected " +
           std::to_string(2 * vertex_count() - 4));
  }
}

void SphereLink::assign(const Topology& topology, Index node) {
  if (topology.cell_dimension() != 3 || node < 0 || node >= topology.node_count() ||
      topology.on_boundary(node) || !topology.used(node)) {
    throw UsageError("the link of node " + std::to_string(node) +
                     ": expected an interior node of a volume mesh");
  }
  const auto neighbours = topology.neighbours(node);
  const auto local = [&](Index other) {
    return static_cast<Index>(std::lower_bound(neighbours.begin(), neighbours.end(), other) -
                              neighbours.begin());
  };
  std::vector<Index> v;  // the corners of a part of the link
  std::vector<Triangle> triangles;
  triangles.reserve(2 * neighbours.size());
  for (const Index e : topology.star(node)) {
    const auto corners = topology.element(e);
    const auto corner = std::find(corners.begin(), corners.end(), node) - corners.begin();
    const Face& cut = topology.shape(e).links[static_cast<std::size_t>(corner)];
    v.clear();
    for (const Index k : cut) v.push_back(local(corners[at(k)]));
    // Neighbours ascend, so the lowest node is the lowest vertex.
    if (v.size() > 3) std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    for (std::size_t k = 1; k + 1 < v.size(); ++k) triangles.push_back({v[0], v[k], v[k + 1]});
  }
  try {
    assign(static_cast<Index>(neighbours.size()), triangles);
  } catch (const UsageError& error) {
    throw MeshError(MeshEntity::node, node, "node " + std::to_string(node) + ": " + error.what());
  }
}

}  // namespace winslow
