#include "gui/view/overlays/space_marks.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "gui/render/ticks.h"

namespace winslow::gui {

namespace {

ImU32 packed_ink(const Rgba& c) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], c[3]));
}

ImVec2 on_screen(const ScreenPoint& p) { return static_cast<ImVec2>(p); }

/// Letters on a ground of their own, as the mesh may lie under them.
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
  // The one that points to the viewer most is drawn last.
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
