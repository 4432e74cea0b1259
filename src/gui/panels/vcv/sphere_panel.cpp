#include "gui/panels/panels.h"

#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "gui/base/text.h"
#include "gui/panels/vcv/sphere_drawing.h"
#include "gui/panels/vcv/sphere_plot.h"
#include "gui/panels/vcv/vcv_parts.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

VcvEdit numbers_of(const VolumeNodalView& view) {
  VcvEdit edit{view.node, view.neighbours, {}, view.vcv.lengths};
  for (const Vec3& p : view.vcv.points) edit.directions.push_back(p.normalized());
  return edit;
}

std::string corners_of(const SphereLink& link, std::size_t t) {
  const auto& [a, b, c] = link.triangles()[t];
  return std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1);
}

/// Draws the head of a table, right-aligned like its numbers.
void table_head(std::initializer_list<const char*> names) {
  bool first = true;
  for (const char* name : names) {
    ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_None, first ? 0.6f : 1.0f);
    first = false;
  }
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableNextRow();
  for (const char* name : names) {
    ImGui::TableNextColumn();
    ui::text_right(name, palette().text_dim);
  }
}

void cell(const std::string& text, bool bad = false) {
  ImGui::TableNextColumn();
  ui::text_right(text, bad ? palette().danger : palette().text);
}

/// Inspects a node of a volume mesh: its star beside its VCV on the sphere, the values of the
/// operator there, and controls to edit the VCV.
class SpherePanel {
 public:
  void draw(const PanelContext& context) {
    if (!context.session.document()) return ui::text_dim("No mesh is open.");
    draw_node_header(context, typed_node_);
    const auto& node = context.session.nodes().inspected();
    if (!node) return draw_node_hint();
    follow_node(context, *node);
    try {
      const VolumeNodalView& view = context.session.inspection().spheres.view_of(*node);
      if (edge_ >= view.neighbours.size()) edge_ = 0;
      draw_plot(context, view);
      draw_kind(context);
      draw_figures(view);
      draw_tables(context.theme, view);
      draw_edge_fields(context, view);
      draw_reset(context, view);
      draw_spread(context, view);
    } catch (const Error& error) {
      draw_no_vcv(error.what());
    }
  }

 private:
  void follow_node(const PanelContext& context, Index node) {
    if (shown_ == node) return;
    if (!shown_ && context.view_state.looks_from) plot_.look_from(*context.view_state.looks_from);
    shown_ = node;
    edge_ = 0;
    hovered_.reset();
    over_face_.reset();
    typed_node_ = node;
    typing_ = 0;
  }

  void draw_plot(const PanelContext& context, const VolumeNodalView& view) {
    const auto lit = lit_neighbour(context, view.neighbours, hovered_);
    const SpherePlot::Outcome outcome = plot_.draw(view, {lit, over_face_, large_}, context.theme);
    take_outcome(context, outcome, edge_);
    hovered_ = outcome.hovered;
    draw_angle_legend(context.theme, SpherePlot::colors_of(view));
    draw_turning(context);
    draw_hint(view);
  }

  void draw_turning(const PanelContext& context) {
    bool linked = plot_.linked();
    if (ui::checkbox("vcv/linked", "Turn together", linked,
                     "Dragging one of the two turns the other with it."))
      plot_.link(linked);
    ui::second_column("Large");
    ui::checkbox("vcv/large", "Large", large_,
                 "One below the other, as wide as the panel: more numbers have room.");
    if (ui::button("vcv/as_mesh", "Seen as the mesh",
                   {"Looks at both from where the mesh is looked at.", ui::ButtonStyle::normal,
                    context.view_state.looks_from.has_value(), 0}))
      plot_.look_from(*context.view_state.looks_from);
  }

  void draw_kind(const PanelContext& context) {
    static constexpr std::array<ui::Named<VcvKind>, 5> kinds{
        {{VcvKind::automatic, "Automatic"},
         {VcvKind::equal, "Equal angles"},
         {VcvKind::existing, "Existing angles"},
         {VcvKind::adjusted, "Adjusted angles"},
         {VcvKind::perturbation, "By perturbation"}}};
    SmoothOptions options = context.session.solver_settings().smooth_options();
    if (ui::choice("vcv/kind", "VCVs", kinds, options.vcv,
                   "The solid angles that control volumes of all nodes have of themselves; of the "
                   "solver, too, where its equations are over them (pointwise form, targets vcv)."))
      context.edit(options);
  }

