#pragma once

#include <memory>
#include <vector>

#include "core/mesh/face_pairs.h"
#include "core/mesh/topology.h"

namespace winslow {

/// The steps of Topology::build, in the order in which they run. Internal to core/mesh, as what
/// they are made of: element_checks, face_pairs, orientation, node_stars, boundary_parts.
class TopologyBuilder {
 public:
  explicit TopologyBuilder(const MeshData& data);
  std::shared_ptr<const Topology> build();

 private:
  void orient_elements();
  void build_surface();
  void build_volume();
  void make_markers();
  void list_marker_nodes();
  void classify_nodes();

  const MeshData& data_;
  FacePairs pairs_;
  std::vector<bool> turned_;  // #elements
  std::shared_ptr<Topology> topology_;
};

}  // namespace winslow
