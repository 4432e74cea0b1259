#include "gui/view/mesh/volume_view.h"

#include "gui/render/space/space_view.h"
#include "gui/view/mesh/mesh_colors.h"

namespace winslow::gui {

namespace {

Rgba mixed(const Rgba& a, const Rgba& b, float share) {
  Rgba c = a;
  for (std::size_t k = 0; k < 3; ++k) c[k] += share * (b[k] - a[k]);
  return c;
}

VolumeStyle volume_style(const ViewOptions& view, float scale) {
  const MeshColors colors = mesh_colors(view);
  const BackdropColors ground = backdrop_colors(view);
  VolumeStyle style;
  // With edges alone, surfaces have the colour of the background, and hide the edges behind them.
  style.fill = view.fill ? colors.fill : mixed(ground.top, ground.bottom, 0.5f);
  style.edge = colors.edge;
  style.edge[3] *= 0.8f;
  style.feature = colors.dark ? Rgba{0.78f, 0.81f, 0.86f, 1} : Rgba{0.13f, 0.15f, 0.18f, 1};
  style.enclosure = colors.dark ? Rgba{0.50f, 0.54f, 0.61f, 1} : Rgba{0.45f, 0.48f, 0.53f, 1};
  style.inverted = colors.inverted;
  style.ghost = colors.ghost;
  style.ghost[3] = 1;
  style.edge_width = scale * static_cast<float>(view.line_width);
  style.feature_width = 1.7f * scale;
  return style;
}

/// Colour of surfaces: paler than that of lines, so that edges stay visible on them.
Rgb surface_color(const ViewOptions& view, const VolumeStyle& style, const std::string& name,
                  Index marker) {
  if (!view.fill) return {style.fill[0], style.fill[1], style.fill[2]};
  const bool dark = mesh_colors(view).dark;
  Rgb color = color_of_marker(view, name, marker, dark);
  const float share = view.markers.of(name).color ? 0.15f : dark ? 0.45f : 0.5f;
  for (std::size_t c = 0; c < 3; ++c) color[c] += share * (style.fill[c] - color[c]);
  return color;
}

MarkerShow show_of(const MarkerLook& look) {
  if (look.hidden) return MarkerShow::hidden;
  if (look.opacity < 1 && look.drawing != MarkerDrawing::outline) return MarkerShow::see_through;
  if (look.drawing == MarkerDrawing::surface) return MarkerShow::surface;
  return look.drawing == MarkerDrawing::outline ? MarkerShow::outline : MarkerShow::automatic;
}

bool usable(const CutPlane& cut) {
  const Vec3 normal(cut.normal.data());
  return cut.on && Vec3(cut.point.data()).allFinite() && normal.allFinite() && normal.norm() > 0;
}

/// The viewport as a camera of the plane, for functions that need one.
Camera viewport_of(const ScreenBox& box) {
  Camera camera;
  camera.set_viewport(box.min.x(), box.min.y(), box.size().x(), box.size().y());
  return camera;
}

}  // namespace

VolumeWish VolumeView::wish_of(const Session& session, const ViewOptions& view, float scale) {
  VolumeWish wish;
  wish.generation = generation_;
  wish.shape = shape_;
  wish.mesh = mesh_;
  wish.boundary = session.document()->boundary();
  // Until the requested field is measured, the colours stay.
  const auto& latest = session.quality().latest();
  if (!view.color)
    measured_.reset();
  else if (latest && latest->field == view.color && !latest->values.empty())
    measured_ = latest;
  wish.measured = measured_;
  wish.colors = color_choice(view);
  wish.isolation = view.isolation;
  const bool volume = session.kind() == MeshKind::volume;
  for (const CutPlane& cut : view.space.cuts)
    if (volume && usable(cut) && wish.cuts.size() < most_clip_planes) wish.cuts.push_back(cut);
  wish.crinkle = view.space.crinkle;
  if (volume && view.space.peel.on && session.topology()->markers().find(view.space.peel.marker))
    wish.peel = view.space.peel;
  wish.mark_inverted = view.mark_inverted;
  wish.worst = worst_;
  wish.surfaces = view.fill;
  wish.edges = view.wireframe;
  wish.style = volume_style(view, scale);
  const auto& markers = session.topology()->markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const MarkerLook look = view.markers.of(markers[m].name);
    wish.markers.push_back(show_of(look));
    wish.opacity.push_back(static_cast<float>(look.opacity));
    wish.marker_colors.push_back(
        surface_color(view, wish.style, markers[m].name, static_cast<Index>(m)));
    if (!volume)
      wish.border_colors.push_back(
          color_of_marker(view, markers[m].name, static_cast<Index>(m), mesh_colors(view).dark));
  }
  if (volume) return wish;
  wish.surface = session.document()->state().surface;
  wish.feature_angle = session.solver_settings().smooth_options().slide.feature_angle;
  return wish;
}

void VolumeView::update(const Session& session, const BeforeMesh& before, const ViewOptions& view,
                        float scale) {
  poll();
  comparison_ = view.comparison;
  divider_ = view.divider;
  if (generation_ != session.generation()) measured_.reset();
  if (!mesh_ || generation_ != session.generation() || shape_ != session.shape()) {
    mesh_ = session.mesh().shared();
    generation_ = session.generation();
    shape_ = session.shape();
  }
  backdrop_ = backdrop_colors(view);
  VolumeWish wish = wish_of(session, view, scale);
  layer_.want(wish);
  if (compares())
    compare(session, before, std::move(wish));
  else
    before_layer_.clear();
  choose_tints(session);
}

