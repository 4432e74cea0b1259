#include "gui/view/overlays/foot_overlay.h"

#include "core/error.h"
#include "gui/base/text.h"
#include "gui/view/mesh/mesh_colors.h"
#include "gui/view/overlays/vcv_overlay.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// Draws the bar with its number; returns the height.
float draw_scale_bar(ImDrawList& list, const ViewOverlay& o, const ImVec2& bottom_left) {
  const double unit = o.view.pixel_size(o.view.to_plane(o.view.viewport().centre()));
  const double length = round_length(unit * static_cast<double>(o.theme.px(140)));
  const auto width = static_cast<float>(length / unit);
  const std::string text = formatted(length, "%g");
  ImFont& font = *o.theme.small;
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, text.c_str());
  const float pad = o.theme.px(6), tick = o.theme.px(5);
  const ImVec2 extent(std::max(width, size.x) + 2 * pad, size.y + tick + 1.5f * pad);
  const ImVec2 min(bottom_left.x, bottom_left.y - extent.y);
  const ImVec2 max(min.x + extent.x, bottom_left.y);
  list.AddRectFilled(min, max, faded(palette().card, 0.85f), o.theme.px(5));
  const float left = min.x + (extent.x - width) / 2, right = left + width;
  const float y = max.y - 0.75f * pad;
  const float thick = o.theme.px(1.5f);
  list.AddLine(ImVec2(left, y), ImVec2(right, y), palette().text, thick);
  list.AddLine(ImVec2(left, y - tick), ImVec2(left, y), palette().text, thick);
  list.AddLine(ImVec2(right, y - tick), ImVec2(right, y), palette().text, thick);
  list.AddText(&font, font.FontSize, ImVec2(min.x + (extent.x - size.x) / 2, min.y + 0.4f * pad),
               palette().text, text.c_str());
  ui::note("scale_bar", ImVec2(left, min.y), ImVec2(right, max.y));
  return extent.y;
}

}  // namespace

void draw_mode(ImDrawList& list, const Theme& theme, const ImVec2& bottom_left, float room,
               const std::string& text) {
  ImFont& font = *theme.small;
  const float pad = theme.px(8);
  const float wrap = std::max(room - 2 * pad, theme.px(80));
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, FLT_MAX, wrap, text.c_str());
  const ImVec2 min(bottom_left.x, bottom_left.y - size.y - 1.4f * pad);
  const ImVec2 max(min.x + size.x + 2 * pad, bottom_left.y);
  list.AddRectFilled(min, max, palette().accent, theme.px(5));
  list.AddText(&font, font.FontSize, ImVec2(min.x + pad, min.y + 0.7f * pad), palette().on_accent,
               text.c_str(), nullptr, wrap);
  ui::note("mode", min, max);
}

double round_length(double most) {
  if (!(most > 0) || !std::isfinite(most)) return 1;
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  for (const double share : {5.0, 2.0})
    if (share * decade <= most) return share * decade;
  return decade;
}

std::string mode_text(const Session& session, const ViewState& state) {
  if (state.ruler)
    return session.in_space()
               ? "Ruler: click two points for a distance and the angle between the faces, a third "
                 "for the angle at the second. Clicks snap to nodes, not with Shift. Esc puts it "
                 "away."
               : "Ruler: click two points for a distance, a third for the angle. Clicks snap to "
                 "nodes, not with Shift. Esc puts it away.";
  if (state.box_zoom_armed) return "Zoom: drag a box. Esc leaves the view as it is.";
  if (session.selection().shape_edit().active)
    return "Editing boundary nodes: drag one; Shift+click holds more. E or Esc ends.";
  return {};
}

void draw_foot(ImDrawList& list, const ViewOverlay& o, const ScreenBox& room,
               const std::string& mode) {
  const float margin = o.theme.px(16);  // beside the handle of the column
  const auto width = static_cast<float>(room.size().x());
  ImVec2 at(static_cast<float>(room.min.x()) + margin, static_cast<float>(room.max.y()) - margin);
  if (o.options.scale_bar && width > o.theme.px(180))
    at.y -= draw_scale_bar(list, o, at) + o.theme.px(6);
  if (!mode.empty()) draw_mode(list, o.theme, at, width - 2 * margin, mode);
}

