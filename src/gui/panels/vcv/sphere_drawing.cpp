#include "gui/panels/vcv/sphere_drawing.h"

#include <Eigen/SVD>

#include "gui/base/text.h"
#include "gui/panels/vcv/vcv_parts.h"
#include "gui/render/space/star_sketch.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

ImVec4 mixed(const ImVec4& a, const ImVec4& b, float share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z), 1};
}
/// Colour of a solid angle, lighter than in the colour map, so that edges and numbers are visible
/// on it.
Rgb tint(const ColorScale& colors, double angle) {
  Rgb c = colors.color(angle);
  for (float& part : c) part += 0.3f * (1 - part);
  return c;
}
ImVec4 shaded(const Rgb& c, double light) {
  const float s = 0.62f + 0.38f * static_cast<float>(light);
  return {s * c[0], s * c[1], s * c[2], 1};
}
float luminance(const ImVec4& c) { return 0.3f * c.x + 0.59f * c.y + 0.11f * c.z; }
ImU32 packed(const ImVec4& c, float alpha = 1) {
  return ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, alpha});
}

bool inside(const std::array<ScreenPoint, 3>& triangle, const ScreenPoint& p) {
  int left = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const ScreenVector side = triangle[(k + 1) % 3] - triangle[k], to = p - triangle[k];
    left += side.x() * to.y() - side.y() * to.x() > 0 ? 1 : 0;
  }
  return left == 0 || left == 3;
}

class Painter {
 public:
  Painter(ImDrawList& list, const Theme& theme, const SpaceCamera& camera, const SphereDrawing& d)
      : list_(list),
        theme_(theme),
        camera_(camera),
        d_(d),
        sketch_(camera, d.star.points, d.link.triangles()),
        labels_(list, theme.small, pixel(camera.viewport().min), pixel(camera.viewport().max)) {
    for (const Vec3& p : d.star.points) {
      ends_.push_back(pixel(camera.project(p).at));
      hidden_.push_back(sketch_.hides(p));
    }
    centre_ = pixel(camera.project(Vec3(0, 0, 0)).at);
  }

  void paint() {
    paint_faces(false);
    paint_lines(true);
    paint_hidden_points();
    paint_faces(true);
    paint_lines(false);
    if (d_.image) paint_ellipsoid(*d_.image);
    paint_points();
    const std::string title(d_.title);
    const ScreenBox area = camera_.viewport();
    const ImVec2 size = theme_.small->CalcTextSizeA(theme_.small->FontSize, 1e6f, 0, title.c_str());
    labels_.place(ImVec2(static_cast<float>(area.min.x()) + theme_.px(6) + size.x / 2,
                         static_cast<float>(area.min.y()) + theme_.px(10)),
                  title, palette().text_dim);
    paint_weights();
    paint_angles();
  }

 private:
  static ImVec2 pixel(const ScreenPoint& p) { return static_cast<ImVec2>(p); }

  ImVec4 face_color(const StarSketch::Face& face) const {
    const double angle = d_.star.solid_angles[face.triangle];
    if (angle < 0) return rgba(palette().danger);
    const ImVec4 color = shaded(tint(d_.colors, angle), face.light);
    return face.front ? color : mixed(color, rgba(palette().card), 0.3f);
  }

  void paint_faces(bool front) {
    for (const StarSketch::Face& face : sketch_.faces()) {
      if (face.front != front) continue;
      const bool lit = d_.lit_face == face.triangle;
      list_.AddTriangleFilled(pixel(face.at[0]), pixel(face.at[1]), pixel(face.at[2]),
                              packed(face_color(face), front ? (lit ? 1.0f : 0.8f) : 1.0f));
    }
  }

  void paint_line(const Vec3& a, const Vec3& b, bool hidden, ImU32 color, float width) {
    for (const StarSketch::Piece& piece : sketch_.cut(a, b))
      if (piece.hidden == hidden)
        list_.AddLine(pixel(piece.a), pixel(piece.b), hidden ? faded(color, 0.6f) : color, width);
  }

