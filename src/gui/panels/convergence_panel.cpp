#include "gui/panels/panels.h"

#include <imgui.h>

#include "core/outer/outer_solver.h"
#include "gui/base/text.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/plot_frame.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

namespace {

/// The visible curves.
struct PlotSeries {
  bool residual = true, move = true, inverted = true, sine = true;
};

/// A convergence history: residual and largest move on a logarithmic axis, with the tolerance as a
/// line. Below, if there is room: the number of inverted elements (left axis) and the smallest sine
/// (right axis). The mouse reads out one iteration.
struct ConvergencePlot {
  std::span<const IterationRecord> history;
  std::optional<double> tolerance;
  PlotSeries series;
};

// Functions, since the colours depend on the palette.
ImU32 residual_color() { return palette().accent; }
ImU32 move_color() { return palette().move_line; }
ImU32 inverted_color() { return palette().danger; }
ImU32 sine_color() { return palette().warning; }

ImU32 pale(ImU32 color) { return (color & ~IM_COL32_A_MASK) | (90u << IM_COL32_A_SHIFT); }

/// Round whole numbers within a range.
std::vector<double> whole_ticks(double low, double high, int wanted) {
  std::vector<double> ticks = nice_ticks(low, high, wanted);
  std::erase_if(ticks, [](double t) { return t != std::round(t); });
  return ticks;
}

/// Draws the two strips, their axes and their curves.
class Drawing {
 public:
  Drawing(const ConvergencePlot& plot, const ImVec2& min, const ImVec2& max, float scale)
      : list_(*ImGui::GetWindowDrawList()), plot_(plot), scale_(scale) {
    const bool wants_lower = plot.series.inverted || plot.series.sine;
    const float height = max.y - min.y - 36 * scale;
    lower_shown_ = wants_lower && height > 96 * scale;
    top_.min = ImVec2(min.x + 54 * scale, min.y + 8 * scale);
    // Leave room beside the frame for the name of the tolerance.
    top_.max = ImVec2(max.x - 72 * scale, max.y - 36 * scale);
    if (!plot.history.empty()) {
      top_.first = plot.history.front().iteration;
      top_.last = std::max(top_.first + 1, static_cast<double>(plot.history.back().iteration));
    } else {
      top_.last = 100;
    }
    bottom_ = top_;
    if (lower_shown_) {
      // The lowest number of the upper strip is above the highest of the lower strip.
      const float gap = ImGui::GetTextLineHeight() + 2 * scale;
      top_.max.y = top_.min.y + 0.6f * (top_.max.y - top_.min.y - gap);
      bottom_.min.y = top_.max.y + gap;
    }
    values_ = residual_axis(plot.history, plot.tolerance.value_or(1e-3), plot.series.residual,
                            plot.series.move);
    inverted_ = inverted_axis(plot.history);
    sine_ = sine_axis(plot.history);
  }

  bool fits() const { return top_.max.x > top_.min.x && top_.max.y > top_.min.y; }

  void draw() {
    draw_columns();
    draw_upper();
    if (lower_shown_) draw_lower();
    draw_numbers();
  }

  const IterationRecord* record_at(float x) const {
    const IterationRecord* best = nullptr;
    for (const IterationRecord& r : plot_.history)
      if (!best || std::abs(top_.x(r.iteration) - x) < std::abs(top_.x(best->iteration) - x))
        best = &r;
    return best;
  }

  void draw_mark(const IterationRecord& r) {
    const float x = top_.x(r.iteration);
    const float foot = lower_shown_ ? bottom_.max.y : top_.max.y;
    list_.AddLine(ImVec2(x, top_.min.y), ImVec2(x, foot), palette().text_faint, scale_);
    const auto dot = [&](float y, ImU32 color) {
      list_.AddCircleFilled(ImVec2(x, y), 4 * scale_, color);
    };
    if (plot_.series.residual && r.residual > 0) dot(top_.y(values_, r.residual), residual_color());
    if (plot_.series.move && r.largest_move > 0) dot(top_.y(values_, r.largest_move), move_color());
    if (lower_shown_ && plot_.series.sine) dot(bottom_.y(sine_, r.min_sine), sine_color());
  }

