#include "gui/view/overlays/lens.h"

namespace winslow::gui {

void Lens::draw(ImDrawList& list, const ViewOverlay& overlay) {
  if (!inset_) return;
  draw_inset_source(list, overlay.theme, *inset_);
  list.AddCallback(
      [](const ImDrawList*, const ImDrawCmd* command) {
        static_cast<const Lens*>(command->UserCallbackData)->paint();
      },
      this);
  draw_inset_frame(list, overlay, *inset_);
}

void Lens::paint() const {
  if (!inset_) return;
  const std::optional<Camera> camera = part_of(inset_->camera, tile_);
  if (!camera) return;
  const ScreenVector size = tile_.size();
  mesh_.draw_magnified(*camera, inset_->camera, static_cast<int>(size.x()),
                       static_cast<int>(size.y()));
}

}  // namespace winslow::gui
