#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/vcv/sphere/node_vcv.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/vcv_edit.h"

/// Which nodes of a volume mesh can take the VCV of another: those whose link is the same graph.
namespace winslow {

/// For each vertex of one link the vertex of the other that stands for it, so that triangles go to
/// triangles and keep their orientation; of all such ways the one that brings the directions of the
/// vertices nearest (in the sum of cosines). None: the links are not the same graph, or one is the
/// mirror image of the other.
///
/// Where one half-edge goes says where all others go, since a link is a 3-connected planar graph:
/// so there are at most as many ways as half-edges, each found or refused in linear time.
std::optional<std::vector<Index>> match_links(const SphereLink& from, std::span<const Vec3> there,
                                              const SphereLink& to, std::span<const Vec3> here);

/// A node whose link is that of another node: its neighbours in the order of the other's.
struct MatchedStar {
  Index node = -1;
  std::vector<Index> neighbours;
  bool operator==(const MatchedStar&) const = default;
};

/// Of the candidates those whose link is that of `source`, an interior node of a volume mesh, in
/// their order; edges that point the same way in the mesh belong together. Source itself, and nodes
/// without a VCV, are left out. stop: gives up, and returns what it has. Throws UsageError or
/// MeshError where the source has no link.
std::vector<MatchedStar> matching_stars(const Mesh& mesh, Index source,
                                        std::span<const Index> candidates,
                                        const std::atomic<bool>* stop = nullptr);

/// Edits that give each of these nodes the VCV of the other.
std::vector<VcvEdit> spread_vcv(const SphereStencil& stencil, std::span<const MatchedStar> stars);

}  // namespace winslow