 private:
  void draw_columns() {
    const int columns = std::max(2, static_cast<int>((top_.max.x - top_.min.x) / (80 * scale_)));
    for (const PlotStrip* strip : {&top_, &bottom_}) {
      if (strip == &bottom_ && !lower_shown_) continue;
      list_.AddRectFilled(strip->min, strip->max, palette().card);
      for (const double value : whole_ticks(top_.first, top_.last, columns))
        list_.AddLine(ImVec2(top_.x(value), strip->min.y), ImVec2(top_.x(value), strip->max.y),
                      palette().grid, scale_);
    }
    for (const double value : whole_ticks(top_.first, top_.last, columns))
      text_at(list_, ImVec2(top_.x(value), bottom_.max.y + 4 * scale_), ImVec2(0.5f, 0),
              palette().text_dim, grouped(static_cast<long long>(value)));
    text_at(list_, ImVec2((top_.min.x + top_.max.x) / 2, bottom_.max.y + 19 * scale_),
            ImVec2(0.5f, 0), palette().text_dim, "outer iteration");
  }

  void draw_upper() {
    draw_decades();
    list_.AddRect(top_.min, top_.max, palette().border, 0, 0, scale_);
    if (plot_.tolerance) draw_tolerance(*plot_.tolerance);
    list_.PushClipRect(top_.min, top_.max, true);
    if (plot_.series.move) draw_line(&IterationRecord::largest_move, move_color(), 1.5f);
    if (plot_.series.residual) draw_line(&IterationRecord::residual, residual_color(), 2.0f);
    list_.PopClipRect();
  }

  /// Draws a line for each decade of at least three pixels, and as many labels as fit.
  void draw_decades() {
    const float height = top_.max.y - top_.min.y;
    const double decades = values_.high - values_.low;
    if (static_cast<double>(height) > 3 * static_cast<double>(scale_) * decades)
      for (double decade = std::ceil(values_.low); decade <= values_.high; ++decade)
        draw_decade(decade, palette().grid);
    const int room = 1 + static_cast<int>(height / ImGui::GetTextLineHeight());
    for (const int decade : named_decades(values_, room)) {
      const float y = draw_decade(decade, palette().border);
      text_at(list_, ImVec2(top_.min.x - 6 * scale_, y), ImVec2(1, 0.5f), palette().text_dim,
              "1e" + std::to_string(decade));
    }
  }

  float draw_decade(double decade, ImU32 color) {
    const float y = top_.y(values_, std::pow(10.0, decade));
    list_.AddLine(ImVec2(top_.min.x, y), ImVec2(top_.max.x, y), color, scale_);
    return y;
  }

  void draw_tolerance(double tolerance) {
    const float y = top_.y(values_, tolerance);
    for (float x = top_.min.x; x < top_.max.x; x += 9 * scale_)
      list_.AddLine(ImVec2(x, y), ImVec2(std::min(x + 5 * scale_, top_.max.x), y),
                    palette().success, 1.4f * scale_);
    text_at(list_, ImVec2(top_.max.x + 5 * scale_, y), ImVec2(0, 0.5f), palette().success,
            "tolerance");
  }

  void draw_line(double IterationRecord::*value, ImU32 color, float width) {
    std::vector<ImVec2> points;
    for (const IterationRecord& r : plot_.history)
      if (r.*value > 0) points.emplace_back(top_.x(r.iteration), top_.y(values_, r.*value));
    draw_points(points, color, width);
  }

  void draw_points(const std::vector<ImVec2>& all, ImU32 color, float width) {
    const std::vector<ImVec2> points = decimated(all);
    // Line by line: a polyline is smeared if two records of one iteration lie above one another.
    for (std::size_t k = 1; k < points.size(); ++k)
      list_.AddLine(points[k - 1], points[k], color, width * scale_);
    if (points.size() <= 40)
      for (const ImVec2& p : points) list_.AddCircleFilled(p, 2.2f * scale_, color);
  }

  void draw_lower() {
    list_.AddRect(bottom_.min, bottom_.max, palette().border, 0, 0, scale_);
    list_.PushClipRect(bottom_.min, bottom_.max, true);
    if (plot_.series.inverted) draw_inverted();
    if (plot_.series.sine) {
      std::vector<ImVec2> points;
      for (const IterationRecord& r : plot_.history)
        if (std::isfinite(r.min_sine))
          points.emplace_back(bottom_.x(r.iteration), bottom_.y(sine_, r.min_sine));
      draw_points(points, sine_color(), 1.5f);
    }
    list_.PopClipRect();
  }