  void draw_hint(const VolumeNodalView& view) {
    ImGui::PushTextWrapPos(0);
    if (const auto& face = plot_.stopped_by()) {
      ui::text_colored(palette().danger,
                       "Stopped: the triangle " +
                           corners_of(view.link, static_cast<std::size_t>(*face)) +
                           " would turn over.");
      ui::note("vcv/stopped");
    } else {
      ui::text_dim("Drag a point over the sphere; with Ctrl its length. Drag beside it: turn.");
    }
    ImGui::PopTextWrapPos();
    ui::tooltip(
        "The mesh answers at once. Elements around a node whose control volume was changed take "
        "its shape for their target, whatever targets the solver is set to. Solid angles stand in "
        "the triangles, weights of the paper's operator beside the points, negative ones in red; "
        "the ellipsoid in the star is the image of the unit sphere.");
  }

  void draw_figures(const VolumeNodalView& view) {
    const auto [low, high] = std::ranges::minmax(view.vcv.solid_angles);
    const double equal = 4 * pi / view.link.triangle_count();
    draw_figure("vcv/triangles", "Triangles",
                std::to_string(view.link.triangle_count()) + " of " + formatted(equal, "%.3f sr"),
                "Triangles of the link: what the elements around the node cut off a small sphere, "
                "and 4 pi over their number.");
    draw_figure("vcv/angles", "Solid angles",
                formatted(low, "%.3f") + " to " + formatted(high, "%.3f sr"),
                "Smallest and largest solid angle of the virtual control volume.");
    draw_figure("vcv/off_target", "Off target",
                view.edited ? "set by hand" : formatted(100 * view.largest_error, "%.2f %%"),
                "By how much a solid angle misses what it is to be, at most. Targets are those of "
                "the kind of VCVs that the solver is set to, over the mesh as the next run is "
                "given it; where they ask for nearly flat tetrahedra they give way to the shape.");
    draw_figure("vcv/singular", "Singular values",
                short_number(view.singular_values[0]) + "  " +
                    short_number(view.singular_values[1]) + "  " +
                    short_number(view.singular_values[2]),
                "Of the nodal Jacobian, which maps the control volume to the mesh: half axes of "
                "the ellipsoid.");
    draw_figure("vcv/kappa", "Kappa", short_number(view.kappa),
                "Ratio of the largest to the smallest of them: 1 where the map is conformal.");
    draw_figure("vcv/smallest", "Smallest weight", short_number(view.smallest_weight),
                "The smallest of the weights over their mean magnitude: 1 where all are equal.",
                view.smallest_weight < 0 ? palette().danger : palette().text);
    draw_figure("vcv/residual", "Residual", short_number(view.scaled_residual),
                "Distance to where the paper's operator would move this node alone, over the mean "
                "length of its edges.");
  }

  void draw_tables(const Theme& theme, const VolumeNodalView& view) {
    ui::tabs("vcv/figures",
             {{"Edges", "Lengths in the virtual control volume and in the mesh, and weights."},
              {"Faces",
               "Solid angles (steradians) of the triangles: of the virtual control volume, as they "
               "are to be, and in the mesh."}},
             table_);
    ImGui::PushFont(theme.small);
    const std::size_t rows = table_ == 0 ? view.neighbours.size() : view.targets.size();
    const float height = ImGui::GetTextLineHeightWithSpacing() *
                             static_cast<float>(std::min<std::size_t>(rows, 9) + 1) +
                         theme.px(4);
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_ScrollY;
    over_face_.reset();
    if (ImGui::BeginTable(table_ == 0 ? "edges" : "faces", table_ == 0 ? 5 : 4, flags,
                          ImVec2(0, height))) {
      if (table_ == 0)
        draw_edges(view);
      else
        draw_faces(view);
      ImGui::EndTable();
    }
    ImGui::PopFont();
  }

