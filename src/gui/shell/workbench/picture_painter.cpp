#include "gui/shell/workbench/picture_painter.h"

#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "gui/base/text.h"
#include "gui/picture/space/scene_figure.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/gl.h"
#include "gui/render/space/space_view.h"
#include "gui/view/mesh/mesh_colors.h"

namespace winslow::gui {

namespace {

constexpr int samples = 4;
/// Side of the tiles of a picture, pixels; a multisampled tile needs 130 MB.
constexpr int tile_side = 2048;
/// ImGui windows need one or two frames to determine their sizes.
constexpr int frames_to_settle = 3;

/// Copies a tile to its place, clipped to the whole picture.
void copy_into(Image& whole, const Image& part, int x, int y) {
  const auto columns = static_cast<std::size_t>(std::min(part.width, whole.width - x));
  for (int row = 0; row < std::min(part.height, whole.height - y); ++row) {
    const auto at = 4 * (static_cast<std::size_t>(y + row) * static_cast<std::size_t>(whole.width) +
                         static_cast<std::size_t>(x));
    std::copy_n(part.pixel(0, row), 4 * columns,
                whole.rgba.begin() + static_cast<std::ptrdiff_t>(at));
  }
}

/// Gives a camera the view of another one, in a viewport of another size.
void fill_viewport(SpaceCamera& camera, const SpaceCamera& as, const ScreenBox& v) {
  const ScreenVector size = as.viewport().size();
  camera = as;
  camera.set_viewport(v.min.x(), v.min.y(), v.size().x(), v.size().y());
  const ScreenVector now = camera.viewport().size();
  camera.look_at(as.centre(),
                 as.units_per_pixel() * std::max(size.x() / now.x(), size.y() / now.y()));
}

/// Names and colours of the visible markers.
std::vector<std::pair<std::string, Rgb>> key_of(const VolumeScenes& scenes,
                                                const Topology& topology) {
  std::vector<std::pair<std::string, Rgb>> key;
  for (std::size_t m = 0; m < topology.markers().size(); ++m) {
    if (m >= scenes.of.marker_colors.size()) break;
    const std::uint32_t color = pack_color(scenes.of.marker_colors[m]);
    const bool seen = std::ranges::any_of(scenes.parts, [&](const auto& part) {
      return std::ranges::any_of(part->fills, [&](const SpaceFill& fill) {
        return fill.marker == static_cast<Index>(m) &&
               std::ranges::any_of(fill.corners,
                                   [&](const SpaceCorner& c) { return c.rgba == color; });
      });
    });
    if (seen) key.emplace_back(topology.markers()[m].name, scenes.of.marker_colors[m]);
  }
  return key;
}

}  // namespace

/// A picture being made.
struct PicturePainter::Picture {
  std::unique_ptr<WindowFrame> frame;
  bool kept = false;  ///< its frame is reused from the previous picture
  bool mesh_alone = false;
  double turned = 0;  ///< rotation of the view of a volume mesh
  ViewOptions options;
  Camera view;
  SpaceCamera space;
  ActionQueue actions;  ///< not carried out
  PanelContext context;
  Lens lens;

