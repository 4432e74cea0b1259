#pragma once

#include "gui/view/tools/mesh_picker.h"
#include "gui/view/tools/pivot_picker.h"

namespace winslow::gui {

/// Picks in the picture of a mesh of space: only what is seen can be picked.
class SpacePicker : public MeshPicker {
 public:
  void look_again() override { looked_.reset(); }
  std::optional<Vec3> point(const PointerFrame& frame) const override;
  Vec3 middle(const PointerFrame& frame) const override;
  std::optional<Vec3> take(const PointerFrame& frame) override;
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
  std::optional<SeenPlace> surface_;  // of which pivot_source() and held() are
  // What seen() was found for.
  struct Looked {
    ScreenPoint at;
    ViewKey view;
    const VolumeScenes* scenes = nullptr;
    bool operator==(const Looked&) const = default;
  };
  std::optional<Looked> looked_;
};

}  // namespace winslow::gui