  void draw_edges(const VolumeNodalView& view) {
    table_head({"", "node", "VCV", "star", "weight"});
    for (std::size_t k = 0; k < view.neighbours.size(); ++k) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      if (ImGui::Selectable((std::to_string(k + 1) + "##row").c_str(), hovered_ == k || edge_ == k,
                            ImGuiSelectableFlags_SpanAllColumns)) {
        edge_ = k;
        typing_ = 0;
      }
      ui::note("vcv/row/" + std::to_string(k));
      if (ImGui::IsItemHovered()) hovered_ = k;
      cell(std::to_string(view.neighbours[k]));
      cell(short_number(view.vcv.lengths[k]));
      cell(short_number(view.physical.lengths[k]));
      cell(formatted(view.weights[k], "%.3f"), view.weights[k] < 0);
    }
  }

  void draw_faces(const VolumeNodalView& view) {
    table_head({"corners", "VCV", "target", "star"});
    for (std::size_t t = 0; t < view.targets.size(); ++t) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::Selectable((corners_of(view.link, t) + "##face").c_str(), false,
                        ImGuiSelectableFlags_SpanAllColumns);
      ui::note("vcv/face/" + std::to_string(t));
      if (ImGui::IsItemHovered()) over_face_ = t;
      cell(formatted(view.vcv.solid_angles[t], "%.3f"));
      cell(formatted(view.targets[t], "%.3f"));
      cell(formatted(view.physical.solid_angles[t], "%.3f"), view.physical.solid_angles[t] < 0);
    }
  }

  void draw_edge_fields(const PanelContext& context, const VolumeNodalView& view) {
    VcvEdit edit = numbers_of(view);
    const std::string which = std::to_string(edge_ + 1);
    ui::text_dim("Direction of " + which);
    ui::tooltip(
        "Where the edge points to, of any length. All others stay; no triangle may turn over.");
    if (typing_ == 0) {
      direction_ = edit.directions[edge_];
      length_ = edit.lengths[edge_];
    }
    ImGui::BeginGroup();
    bool entered = false;
    ui::space_vector_field({"vcv/direction", "Components along the axes of the mesh."}, direction_,
                           &entered);
    ui::row("Length of " + which, "Only ratios within one control volume act.");
    ui::number("vcv/length", length_, {}, "%.4g");
    const bool length_done = ImGui::IsItemDeactivatedAfterEdit();
    ImGui::EndGroup();
    // When the focus moves between fields, no field is active for a frame.
    typing_ = ImGui::IsItemActive() ? 3 : std::max(typing_ - 1, 0);
    if (entered || length_done) typing_ = 0;
    if (entered && direction_.allFinite() && direction_.norm() > 0) {
      edit.directions[edge_] = direction_;
      edit_vcv(context, std::move(edit));
    } else if (length_done) {
      edit_length(context, std::move(edit), edge_, length_);
    }
  }

  void draw_reset(const PanelContext& context, const VolumeNodalView& view) {
    std::vector<Index> edited;
    if (const auto stencils = context.session.mesh().sphere_vcvs())
      for (const auto& [node, stencil] : *stencils) edited.push_back(node);
    draw_resets(context, {view.node, {}, {}, {}}, view.edited, edited,
                {"Give this node its default control volume again.",
                 "Give all nodes their default control volumes again."});
  }

  void draw_spread(const PanelContext& context, const VolumeNodalView& view) {
    ui::row("Apply to",
            "Gives this control volume to other nodes whose link is the same graph: as many "
            "triangles, joined in the same way. It is turned so that edges which point the same "
            "way in the mesh have the same numbers.");
    ui::combo("vcv/spread", {"Pinned nodes", "Nodes within a radius", "All nodes"}, spread_to_);
    StarMatches::Wish wish{view.node};
    if (spread_to_ == 0) wish.among = context.session.nodes().pinned();
    if (spread_to_ == 1) {
      ui::row("Radius", "Units of the mesh.");
      if (radius_ == 0) radius_ = 3 * view.physical.mean_length();
      ui::number("vcv/radius", radius_, {}, "%.4g");
      wish.radius = radius_;
    }
    const StarMatches::Found* found = context.session.inspection().star_matches.find(wish);
    if (!found) {
      ui::button("vcv/apply", "Looking for nodes...",
                 {"Nodes with the same link are looked for.", ui::ButtonStyle::normal, false, -1});
      return;
    }
    const std::string tip = !found->empty()   ? "To the nodes with the same link."
                            : spread_to_ == 0 ? "Pin another node with the same link first."
                            : spread_to_ == 1
                                ? "No other node within this radius has the same link."
                                : "No other node of the mesh has the same link.";
    const std::string label =
        found->empty() ? "Apply to no node" : "Apply to " + counted(found->size(), "node");
    if (!ui::button("vcv/apply", label, {tip, ui::ButtonStyle::normal, !found->empty(), -1}))
      return;
    const VcvEdit own = numbers_of(view);
    context.emit(action::EditVcvs{spread_vcv({own.directions, own.lengths}, *found)});
  }

  SpherePlot plot_;
  bool large_ = false;
  int typed_node_ = 0;
  std::optional<Index> shown_;            // node of the state below
  std::optional<std::size_t> hovered_;    // neighbour
  std::optional<std::size_t> over_face_;  // triangle, in the table
  std::size_t edge_ = 0;                  // whose numbers are in the fields
  std::size_t table_ = 0;
  Vec3 direction_{0, 0, 1};  // as typed
  double length_ = 1;
  std::size_t spread_to_ = 0;  // which of the choices of "Apply to"
  double radius_ = 0;          // of the second choice; 0: not set yet
  int typing_ = 0;             // frames for which the fields keep what was typed
};

}  // namespace

DrawPanel sphere_panel() { return panel_of<SpherePanel>(); }

}  // namespace winslow::gui