  Picture(std::unique_ptr<WindowFrame> of, const Shown& shown)
      : frame(std::move(of)),
        options(shown.context.view),
        view(shown.view),
        space(shown.space),
        context{shown.context.session,
                options,
                shown.context.view_state,
                frame->ui.theme(),
                actions,
                shown.context.capture,
                shown.context.recent,
                shown.context.demo,
                shown.context.before,
                shown.pane.mesh_view().shown()},
        lens(shown.pane.mesh_view()) {}
};

PicturePainter::~PicturePainter() = default;

void PicturePainter::paint_window() {
  WindowFrame& window = shown_.window;
  glViewport(0, 0, window.width, window.height);
  glDisable(GL_SCISSOR_TEST);
  const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(
      (shown_.context.view.lightness == Lightness::dark ? dark_palette() : light_palette()).card);
  glClearColor(ground.x, ground.y, ground.z, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  shown_.pane.lens().set_tile({ScreenPoint(), ScreenPoint(window.width, window.height)});
  MeshView& mesh = shown_.pane.mesh_view();
  if (shown_.session.in_space())
    mesh.volume().draw_kept(shown_.space, window.width, window.height);
  else
    mesh.draw_kept(shown_.view, window.width, window.height);
  window.ui.paint();
}

Image PicturePainter::picture() {
  const unsigned bound = FrameBuffer::bound();
  FrameBuffer buffer(shown_.window.width, shown_.window.height, samples);
  buffer.bind();
  paint_window();
  Image image = buffer.read();
  glBindFramebuffer(GL_FRAMEBUFFER, bound);
  return image;
}

/// The fonts of large pictures need tens of megabytes.
void PicturePainter::forget_idle(double seconds) {
  constexpr double patience = 1;
  age_ += seconds;
  if (age_ < patience || !last_) return;
  last_.reset();
  shown_.window.ui.make_current();
}

ScreenVector PicturePainter::picture_extent(const PictureSpec& spec) const {
  const Area& v = shown_.window.layout.viewport;
  if (spec.panels) return ScreenVector(shown_.window.width, shown_.window.height);
  // The mesh at its size on screen, with the legend's strip beside it.
  const float legend = spec.legend ? shown_.window.layout.legend.width : 0;
  return ScreenVector(v.width + legend, v.height);
}

Image PicturePainter::picture_of(const Coordinates& nodes, const PictureSpec& spec) {
  if (nodes == shown_.session.coordinates()) return picture(spec);
  shown_.session.show_instead(nodes);
  try {
    Image image = picture(spec);
    shown_.session.show_instead({});
    return image;
  } catch (...) {
    shown_.session.show_instead({});
    throw;
  }
}

Image PicturePainter::picture(const PictureSpec& spec) {
  const ScreenVector extent = picture_extent(spec);
  const auto [width, height] = picture_size(spec, extent.x(), extent.y());
  const double ratio = std::min({width / extent.x(), height / extent.y(), largest_picture_scale});
  const float unit = shown_.window.ui.theme().scale * static_cast<float>(ratio);
  const Bounds visible = shown_.view.visible();
  // The colours must match this mesh, not an earlier one.
  const ViewOptions& view = shown_.context.view;
  shown_.session.quality().measure_now(view.color, view.before);

  const unsigned bound = FrameBuffer::bound();
  std::unique_ptr<Picture> picture;
  try {
    picture = begin(spec, unit);
    picture->frame->width = width;
    picture->frame->height = height;
    const int frames = picture->kept && picture->mesh_alone ? 1 : frames_to_settle;
    for (int frame = 0; frame < frames; ++frame) {
      picture->frame->ui.resemble(shown_.window.ui);
      lay_out(*picture, visible);
    }
    Image image = paint_tiles(*picture, spec.transparent && picture->mesh_alone);
    end(std::move(picture), bound);
    return image;
  } catch (...) {
    end(std::move(picture), bound);
    throw;
  }
}

std::unique_ptr<PicturePainter::Picture> PicturePainter::begin(const PictureSpec& spec,
                                                               float scale) {
  const bool kept = last_ && last_->ui.theme().scale == scale;
  std::unique_ptr<WindowFrame> frame =
      kept ? std::move(last_) : std::make_unique<WindowFrame>(scale);
  last_.reset();
  frame->layout = shown_.window.layout;
  auto picture = std::make_unique<Picture>(std::move(frame), shown_);
  picture->kept = kept;
  picture->mesh_alone = !spec.panels;
  picture->turned = spec.turned;
  picture->options.legend = picture->options.legend && spec.legend;
  return picture;
}

/// Keeps the frame of a picture for the next one and restores the drawing of the window. picture:
/// null if it could not be begun.
void PicturePainter::end(std::unique_ptr<Picture> picture, unsigned framebuffer) {
  if (picture) last_ = std::move(picture->frame);
  age_ = 0;
  UiLayer& ui = shown_.window.ui;
  ui.make_current();
  const bool in_space = shown_.session.in_space();
  const View& view = in_space ? static_cast<const View&>(shown_.space) : shown_.view;
  shown_.pane.update(shown_.context.view, view, ui.theme().scale);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

void PicturePainter::lay_out(Picture& picture, const Bounds& visible) {
  WindowFrame& frame = *picture.frame;
  // The layout of the previous frame may have replaced the mesh shown in the panels.
  picture.context.shown = shown_.pane.mesh_view().shown();
  frame.ui.begin(InputState{}, frame.width, frame.height, 1.0 / 60);
  if (picture.mesh_alone) {
    frame.layout.arrange_mesh(frame.width, frame.height, picture.options, frame.ui.theme());
  } else {
    shown_.regions.draw_menu(picture.context, frame);
  }
  const Area& v = frame.layout.viewport;
  picture.view.set_viewport(v.x, v.y, v.width, v.height);
  const bool in_space = shown_.session.in_space();
  ScreenBox now{{v.x, v.y}, {v.x + v.width, v.y + v.height}};
  if (picture.options.comparison == Comparison::split)
    now = side_by_side(now, picture.options.divider).now;
  if (in_space) fill_viewport(picture.space, shown_.space, now);
  if (in_space && picture.turned != 0) {
    ViewDirection direction = picture.space.direction();
    direction.azimuth += picture.turned;
    picture.space.look_from(direction);
  }
  if (!in_space && shown_.session.document()) picture.view.fit(visible, 0);
  const View& view = in_space ? static_cast<const View&>(picture.space) : picture.view;
  const float scale = frame.ui.theme().scale;
  picture.lens.place(in_space ? std::nullopt
                              : pinned_inset(shown_.session, picture.options, picture.view,
                                             static_cast<double>(scale)));
  if (!picture.mesh_alone) shown_.regions.draw(picture.context, frame.layout);
  shown_.regions.draw_over_mesh(
      picture.context, frame.layout.viewport,
      picture.mesh_alone ? Regions::Cards::none : Regions::Cards::of_the_mesh);
  // A picture must show this mesh: unlike a frame, wait until it is prepared.
  ViewportPane& pane = shown_.pane;
  const auto update = [&] { pane.update(picture.options, view, scale); };
  for (update(); pane.mesh_view().busy(); update()) std::this_thread::yield();
  pane.draw_overlays(*ImGui::GetBackgroundDrawList(),
                     {picture.context, view, frame.layout, picture.lens,
                      in_space ? &picture.space : nullptr, picture.mesh_alone});
  frame.ui.end();
  picture.actions.clear();  // a picture has no user input
}

Image PicturePainter::paint_tiles(Picture& picture, bool transparent) {
  const int width = picture.frame->width, height = picture.frame->height;
  Image whole;
  whole.width = width;
  whole.height = height;
  whole.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const int side_x = std::min(width, tile_side);
  const int side_y = std::min(height, tile_side);
  const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(palette().card);
  const FrameBuffer buffer(side_x, side_y, samples);
  for (int y = 0; y < height; y += side_y)
    for (int x = 0; x < width; x += side_x) {
      if (transparent)
        buffer.clear({0, 0, 0, 0});
      else
        buffer.clear({ground.x, ground.y, ground.z, 1});
      const ScreenBox tile{ScreenPoint(x, y), ScreenPoint(x + side_x, y + side_y)};
      picture.lens.set_tile(tile);
      if (shown_.session.in_space())
        draw_space_tile(picture, tile, transparent, side_y);
      else if (const auto part = part_of(picture.view, tile))
        shown_.pane.mesh_view().draw(*part, transparent ? nullptr : &picture.view, side_y);
      picture.frame->ui.paint_part(static_cast<float>(x), static_cast<float>(y),
                                   static_cast<float>(side_x), static_cast<float>(side_y));
      copy_into(whole, buffer.read(), x, y);
    }
  if (transparent) divide_by_alpha(whole);
  return whole;
}

void PicturePainter::draw_space_tile(const Picture& picture, const ScreenBox& tile,
                                     bool transparent, int height) {
  SpaceCamera camera = picture.space;
  const ScreenVector corner = camera.viewport().min - tile.min;
  const ScreenVector size = camera.viewport().size();
  camera.set_viewport(corner.x(), corner.y(), size.x(), size.y());
  const ScreenBox whole = camera.viewport();
  shown_.pane.mesh_view().volume().draw(camera, transparent ? nullptr : &whole, height);
}

VectorFigure PicturePainter::figure(bool legend) const {
  VectorFigure figure;
  const Session& session = shown_.session;
  if (session.in_space()) return space_figure(legend);
  const ViewOptions& view = shown_.context.view;
  const auto& shown_legend = shown_.pane.mesh_view().legend();
  const Document* document = session.document();
  if (!document) throw Error("There is no mesh to draw.");
  figure.mesh = Mesh{session.topology(), session.coordinates()};
  const double scale = static_cast<double>(shown_.window.ui.theme().scale);
  const Area& v = shown_.window.layout.viewport;
  figure.camera.set_viewport(0, 0, v.width / scale, v.height / scale);
  figure.camera.look_at(shown_.view.centre(), shown_.view.units_per_pixel() * scale);
  if (const auto inset = pinned_inset(session, view, figure.camera, 1))
    figure.inset = FigureInset{inset->camera, inset->source};
  figure.fill = view.fill;
  figure.wireframe = view.wireframe;
  figure.mark_inverted = view.mark_inverted;
  figure.framed = true;
  figure.edge_width = 0.8 * view.line_width;
  figure.dark = mesh_colors(view).dark;
  figure.title = document->name();
  if (view.fill && view.color && shown_legend) {
    shown_.session.quality().measure_now(view.color, view.before);
    figure.values = shown_.session.quality().latest()->values;
    figure.scale = shown_legend->scale;
    if (legend) figure.legend = shown_legend;
  }
  for (const Index node : session.nodes().pinned())
    figure.vcvs.push_back(inspect_node(*session.vcv(), figure.mesh.coordinates, node));
  const auto& markers = figure.mesh.topology->markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const Rgb color = color_of_marker(view, markers[m].name, static_cast<Index>(m), figure.dark);
    const bool hidden = view.markers.of(markers[m].name).hidden;
    figure.marker_colors.push_back(hidden ? std::nullopt : std::optional(color));
    if (!hidden) figure.key.emplace_back(markers[m].name, color);
  }
  const Index inverted = check_validity(*figure.mesh.topology, figure.mesh.coordinates).inverted;
  if (inverted > 0) figure.warning = counted(inverted, "inverted element");
  return figure;
}

/// The present view of the mesh; as a raster image if there are too many polygons.
VectorFigure PicturePainter::space_figure(bool legend) const {
  VectorFigure figure;
  const Session& session = shown_.session;
  const ViewOptions& view = shown_.context.view;
  const VolumeView& volume = shown_.pane.mesh_view().volume();
  if (!volume.scenes()) throw Error("The mesh is not drawn yet.");
  const VolumeScenes& scenes = *volume.scenes();
  const double scale = static_cast<double>(shown_.window.ui.theme().scale);
  SpaceCamera camera = shown_.space;
  const ScreenVector size = camera.viewport().size() / scale;
  camera.set_viewport(0, 0, size.x(), size.y());
  camera.look_at(camera.centre(), camera.units_per_pixel() * scale);
  figure.camera.set_viewport(0, 0, size.x(), size.y());
  figure.framed = true;
  figure.dark = mesh_colors(view).dark;
  figure.title = session.document()->name();
  if (legend && view.legend && scenes.legend) figure.legend = scenes.legend;
  figure.key = key_of(scenes, *session.topology());
  const Index inverted = scenes.shown.validity.inverted;
  if (inverted > 0) figure.warning = counted(inverted, "inverted element");
  SceneFigureOptions how;
  how.line_scale = 1 / scale;
  how.axes = view.space.axes;
  how.scale_bar = view.scale_bar;
  if (figure.dark) how.ink = {0.86f, 0.88f, 0.92f};
  FigureScene drawn = figure_of_scene(scenes.parts, scenes.planes, camera, how);
  if (drawn.wants_raster) drawn.raster = raster_of(camera, drawn.raster_pixels);
  figure.scene = std::make_shared<const FigureScene>(std::move(drawn));
  return figure;
}

/// The view of a camera as a raster image, with so many pixels per point.
Image PicturePainter::raster_of(SpaceCamera camera, double finest) const {
  const ScreenVector size = camera.viewport().size();
  const double factor = std::min(finest, 2.0 * tile_side / std::max(size.x(), size.y()));
  const auto width = static_cast<int>(std::lround(factor * size.x()));
  const auto height = static_cast<int>(std::lround(factor * size.y()));
  camera.set_viewport(0, 0, width, height);
  camera.look_at(camera.centre(), camera.units_per_pixel() / factor);
  const unsigned bound = FrameBuffer::bound();
  const FrameBuffer buffer(width, height, samples);
  buffer.clear({0, 0, 0, 0});
  shown_.pane.mesh_view().volume().draw_alone(camera, height);
  Image image = buffer.read();
  divide_by_alpha(image);
  glBindFramebuffer(GL_FRAMEBUFFER, bound);
  return image;
}

}  // namespace winslow::gui
