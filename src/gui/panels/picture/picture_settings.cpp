#include "gui/panels/picture/picture_settings.h"

#include <cmath>
#include <vector>

#include "core/error.h"
#include "gui/base/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

struct Choice {
  const char* label;
  double scale;
};
constexpr std::array<Choice, 4> choices{
    {{"As the window", 1}, {"Twice as large", 2}, {"Four times as large", 4}, {"Other", 0}}};

}  // namespace

void PictureSettings::set(const PictureSpec& spec, double width, double height) {
  spec_ = spec;
  width_ = spec.size ? (*spec.size)[0] : static_cast<int>(std::lround(width));
  height_ = spec.size ? (*spec.size)[1] : static_cast<int>(std::lround(height));
}

void PictureSettings::draw(const std::string& id, bool film, double width, double height) {
  std::vector<std::string> labels;
  std::size_t chosen = choices.size() - 1;
  for (std::size_t k = 0; k < choices.size(); ++k) {
    labels.emplace_back(choices[k].label);
    if (!spec_.size && choices[k].scale == spec_.scale) chosen = k;
  }
  ui::row("Size", "Letters and lines grow with the picture: it looks the same, only finer.");
  if (ui::combo(id + "/size", labels, chosen)) {
    spec_.size.reset();
    spec_.scale = choices[chosen].scale;
    if (chosen + 1 == choices.size()) spec_.size = {width_, height_};
  }
  if (spec_.size) {
    ui::row("Width", "Pixels");
    ui::number(id + "/width", width_);
    ui::row("Height", "Pixels");
    ui::number(id + "/height", height_);
    spec_.size = {width_, height_};
  }
  bool mesh_alone = !spec_.panels;
  if (ui::checkbox(id + "/mesh_alone", "The mesh alone", mesh_alone,
                   "Without panels, handles and buttons"))
    spec_.panels = !mesh_alone;
  if (mesh_alone && !film)
    ui::checkbox(id + "/transparent", "Transparent background", spec_.transparent,
                 "No paper behind the mesh: for slides and drawings");
  ui::checkbox(id + "/legend", "Legend", spec_.legend, "The bar that says what the colours mean");
  error_.clear();
  try {
    const auto size = picture_size(spec_, width, height);
    ui::text_dim(grouped(size[0]) + " x " + grouped(size[1]) + " pixels");
  } catch (const Error& wrong) {
    error_ = wrong.what();
    ui::text_colored(palette().danger, "Too large or too small");
    ui::tooltip(error_);
  }
}

}  // namespace winslow::gui
