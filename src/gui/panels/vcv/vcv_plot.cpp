#include "gui/panels/vcv/vcv_plot.h"

#include "gui/base/input.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr float star_share = 0.44f;  // of the row
constexpr double filling = 0.76;     // the longest edge, over half of the picture

std::string angle_text(double angle) { return formatted(degrees(angle), "%.0f\xC2\xB0"); }

/// Data for the drawing of one star.
struct Drawing {
  ImDrawList& list;
  const Theme& theme;
  const Star& star;
  std::vector<ImVec2> ends;  // pixels
  ImVec2 centre;
  std::optional<std::size_t> lit;
};

void draw_polygon(const Drawing& d) {
  const std::size_t n = d.ends.size();
  for (std::size_t k = 0; k < n; ++k) {
    const ImVec2& p = d.ends[k];
    const ImVec2& q = d.ends[(k + 1) % n];
    // Inverted triangles of the physical star are marked as a warning.
    const bool inverted = d.star.areas[k] < 0;
    d.list.AddTriangleFilled(d.centre, p, q,
                             inverted ? palette().danger_soft : palette().accent_soft);
    d.list.AddLine(p, q, palette().text_faint, d.theme.px(1));
  }
}

void draw_disc(const Drawing& d, std::size_t k) {
  const bool lit = d.lit == k;
  const float radius = d.theme.px(disc_size);
  d.list.AddCircleFilled(d.ends[k], radius, lit ? palette().accent : palette().card, 20);
  d.list.AddCircle(d.ends[k], radius, palette().accent, 20, d.theme.px(1.2f));
  draw_number(d.list, d.theme, d.ends[k], k, lit);
}

void draw_spokes(const Drawing& d, std::span<const double> weights) {
  double largest = 0;
  for (const double w : weights) largest = std::max(largest, std::abs(w));
  for (std::size_t k = 0; k < d.ends.size(); ++k) {
    const double share = weights.empty() || !(largest > 0) ? 0.35 : std::abs(weights[k]) / largest;
    const bool negative = !weights.empty() && weights[k] < 0;
    d.list.AddLine(d.centre, d.ends[k], negative ? palette().danger : palette().accent,
                   d.theme.px(1 + 2.2f * static_cast<float>(share)));
  }
  d.list.AddCircleFilled(d.centre, d.theme.px(3), palette().text);
}

ImVec2 between(const ImVec2& a, const ImVec2& b, float t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

void label_angles(const Drawing& d, LabelPlacer& labels) {
  const std::size_t n = d.ends.size();
  for (std::size_t k = 0; k < n; ++k) {
    const ImVec2 middle = between(d.ends[k], d.ends[(k + 1) % n], 0.5f);
    labels.place(between(d.centre, middle, 0.72f), angle_text(d.star.angles[k]),
                 palette().text_dim);
  }
}

/// Labels negative weights first, since there may not be room for all.
void label_weights(const Drawing& d, std::span<const double> weights, LabelPlacer& labels) {
  for (const bool negative : {true, false})
    for (std::size_t k = 0; k < weights.size(); ++k)
      if ((weights[k] < 0) == negative)
        labels.place(between(d.centre, d.ends[k], 0.52f), formatted(weights[k], "%.2f"),
                     negative ? palette().danger : palette().text, palette().card);
}

Star star_of(const VcvEdit& edit) {
  std::vector<double> angles;
  for (const double angle : edit.angles) angles.push_back(radians(angle));
  return make_star(vcv_points(angles, edit.lengths));
}

/// Image of the unit circle under the nodal Jacobian.
std::vector<Vec2> ellipse_of(const NodalGradient& jacobian) {
  constexpr int pieces = 64;
  std::vector<Vec2> points;
  for (int i = 0; i < pieces; ++i) {
    const double t = 2 * pi * i / pieces;
    points.push_back(std::cos(t) * jacobian.rx + std::sin(t) * jacobian.ry);
  }
  return points;
}

}  // namespace

