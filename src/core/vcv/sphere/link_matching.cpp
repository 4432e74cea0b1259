#include "core/vcv/sphere/link_matching.h"

#include "core/error.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

namespace {

/// Maps one link to another, starting from the image of half-edge 0.
class LinkMap {
 public:
  LinkMap(const SphereLink& from, const SphereLink& to)
      : from_(from), to_(to), images_(3 * at(from.triangle_count())) {}

  /// False if no map of the whole link has this image.
  bool begin_at(Index image) {
    std::ranges::fill(images_, Index{-1});
    todo_.clear();
    if (!put(0, image)) return false;
    while (!todo_.empty()) {
      const Index h = todo_.back();
      todo_.pop_back();
      const Index g = images_[at(h)];
      if (!put(SphereLink::next_of(h), SphereLink::next_of(g)) || !put(from_.twin(h), to_.twin(g)))
        return false;
    }
    return true;
  }
  /// The map by vertices of the first link.
  std::vector<Index> vertices() const {
    std::vector<Index> vertices(at(from_.vertex_count()));
    for (std::size_t h = 0; h < images_.size(); ++h)
      vertices[at(from_.start_of(static_cast<Index>(h)))] = to_.start_of(images_[h]);
    return vertices;
  }

 private:
  bool put(Index half_edge, Index image) {
    Index& known = images_[at(half_edge)];
    if (known >= 0) return known == image;
    if (from_.degree(from_.start_of(half_edge)) != to_.degree(to_.start_of(image))) return false;
    known = image;
    todo_.push_back(half_edge);
    return true;
  }

  const SphereLink &from_, &to_;
  std::vector<Index> images_;  // by half-edge
  std::vector<Index> todo_;
};

double nearness_of(const std::vector<Index>& vertices, std::span<const Vec3> there,
                   std::span<const Vec3> here) {
  double sum = 0;
  for (std::size_t k = 0; k < vertices.size(); ++k) sum += there[k].dot(here[at(vertices[k])]);
  return sum;
}

/// The link of a node and the unit directions to its neighbours.
struct SeenLink {
  SphereLink link;
  std::vector<Vec3> directions;

  void look(const Mesh& mesh, Index node) {
    link.assign(*mesh.topology, node);
    directions.clear();
    const Vec3 middle = mesh.coordinates.xyz(node);
    for (const Index k : mesh.topology->neighbours(node))
      directions.push_back((mesh.coordinates.xyz(k) - middle).normalized());
  }
};

}  // namespace

std::optional<std::vector<Index>> match_links(const SphereLink& from, std::span<const Vec3> there,
                                              const SphereLink& to, std::span<const Vec3> here) {
  // With equal numbers of triangles, a map covers each triangle exactly once.
  if (from.triangle_count() != to.triangle_count() || from.vertex_count() != to.vertex_count())
    return std::nullopt;
  std::optional<std::vector<Index>> best;
  double best_nearness = 0;
  LinkMap map(from, to);
  for (Index image = 0; image < 3 * to.triangle_count(); ++image) {
    if (!map.begin_at(image)) continue;
    std::vector<Index> vertices = map.vertices();
    const double nearness = nearness_of(vertices, there, here);
    if (best && nearness <= best_nearness) continue;
    best = std::move(vertices);
    best_nearness = nearness;
  }
  return best;
}

std::vector<MatchedStar> matching_stars(const Mesh& mesh, Index source,
                                        std::span<const Index> candidates,
                                        const std::atomic<bool>* stop) {
  const Topology& topology = *mesh.topology;
  SeenLink from, to;
  from.look(mesh, source);
  std::vector<MatchedStar> stars;
  for (const Index node : candidates) {
    if (stop && *stop) break;
    const auto neighbours = topology.neighbours(node);
    if (node == source || neighbours.size() != from.directions.size() || topology.on_boundary(node))
      continue;
    try {
      to.look(mesh, node);
    } catch (const Error&) {
      continue;  // a star without a link has no VCV
    }
    const auto vertices = match_links(from.link, from.directions, to.link, to.directions);
    if (!vertices) continue;
    MatchedStar star{node, {}};
    for (const Index k : *vertices) star.neighbours.push_back(neighbours[at(k)]);
    stars.push_back(std::move(star));
  }
  return stars;
}

std::vector<VcvEdit> spread_vcv(const SphereStencil& stencil, std::span<const MatchedStar> stars) {
  std::vector<VcvEdit> edits;
  edits.reserve(stars.size());
  for (const auto& [node, neighbours] : stars)
    edits.push_back({node, neighbours, {}, stencil.lengths, stencil.directions});
  return edits;
}

}  // namespace winslow
