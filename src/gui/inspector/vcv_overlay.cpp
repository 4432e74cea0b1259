#include "gui/inspector/vcv_overlay.h"

#include <cmath>
#include <string>
#include <vector>

namespace winslow::gui {

namespace {

// Seen on plain meshes, on every colour map and in both themes.
constexpr ImU32 fill = IM_COL32(234, 88, 12, 84);
constexpr ImU32 line = IM_COL32(194, 65, 12, 255);
constexpr ImU32 casing = IM_COL32(255, 255, 255, 200);
constexpr ImU32 negative = IM_COL32(201, 34, 43, 255);

ImVec2 pixel(const Camera& camera, const Vec2& world) {
  const Vec2 p = camera.to_screen(world);
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

/// Ends of the VCV's edges in the physical plane.
std::vector<Vec2> over_star(const NodalView& node) {
  const double turn = fitted_turn(node.vcv, node.physical);
  const double scale = node.physical.mean_length() / node.vcv.mean_length();
  const double c = scale * std::cos(turn), s = scale * std::sin(turn);
  std::vector<Vec2> ends;
  for (const Vec2& p : node.vcv.points)
    ends.push_back(node.position + Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
  return ends;
}

void draw_number(ImDrawList& list, const ImVec2& centre, Index node, float room, ImFont* font) {
  const std::string text = std::to_string(node);
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text.c_str());
  if (size.x > 1.1f * room) return;
  const ImVec2 at(centre.x - size.x / 2, centre.y - size.y / 2);
  list.AddRectFilled(ImVec2(at.x - 3, at.y - 1), ImVec2(at.x + size.x + 3, at.y + size.y + 1),
                     IM_COL32(255, 255, 255, 235), 3);
  list.AddText(font, font->FontSize, at, line, text.c_str());
}

void draw_one(ImDrawList& list, const Camera& camera, const NodalView& node, float unit,
              ImFont* font) {
  const ImVec2 centre = pixel(camera, node.position);
  std::vector<ImVec2> ends;
  for (const Vec2& p : over_star(node)) ends.push_back(pixel(camera, p));
  const std::size_t n = ends.size();
  for (std::size_t k = 0; k < n; ++k)
    list.AddTriangleFilled(centre, ends[k], ends[(k + 1) % n], fill);
  const auto count = static_cast<int>(n);
  list.AddPolyline(ends.data(), count, casing, ImDrawFlags_Closed, 4 * unit);
  for (std::size_t k = 0; k < n; ++k)
    list.AddLine(centre, ends[k], node.weights[k] < 0 ? negative : line, 1.3f * unit);
  list.AddPolyline(ends.data(), count, line, ImDrawFlags_Closed, 2 * unit);
  const auto reach = static_cast<float>(node.physical.mean_length() / camera.units_per_pixel());
  draw_number(list, centre, node.node, reach, font);
}

}  // namespace

void draw_vcvs(ImDrawList& list, const Camera& camera, std::span<const NodalView> nodes, float unit,
               ImFont* font) {
  const Bounds seen = camera.visible();
  for (const NodalView& node : nodes) {
    const double reach = 2 * node.physical.mean_length();
    const bool inside = ((node.position - seen.min).array() > -reach).all() &&
                        ((seen.max - node.position).array() > -reach).all();
    if (inside) draw_one(list, camera, node, unit, font);
  }
}

void draw_node_ring(ImDrawList& list, const ImVec2& at, float radius, float width, ImU32 color) {
  list.AddCircle(at, radius, casing, 32, 2.2f * width);
  list.AddCircle(at, radius, color, 32, width);
}

}  // namespace winslow::gui