VcvEdit numbers_of(const NodalView& view) {
  VcvEdit edit{view.node, view.neighbours, {}, view.vcv.lengths};
  for (const double angle : view.vcv.angles) edit.angles.push_back(degrees(angle));
  return edit;
}

ImVec2 VcvFrame::pixel(const Vec2& p) const {
  const double c = std::cos(turn), s = std::sin(turn);
  return {centre.x + static_cast<float>(scale * (c * p.x() - s * p.y())),
          centre.y - static_cast<float>(scale * (s * p.x() + c * p.y()))};
}

Vec2 VcvFrame::point(const ImVec2& p) const {
  const Vec2 q = Vec2(p.x - centre.x, centre.y - p.y) / scale;
  const double c = std::cos(turn), s = std::sin(turn);
  return {c * q.x() + s * q.y(), -s * q.x() + c * q.y()};
}

namespace {

VcvFrame frame_of(const Star& star, const ImVec2& min, const ImVec2& size, double turn) {
  VcvFrame frame;
  frame.min = min;
  frame.max = ImVec2(min.x + size.x, min.y + size.y);
  frame.centre = ImVec2(min.x + size.x / 2, min.y + size.y / 2);
  const double longest = *std::max_element(star.lengths.begin(), star.lengths.end());
  if (longest > 0)
    frame.scale = filling * 0.5 * static_cast<double>(std::min(size.x, size.y)) / longest;
  frame.turn = turn;
  return frame;
}

std::optional<std::size_t> end_at(const VcvFrame& frame, const Star& star, const ImVec2& mouse,
                                  float radius) {
  std::optional<std::size_t> nearest;
  float best = radius;
  for (std::size_t k = 0; k < star.points.size(); ++k) {
    const ImVec2 end = frame.pixel(star.points[k]);
    const float distance = std::hypot(end.x - mouse.x, end.y - mouse.y);
    if (distance > best) continue;
    best = distance;
    nearest = k;
  }
  return nearest;
}

void draw_star(ImDrawList& list, const Theme& theme, const NodalView& view, const VcvFrame& frame,
               std::optional<std::size_t> lit) {
  list.PushClipRect(frame.min, frame.max, true);
  Drawing d{list, theme, view.physical, {}, frame.centre, lit};
  for (const Vec2& p : view.physical.points) d.ends.push_back(frame.pixel(p));
  draw_polygon(d);
  draw_spokes(d, {});
  std::vector<ImVec2> ellipse;
  for (const Vec2& p : ellipse_of(view.gradient)) ellipse.push_back(frame.pixel(p));
  list.AddPolyline(ellipse.data(), static_cast<int>(ellipse.size()), palette().move_line,
                   ImDrawFlags_Closed, theme.px(1.5f));
  LabelPlacer labels(list, theme.small, frame.min, frame.max);
  for (std::size_t k = 0; k < d.ends.size(); ++k) {
    draw_disc(d, k);
    labels.block(d.ends[k], theme.px(disc_size));
  }
  labels.place(ImVec2(frame.min.x + theme.px(17), frame.min.y + theme.px(10)), "Star",
               palette().text_dim);
  label_angles(d, labels);
  list.PopClipRect();
}

void draw_vcv(ImDrawList& list, const Theme& theme, const NodalView& view, const Star& star,
              const VcvFrame& frame, std::optional<std::size_t> lit) {
  list.PushClipRect(frame.min, frame.max, true);
  Drawing d{list, theme, star, {}, frame.centre, lit};
  for (const Vec2& p : star.points) d.ends.push_back(frame.pixel(p));
  draw_polygon(d);
  draw_spokes(d, view.weights);
  LabelPlacer labels(list, theme.small, frame.min, frame.max);
  for (std::size_t k = 0; k < d.ends.size(); ++k) {
    draw_disc(d, k);
    labels.block(d.ends[k], theme.px(disc_size));
    const float r = theme.px(disc_size);
    ui::note("vcv/end/" + std::to_string(k), ImVec2(d.ends[k].x - r, d.ends[k].y - r),
             ImVec2(d.ends[k].x + r, d.ends[k].y + r));
  }
  labels.place(ImVec2(frame.min.x + theme.px(17), frame.min.y + theme.px(10)), "VCV",
               palette().text_dim);
  label_weights(d, view.weights, labels);
  label_angles(d, labels);
  list.PopClipRect();
}

}  // namespace