  /// Draws the edges of the link and those from the node.
  void paint_lines(bool hidden) {
    double largest = 0;
    for (const double w : d_.weights) largest = std::max(largest, std::abs(w));
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      const bool negative = !d_.weights.empty() && d_.weights[k] < 0;
      const double share = largest > 0 ? std::abs(d_.weights[k]) / largest : 0.3;
      paint_line(Vec3(0, 0, 0), d_.star.points[k], hidden,
                 negative ? palette().danger : palette().accent,
                 theme_.px(1 + 2.2f * static_cast<float>(share)));
    }
    if (hidden) list_.AddCircleFilled(centre_, theme_.px(3), palette().text);
    for (const auto& [a, b, c] : d_.link.triangles())
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        if (p < q)  // the adjacent triangle has the reverse edge
          paint_line(d_.star.points[at(p)], d_.star.points[at(q)], hidden, palette().text,
                     theme_.px(hidden ? 1.0f : 1.3f));
    if (!d_.lit_face) return;
    const auto& [a, b, c] = d_.link.triangles()[*d_.lit_face];
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      paint_line(d_.star.points[at(p)], d_.star.points[at(q)], hidden, palette().accent,
                 theme_.px(3));
  }

  void paint_hidden_points() {
    for (std::size_t k = 0; k < ends_.size(); ++k)
      if (hidden_[k])
        list_.AddCircleFilled(ends_[k], theme_.px(d_.lit == k ? 5.0f : 3.0f),
                              d_.lit == k ? palette().accent : palette().text_dim, 16);
  }

  /// Points in front of the solid: first the highlighted one, then by distance, nearest first.
  std::vector<std::size_t> front_points() const {
    std::vector<std::pair<double, std::size_t>> points;
    for (std::size_t k = 0; k < ends_.size(); ++k)
      if (!hidden_[k])
        points.emplace_back(d_.lit == k ? -std::numeric_limits<double>::infinity()
                                        : camera_.project(d_.star.points[k]).depth,
                            k);
    std::sort(points.begin(), points.end());
    std::vector<std::size_t> order;
    for (const auto& [depth, k] : points) order.push_back(k);
    return order;
  }

  /// Draws numbered discs, or dots if a disc would overlap another one.
  void paint_points() {
    const float disc = theme_.px(disc_size);
    std::vector<ImVec2> discs;
    for (const std::size_t k : front_points()) {
      const bool lit = d_.lit == k;
      const bool negative = !d_.weights.empty() && d_.weights[k] < 0;
      const bool room = std::ranges::none_of(discs, [&](const ImVec2& other) {
        return std::hypot(other.x - ends_[k].x, other.y - ends_[k].y) < 2 * disc;
      });
      const float radius = room ? disc : theme_.px(3.5f);
      if (room) discs.push_back(ends_[k]);
      list_.AddCircleFilled(ends_[k], radius, lit ? palette().accent : palette().card, 20);
      list_.AddCircle(ends_[k], radius, negative ? palette().danger : palette().accent, 20,
                      theme_.px(negative ? 2.0f : 1.2f));
      labels_.block(ends_[k], radius);
      ui::note(std::string(d_.id) + "/end/" + std::to_string(k),
               ImVec2(ends_[k].x - radius, ends_[k].y - radius),
               ImVec2(ends_[k].x + radius, ends_[k].y + radius));
      if (!room) continue;
      draw_number(list_, theme_, ends_[k], k, lit);
    }
  }

  /// Draws the weights beside their points, on the outer side.
  void paint_weights() {
    for (const bool negative : {true, false})
      for (std::size_t k = 0; k < d_.weights.size(); ++k) {
        if ((d_.weights[k] < 0) != negative || hidden_[k]) continue;
        const std::string text = formatted(d_.weights[k], "%.2f");
        const ImVec2 size =
            theme_.small->CalcTextSizeA(theme_.small->FontSize, 1e6f, 0, text.c_str());
        ImVec2 out(ends_[k].x - centre_.x, ends_[k].y - centre_.y);
        const float length = std::hypot(out.x, out.y);
        if (length < 1) continue;
        out = ImVec2(out.x / length, out.y / length);
        const float off = theme_.px(disc_size) + theme_.px(2) + std::abs(out.x) * size.x / 2 +
                          std::abs(out.y) * size.y / 2;
        const ImVec2 middle(ends_[k].x + off * out.x, ends_[k].y + off * out.y);
        if (labels_.place(middle, text, negative ? palette().danger : palette().text,
                          faded(palette().card, 0.85f)))
          ui::note(std::string(d_.id) + "/weight/" + std::to_string(k),
                   ImVec2(middle.x - size.x / 2, middle.y - size.y / 2),
                   ImVec2(middle.x + size.x / 2, middle.y + size.y / 2));
      }
  }

  void paint_angles() {
    for (const StarSketch::Face& face : sketch_.faces()) {
      if (!face.front) continue;
      const std::string text = formatted(d_.star.solid_angles[face.triangle], "%.2f");
      const ImVec2 size =
          theme_.small->CalcTextSizeA(theme_.small->FontSize, 1e6f, 0, text.c_str());
      const ScreenVector sum = (face.at[0] - ScreenPoint()) + (face.at[1] - ScreenPoint()) +
                               (face.at[2] - ScreenPoint());
      const ScreenPoint middle = ScreenPoint() + sum / 3;
      const double w = static_cast<double>(size.x) / 2 + 1, h = static_cast<double>(size.y) / 2 - 1;
      const bool fits = inside(face.at, middle + ScreenVector(-w, -h)) &&
                        inside(face.at, middle + ScreenVector(w, -h)) &&
                        inside(face.at, middle + ScreenVector(-w, h)) &&
                        inside(face.at, middle + ScreenVector(w, h));
      if (!fits) continue;
      const ImU32 ink = luminance(mixed(face_color(face), rgba(palette().card), 0.2f)) > 0.5f
                            ? IM_COL32(20, 24, 31, 255)
                            : IM_COL32_WHITE;
      if (labels_.place(pixel(middle), text, ink))
        ui::note(std::string(d_.id) + "/angle/" + std::to_string(face.triangle),
                 pixel(middle + ScreenVector(-w, -h)), pixel(middle + ScreenVector(w, h)));
    }
  }

  /// Draws the image of the unit sphere: its outline and the three ellipses through its half axes,
  /// faint on the far side.
  void paint_ellipsoid(const VolumeNodalView& view) {
    const ImU32 line = palette().move_line;
    const double width = 1 / camera_.units_per_pixel();
    Eigen::Matrix<double, 2, 3> onto;
    onto.row(0) = width * camera_.right().transpose();
    onto.row(1) = -width * camera_.up().transpose();
    const Eigen::Matrix3d axes = view.u * view.singular_values.asDiagonal();
    const Eigen::Matrix<double, 2, 3> flat = onto * axes;
    const Eigen::JacobiSVD<Eigen::Matrix<double, 2, 3>> svd(flat, Eigen::ComputeFullU);
    constexpr int pieces = 64;
    std::vector<ImVec2> outline;
    for (int i = 0; i < pieces; ++i) {
      const double t = 2 * pi * i / pieces;
      const Vec2 p = svd.matrixU() * Vec2(svd.singularValues()[0] * std::cos(t),
                                          svd.singularValues()[1] * std::sin(t));
      outline.emplace_back(centre_.x + static_cast<float>(p.x()),
                           centre_.y + static_cast<float>(p.y()));
    }
    list_.AddConvexPolyFilled(outline.data(), pieces, faded(line, 0.15f));
    list_.AddPolyline(outline.data(), pieces, line, ImDrawFlags_Closed, theme_.px(1.6f));
    if (!(view.singular_values[2] > 0)) return;
    const Eigen::Matrix3d normals = view.u * view.singular_values.cwiseInverse().asDiagonal();
    for (int axis = 0; axis < 3; ++axis) {
      const auto on_circle = [&](int i) {
        const double t = 2 * pi * i / pieces;
        Vec3 s(0, 0, 0);
        s[(axis + 1) % 3] = std::cos(t);
        s[(axis + 2) % 3] = std::sin(t);
        return s;
      };
      for (int i = 0; i < pieces; ++i) {
        const Vec2 a = flat * on_circle(i), b = flat * on_circle(i + 1);
        const bool front = (normals * on_circle(i)).dot(camera_.back()) >= 0;
        list_.AddLine(
            {centre_.x + static_cast<float>(a.x()), centre_.y + static_cast<float>(a.y())},
            {centre_.x + static_cast<float>(b.x()), centre_.y + static_cast<float>(b.y())},
            faded(line, front ? 0.9f : 0.25f), theme_.px(1));
      }
    }
  }

  ImDrawList& list_;
  const Theme& theme_;
  const SpaceCamera& camera_;
  const SphereDrawing& d_;
  StarSketch sketch_;
  LabelPlacer labels_;
  std::vector<ImVec2> ends_;
  std::vector<bool> hidden_;
  ImVec2 centre_;
};

}  // namespace