void draw_out_of_view(ImDrawList& list, const ViewOverlay& o) {
  if (anything_in_view(*o.session.topology(), o.session.coordinates(), o.view.visible())) return;
  constexpr const char* text = "Nothing in view. Home: fit all";
  ImFont& font = *o.theme.regular;
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, text);
  const ScreenPoint middle = o.view.viewport().centre();
  const float pad = o.theme.px(10);
  const ImVec2 min(static_cast<float>(middle.x()) - size.x / 2 - pad,
                   static_cast<float>(middle.y()) - size.y / 2 - pad);
  const ImVec2 max(min.x + size.x + 2 * pad, min.y + size.y + 2 * pad);
  list.AddRectFilled(min, max, palette().card, o.theme.px(6));
  list.AddRect(min, max, palette().border, o.theme.px(6));
  list.AddText(&font, font.FontSize, ImVec2(min.x + pad, min.y + pad), palette().text, text);
  ui::note("out_of_view", min, max);
}

bool anything_in_view(const Topology& topology, const Coordinates& coordinates, const Bounds& box) {
  const Vec2 middle = box.centre();
  bool inside = false;
  for (const auto& loop : topology.boundary_loops()) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 a = coordinates.xy(loop[k]);
      const Vec2 b = coordinates.xy(loop[(k + 1) % loop.size()]);
      if (part_within(a, b, box)) return true;
      if (right_of(middle, a, b)) inside = !inside;
    }
  }
  return inside;
}

namespace {

ImVec2 seen_at(const SpaceOverlay& o, const Vec3& point) {
  return static_cast<ImVec2>(o.view.project(point).at);
}

/// True if nothing in the picture hides the node of a surface mesh.
bool is_seen(const SpaceOverlay& o, const VolumeView& picture, const Vec3& point) {
  constexpr double slack = 4;  // pixels
  const View::Projection there = o.view.project(point);
  const auto hit = picture.pick(o.view, there.at);
  return !hit || o.view.project(hit->point).depth > there.depth - slack * o.view.pixel_size(point);
}

/// Draws the VCV of a node in the form of its kind of mesh.
void draw_pin(ImDrawList& list, const SpaceOverlay& o, Index node) {
  if (o.session.kind() != MeshKind::surface)
    return draw_sphere_vcv(list, o.space, o.session.inspection().spheres.view_of(node),
                           o.theme.px(1), o.theme.small);
  const Coordinates& x = o.session.coordinates();
  const NodalView view = inspect_node(*o.session.vcv(), x, node);
  draw_vcv(list, o.view, view, plane_of_star(*o.session.topology(), x, view), o.theme.px(1),
           o.theme.small);
}

/// Draws the VCVs of pinned nodes, the furthest first; on a surface mesh without those that it
/// hides.
void draw_pins(ImDrawList& list, const SpaceOverlay& o, const VolumeView& picture) {
  std::vector<std::pair<double, Index>> by_depth;
  for (const Index node : o.session.nodes().pinned())
    by_depth.emplace_back(-o.view.project(o.session.coordinates().xyz(node)).depth, node);
  std::sort(by_depth.begin(), by_depth.end());
  for (const auto& [depth, node] : by_depth) {
    const Vec3 place = o.session.coordinates().xyz(node);
    if (o.session.kind() == MeshKind::surface && !is_seen(o, picture, place)) continue;
    try {
      draw_pin(list, o, node);
    } catch (const Error&) {
      continue;  // a star without a VCV; the tab gives the reason
    }
    const ImVec2 at = seen_at(o, place);
    ui::note("pin/" + std::to_string(node), {at.x - 4, at.y - 4}, {at.x + 4, at.y + 4});
  }
}

}  // namespace

void draw_space_marks(ImDrawList& list, const SpaceOverlay& o, const VolumeView& picture) {
  draw_pins(list, o, picture);
  const BackdropColors ground = backdrop_colors(o.options);
  const Rgba ink = ground.dark() ? Rgba{0.86f, 0.88f, 0.92f, 1} : Rgba{0.13f, 0.15f, 0.18f, 1};
  const MarkColors colors{ink, ground.bottom};
  ImFont& font = *o.theme.regular;
  if (o.options.space.axes) {
    draw_axes(list, font, font.FontSize, o.space, colors);
    const ImVec2 corner(static_cast<float>(o.view.viewport().min.x()),
                        static_cast<float>(o.view.viewport().max.y()));
    ui::note("space/axes", {corner.x, corner.y - 6 * font.FontSize},
             {corner.x + 6 * font.FontSize, corner.y});
  }
  if (o.options.scale_bar) draw_scale_bar(list, font, font.FontSize, o.space, colors);
}

