#include "gui/panels/panels.h"

#include "core/layers/layer_stack.h"
#include "core/strategy/layering.h"
#include "gui/base/text.h"
#include "gui/document/session/mesh_layers.h"
#include "gui/panels/layers/layer_forms.h"
#include "gui/panels/layers/layer_lists.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/plot_frame.h"
#include "gui/widgets/ui_layer.h"

namespace winslow::gui {

namespace {

/// True if the mesh on screen is the result of these options: a plan would insert the same layers
/// again.
bool just_inserted(const History& history, const LayerOptions& options) {
  if (history.position() == 0) return false;
  const auto* last = std::get_if<LayersCommand>(&history.command(history.position()));
  return last && last->task == LayerTask::insert && options_of(*last) == options;
}

/// Summary of the layers of the mesh.
struct LayerStatus {
  int count = 0;        ///< largest number at any wall
  std::string markers;  ///< markers with layers
  bool known = false;   ///< inserted or held here; otherwise from the file
  bool held = false;
};

LayerStatus status(const PanelContext& context) {
  LayerStatus status;
  const auto add = [&status](const std::string& marker, int count) {
    if (count == 0) return;
    status.count = std::max(status.count, count);
    status.markers += (status.markers.empty() ? "" : ", ") + marker;
  };
  if (const auto stack = context.session.mesh().layers()) {
    status.known = true;
    status.held = stack->held;
    for (const Marker& marker : context.topology()->markers())
      add(marker.name, layer_count(*stack, *context.topology(), {{marker.name}, {}}));
    return status;
  }
  for (const auto& [marker, count] : context.session.layers().found().at_markers())
    add(marker, count);
  return status;
}

/// The walls for the buttons of the card: the selected ones, or else all that have layers.
std::vector<std::string> walls_with_layers(const PanelContext& context) {
  std::vector<std::string> walls;
  const bool all = context.session.selection().empty();
  const auto& markers = context.topology()->markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const bool meant = all || context.session.selection().contains(static_cast<Index>(m));
    if (meant && may_have_layers(*context.topology(), {LayerWall{{markers[m].name}, {}}}))
      walls.push_back(markers[m].name);
  }
  return walls;
}

/// Layers at walls: their settings, their preview, and their resulting quality.
class LayersPanel {
 public:
  void draw(const PanelContext& context) {
    const auto hide = [&] {
      if (context.session.layers().preview().wanted()) context.emit(action::PreviewLayers{});
    };
    if (!ui::section("section/layers", "Layers")) return hide();
    if (!context.session.document()) return ui::text_dim("No mesh is open.");
    update(context);
    draw_status(context);
    if (!open_) return hide();
    if (names_.empty()) {
      ui::text_wrapped(
          walls_.walls().empty()
              ? "Select the markers that are walls first."
              : "Select a wall of the list to change its settings, or other markers to add them.");
      if (walls_.walls().empty()) return hide();
    }
    ImGui::BeginDisabled(context.session.in_motion());
    if (!names_.empty()) draw_settings(context);
    draw_walls(context);
    draw_insertion(context);
    draw_in_place(context);
    // Below the buttons, so that the buttons are visible without scrolling.
    draw_corners();
    columns_.draw(context, command(context, LayerTask::insert).layers.walls);
    if (!names_.empty()) ui::height_plot("layers/plot", {form_.heights(), {}}, context.theme);
    ImGui::EndDisabled();
  }

 private:
  /// Updates the panel after changes of the selection or the mesh.
  void update(const PanelContext& context) {
    if (generation_ != context.session.generation()) {
      walls_.clear();
      columns_.clear();
      shown_.clear();
      generation_ = context.session.generation();
      open_ = false;
    }
    // Unfold the settings for a requested field, and for a mesh without layers, where inserting is
    // the only operation.
    const bool wanted = UiLayer::current().keyboard_wanted().starts_with("layers/");
    const bool known = context.session.layers().found().looked_at(context.session.topology());
    if (wanted || (known && status(context).count == 0)) open_ = true;
    const std::vector<std::string> before = std::exchange(names_, {});
    for (const Index m : context.session.selection().markers())
      names_.push_back(context.topology()->markers()[static_cast<std::size_t>(m)].name);
    const LayerWall* wall = walls_.find(names_);
    if (wall && shown_ != names_) {
      form_.set(wall->spacing);
      part_.set(wall->part);
    }
    // A part belongs to its markers: for other markers begin with the whole wall.
    if (!wall && names_ != before) part_.set({});
    shown_ = wall ? names_ : std::vector<std::string>();
  }

  void draw_settings(const PanelContext& context) {
    if (!walls_.walls().empty()) {
      const std::string of = joined(names_);
      ui::text_dim(ui::elided(shown_.empty() ? of + ": not in the list yet" : "Settings of " + of,
                              ImGui::GetContentRegionAvail().x));
      ui::note("layers/settings_of");
      ui::tooltip(of);
    }
    form_.draw();
    part_.draw(context, names_);
    if (LayerWall* wall = walls_.find(names_)) {
      wall->spacing = form_.spacing();
      wall->part = part_.part();
    }
  }