  /// Draws blocks, at most one per column of pixels.
  void draw_inverted() {
    const auto& history = plot_.history;
    for (std::size_t i = 0; i < history.size();) {
      const float left = bottom_.x(history[i].iteration);
      float right = left;
      Index most = 0;
      for (; i < history.size() && right < left + 1; ++i) {
        most = std::max(most, history[i].inverted);
        right = i + 1 < history.size() ? bottom_.x(history[i + 1].iteration)
                                       : std::max(left + 2 * scale_, bottom_.max.x);
      }
      if (most > 0)
        list_.AddRectFilled(ImVec2(left, bottom_.y(inverted_, most)), ImVec2(right, bottom_.max.y),
                            pale(inverted_color()));
    }
  }

  /// Draws the axes of the lower strip: inverted elements at its left, sines at its right.
  void draw_numbers() {
    if (!lower_shown_ || plot_.history.empty()) return;
    const int rows = std::max(2, static_cast<int>((bottom_.max.y - bottom_.min.y) / (24 * scale_)));
    if (plot_.series.inverted)
      for (const double value : whole_ticks(0, inverted_.high, rows))
        text_at(list_, ImVec2(bottom_.min.x - 6 * scale_, bottom_.y(inverted_, value)),
                ImVec2(1, 0.5f), inverted_color(), grouped(static_cast<long long>(value)));
    if (!plot_.series.sine) return;
    const std::vector<double> ticks = nice_ticks(sine_.low, sine_.high, rows);
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 0.1;
    for (const double value : ticks)
      text_at(list_, ImVec2(bottom_.max.x + 6 * scale_, bottom_.y(sine_, value)), ImVec2(0, 0.5f),
              sine_color(), format_tick(value, step));
  }

  ImDrawList& list_;
  const ConvergencePlot& plot_;
  float scale_;
  bool lower_shown_ = false;
  PlotStrip top_, bottom_;
  PlotAxis values_, inverted_, sine_;
};

void draw_readout(const IterationRecord& r) {
  ImGui::BeginTooltip();
  ImGui::Text("Iteration %d, %s", r.iteration, std::string(stage_name(r.stage)).c_str());
  ui::text_colored(residual_color(), "residual  " + short_number(r.residual));
  ui::text_colored(move_color(), "largest move  " + short_number(r.largest_move));
  ui::text_colored(r.inverted > 0 ? inverted_color() : palette().text_dim,
                   counted(r.inverted, "inverted element"));
  ui::text_colored(sine_color(), "smallest sine  " + short_number(r.min_sine));
  ui::text_dim("damping  " + short_number(r.damping));
  ui::text_dim("linear iterations  " + std::to_string(r.linear_iterations));
  if (r.fraction < 1) ui::text_dim("motion applied  " + short_number(100 * r.fraction) + " %");
  if (r.clipped) ui::text_dim("negative weights clipped");
  ImGui::EndTooltip();
}

/// Draws a line that names the curves; a click shows or hides one. Its entries have the ids
/// ID/residual, ID/move, ID/inverted and ID/sine.
void draw_convergence_key(std::string_view id, PlotSeries& series, float scale) {
  struct Entry {
    const char *name, *label;
    ImU32 color;
    bool PlotSeries::*shown;
    bool block;
  };
  const std::array<Entry, 4> entries{
      {{"residual", "residual", residual_color(), &PlotSeries::residual, false},
       {"move", "largest move", move_color(), &PlotSeries::move, false},
       {"inverted", "inverted elements", inverted_color(), &PlotSeries::inverted, true},
       {"sine", "smallest sine", sine_color(), &PlotSeries::sine, false}}};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float height = ImGui::GetTextLineHeight() + 2 * scale;
  for (const Entry& e : entries) {
    const float width = 22 * scale + ImGui::CalcTextSize(e.label).x;
    if (&e != &entries.front()) ImGui::SameLine(0, 16 * scale);
    if (&e != &entries.front() && ImGui::GetContentRegionAvail().x < width) {
      ImGui::NewLine();
      break;
    }
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const std::string name = std::string(id) + '/' + e.name;
    bool& shown = series.*e.shown;
    if (ImGui::InvisibleButton(name.c_str(), ImVec2(width, height))) shown = !shown;
    ui::note(name);
    ui::tooltip(shown ? "Click to hide this curve." : "Click to show this curve.");
    const float y = at.y + height / 2;
    const ImU32 color = shown ? e.color : palette().border;
    if (e.block)
      list.AddRectFilled(ImVec2(at.x, y - 4 * scale), ImVec2(at.x + 16 * scale, y + 4 * scale),
                         shown ? pale(color) : color);
    else
      list.AddLine(ImVec2(at.x, y), ImVec2(at.x + 16 * scale, y), color, 2 * scale);
    text_at(list, ImVec2(at.x + 22 * scale, y), ImVec2(0, 0.5f),
            shown ? palette().text_dim : palette().text_faint, e.label);
  }
}

/// Draws the plot as an item of the current window.
void draw_convergence_plot(std::string_view id, const ConvergencePlot& plot, const ImVec2& size,
                           float scale) {
  const ImVec2 min = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(std::string(id).c_str(), size);
  ui::note(id);
  const bool hovered = ImGui::IsItemHovered();
  Drawing drawing(plot, min, ImVec2(min.x + size.x, min.y + size.y), scale);
  if (!drawing.fits()) return;
  drawing.draw();
  const IterationRecord* record = hovered ? drawing.record_at(ImGui::GetIO().MousePos.x) : nullptr;
  if (!record) return;
  drawing.draw_mark(*record);
  draw_readout(*record);
}

/// The command whose iterations are shown: that of the job, or the one that led to the mesh; null:
/// none.
const Command* command_shown(const LiveMesh& mesh) {
  if (mesh.work().job().active()) return &mesh.work().job().command();
  const Document* document = mesh.document();
  if (!document || document->history().position() == 0) return nullptr;
  return &document->history().command(document->history().position());
}

/// Tolerance of the shown iterations: that of their command, or else of the next one.
double tolerance_shown(const Session& session) {
  const Command* command = command_shown(session.mesh());
  const SmoothOptions* options = command ? smooth_options(*command) : nullptr;
  return tolerance_of(options ? *options : session.solver_settings().smooth_options(),
                      cell_dimension_of(session.kind()));
}

/// Shows the iterations of the running job, or of the command that led to the present mesh.
class ConvergencePanel {
 public:
  void draw(const PanelContext& context) {
    const Session& session = context.session;
    if (convergence_empty(context)) return draw_strip(context);
    draw_header(context);
    const auto history = session.mesh().convergence();
    ImVec2 size = ImGui::GetContentRegionAvail();
    size.x = std::max(size.x, 1.0f);
    size.y = std::max(size.y, 1.0f);
    // An active text field may contain any number.
    const double tolerance = tolerance_shown(session);
    ConvergencePlot plot{history, {}, series_};
    if (tolerance > 0) plot.tolerance = tolerance;
    draw_convergence_plot("convergence/plot", plot, size, context.theme.scale);
  }

