#pragma once

#include "core/mesh/face_pairs.h"
#include "core/mesh/mesh_data.h"
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

/// The connected parts of a mesh's boundary as faces with the elements behind them: the loops of a
/// plane or surface mesh, walked along; of a volume mesh the surfaces whose faces hang together by
/// edges, in the order of their first faces.
std::vector<std::vector<Face>> boundary_parts(const Topology& topology);

/// Throws MeshError naming an element: of another dimension than the first or than the space has
/// room for, with another number of corners than its type has, with a corner that is no node, or
/// one twice. Also if there is no element.
void check_elements(const MeshData& data);

}  // namespace winslow