  void draw_walls(const PanelContext& context) {
    if (!names_.empty() && shown_.empty()) {
      const std::string names = joined(names_);
      const float width = ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().FramePadding.x;
      if (ui::button("layers/add_wall", ui::elided("Add " + names + " as a wall", width),
                     {"Keep these settings for " + names +
                          ", then select other walls and give them others. Layers are inserted at "
                          "all walls of the list together.",
                      ui::ButtonStyle::normal, true, -1})) {
        walls_.add({names_, form_.spacing(), part_.part()});
        shown_ = names_;
      }
    }
    walls_.draw(context);
  }

  void draw_corners() {
    if (!ui::fold("layers/corners", "Corners and gaps",
                  "How layers go round corners and through gaps. The defaults need no touch."))
      return;
    ui::checkbox("layers/fans", "Fans at sharp corners", corners_.fans,
                 "Several columns at sharp convex corners, such as a trailing edge.");
    if (corners_.fans) {
      layer_field("layers/fan_threshold", "Fans from", corners_.fan_threshold,
                  "Turning of the wall from which a corner gets a fan, degrees.");
      layer_field("layers/fan_angle", "Fan angle", corners_.fan_angle,
                  "Between neighbouring columns of a fan, degrees.");
    }
    layer_field("layers/clearance", "Clearance", corners_.clearance,
                "Share of a gap's width that the layers of either side may take, below 0.5.");
    layer_field("layers/steepest", "Steepest", corners_.steepest,
                "Change of thickness along the wall, per length of wall.");
  }

  void draw_insertion(const PanelContext& context) {
    ui::checkbox("layers/control", "Hold the spacing", control_,
                 "Ask for the heights through the virtual control volumes, now and whenever a body "
                 "moves. Off: smoothing spreads the layers as it likes.");
    ui::checkbox("layers/preview", "Preview", preview_,
                 "Draw the planned columns and layers; columns cut short in another colour. After "
                 "an insertion, once a setting is changed.");
    const LayersCommand insertion = command(context, LayerTask::insert);
    const LayerOptions wanted = options_of(insertion);
    const bool shown = preview_ && !context.session.in_motion() &&
                       !just_inserted(context.session.document()->history(), wanted);
    const auto& planned = context.session.layers().preview().wanted();
    if (shown && planned != wanted) context.emit(action::PreviewLayers{wanted});
    if (!shown && planned) context.emit(action::PreviewLayers{});
    if (preview_) {
      // Reserve the height of a plan's text even without a plan, so that the buttons below do not
      // move.
      const float end =
          ImGui::GetCursorPosY() + 2 * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
      if (shown)
        draw_plan(context);
      else
        ui::text_dim(context.session.in_motion() ? "" : "These layers are in the mesh.");
      ImGui::SetCursorPosY(std::max(end, ImGui::GetCursorPosY()));
    }
    const bool ready =
        !context.session.in_motion() && context.session.layers().preview().error().empty();
    std::string at;
    for (const LayerWall& wall : wanted.walls)
      at += (at.empty() ? "" : "; ") + joined(wall.markers);
    const std::string label = walls_.walls().empty() ? "Insert layers" : "Insert layers at " + at;
    const float width = ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().FramePadding.x;
    if (ui::button("layers/insert", ui::elided(label, width),
                   {"Insert layers at " + at + ", make room for them and smooth.",
                    ui::ButtonStyle::primary, ready, -1}))
      context.emit(action::RunCommand{insertion, false});
  }

  void draw_plan(const PanelContext& context) {
    const LayerPreview& preview = context.session.layers().preview();
    if (const std::string error = preview.error(); !error.empty()) {
      ui::text_wrapped("Cannot be done: " + error);
      return ui::note("layers/cannot");
    }
    const LayerStack* plan = preview.plan();
    if (!plan) return ui::text_dim("Planning ...");
    double thickest = 0;
    std::size_t cut = 0;
    for (const LayerColumn& column : plan->columns) {
      thickest = std::max(thickest, column.thickness());
      cut += cut_short(column) ? 1 : 0;
    }
    ui::text_wrapped(counted(plan->columns.size(), "column") + ", " + std::to_string(cut) +
                     " cut short, up to " + short_number(thickest) + " thick");
    ui::note("layers/summary");
  }