void draw_sphere(ImDrawList& list, const Theme& theme, const SpaceCamera& camera,
                 const SphereDrawing& drawing) {
  const ScreenBox area = camera.viewport();
  list.PushClipRect(static_cast<ImVec2>(area.min), static_cast<ImVec2>(area.max), true);
  Painter(list, theme, camera, drawing).paint();
  list.PopClipRect();
}

void draw_angle_legend(const Theme& theme, const ColorScale& colors) {
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float row = ImGui::GetContentRegionAvail().x;
  const std::string low = formatted(colors.low, "%.2f"), high = formatted(colors.high, "%.2f sr");
  ImFont* font = theme.small;
  const float left = font->CalcTextSizeA(font->FontSize, 1e6f, 0, low.c_str()).x + theme.px(5);
  const float right = font->CalcTextSizeA(font->FontSize, 1e6f, 0, high.c_str()).x + theme.px(5);
  const float height = theme.px(8), line = font->FontSize;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  constexpr int strips = 48;
  const float from = start.x + left, width = row - left - right,
              top = start.y + (line - height) / 2;
  for (int k = 0; k < strips; ++k) {
    const Rgb c = tint(colors, colors.value_at((k + 0.5) / strips));
    list.AddRectFilled({from + width * static_cast<float>(k) / strips, top},
                       {from + width * static_cast<float>(k + 1) / strips + 0.5f, top + height},
                       packed({c[0], c[1], c[2], 1}));
  }
  list.AddText(font, font->FontSize, start, palette().text_dim, low.c_str());
  list.AddText(font, font->FontSize, {start.x + row - right + theme.px(5), start.y},
               palette().text_dim, high.c_str());
  ImGui::Dummy({row, line});
  ui::note("vcv/angle_legend");
  ui::tooltip(
      "Solid angles of the triangles around the node, in steradians: all of them together are 4 "
      "pi, "
      "12.57.");
}

std::vector<bool> points_in_front(const SpaceCamera& camera, const SphereLink& link,
                                  const SphereStar& star) {
  const StarSketch sketch(camera, star.points, link.triangles());
  std::vector<bool> front;
  for (const Vec3& p : star.points) front.push_back(!sketch.hides(p));
  return front;
}

}  // namespace winslow::gui