double space_marks_top(const ViewOverlay& o) {
  const double height = o.options.space.axes ? 6 * static_cast<double>(o.theme.regular->FontSize)
                                             : static_cast<double>(o.theme.px(12));
  return o.view.viewport().max.y() - height;
}

namespace {

ImU32 packed_ink(const Rgba& c) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], c[3]));
}

ImVec2 on_screen(const ScreenPoint& p) { return static_cast<ImVec2>(p); }

/// Draws letters on a background of their own, as the mesh may lie beneath.
void draw_mark_text(ImDrawList& list, ImFont& font, float size, const ScreenPoint& centre,
                    const std::string& text, const MarkColors& colors) {
  const ImVec2 extent = font.CalcTextSizeA(size, 1e6f, 0, text.c_str());
  const ImVec2 corner(std::round(static_cast<float>(centre.x()) - 0.5f * extent.x),
                      std::round(static_cast<float>(centre.y()) - 0.5f * extent.y));
  Rgba ground = colors.paper;
  ground[3] = 0.75f;
  const float room = 0.15f * size;
  list.AddRectFilled({corner.x - room, corner.y}, {corner.x + extent.x + room, corner.y + extent.y},
                     packed_ink(ground), room);
  list.AddText(&font, size, corner, packed_ink(colors.ink), text.c_str());
}

}  // namespace

void draw_axes(ImDrawList& list, ImFont& font, float size, const SpaceCamera& camera,
               const MarkColors& colors) {
  const double em = static_cast<double>(size);
  const ScreenBox view = camera.viewport();
  const ScreenPoint origin(view.min.x() + 3.0 * em, view.max.y() - 3.0 * em);
  struct Axis {
    Vec3 direction;
    const char* name;
  };
  std::array<Axis, 3> axes{{{Vec3::UnitX(), "x"}, {Vec3::UnitY(), "y"}, {Vec3::UnitZ(), "z"}}};
  // The axis that points to the viewer most is drawn last.
  std::ranges::sort(axes, {}, [&](const Axis& a) { return camera.back().dot(a.direction); });
  for (const auto& [direction, name] : axes) {
    const ScreenVector along(camera.right().dot(direction), -camera.up().dot(direction));
    const double length = along.norm();
    if (length < 0.08) {  // towards the viewer, or away
      list.AddCircleFilled(on_screen(origin), 0.18f * size, packed_ink(colors.ink));
      draw_mark_text(list, font, size, origin + ScreenVector(-0.8 * em, 0.8 * em), name, colors);
      continue;
    }
    const ScreenPoint tip = origin + 2.0 * em * along;
    list.AddLine(on_screen(origin), on_screen(tip), packed_ink(colors.ink),
                 std::max(1.5f, 0.1f * size));
    const ScreenVector unit = along / length, across(-unit.y(), unit.x());
    const ScreenPoint foot = tip - 0.45 * em * unit;
    list.AddTriangleFilled(on_screen(tip), on_screen(foot + 0.17 * em * across),
                           on_screen(foot - 0.17 * em * across), packed_ink(colors.ink));
    draw_mark_text(list, font, size, tip + 0.65 * em * unit, name, colors);
  }
}

void draw_scale_bar(ImDrawList& list, ImFont& font, float size, const SpaceCamera& camera,
                    const MarkColors& colors) {
  if (camera.in_perspective()) return;
  const ScreenBox view = camera.viewport();
  const double em = static_cast<double>(size);
  const double most = std::min(0.2 * view.size().x(), 9 * em) * camera.units_per_pixel();
  const std::vector<double> lengths = nice_ticks(0, most, 2);
  if (lengths.size() < 2) return;
  const double length = lengths.back();
  const double pixels = length / camera.units_per_pixel();
  const ScreenPoint end(view.max.x() - 1.0 * em, view.max.y() - 1.0 * em);
  const ScreenPoint start = end - ScreenVector(pixels, 0);
  const ScreenVector tick(0, 0.3 * em);
  for (const auto& [a, b] : {std::pair(start, end), std::pair(start - tick, start + tick),
                             std::pair(end - tick, end + tick)})
    list.AddLine(on_screen(a), on_screen(b), packed_ink(colors.ink), std::max(1.5f, 0.1f * size));
  draw_mark_text(list, font, size, midpoint(start, end) - ScreenVector(0, 0.85 * em),
                 format_power(length), colors);
}

}  // namespace winslow::gui
