#include "gui/panels/panels.h"

#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "core/mesh/surface_faces.h"
#include "gui/base/text.h"
#include "gui/panels/vcv/vcv_parts.h"
#include "gui/panels/vcv/vcv_plot.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// Inspects a node: its star beside its VCV, the values of the operator there, and controls to edit
/// the VCV.
class VcvPanel {
 public:
  void draw(const PanelContext& context) {
    if (!context.session.document()) return ui::text_dim("No mesh is open.");
    draw_node_header(context, typed_node_);
    const auto& node = context.session.nodes().inspected();
    if (!node) return draw_node_hint();
    if (shown_ != node) {
      shown_ = node;
      edge_ = 0;
      hovered_.reset();
      typed_node_ = *node;
    }
    try {
      const NodalView view =
          inspect_node(*context.session.vcv(), context.session.coordinates(), *node);
      if (!plot_.dragging() || edge_ >= view.neighbours.size()) edge_ %= view.neighbours.size();
      draw_plot(context, view);
      draw_figures(view, context.theme);
      draw_neighbours(context, view);
      draw_edge_fields(context, view);
      draw_reset(context, view);
      draw_spread(context, view);
    } catch (const UsageError& error) {
      draw_no_vcv(error.what());
    }
  }

 private:
  void draw_plot(const PanelContext& context, const NodalView& view) {
    const auto lit = lit_neighbour(context, view.neighbours, hovered_);
    const VcvPlot::Outcome outcome = plot_.draw(view, lit, context.theme);
    take_outcome(context, outcome, edge_);
    hovered_ = outcome.hovered;
    ImGui::PushTextWrapPos(0);
    ui::text_dim("Drag an end: Shift its angle only, Ctrl its length.");
    ImGui::PopTextWrapPos();
    if (context.session.kind() == MeshKind::surface)
      ui::text_dim("The star laid flat, angles scaled to 360\xC2\xB0.");
    ui::tooltip(
        "Dragging an end of the virtual control volume changes the two angles beside the edge and "
        "its length; the mesh answers at once. Elements around a node whose control volume was "
        "changed take its shape for their target, whatever targets the solver is set to. Weights "
        "stand on the edges, negative ones in red; the ellipse in the star is the image of the "
        "unit circle.");
  }

