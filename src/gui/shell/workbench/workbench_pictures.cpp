#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "gui/base/text.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/gl.h"
#include "gui/shell/workbench/workbench.h"
#include "gui/view/mesh/mesh_colors.h"

namespace winslow::gui {

namespace {

constexpr int picture_samples = 4;
/// Side of the pieces that a picture is drawn in, pixels: multisampled, 130 MB.
constexpr int tile_side = 2048;
/// Windows of the interface need a frame or two to find their sizes.
constexpr int frames_to_settle = 3;

/// Copies a part to where it belongs, cut off where the whole ends.
void copy_into(Image& whole, const Image& part, int x, int y) {
  const auto columns = static_cast<std::size_t>(std::min(part.width, whole.width - x));
  for (int row = 0; row < std::min(part.height, whole.height - y); ++row) {
    const auto at = 4 * (static_cast<std::size_t>(y + row) * static_cast<std::size_t>(whole.width) +
                         static_cast<std::size_t>(x));
    std::copy_n(part.pixel(0, row), 4 * columns,
                whole.rgba.begin() + static_cast<std::ptrdiff_t>(at));
  }
}

/// Where a camera's viewport and a part of the framebuffer meet, in whole pixels, as the renderer
/// draws them; pixels count from the part's corner. An empty viewport where they do not.
Camera camera_of_part(const Camera& camera, const Area& part) {
  const double left = std::round(camera.viewport_origin().x());
  const double top = std::round(camera.viewport_origin().y());
  const auto x = static_cast<double>(part.x), y = static_cast<double>(part.y);
  const double x0 = std::max(x, left);
  const double y0 = std::max(y, top);
  const double x1 =
      std::min(x + static_cast<double>(part.width), left + std::round(camera.viewport_width()));
  const double y1 =
      std::min(y + static_cast<double>(part.height), top + std::round(camera.viewport_height()));
  Camera met;
  if (x1 <= x0 || y1 <= y0) {
    met.set_viewport(0, 0, 0, 0);
    return met;
  }
  met.set_viewport(x0 - x, y0 - y, x1 - x0, y1 - y0);
  met.look_at(camera.to_world(0.5 * Vec2(x0 + x1, y0 + y1)), camera.units_per_pixel());
  return met;
}

}  // namespace

/// What the window shows, while a picture is being laid out with other sizes.
struct Workbench::Kept {
  std::unique_ptr<UiLayer> ui;
  Camera camera;
  Layout layout;
  ViewOptions view;
  std::optional<Inset> lens;
  ActionQueue actions;
  int width = 1, height = 1;
};

Workbench::Kept Workbench::put_aside() {
  return {std::move(ui_), camera_, layout_, view_, lens_, std::exchange(actions_, {}),
          width_,         height_};
}

void Workbench::bring_back(Kept kept) {
  picture_ui_ = std::move(ui_);
  picture_age_ = 0;
  ui_ = std::move(kept.ui);
  camera_ = kept.camera;
  layout_ = kept.layout;
  view_ = kept.view;
  lens_ = kept.lens;
  actions_ = std::move(kept.actions);
  width_ = kept.width;
  height_ = kept.height;
  picturing_ = mesh_alone_ = false;
  ui_->make_current();
  update_mesh_view();
}

/// Letters of large pictures take tens of megabytes.
void Workbench::forget_pictures(double seconds) {
  constexpr double patience = 1;
  picture_age_ += seconds;
  if (picture_age_ < patience || !picture_ui_) return;
  picture_ui_.reset();
  ui_->make_current();
}

Vec2 Workbench::picture_extent(const PictureSpec& spec) const {
  const Area& v = layout_.viewport;
  return spec.panels ? Vec2(width_, height_) : Vec2(v.width, v.height);
}

Image Workbench::picture(const PictureSpec& spec) {
  const Vec2 extent = picture_extent(spec);
  const auto [width, height] = picture_size(spec, extent.x(), extent.y());
  const double ratio = std::min({width / extent.x(), height / extent.y(), largest_picture_scale});
  const float unit = ui_->theme().scale * static_cast<float>(ratio);
  const Bounds visible = camera_.visible();
  // Colours must be those of this mesh, not of one a moment ago.
  session_.quality().measure_now(view_.color);

  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  Kept kept = put_aside();
  try {
    const bool fits = picture_ui_ && picture_ui_->theme().scale == unit;
    ui_ = fits ? std::move(picture_ui_) : std::make_unique<UiLayer>(unit);
    picture_ui_.reset();
    width_ = width;
    height_ = height;
    view_.legend = view_.legend && spec.legend;
    picturing_ = true;
    mesh_alone_ = !spec.panels;
    for (int frame = 0; frame < (fits && mesh_alone_ ? 1 : frames_to_settle); ++frame) {
      ui_->resemble(*kept.ui);
      lay_out_picture(visible);
    }
    Image image = paint_tiles(spec.transparent && mesh_alone_);
    bring_back(std::move(kept));
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
    return image;
  } catch (...) {
    bring_back(std::move(kept));
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
    throw;
  }
}

void Workbench::lay_out_picture(const Bounds& visible) {
  ui_->begin(InputState{}, width_, height_, 1.0 / 60);
  if (mesh_alone_) {
    layout_ = Layout();
    layout_.viewport = {0, 0, static_cast<float>(width_), static_cast<float>(height_)};
  } else {
    draw_menu();
  }
  const Area& v = layout_.viewport;
  camera_.set_viewport(v.x, v.y, v.width, v.height);
  if (session_.document()) camera_.fit(visible, 0);
  lens_ = pinned_inset(camera_, static_cast<double>(ui_->theme().scale));
  if (!mesh_alone_) draw_regions();
  draw_viewport();
  // A picture is of this mesh: here, unlike in a frame, what is prepared is waited for.
  for (update_mesh_view(); mesh_view_.busy(); update_mesh_view()) std::this_thread::yield();
  draw_overlays(*ImGui::GetBackgroundDrawList());
  ui_->end();
  actions_.clear();  // nobody pressed anything
}

void Workbench::paint_lens() {
  if (!lens_) return;
  const Camera camera = camera_of_part(lens_->camera, tile_);
  if (camera.viewport_width() > 0)
    mesh_view_.draw_magnified(camera, lens_->camera, static_cast<int>(tile_.width),
                              static_cast<int>(tile_.height));
}

Image Workbench::paint_tiles(bool transparent) {
  Image whole;
  whole.width = width_;
  whole.height = height_;
  whole.rgba.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  const int side_x = std::min(width_, tile_side);
  const int side_y = std::min(height_, tile_side);
  const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(palette().card);
  const FrameBuffer buffer(side_x, side_y, picture_samples);
  for (int y = 0; y < height_; y += side_y)
    for (int x = 0; x < width_; x += side_x) {
      if (transparent)
        buffer.clear({0, 0, 0, 0});
      else
        buffer.clear({ground.x, ground.y, ground.z, 1});
      tile_ = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(side_x),
               static_cast<float>(side_y)};
      const Camera part = camera_of_part(camera_, tile_);
      if (part.viewport_width() > 0)
        mesh_view_.draw(part, transparent ? nullptr : &camera_, side_x, side_y);
      ui_->paint_part(tile_.x, tile_.y, tile_.width, tile_.height);
      copy_into(whole, buffer.read(), x, y);
    }
  if (transparent) divide_by_alpha(whole);
  return whole;
}

