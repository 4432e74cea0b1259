#include "core/layers/wall_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/error.h"

namespace winslow {

namespace {

using Edge = std::array<Index, 2>;

Edge key_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

Index marker_named(const Topology& topology, const std::string& name) {
  const auto found = topology.find_marker(name);
  if (found) return *found;
  std::string known;
  for (const Marker& marker : topology.markers()) {
    known += (known.empty() ? "" : ", ") + marker.name;
  }
  throw UsageError("the mesh has no marker '" + name + "'; it has: " + known);
}

/// The wall of every edge that is to have layers.
std::map<Edge, Index> wall_edges(const Mesh& mesh, std::span<const LayerWall> walls) {
  const Topology& topology = *mesh.topology;
  const Coordinates& x = mesh.coordinates;
  std::map<Edge, Index> wanted;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const WallPart& part = walls[w].part;
    bool any = false;
    for (const std::string& name : walls[w].markers) {
      const Index marker = marker_named(topology, name);
      for (const Face& edge : topology.markers()[static_cast<std::size_t>(marker)].faces) {
        const auto [a, b] = edge.edge();
        if (!part.holds(x.xy(a)) || !part.holds(x.xy(b))) continue;
        any = true;
        const auto [it, fresh] = wanted.emplace(key_of(a, b), static_cast<Index>(w));
        if (!fresh && it->second != static_cast<Index>(w)) {
          throw UsageError("the layers of marker '" + name + "' are asked for twice");
        }
      }
    }
    if (!any && !walls[w].markers.empty()) {
      throw UsageError("no edge of marker '" + walls[w].markers.front() +
                       "' lies in the part of it that is to have layers");
    }
  }
  if (wanted.empty()) throw UsageError("no marker is given to insert layers at");
  return wanted;
}

/// The runs of wanted edges in one boundary loop.
void add_chains(const std::vector<Index>& loop, std::map<Edge, Index>& wanted,
                std::vector<WallChain>& chains) {
  const std::size_t n = loop.size();
  std::vector<Index> wall(n, -1);
  std::size_t count = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto it = wanted.find(key_of(loop[k], loop[(k + 1) % n]));
    if (it == wanted.end()) continue;
    wall[k] = it->second;
    wanted.erase(it);
    ++count;
  }
  if (count == 0) return;
  if (count == n) {
    chains.push_back({loop, true, wall, -1, -1});
    return;
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (wall[k] < 0 || wall[(k + n - 1) % n] >= 0) continue;
    WallChain chain;
    chain.before = loop[(k + n - 1) % n];
    std::size_t i = k;
    for (; wall[i % n] >= 0; ++i) {
      chain.nodes.push_back(loop[i % n]);
      chain.wall.push_back(wall[i % n]);
    }
    chain.nodes.push_back(loop[i % n]);
    chain.after = loop[(i + 1) % n];
    chains.push_back(std::move(chain));
  }
}

}  // namespace

std::vector<WallChain> find_wall_chains(const Mesh& mesh, std::span<const LayerWall> walls) {
  require_plane(*mesh.topology, "layers");
  std::map<Edge, Index> wanted = wall_edges(mesh, walls);
  std::vector<WallChain> chains;
  for (const auto& loop : mesh.topology->boundary_loops()) add_chains(loop, wanted, chains);
  if (!wanted.empty()) {
    const Edge inside = wanted.begin()->first;
    throw UsageError("the edge between nodes " + std::to_string(inside[0]) + " and " +
                     std::to_string(inside[1]) +
                     " has elements on both sides; layers are inserted at the boundary only");
  }
  return chains;
}

double open_angle(const Vec2& previous, const Vec2& next) {
  const double angle =
      std::atan2(next.x() * previous.y() - next.y() * previous.x(), next.dot(previous));
  return angle > 0 ? angle : angle + 2 * pi;
}

}  // namespace winslow
