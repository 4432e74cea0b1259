#include "gui/view/overlays/vcv_overlay.h"

#include <string>
#include <vector>

#include "gui/view/overlays/vcv_shape.h"

namespace winslow::gui {

namespace {

ImU32 color(const Rgb& c, float alpha = 1) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], alpha));
}

struct Pen {
  float unit;  ///< width of a hair line, pixels
  ImFont* font;
};

void draw_number(ImDrawList& list, const ImVec2& centre, Index node, float room, ImFont* font) {
  const std::string text = std::to_string(node);
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text.c_str());
  if (size.x > 1.1f * room) return;
  const ImVec2 at(centre.x - size.x / 2, centre.y - size.y / 2);
  list.AddRectFilled(ImVec2(at.x - 3, at.y - 1), ImVec2(at.x + size.x + 3, at.y + size.y + 1),
                     color(VcvColors().casing, VcvColors().label_alpha), 3);
  list.AddText(font, font->FontSize, at, color(VcvColors().line), text.c_str());
}

/// ends: of the VCV's edges, on screen. reach: length of the star's edges, pixels.
void draw_one(ImDrawList& list, const NodalView& node, const ImVec2& centre,
              const std::vector<ImVec2>& ends, float reach, const Pen& pen) {
  const VcvColors colors;
  const ImU32 line = color(colors.line);
  const float unit = pen.unit;
  const std::size_t n = ends.size();
  for (std::size_t k = 0; k < n; ++k)
    list.AddTriangleFilled(centre, ends[k], ends[(k + 1) % n],
                           color(colors.fill, colors.fill_alpha));
  const auto count = static_cast<int>(n);
  list.AddPolyline(ends.data(), count, color(colors.casing, colors.casing_alpha),
                   ImDrawFlags_Closed, 4 * unit);
  for (std::size_t k = 0; k < n; ++k)
    list.AddLine(centre, ends[k], node.weights[k] < 0 ? color(colors.negative) : line, 1.3f * unit);
  list.AddPolyline(ends.data(), count, line, ImDrawFlags_Closed, 2 * unit);
  draw_number(list, centre, node.node, reach, pen.font);
}

}  // namespace

void draw_vcvs(ImDrawList& list, const View& view, std::span<const NodalView> nodes, float unit,
               ImFont* font) {
  const Bounds seen = view.visible();
  const auto pixel = [&](const Vec2& p) { return static_cast<ImVec2>(view.to_screen(p)); };
  for (const NodalView& node : nodes) {
    if (!vcv_in_sight(node, seen)) continue;
    std::vector<ImVec2> ends;
    for (const Vec2& p : vcv_over_star(node)) ends.push_back(pixel(p));
    const double reach = node.physical.mean_length() / view.pixel_size(node.position);
    draw_one(list, node, pixel(node.position), ends, static_cast<float>(reach), {unit, font});
  }
}

void draw_vcv(ImDrawList& list, const View& view, const NodalView& node, const StarPlane& plane,
              float unit, ImFont* font) {
  const auto pixel = [&](const Vec2& p) {
    return static_cast<ImVec2>(view.project(plane.at(p)).at);
  };
  std::vector<ImVec2> ends;
  for (const Vec2& p : vcv_over_star(node)) ends.push_back(pixel(p));
  const double reach = node.physical.mean_length() / view.pixel_size(plane.origin);
  draw_one(list, node, pixel({0, 0}), ends, static_cast<float>(reach), {unit, font});
}

void draw_node_ring(ImDrawList& list, const ImVec2& at, float radius, float width, ImU32 ink) {
  list.AddCircle(at, radius, color(VcvColors().casing, VcvColors().casing_alpha), 32, 2.2f * width);
  list.AddCircle(at, radius, ink, 32, width);
}

}  // namespace winslow::gui
