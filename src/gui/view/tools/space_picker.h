#pragma once

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/mesh/volume_view.h"
#include "gui/view/tools/mesh_picker.h"

namespace winslow::gui {

/// Corners of the face of the boundary that is seen at a place, counter-clockwise for the viewer;
/// empty: none is.
std::vector<Index> seen_face(const SeenPlace& seen, const Mesh& mesh);
/// The corner of seen_face() that is nearest to the place.
std::optional<Index> nearest_corner(const SeenPlace& seen, const Mesh& mesh);

/// Finds what a click in a volume mesh sets the pivot to.
class PivotPicker {
 public:
  /// The pivot that a click at a place would set; none: no surface is there. If the pivot is made
  /// from two nodes: the node there alone, or both once `first` is set.
  std::optional<PivotSource> source_at(const SeenPlace& seen, PivotFrom from,
                                       std::optional<Index> first, const Session& session);
  /// End nodes of the straight row of sharp edges through an edge. The edge's own ends if it is not
  /// sharp.
  std::vector<Index> straight_row(Index a, Index b, const Session& session);

 private:
  void find_sharp_edges(const Session& session);
  Index end_of_row(Index from, Index to, const Coordinates& x) const;

  // Sharp edges by their nodes, of the mesh of generation_.
  std::vector<std::array<Index, 2>> sharp_;  // both ways, ascending
  std::uint64_t generation_ = 0;
};

/// The visible place of a surface mesh's border lines that is nearest to a place of the screen, at
/// most `reach` pixels away. None for lines hidden by their marker's eye or by the surface, and for
/// other meshes.
std::optional<SeenPlace> seen_border(const ScreenPoint& at, double reach, const VolumeView& picture,
                                     const View& view, const MarkerLooks& looks);

/// Picks in the picture of a mesh of space: only what is seen can be picked.
class SpacePicker : public MeshPicker {
 public:
  void look_again() override { looked_.reset(); }
  std::optional<Vec3> point(const PointerFrame& frame) const override;
  Vec3 middle(const PointerFrame& frame) const override;
  std::optional<Vec3> grab(const PointerFrame& frame) override;
  void click(const PointerFrame& frame) const override;
  bool inspect(const PointerFrame& frame) const override;
  std::optional<RulerPoint> ruler_point(const PointerFrame& frame) override;
  PickedPlace place_at(const ScreenPoint& at, const PointerFrame& frame) override;

 private:
  void find(const PointerFrame& frame, bool handled) override;
  void forget() override;
  void find_held(const PointerFrame& frame);
  bool click_for_pivot(const PointerFrame& frame) const;
  void click_for_shape(bool add, const PointerFrame& frame) const;

  PivotPicker pivot_picker_;
  std::optional<SeenPlace> surface_;  // place for which pivot_source() and held() were found
  // Input for which seen() was found.
  struct Looked {
    ScreenPoint at;
    ViewKey view;
    const VolumeScenes* scenes = nullptr;
    bool operator==(const Looked&) const = default;
  };
  std::optional<Looked> looked_;
};

}  // namespace winslow::gui
