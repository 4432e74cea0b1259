#include "gui/widgets/convergence_plot.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gui/render/ticks.h"
#include "gui/studio/text.h"
#include "gui/studio/theme.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

// What lies beyond, zero and infinity above all, is drawn here.
constexpr double floor_value = 1e-16;
constexpr double ceiling_value = 1e16;

double within_range(double v) { return std::clamp(v, floor_value, ceiling_value); }

struct Frame {
  ImVec2 min, max;          // of the plotting area
  double last = 1;          // iterations run from 0 to this
  int low = -12, high = 0;  // decades
  double inverted = 0;      // top of the right axis; 0: no right axis

  float x(double iteration) const {
    return min.x + static_cast<float>(iteration / last) * (max.x - min.x);
  }
  float y(double value) const {
    const double t = (std::log10(within_range(value)) - low) / (high - low);
    return max.y - static_cast<float>(std::clamp(t, 0.0, 1.0)) * (max.y - min.y);
  }
  float y_inverted(double count) const {
    return max.y - static_cast<float>(count / inverted) * (max.y - min.y);
  }
};

Frame make_frame(const ConvergencePlot& plot, const ImVec2& min, const ImVec2& max, float scale) {
  Frame f;
  double smallest = within_range(plot.tolerance.value_or(1e-3));
  double largest = smallest;
  for (const IterationRecord& r : plot.history) {
    for (double v : {r.residual, r.largest_move}) {
      if (!(v > 0)) continue;
      smallest = std::min(smallest, within_range(v));
      largest = std::max(largest, within_range(v));
    }
    f.inverted = std::max(f.inverted, static_cast<double>(r.inverted));
  }
  f.low = static_cast<int>(std::floor(std::log10(smallest) - 0.15));
  f.high = std::max(f.low + 1, static_cast<int>(std::ceil(std::log10(largest) + 0.15)));
  if (plot.history.empty()) {
    f.last = 100;
    f.high = std::max(f.high, 0);
  } else {
    f.last = std::max(1, plot.history.back().iteration);
  }
  if (f.inverted > 0) f.inverted *= 1.08;
  const float right = f.inverted > 0 ? 52 * scale : 14 * scale;
  f.min = ImVec2(min.x + 54 * scale, min.y + 26 * scale);
  f.max = ImVec2(max.x - right, max.y - 36 * scale);
  return f;
}

void text_at(ImDrawList& list, const ImVec2& anchor, float align_x, float align_y, ImU32 c,
             const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list.AddText(
      ImVec2(std::round(anchor.x - align_x * size.x), std::round(anchor.y - align_y * size.y)), c,
      text.c_str());
}

/// Round whole numbers from 0 to `high`.
std::vector<double> whole_ticks(double high, int wanted) {
  std::vector<double> ticks = nice_ticks(0, high, wanted);
  std::erase_if(ticks, [](double t) { return t != std::round(t); });
  return ticks;
}

void draw_axes(ImDrawList& list, const Frame& f, float scale) {
  list.AddRectFilled(f.min, f.max, palette().card);
  const int rows = std::max(2, static_cast<int>((f.max.y - f.min.y) / (22 * scale)));
  const int step = std::max(1, (f.high - f.low + rows - 1) / rows);
  for (int decade = f.low; decade <= f.high; ++decade) {
    if (decade % step != 0) continue;
    const float y = f.y(std::pow(10.0, decade));
    list.AddLine(ImVec2(f.min.x, y), ImVec2(f.max.x, y), palette().grid, scale);
    text_at(list, ImVec2(f.min.x - 6 * scale, y), 1, 0.5f, palette().text_dim,
            "1e" + std::to_string(decade));
  }
  const int columns = std::max(2, static_cast<int>((f.max.x - f.min.x) / (80 * scale)));
  for (const double value : whole_ticks(f.last, columns)) {
    const float x = f.x(value);
    list.AddLine(ImVec2(x, f.min.y), ImVec2(x, f.max.y), palette().grid, scale);
    text_at(list, ImVec2(x, f.max.y + 4 * scale), 0.5f, 0, palette().text_dim,
            grouped(static_cast<long long>(value)));
  }
  text_at(list, ImVec2((f.min.x + f.max.x) / 2, f.max.y + 19 * scale), 0.5f, 0, palette().text_dim,
          "outer iteration");
  if (f.inverted > 0) {
    for (const double value : whole_ticks(f.inverted, std::max(2, rows / 2)))
      text_at(list, ImVec2(f.max.x + 6 * scale, f.y_inverted(value)), 0, 0.5f, palette().danger,
              grouped(static_cast<long long>(value)));
  }
  list.AddRect(f.min, f.max, palette().border, 0, 0, scale);
}

void draw_inverted(ImDrawList& list, const Frame& f, std::span<const IterationRecord> history) {
  if (!(f.inverted > 0)) return;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const double next = i + 1 < history.size() ? history[i + 1].iteration : f.last;
    // A new target of a drag starts with a second record of the same iteration.
    if (history[i].inverted == 0 || next <= history[i].iteration) continue;
    list.AddRectFilled(ImVec2(f.x(history[i].iteration), f.y_inverted(history[i].inverted)),
                       ImVec2(f.x(next), f.max.y), faded(palette().danger, 0.19f));
  }
}