/// The magnifier as a picture has it: one that follows the mouse is none of the mesh's.
std::optional<Inset> Workbench::pinned_inset(const Camera& camera, double scale) const {
  if (!session_.document() || !view_.magnifier.pin) return std::nullopt;
  return magnifier_inset(view_.magnifier, camera, Vec2(0, 0), false, scale);
}

VectorFigure Workbench::figure(bool legend) const {
  VectorFigure figure;
  const Document* document = session_.document();
  if (!document) throw Error("There is no mesh to draw.");
  figure.mesh = Mesh{session_.topology(), session_.coordinates()};
  const double scale = static_cast<double>(ui_->theme().scale);
  const Area& v = layout_.viewport;
  figure.camera.set_viewport(0, 0, v.width / scale, v.height / scale);
  figure.camera.look_at(camera_.centre(), camera_.units_per_pixel() * scale);
  if (const auto inset = pinned_inset(figure.camera, 1))
    figure.inset = FigureInset{inset->camera, inset->source};
  figure.fill = view_.fill;
  figure.wireframe = view_.wireframe;
  figure.mark_inverted = view_.mark_inverted;
  figure.framed = true;
  figure.edge_width = 0.8 * view_.line_width;
  figure.dark = mesh_colors(view_).dark;
  figure.title = document->name();
  if (view_.fill && view_.color && mesh_view_.legend()) {
    figure.values = element_values(*document->state().vcv, figure.mesh.coordinates, *view_.color);
    figure.scale = mesh_view_.legend()->scale;
    if (legend) figure.legend = mesh_view_.legend();
  }
  for (const Index node : session_.nodes().pinned())
    figure.vcvs.push_back(inspect_node(*session_.vcv(), figure.mesh.coordinates, node));
  const auto& markers = figure.mesh.topology->markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    figure.marker_colors.push_back(marker_color(static_cast<Index>(m), figure.dark));
    figure.key.emplace_back(markers[m].name, figure.marker_colors.back());
  }
  const Index inverted = check_validity(*figure.mesh.topology, figure.mesh.coordinates).inverted;
  if (inverted > 0) figure.warning = counted(inverted, "inverted element");
  return figure;
}

}  // namespace winslow::gui
