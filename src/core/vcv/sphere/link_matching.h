#pragma once

#include <atomic>

#include "core/mesh/mesh.h"
#include "core/vcv/sphere/node_vcv.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/vcv_edit.h"

/// Finds nodes of a volume mesh that can be given the VCV of another node. The link of a node is
/// the graph of its neighbours. Two nodes can have the same VCV if their links are the same graph.
namespace winslow {

/// Maps the vertices of one link to those of another: element i of the result is the vertex of `to`
/// that vertex i of `from` is mapped to. Triangles are mapped to triangles and keep their
/// orientation. Of all such maps this is the one for which the directions of the vertices agree
/// best (largest sum of cosines). There is none if the links are different graphs, or if one is the
/// mirror image of the other.
///
/// A link is a 3-connected planar graph, so the image of one half-edge determines the whole map.
/// There are at most as many maps as half-edges; each is found or ruled out in linear time.
std::optional<std::vector<Index>> match_links(const SphereLink& from, std::span<const Vec3> there,
                                              const SphereLink& to, std::span<const Vec3> here);

/// A node whose link is the same graph as that of another node. Its neighbours are in the order of
/// the map: neighbour k corresponds to neighbour k of the other node.
struct MatchedStar {
  Index node = -1;
  std::vector<Index> neighbours;
  bool operator==(const MatchedStar&) const = default;
};

/// Returns the candidates whose link is the same graph as that of `source`, in the order given.
/// Edges that point in about the same direction in the mesh are matched. The result leaves out
/// `source` itself and nodes without a VCV. source: an interior node of a volume mesh. stop: the
/// search ends early when it becomes true, and returns what it has found. Throws UsageError or
/// MeshError if the source has no link.
std::vector<MatchedStar> matching_stars(const Mesh& mesh, Index source,
                                        std::span<const Index> candidates,
                                        const std::atomic<bool>* stop = nullptr);

/// Edits that give each of these nodes this VCV.
std::vector<VcvEdit> spread_vcv(const SphereStencil& stencil, std::span<const MatchedStar> stars);

}  // namespace winslow