/// wish: of the mesh now.
void VolumeView::compare(const Session& session, const BeforeMesh& before, VolumeWish wish) {
  if (!before_mesh_ || before_generation_ != session.generation() ||
      before_shape_ != before.shape())
    before_mesh_ = std::make_shared<const Mesh>(Mesh{before.topology(), *before.coordinates()});
  before_generation_ = session.generation();
  before_shape_ = before.shape();
  wish.mesh = before_mesh_;
  wish.shape = before.shape();
  wish.worst.clear();
  wish.ghost = comparison_ == Comparison::ghost;
  wish.measured.reset();
  if (wish.ghost) {
    wish.colors = {};
    wish.isolation = {};
    return before_layer_.want(std::move(wish));
  }
  const auto measured = before.measured();
  if (measured && measured->field && measured_ && measured->field == measured_->field &&
      !measured->values.empty())
    wish.measured = measured;
  // The same colour means the same value on both sides.
  if (const auto& legend = this->legend()) {
    wish.colors.range = {{legend->scale.low, legend->scale.high}};
    wish.colors.axis = legend->scale.logarithmic ? ColorAxis::logarithmic : ColorAxis::linear;
  }
  before_layer_.want(std::move(wish));
}

bool VolumeView::poll() {
  const bool news = layer_.poll();
  return before_layer_.poll() || news;
}

void VolumeView::clear() {
  if (!mesh_) return;
  layer_.clear();
  before_layer_.clear();
  renderer_.set_parts({}, {});
  before_renderer_.set_parts({}, {});
  drawn_ = before_drawn_ = ghost_drawn_ = 0;
  before_mesh_.reset();
  worst_.clear();
  mesh_.reset();
  measured_.reset();
  kept_.clear();
}

/// Tints the selection, and what lies under the mouse in the list or in the picture.
void VolumeView::choose_tints(const Session& session) {
  constexpr Rgba accent{0.16f, 0.45f, 0.95f, 0};
  tints_.assign(session.topology()->markers().size(), accent);
  for (const Index m : session.selection().hovered())
    if (at(m) < tints_.size()) tints_[at(m)][3] = 0.22f;
  for (const Index m : session.selection().markers())
    if (at(m) < tints_.size()) tints_[at(m)][3] = tints_[at(m)][3] > 0 ? 0.6f : 0.5f;
}

const std::optional<Legend>& VolumeView::legend() const {
  static const std::optional<Legend> none;
  return layer_.scenes() ? layer_.scenes()->legend : none;
}

std::optional<SpaceHit> VolumeView::pick(const View& view, const ScreenPoint& at) const {
  const VolumeScenes* scenes = layer_.scenes();
  if (!scenes) return std::nullopt;
  return pick_in_scene(scenes->parts, scenes->planes, view.unproject(at));
}

void VolumeView::draw(const SpaceCamera& camera, const ScreenBox* whole, int height) {
  const bool both = comparison_ == Comparison::split;
  const ScreenBox box = both ? whole_of(camera.viewport(), divider_) : camera.viewport();
  if (whole) draw_backdrop(viewport_of(box), viewport_of(both ? box : *whole), backdrop_, height);
  if (!layer_.scenes()) return;
  if (both) draw_before(camera, box, height);
  draw_now(camera, height);
}

void VolumeView::draw_now(const SpaceCamera& camera, int height) {
  const VolumeScenes* scenes = layer_.scenes();
  const VolumeScenes* ghost =
      comparison_ == Comparison::ghost && before_layer_.scenes() ? before_layer_.scenes() : nullptr;
  if (ghost && !ghost->of.ghost) ghost = nullptr;
  const std::uint64_t ghost_revision = ghost ? before_layer_.revision() : 0;
  if (drawn_ != layer_.revision() || ghost_drawn_ != ghost_revision) {
    auto parts = scenes->parts;
    if (ghost) parts.push_back(ghost->parts.front());
    renderer_.set_parts(parts, scenes->planes);
  }
  drawn_ = layer_.revision();
  ghost_drawn_ = ghost_revision;
  renderer_.set_tints(tints_);
  SpaceCamera seen = camera;
  Box<3> content = scenes->parts.front()->extent;
  if (ghost) content.add(ghost->parts.front()->extent);
  seen.set_content(content);
  renderer_.draw(seen, height);
}

/// Draws with the same camera in the other part of the view.
void VolumeView::draw_before(SpaceCamera camera, const ScreenBox& whole, int height) {
  const VolumeScenes* scenes = before_layer_.scenes();
  if (!scenes || scenes->of.ghost) return;
  if (before_drawn_ != before_layer_.revision())
    before_renderer_.set_parts(scenes->parts, scenes->planes);
  before_drawn_ = before_layer_.revision();
  before_renderer_.set_tints(tints_);
  const ScreenBox part = side_by_side(whole, divider_).before;
  camera.set_viewport(part.min.x(), part.min.y(), part.size().x(), part.size().y());
  camera.set_content(scenes->parts.front()->extent);
  before_renderer_.draw(camera, height);
}

void VolumeView::draw_kept(const SpaceCamera& camera, int width, int height) {
  const ScreenBox box =
      comparison_ == Comparison::split ? whole_of(camera.viewport(), divider_) : camera.viewport();
  PictureKey key{camera, width, height, backdrop_, layer_.revision(), 0, tints_, comparison_};
  if (compares()) key.before = before_layer_.revision();
  kept_.show(key, FrameBuffer::part_of(box, height), width, height,
             [&] { draw(camera, &box, height); });
}

}  // namespace winslow::gui
