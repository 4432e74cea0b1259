#include "gui/panels/layers/layers_panel.h"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "core/layers/layer_measures.h"
#include "core/strategy/layering.h"
#include "gui/base/text.h"
#include "gui/panels/layers/fields.h"
#include "gui/panels/layers/layers_in_place.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/height_plot.h"

namespace winslow::gui {

namespace {

/// The mesh on screen is what these options have made: a plan would be for the same once more.
bool just_inserted(const Session& session, const LayerOptions& options) {
  const History& history = session.document()->history();
  if (history.position() == 0) return false;
  const auto* last = std::get_if<LayersCommand>(&history.command(history.position()));
  return last && last->task == LayerTask::insert && options_of(*last) == options;
}

}  // namespace

void LayersPanel::draw(const PanelContext& context) {
  const auto hide = [&] {
    if (context.session.jobs().layer_preview().wanted()) context.emit(action::PreviewLayers{});
  };
  if (!ui::section("section/layers", "Layers")) return hide();
  if (!context.session.document()) {
    ui::text_dim("No mesh is open.");
    return;
  }
  follow(context);
  result_.draw(context);
  if (names_.empty()) {
    ui::text_wrapped(walls_.walls().empty()
                         ? "Select the markers that are walls first."
                         : "Select a wall of the list to change its settings, or other markers "
                           "to add them.");
    if (walls_.walls().empty()) return hide();
  }
  ImGui::BeginDisabled(context.session.in_motion());
  if (!names_.empty()) draw_settings(context);
  draw_walls(context);
  draw_insertion(context);
  draw_in_place(context);
  // Below the buttons, so that these need no scrolling.
  draw_corners();
  columns_.draw(context, command(context, LayerTask::insert).layers.walls);
  if (!names_.empty()) ui::height_plot("layers/plot", {form_.heights(), {}}, context.theme);
  ImGui::EndDisabled();
}

/// The selection may have changed, and the mesh.
void LayersPanel::follow(const PanelContext& context) {
  if (generation_ != context.session.generation()) {
    walls_.clear();
    columns_.clear();
    shown_.clear();
    generation_ = context.session.generation();
  }
  const std::vector<std::string> before = std::exchange(names_, {});
  for (const Index m : context.session.selection().markers())
    names_.push_back(context.topology()->markers()[static_cast<std::size_t>(m)].name);
  const LayerWall* wall = walls_.find(names_);
  if (wall && shown_ != names_) {
    form_.set(wall->spacing);
    part_.set(wall->part);
  }
  // A part is of its markers: others begin as a whole.
  if (!wall && names_ != before) part_.set({});
  shown_ = wall ? names_ : std::vector<std::string>();
}

void LayersPanel::draw_settings(const PanelContext& context) {
  if (!walls_.walls().empty()) {
    const std::string of = marker_list(names_);
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

void LayersPanel::draw_walls(const PanelContext& context) {
  if (!names_.empty() && shown_.empty()) {
    const std::string names = marker_list(names_);
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

void LayersPanel::draw_corners() {
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

LayersCommand LayersPanel::command(const PanelContext& context, LayerTask task) const {
  LayersCommand command;
  command.task = task;
  command.layers = corners_;
  command.layers.walls = walls_.walls();
  if (command.layers.walls.empty())
    command.layers.walls = {{names_, form_.spacing(), part_.part()}};
  if (task == LayerTask::insert)  // layers that are there have the columns that they have
    command.layers.overrides = columns_.on(*context.topology(), command.layers.walls);
  command.control = control_;
  command.smooth = context.session.jobs().smooth_options();
  return command;
}

void LayersPanel::draw_insertion(const PanelContext& context) {
  ui::checkbox("layers/control", "Hold the spacing", control_,
               "Ask for the heights through the virtual control volumes, now and whenever a body "
               "moves. Off: smoothing spreads the layers as it likes.");
  ui::checkbox("layers/preview", "Show where they will stand", preview_,
               "Draw the planned columns and layers; columns cut short in another colour. After an "
               "insertion, once a setting is changed.");
  const LayersCommand insertion = command(context, LayerTask::insert);
  const LayerOptions wanted = options_of(insertion);
  const bool shown =
      preview_ && !context.session.in_motion() && !just_inserted(context.session, wanted);
  const auto& planned = context.session.jobs().layer_preview().wanted();
  if (shown && planned != wanted) context.emit(action::PreviewLayers{wanted});
  if (!shown && planned) context.emit(action::PreviewLayers{});
  if (shown) draw_plan(context);
  const bool ready =
      !context.session.in_motion() && context.session.jobs().layer_preview().error().empty();
  std::string at;
  for (const LayerWall& wall : wanted.walls)
    at += (at.empty() ? "" : "; ") + marker_list(wall.markers);
  const std::string label = walls_.walls().empty() ? "Insert layers" : "Insert layers at " + at;
  const float width = ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().FramePadding.x;
  if (ui::button("layers/insert", ui::elided(label, width),
                 {"Insert layers at " + at + ", make room for them and smooth.",
                  ui::ButtonStyle::primary, ready, -1}))
    context.emit(action::RunCommand{insertion, false});
}

void LayersPanel::draw_plan(const PanelContext& context) {
  const LayerPreview& preview = context.session.jobs().layer_preview();
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

LayersCommand LayersPanel::in_place(const PanelContext& context, LayerTask task) const {
  LayersCommand taken = command(context, task);
  limit_to_present_layers(context.session, taken);
  return taken;
}

/// Buttons for the layers that the walls have, where they may have some.
void LayersPanel::draw_in_place(const PanelContext& context) {
  const LayersCommand present = command(context, LayerTask::hold);
  if (!may_have_layers(*context.topology(), present.layers.walls)) return;
  ui::text_dim("Layers that these walls have");
  const bool free = !context.session.in_motion();
  const bool matches = std::ranges::any_of(
      present.layers.walls, [](const LayerWall& wall) { return wall.spacing.match_outside; });
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  const std::string respace_tip =
      matches ? "Layers that are there cannot match the elements outside by their number: switch "
                "\"Match the elements outside\" off."
              : "Give the layers that are there these heights. Their number stays; in a mesh read "
                "from a file, at most as many as \"Layers\" says are found.";
  if (ui::button("layers/respace", "Respace",
                 {respace_tip, ui::ButtonStyle::normal, free && !matches, width}))
    context.emit(action::RunCommand{in_place(context, LayerTask::respace), false});
  ImGui::SameLine();
  const bool held = all_held(context.session, present.layers.walls);
  const std::string hold_tip =
      held ? "These layers are held already: whatever moves, their heights are kept."
           : "Keep the heights that the layers have, whatever moves from here on. Layers of a mesh "
             "read from a file are found from the wall up, quadrilateral by quadrilateral.";
  if (ui::button("layers/hold", held ? "Held" : "Hold",
                 {hold_tip, ui::ButtonStyle::normal, free && !held, width}))
    context.emit(action::RunCommand{in_place(context, LayerTask::hold), false});
}

}  // namespace winslow::gui