  void draw_figures(const NodalView& view, const Theme& theme) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(8), theme.px(4)));
    const WinslowCoefficients& c = view.coefficients;
    draw_figure(
        "vcv/coefficients", "\xCE\xB1  \xCE\xB2  \xCE\xB3",
        formatted(c.alpha, "%.3f") + "   " + formatted(c.beta, "%.3f") + "   " +
            formatted(c.gamma, "%.3f"),
        "Coefficients of the Winslow equations at this node, divided by (alpha + gamma) / 2.");
    draw_figure(
        "vcv/singular", "Singular values",
        short_number(view.singular_values[0]) + "   " + short_number(view.singular_values[1]),
        "Of the nodal Jacobian, which maps the control volume to the mesh: half axes of the "
        "ellipse.");
    draw_figure("vcv/kappa", "Kappa", short_number(view.kappa),
                "Ratio of the singular values: 1 where the map is conformal.");
    draw_figure("vcv/smallest", "Smallest weight", short_number(view.smallest_weight),
                "The smallest of the weights over their mean magnitude: 1 where all are equal.",
                view.smallest_weight < 0 ? palette().danger : palette().text);
    draw_figure("vcv/residual", "Residual", short_number(view.scaled_residual),
                "Distance to where the paper's operator would move this node alone, over the mean "
                "length of its edges.");
    ImGui::PopStyleVar();
  }

  void draw_neighbours(const PanelContext& context, const NodalView& view) {
    std::size_t chosen = star_figures_ ? 1 : 0;
    if (ui::tabs("vcv/figures",
                 {{"VCV", "Angles (degrees), lengths and areas of the virtual control volume."},
                  {"Star", "Angles (degrees), lengths and areas in the mesh."}},
                 chosen))
      star_figures_ = chosen == 1;
    const Star& star = star_figures_ ? view.physical : view.vcv;
    ImGui::PushFont(context.theme.small);
    std::optional<std::size_t> over;
    if (ImGui::BeginTable("neighbours", 6, ImGuiTableFlags_SizingStretchProp)) {
      for (const char* head : {"", "node", "angle", "length", "area", "weight"})
        ImGui::TableSetupColumn(head, ImGuiTableColumnFlags_None, head[0] == '\0' ? 0.5f : 1.0f);
      ImGui::TableNextRow();
      for (int k = 0; k < 6; ++k) {
        ImGui::TableNextColumn();
        ui::text_right(ImGui::TableGetColumnName(k), palette().text_dim);
      }
      for (std::size_t k = 0; k < view.neighbours.size(); ++k) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::string number = std::to_string(k + 1);
        if (ImGui::Selectable((number + "##row").c_str(), hovered_ == k || edge_ == k,
                              ImGuiSelectableFlags_SpanAllColumns))
          edge_ = k;
        ui::note("vcv/row/" + std::to_string(k));
        if (ImGui::IsItemHovered()) over = k;
        const double weight = view.weights[k];
        const std::array<std::string, 5> cells{
            std::to_string(view.neighbours[k]), formatted(degrees(star.angles[k]), "%.1f"),
            short_number(star.lengths[k]), short_number(star.areas[k]), formatted(weight, "%.3f")};
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
          ImGui::TableNextColumn();
          const bool bad = (cell == 4 && weight < 0) || (cell == 3 && star.areas[k] < 0);
          ui::text_right(cells[cell], bad ? palette().danger : palette().text);
        }
      }
      ImGui::EndTable();
    }
    ImGui::PopFont();
    if (over && over != hovered_) hovered_ = over;
  }

  void draw_edge_fields(const PanelContext& context, const NodalView& view) {
    VcvEdit edit = numbers_of(view);
    const std::size_t n = view.neighbours.size();
    const std::string which =
        std::to_string(edge_ + 1) + " to " + std::to_string((edge_ + 1) % n + 1);
    ui::row("Angle " + which, "Degrees. The other angles share what is left as they did.");
    const bool fixed_angles = n == 2;
    ImGui::BeginDisabled(fixed_angles);
    if (!typing_angle_) angle_ = edit.angles[edge_];
    ui::number("vcv/angle", angle_, {}, "%.4g");
    const bool angle_done = ImGui::IsItemDeactivatedAfterEdit();
    typing_angle_ = ImGui::IsItemActive();
    ImGui::EndDisabled();
    ui::row("Length of " + std::to_string(edge_ + 1), "Only ratios within one control volume act.");
    if (!typing_length_) length_ = edit.lengths[edge_];
    ui::number("vcv/length", length_, {}, "%.4g");
    const bool length_done = ImGui::IsItemDeactivatedAfterEdit();
    typing_length_ = ImGui::IsItemActive();
    // Invalid input leaves the value unchanged and is no edit.
    if (angle_done && angle_ > 0 && angle_ < 180 && angle_ != edit.angles[edge_]) {
      const double rest = 360 - edit.angles[edge_];
      for (double& angle : edit.angles) angle *= (360 - angle_) / rest;
      edit.angles[edge_] = angle_;
      edit_vcv(context, std::move(edit));
    } else if (length_done) {
      edit_length(context, std::move(edit), edge_, length_);
    }
  }

  void draw_reset(const PanelContext& context, const NodalView& view) {
    std::vector<Index> edited;
    for (const auto& [node, stencil] : context.session.vcv()->edits()) edited.push_back(node);
    draw_resets(context, {view.node, view.neighbours, {}, {}}, view.edited, edited,
                {"Give this node equal angles and unit edges again.",
                 "Give all nodes equal angles and unit edges again."});
  }

  void draw_spread(const PanelContext& context, const NodalView& view) {
    ui::row("Apply to",
            "Gives this control volume to other nodes with as many neighbours, turned so that "
            "edges which point the same way in the mesh have the same numbers; on a surface, in "
            "the tangent planes.");
    ui::combo("vcv/spread", {"Pinned nodes", "Nodes within a radius"}, spread_to_);
    if (spread_to_ == 1) {
      ui::row("Radius", "Units of the mesh.");
      if (radius_ == 0) radius_ = 3 * view.physical.mean_length();
      ui::number("vcv/radius", radius_, {}, "%.4g");
    }
    const std::vector<Index>& targets = spread_targets(context, view);
    const std::string alike = "with " + std::to_string(view.neighbours.size()) + " neighbours";
    const std::string tip = !targets.empty() ? "To the nodes " + alike + "."
                            : spread_to_ == 0
                                ? "Pin another node " + alike + " first."
                                : "No other free node " + alike + " lies within this radius.";
    const std::string label =
        targets.empty() ? "Apply to no node" : "Apply to " + counted(targets.size(), "node");
    if (ui::button("vcv/apply", label, {tip, ui::ButtonStyle::normal, !targets.empty(), -1}))
      context.emit(action::EditVcvs{
          spread_vcv(*context.session.vcv(), context.session.coordinates(), view.node, targets)});
  }

  const std::vector<Index>& spread_targets(const PanelContext& context, const NodalView& view) {
    const Session& session = context.session;
    SpreadTo wanted{session.shape(), view.node, spread_to_, radius_, session.nodes().pinned()};
    if (wanted == spread_) return targets_;
    spread_ = std::move(wanted);
    const Topology& topology = *context.topology();
    const auto fits = [&](Index node) {
      return node != view.node && topology.neighbours(node).size() == view.neighbours.size();
    };
    targets_.clear();
    if (spread_to_ == 0) {
      std::ranges::copy_if(spread_.pinned, std::back_inserter(targets_), fits);
      return targets_;
    }
    const auto near = within(context, view.node);
    for (const Index node : topology.interior_nodes())
      if (near(node) && fits(node)) targets_.push_back(node);
    return targets_;
  }

  std::function<bool(Index)> within(const PanelContext& context, Index middle) const;
  /// The inputs that determine the nodes to which a VCV is applied.
  struct SpreadTo {
    std::uint64_t shape = 0;
    Index node = -1;
    std::size_t choice = 0;
    double radius = 0;
    std::vector<Index> pinned;
    bool operator==(const SpreadTo&) const = default;
  };
  VcvPlot plot_;
  int typed_node_ = 0;
  std::optional<Index> shown_;          // node of the state below
  std::optional<std::size_t> hovered_;  // neighbour, in the table
  std::size_t edge_ = 0;                // whose numbers are in the fields
  double angle_ = 0, length_ = 0;       // as typed
  bool typing_angle_ = false, typing_length_ = false;
  bool star_figures_ = false;  // the table shows the physical star
  std::size_t spread_to_ = 0;
  double radius_ = 0;
  SpreadTo spread_;  // inputs of targets_, which require a loop over all nodes
  std::vector<Index> targets_;
};

}  // namespace

/// A test whether a node lies within the radius of another; on a surface mesh also on the same
/// side.
std::function<bool(Index)> VcvPanel::within(const PanelContext& context, Index middle) const {
  const Coordinates& x = context.session.coordinates();
  if (context.session.kind() == MeshKind::plane)
    return [&x, from = x.xy(middle), radius = radius_](Index node) {
      return (x.xy(node) - from).norm() <= radius;
    };
  const Topology& topology = *context.topology();
  const SpacePoints points(x);
  return [&topology, points, from = points[middle], radius = radius_,
          normal = star_normal(topology, points, middle)](Index node) {
    return (points[node] - from).norm() <= radius &&
           star_normal(topology, points, node).dot(normal) > 0;
  };
}

DrawPanel vcv_panel() { return panel_of<VcvPanel>(); }

}  // namespace winslow::gui
