#include "gui/panels/picture/picture_dialog.h"

#include "gui/picture/capture/capture.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/dialog.h"

namespace winslow::gui {

void PictureDialog::set_extents(const ScreenVector& window, const ScreenVector& mesh) {
  window_ = window;
  mesh_ = mesh;
}

void PictureDialog::draw(const PanelContext& context) {
  if (std::exchange(opened_, false))
    settings_.set(context.capture.picture(), window_.x(), window_.y());
  ui::Dialog dialog("###picture", "Save a picture", wanted_, context.theme);
  if (!dialog.shown()) return;
  const ScreenVector& extent = settings_.spec().panels ? window_ : mesh_;
  settings_.draw("picture", false, extent.x(), extent.y());
  ImGui::Spacing();
  ui::text_dim("A name that ends in .svg or .pdf gives vector graphics");
  ui::text_dim("of the mesh alone, for print.");
  const auto answer = dialog.buttons("picture", "Choose file...", settings_.error().empty());
  if (!answer.accepted) return;
  context.emit(action::SetPictureSpec{settings_.spec()});
  context.emit(action::ShowFileDialog{FilePurpose::picture});
}

}  // namespace winslow::gui