 private:
  void draw_header(const PanelContext& context) {
    const Session& session = context.session;
    const std::string label = "Export CSV";
    const float button =
        ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
    const float room = ImGui::GetContentRegionAvail().x;
    ImGui::AlignTextToFramePadding();
    const float start = ImGui::GetCursorPosX();
    ImGui::PushFont(context.theme.bold);
    const Command* command = command_shown(session.mesh());
    const std::string title = command ? "Convergence: " + describe(*command) : "Convergence";
    ImGui::TextUnformatted(ui::elided(title, room - button - context.theme.px(12)).c_str());
    ImGui::PopFont();
    ImGui::SameLine(start + room - button);
    if (ui::button("convergence/export", label,
                   {"Write every iteration shown here, with all its numbers, as a table for a "
                    "spreadsheet or a plotting program.",
                    ui::ButtonStyle::normal, !session.mesh().convergence().empty()}))
      context.emit(action::ShowFileDialog{FilePurpose::export_convergence});
    draw_convergence_key("convergence", series_, context.theme.scale);
  }

  static void draw_strip(const PanelContext& context) {
    ImGui::AlignTextToFramePadding();
    ui::text_in(context.theme.bold, "Convergence");
    ui::note("convergence/strip");
    ImGui::SameLine(0, context.theme.px(16));
    ui::text_dim(
        ui::elided("Move a body or press Smooth: the residual of every iteration appears here.",
                   ImGui::GetContentRegionAvail().x));
  }

  PlotSeries series_;
};

}  // namespace

bool convergence_empty(const PanelContext& context) {
  if (context.session.job().active()) return false;
  const Document* document = context.session.document();
  if (!document) return true;
  // Check the whole history, so that undo does not change the layout.
  const History& history = document->history();
  for (std::size_t k = 1; k < history.size(); ++k)
    if (!history.result(k).history.empty()) return false;
  return true;
}

DrawPanel convergence_panel() { return panel_of<ConvergencePanel>(); }

}  // namespace winslow::gui