  /// Draws a card with the existing layers and the operations on them.
  void draw_status(const PanelContext& context) {
    const LayerStatus found = status(context);
    if (found.count == 0) {
      // One line in either case, so that the items below do not move.
      return ui::text_dim(context.session.layers().found().busy() ? "Looking for layers ..."
                                                                  : "The mesh has no layers.");
    }
    const Theme& theme = context.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float pad = theme.px(8);
    list.ChannelsSplit(2);
    list.ChannelsSetCurrent(1);
    ImGui::SetCursorScreenPos(ImVec2(start.x + pad, start.y + pad));
    ImGui::BeginGroup();
    ui::text_in(theme.bold, (counted(found.count, "layer") + (found.held    ? " held"
                                                              : found.known ? ""
                                                                            : " found")));
    ui::note("layers/status");
    ui::tooltip(found.known ? "Layers that were inserted or held here."
                            : "Layers that came with the file: quadrilaterals on the walls, "
                              "counted from the wall up.");
    ui::text_dim(ui::elided("at " + found.markers, width - 2 * pad));
    ui::tooltip(found.markers);
    draw_choices(context);
    ImGui::EndGroup();
    const ImVec2 end(start.x + width, ImGui::GetItemRectMax().y + pad);
    list.ChannelsSetCurrent(0);
    list.AddRectFilled(start, end, palette().card, theme.px(6));
    list.AddRect(start, end, palette().border, theme.px(6));
    list.ChannelsMerge();
    ImGui::SetCursorScreenPos(ImVec2(start.x, end.y + pad));
    result_.draw(context);
  }

  void draw_choices(const PanelContext& context) {
    LayersCommand hold;
    hold.task = LayerTask::hold;
    hold.control = true;
    hold.smooth = context.session.solver_settings().smooth_options();
    const std::vector<std::string> walls = walls_with_layers(context);
    hold.layers.walls = {{walls, {}}};
    const bool held = !walls.empty() && context.session.layers().all_held(hold.layers.walls);
    const bool free = !context.session.in_motion() && !walls.empty();
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float pad = context.theme.px(8);
    const float width = (ImGui::GetContentRegionAvail().x - pad - 2 * gap) / 3;
    const std::string at = walls.empty() ? "" : " at " + joined(walls);
    if (ui::button(
            "layers/hold", held ? "Kept" : "Keep",
            {held ? "The layers" + at + " are held already: whatever moves, their heights are kept."
                  : "Hold the layers" + at +
                        ": whatever moves from here on, their heights are kept. Layers of a mesh "
                        "read from a file are found from the wall up.",
             ui::ButtonStyle::normal, free && !held, width})) {
      context.session.layers().limit_to_present(hold);
      context.emit(action::RunCommand{hold, false});
    }
    ImGui::SameLine(0, gap);
    if (ui::button("layers/open_respace", "Respace",
                   {"Give these layers other heights: opens the settings.", ui::ButtonStyle::normal,
                    free, width}))
      open_ = true;
    ImGui::SameLine(0, gap);
    if (ui::button("layers/open_insert", open_ ? "Fold" : "Insert",
                   {open_ ? "Fold the settings away."
                          : "Insert layers at walls that have none: opens the settings.",
                    ui::ButtonStyle::normal, true, width}))
      open_ = !open_;
  }

  /// Draws a button for existing layers of the walls, if they can have some.
  void draw_in_place(const PanelContext& context) {
    const LayersCommand present = command(context, LayerTask::hold);
    if (!may_have_layers(*context.topology(), present.layers.walls)) return;
    ui::text_dim("Existing layers");
    const bool free = !context.session.in_motion();
    const bool matches = std::ranges::any_of(
        present.layers.walls, [](const LayerWall& wall) { return wall.spacing.match_outside; });
    const std::string tip =
        matches ? "Layers that are there cannot match the elements outside by their number: switch "
                  "\"Match the elements outside\" off."
                : "Give the layers that are there these heights. Their number stays; in a mesh "
                  "read from a file, at most as many as \"Layers\" says are found.";
    if (ui::button("layers/respace", "Respace",
                   {tip, ui::ButtonStyle::normal, free && !matches, -1}))
      context.emit(action::RunCommand{in_place(context, LayerTask::respace), false});
  }

  LayersCommand command(const PanelContext& context, LayerTask task) const {
    LayersCommand command;
    command.task = task;
    command.layers = corners_;
    command.layers.walls = walls_.walls();
    if (command.layers.walls.empty())
      command.layers.walls = {{names_, form_.spacing(), part_.part()}};
    if (task == LayerTask::insert)  // the columns of existing layers are fixed
      command.layers.overrides = columns_.on(*context.topology(), command.layers.walls);
    command.control = control_;
    command.smooth = context.session.solver_settings().smooth_options();
    return command;
  }

  LayersCommand in_place(const PanelContext& context, LayerTask task) const {
    LayersCommand taken = command(context, task);
    context.session.layers().limit_to_present(taken);
    return taken;
  }

  SpacingForm form_;
  PartForm part_;
  WallList walls_;
  ColumnList columns_;
  LayerResult result_;
  LayerOptions corners_;
  bool control_ = true, preview_ = true;
  bool open_ = false;               // the settings are unfolded
  std::uint64_t generation_ = 0;    // of the mesh of the walls
  std::vector<std::string> names_;  // markers selected
  std::vector<std::string> shown_;  // markers of the wall shown in the form; empty: none
};

}  // namespace

DrawPanel layers_panel() { return panel_of<LayersPanel>(); }

}  // namespace winslow::gui