void VcvPlot::drive_drag(const NodalView& view, const VcvFrame& frame, float margin,
                         std::optional<std::size_t> under, Outcome& outcome) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!ImGui::IsItemActive()) {
    if (drag_) outcome.ended = true;
    drag_.reset();
    let_go_ = true;
    return;
  }
  if (!drag_ && let_go_ && ImGui::IsItemActivated() && under) {
    drag_.emplace(view, *under);
    drag_frame_ = frame;
    edit_ = numbers_of(view);
  }
  if (!drag_) return;
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) {
    drag_.reset();
    let_go_ = false;
    outcome.cancelled = true;
    return;
  }
  if (io.MouseDelta.x == 0 && io.MouseDelta.y == 0) return;
  const auto constraint = io.KeyShift  ? VcvDrag::Constraint::angle_only
                          : io.KeyCtrl ? VcvDrag::Constraint::length_only
                                       : VcvDrag::Constraint::none;
  const float room = 0.5f * std::min(frame.max.x - frame.min.x, frame.max.y - frame.min.y);
  VcvEdit wanted = drag_->to(drag_frame_.point(io.MousePos), constraint,
                             static_cast<double>(room - margin) / drag_frame_.scale);
  if (wanted == edit_) return;
  edit_ = wanted;
  outcome.edit = std::move(wanted);
}

VcvPlot::Outcome VcvPlot::draw(const NodalView& view, std::optional<std::size_t> highlighted,
                               const Theme& theme) {
  Outcome outcome;
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float width = std::max(ImGui::GetContentRegionAvail().x, theme.px(120));
  const float gap = theme.px(6);
  const ImVec2 star_size(star_share * (width - gap), (1 - star_share) * (width - gap));
  const ImVec2 vcv_size(star_size.y, star_size.y);
  const ImVec2 vcv_min(start.x + star_size.x + gap, start.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (const auto& [min, size] : {std::pair{start, star_size}, std::pair{vcv_min, vcv_size}}) {
    const ImVec2 max(min.x + size.x, min.y + size.y);
    list.AddRectFilled(min, max, palette().card, theme.px(4));
    list.AddRect(min, max, palette().border, theme.px(4));
  }
  const VcvFrame star_frame = frame_of(view.physical, start, star_size, 0);

  ImGui::InvisibleButton("star", star_size);
  ui::note("vcv/star");
  const bool over_star = ImGui::IsItemHovered();
  ImGui::SameLine(0, gap);
  ImGui::InvisibleButton("vcv", vcv_size);
  ui::note("vcv/plot");
  const bool over_vcv = ImGui::IsItemHovered();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float reach = theme.px(disc_size + 4);
  VcvFrame frame = frame_of(view.vcv, vcv_min, vcv_size, fitted_turn(view.vcv, view.physical));
  if (over_vcv) outcome.hovered = end_at(frame, view.vcv, mouse, reach);
  if (over_star) outcome.hovered = end_at(star_frame, view.physical, mouse, reach);
  drive_drag(view, frame, theme.px(disc_size + 2), over_vcv ? outcome.hovered : std::nullopt,
             outcome);
  // During a drag only the dragged edge moves in the picture.
  Star shown = view.vcv;
  if (drag_) {
    outcome.hovered = drag_->edge();
    shown = star_of(edit_);
    const double turn = drag_->turn(edit_);
    frame.scale = drag_frame_.scale;
    frame.turn = drag_frame_.turn + turn;
  }
  const auto lit = outcome.hovered ? outcome.hovered : highlighted;
  draw_star(list, theme, view, star_frame, lit);
  draw_vcv(list, theme, view, shown, frame, lit);
  if ((over_vcv && outcome.hovered) || drag_) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  return outcome;
}

}  // namespace winslow::gui
