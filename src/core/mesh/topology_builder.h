#pragma once

#include <memory>

#include "core/mesh/topology.h"

namespace winslow {

/// The steps of Topology::build, in the order in which they run. Internal to core/mesh.
class TopologyBuilder {
 public:
  explicit TopologyBuilder(const MeshData& data);
  std::shared_ptr<const Topology> build();

 private:
  void check_elements() const;
  void pair_edges();
  void orient_elements();
  void check_manifold_nodes() const;
  void build_half_edges();
  void build_stars();
  void build_loops();
  void build_markers();
  void constrain_nodes();

  void walk_part(Index seed, std::vector<signed char>& flip, std::vector<unsigned char>& seen,
                 std::vector<Index>& part) const;
  void check_open(const std::vector<Index>& part) const;

  const MeshData& data_;
  std::shared_ptr<Topology> topology_;
  /// Edge behind corner k of an element: from corner k to corner k + 1.
  std::vector<Index> corner_edge_;
};

}  // namespace winslow