void draw_line(ImDrawList& list, const Frame& f, std::span<const IterationRecord> history,
               double IterationRecord::*value, ImU32 c, float width, float scale) {
  std::vector<ImVec2> points;
  for (const IterationRecord& r : history)
    if (r.*value > 0) points.emplace_back(f.x(r.iteration), f.y(r.*value));
  list.AddPolyline(points.data(), static_cast<int>(points.size()), c, 0, width * scale);
  if (points.size() <= 40)
    for (const ImVec2& p : points) list.AddCircleFilled(p, 2.2f * scale, c);
}

void draw_tolerance(ImDrawList& list, const Frame& f, double tolerance, float scale) {
  const float y = f.y(tolerance);
  for (float x = f.min.x; x < f.max.x; x += 9 * scale)
    list.AddLine(ImVec2(x, y), ImVec2(std::min(x + 5 * scale, f.max.x), y), palette().success,
                 1.4f * scale);
  text_at(list, ImVec2(f.min.x + 6 * scale, y - 2 * scale), 0, 1, palette().success, "tolerance");
}

void draw_key(ImDrawList& list, const Frame& f, float scale) {
  struct Entry {
    ImU32 color;
    const char* label;
    bool block;
  };
  std::vector<Entry> entries{{palette().accent, "residual", false},
                             {palette().move_line, "largest move", false}};
  if (f.inverted > 0) entries.push_back({palette().danger, "inverted elements", true});
  float x = f.min.x;
  const float y = f.min.y - 13 * scale;
  for (const Entry& e : entries) {
    const float width = 22 * scale + ImGui::CalcTextSize(e.label).x;
    if (x + width > f.max.x) break;
    if (e.block)
      list.AddRectFilled(ImVec2(x, y - 4 * scale), ImVec2(x + 16 * scale, y + 4 * scale),
                         faded(palette().danger, 0.35f));
    else
      list.AddLine(ImVec2(x, y), ImVec2(x + 16 * scale, y), e.color, 2 * scale);
    text_at(list, ImVec2(x + 22 * scale, y), 0, 0.5f, palette().text_dim, e.label);
    x += width + 18 * scale;
  }
}

const IterationRecord* record_at(const Frame& f, std::span<const IterationRecord> history,
                                 const ImVec2& mouse) {
  const IterationRecord* best = nullptr;
  float distance = 0;
  for (const IterationRecord& r : history) {
    const float d = std::abs(f.x(r.iteration) - mouse.x);
    if (best && d >= distance) continue;
    best = &r;
    distance = d;
  }
  return best;
}

void draw_readout(ImDrawList& list, const Frame& f, const IterationRecord& r, float scale) {
  const float x = f.x(r.iteration);
  list.AddLine(ImVec2(x, f.min.y), ImVec2(x, f.max.y), palette().text_faint, scale);
  if (r.residual > 0) list.AddCircleFilled(ImVec2(x, f.y(r.residual)), 4 * scale, palette().accent);
  if (r.largest_move > 0)
    list.AddCircleFilled(ImVec2(x, f.y(r.largest_move)), 4 * scale, palette().move_line);
  ImGui::BeginTooltip();
  ImGui::Text("Iteration %d", r.iteration);
  ui::text_colored(palette().accent, "residual         " + short_number(r.residual));
  ui::text_colored(palette().move_line, "largest move  " + short_number(r.largest_move));
  ui::text_colored(r.inverted > 0 ? palette().danger : palette().text_dim,
                   counted(r.inverted, "inverted element"));
  ui::text_dim("smallest sine " + short_number(r.min_sine));
  if (r.fraction < 1) ui::text_dim("motion applied " + short_number(100 * r.fraction) + " %");
  if (r.clipped) ui::text_dim("negative weights clipped");
  ImGui::EndTooltip();
}

}  // namespace

std::optional<IterationRecord> draw_convergence_plot(std::string_view id,
                                                     const ConvergencePlot& plot,
                                                     const ImVec2& size, float scale) {
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 max(min.x + size.x, min.y + size.y);
  ImGui::InvisibleButton(std::string(id).c_str(), size);
  ui::note(id);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Frame frame = make_frame(plot, min, max, scale);
  if (frame.max.x <= frame.min.x || frame.max.y <= frame.min.y) return std::nullopt;
  draw_axes(list, frame, scale);
  list.PushClipRect(frame.min, frame.max, true);
  draw_inverted(list, frame, plot.history);
  if (plot.tolerance) draw_tolerance(list, frame, *plot.tolerance, scale);
  draw_line(list, frame, plot.history, &IterationRecord::largest_move, palette().move_line, 1.5f,
            scale);
  draw_line(list, frame, plot.history, &IterationRecord::residual, palette().accent, 2.0f, scale);
  list.PopClipRect();
  draw_key(list, frame, scale);
  const IterationRecord* record =
      hovered ? record_at(frame, plot.history, ImGui::GetIO().MousePos) : nullptr;
  if (!record) return std::nullopt;
  draw_readout(list, frame, *record, scale);
  return *record;
}

}  // namespace winslow::gui
