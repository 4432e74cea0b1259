#include "gui/view/overlays/vcv_overlay.h"

#include "gui/render/space/star_sketch.h"

namespace winslow::gui {

namespace {

/// light: share of the light, 0 to 1, that falls on it.
ImU32 color(const Rgb& c, float alpha = 1, float light = 1) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(light * c[0], light * c[1], light * c[2], alpha));
}

struct Pen {
  float unit;  ///< width of a hair line, pixels
  ImFont* font;
};

/// below: distance of the text's upper end below the place, as a share of its height; -0.5 centres
/// the text. room: pixels available.
void draw_number(ImDrawList& list, const ImVec2& centre, float below, Index node, double room,
                 ImFont* font) {
  const std::string text = std::to_string(node);
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, text.c_str());
  if (static_cast<double>(size.x) > 1.1 * room) return;
  const ImVec2 at(centre.x - size.x / 2, centre.y + below * size.y);
  list.AddRectFilled(ImVec2(at.x - 3, at.y - 1), ImVec2(at.x + size.x + 3, at.y + size.y + 1),
                     color(VcvColors().casing, VcvColors().label_alpha), 3);
  list.AddText(font, font->FontSize, at, color(VcvColors().line), text.c_str());
}

/// ends: of the VCV's edges, on screen. reach: length of the star's edges, pixels.
void draw_one(ImDrawList& list, const NodalView& node, const ImVec2& centre,
              const std::vector<ImVec2>& ends, double reach, const Pen& pen) {
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
  draw_number(list, centre, -0.5f, node.node, reach, pen.font);
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
    draw_one(list, node, pixel(node.position), ends, reach, {unit, font});
  }
}

void draw_vcv(ImDrawList& list, const View& view, const NodalView& node, const StarPlane& plane,
              float unit, ImFont* font) {
  const auto pixel = [&](const Vec2& p) {
    return static_cast<ImVec2>(view.project(plane.point(p)).at);
  };
  std::vector<ImVec2> ends;
  for (const Vec2& p : vcv_over_star(node)) ends.push_back(pixel(p));
  const double reach = node.physical.mean_length() / view.pixel_size(plane.origin);
  draw_one(list, node, pixel({0, 0}), ends, reach, {unit, font});
}

void draw_node_ring(ImDrawList& list, const ImVec2& at, float radius, float width, ImU32 ink) {
  list.AddCircle(at, radius, color(VcvColors().casing, VcvColors().casing_alpha), 32, 2.2f * width);
  list.AddCircle(at, radius, ink, 32, width);
}

std::vector<Vec2> vcv_over_star(const NodalView& node) {
  const double turn = fitted_turn(node.vcv, node.physical);
  const double scale = node.physical.mean_length() / node.vcv.mean_length();
  const double c = scale * std::cos(turn), s = scale * std::sin(turn);
  std::vector<Vec2> ends;
  for (const Vec2& p : node.vcv.points)
    ends.push_back(node.position + Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
  return ends;
}

bool vcv_in_sight(const NodalView& node, const Bounds& seen) {
  const double reach = 2 * node.physical.mean_length();
  return ((node.position - seen.min).array() > -reach).all() &&
         ((seen.max - node.position).array() > -reach).all();
}

namespace {

class SphereSketch {
 public:
  SphereSketch(ImDrawList& list, const SpaceCamera& camera, const VolumeNodalView& node, float unit)
      : list_(list),
        node_(node),
        unit_(unit),
        points_(sphere_over_star(node)),
        sketch_(camera, points_, node.link.triangles()) {}

  void draw() {
    draw_faces(false);
    draw_lines(true);
    draw_faces(true);
    draw_lines(false);
  }

 private:
  void draw_faces(bool front) {
    for (const StarSketch::Face& face : sketch_.faces()) {
      if (face.front != front) continue;
      const auto light = 0.55f + 0.45f * static_cast<float>(face.light);
      list_.AddTriangleFilled(
          ImVec2(face.at[0]), ImVec2(face.at[1]), ImVec2(face.at[2]),
          color(colors_.fill, (front ? 1.3f : 0.9f) * colors_.fill_alpha, light));
    }
  }

  void draw_line(const Vec3& a, const Vec3& b, bool hidden, const Rgb& ink, float width) {
    for (const StarSketch::Piece& piece : sketch_.cut(a, b)) {
      if (piece.hidden != hidden) continue;
      if (!hidden)
        list_.AddLine(ImVec2(piece.a), ImVec2(piece.b), color(colors_.casing, colors_.casing_alpha),
                      (width + 1.8f) * unit_);
      list_.AddLine(ImVec2(piece.a), ImVec2(piece.b), color(ink, hidden ? 0.45f : 1.0f),
                    width * unit_);
    }
  }

  void draw_lines(bool hidden) {
    for (std::size_t k = 0; k < points_.size(); ++k)
      draw_line(node_.position, points_[k], hidden,
                node_.weights[k] < 0 ? colors_.negative : colors_.line, 1.3f);
    for (const auto& [a, b, c] : node_.link.triangles())
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        if (p < q) draw_line(points_[at(p)], points_[at(q)], hidden, colors_.line, 1.8f);
  }

  ImDrawList& list_;
  const VolumeNodalView& node_;
  float unit_;
  VcvColors colors_;
  std::vector<Vec3> points_;
  StarSketch sketch_;
};

}  // namespace

std::vector<Vec3> sphere_over_star(const VolumeNodalView& node) {
  const double scale = node.physical.mean_length() / node.vcv.mean_length();
  std::vector<Vec3> points;
  for (const Vec3& p : node.vcv.points) points.emplace_back(node.position + scale * p);
  return points;
}

void draw_sphere_vcv(ImDrawList& list, const SpaceCamera& camera, const VolumeNodalView& node,
                     float unit, ImFont* font) {
  SphereSketch(list, camera, node, unit).draw();
  const double reach = node.physical.mean_length() / camera.pixel_size(node.position);
  // Below the node, since a ring may surround the node.
  draw_number(list, ImVec2(camera.project(node.position).at), 0.8f, node.node, reach, font);
}

}  // namespace winslow::gui
