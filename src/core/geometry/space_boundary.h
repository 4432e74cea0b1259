#pragma once

#include "core/geometry/boundary_kinds.h"
#include "core/geometry/curve.h"
#include "core/geometry/surface/surface.h"
#include "core/mesh/surface_faces.h"

namespace winslow {

/// Surfaces and curves of space, and which of them each node slides on.
class SpaceGeometry final : public SlidingGeometry {
 public:
  Foot foot(Index node, const Vec3& point) const override;

  /// x: of all nodes, near the surface.
  void add(std::shared_ptr<const Surface> surface, std::span<const Index> nodes,
           const SpacePoints& x);
  void add(std::shared_ptr<const SpaceCurve> curve, std::span<const Index> nodes);

 private:
  struct Piece {
    std::shared_ptr<const Surface> surface;
    std::shared_ptr<const SpaceCurve> curve;
  };

  struct Slider {
    Index piece;
    Vec3 direction;  // that the first of its frame is to be near to
  };

  std::vector<Piece> pieces_;
  std::vector<Slider> sliders_;
  NodeParts numbers_;  // of the sliders
};

/// The faces of sliding markers of a volume mesh, or the elements of a surface mesh, and which
/// nodes lie on the boundary that does not slide (#nodes, 1 or 0).
struct SlidingFaces {
  std::vector<SurfaceFace> faces;
  std::vector<unsigned char> stays;
};
/// markers: indices; of a surface mesh none are looked at.
SlidingFaces sliding_faces(const Topology& topology, std::span<const Index> markers);

/// For reports: of the marker of a face, -1 for none.
std::string part_name(const Topology& topology, Index marker);
/// The lowest marker of the faces at each node of some faces.
std::map<Index, Index> markers_at(std::span<const SurfaceFace> faces);

}  // namespace winslow
