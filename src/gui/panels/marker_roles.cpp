#include "gui/panels/marker_roles.h"

#include <imgui.h>

#include "gui/document/jobs/run_settings.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

enum class Role { fixed, slides, periodic, listed, moves, gives_way };
constexpr std::array words{"fixed", "slides", "periodic", "listed", "moves", "gives way"};

bool is_listed(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// What nodes do if the selection moves; null: not known yet, or nothing is selected.
std::shared_ptr<const NodeRoles> roles_of_selection(const PanelContext& context) {
  if (context.session.selection().markers().empty()) return nullptr;
  return context.session.inspection().roles.find();
}

Role role_of(const PanelContext& context, Index marker, const std::string& name) {
  if (context.session.selection().contains(marker)) return Role::moves;
  if (context.session.selection().plan().contains(name)) return Role::listed;
  const SlideOptions& slide = context.session.solver_settings().smooth_options().slide;
  if (partner_of(slide, context.session.solver_settings().file_pairs(), name))
    return Role::periodic;
  if (is_listed(slide.markers, name)) return Role::slides;
  if (is_listed(slide.fixed, name)) return Role::fixed;
  const auto roles = roles_of_selection(context);
  return roles && is_listed(roles->give_way, name) ? Role::gives_way : Role::fixed;
}

void edit_slide(const PanelContext& context, const SlideOptions& slide) {
  SmoothOptions after = context.session.solver_settings().smooth_options();
  after.slide = slide;
  context.edit(after);
}

void toggle_sliding(const PanelContext& context, Role role, const std::string& name) {
  SlideOptions slide = context.session.solver_settings().smooth_options().slide;
  if (role == Role::gives_way)
    slide.fixed.push_back(name);
  else if (!stop_sliding(slide, name) && std::erase(slide.fixed, name) == 0)
    slide.markers.push_back(name);
  edit_slide(context, slide);
}

/// Merges equal lines: "plane", found ten times, becomes "plane (10)".
std::vector<std::string> told_once(const std::vector<std::string>& lines) {
  std::vector<std::string> out;
  std::vector<std::size_t> times;
  for (const std::string& line : lines) {
    const auto before = std::ranges::find(out, line);
    if (before != out.end()) {
      ++times[static_cast<std::size_t>(before - out.begin())];
      continue;
    }
    out.push_back(line);
    times.push_back(1);
  }
  for (std::size_t k = 0; k < out.size(); ++k)
    if (times[k] > 1) out[k] += " (" + std::to_string(times[k]) + ")";
  return out;
}

std::string tip_of(const PanelContext& context, Role role, const std::string& name) {
  const SolverSettings& settings = context.session.solver_settings();
  switch (role) {
    case Role::moves:
      return name + " is selected: it moves.";
    case Role::listed:
      return name + " is in the list of bodies that move together.";
    case Role::slides:
      return name +
             " slides: while the mesh is smoothed its nodes move along the boundary, which keeps "
             "its "
             "shape; corners stay. Click: all of it stays. Right click: periodic with another.";
    case Role::periodic:
      return name + " is periodic with " +
             partner_of(settings.smooth_options().slide, settings.file_pairs(), name).value_or("") +
             ": their nodes move together and keep matching. Click to choose another marker, or "
             "none.";
    case Role::gives_way:
      return name +
             " gives way: what is selected stands on it, so its nodes slide while that moves. "
             "Click: all of it stays.";
    case Role::fixed:
      break;
  }
  if (is_listed(settings.smooth_options().slide.fixed, name))
    return name +
           " stays, also where a moving body stands on it. Click: it gives way there. Right "
           "click: periodic with another marker.";
  if (const auto roles = roles_of_selection(context); roles && is_listed(roles->in_the_way, name))
    return name +
           " stays where it is, and what is selected stands on it. It is no straight line, circle, "
           "plane, cylinder or sphere there, so it cannot give way. Select it as well to move it.";
  return name +
         " stays where it is. Click: its nodes slide along the boundary while the mesh is "
         "smoothed, "
         "as those of a far field may. Right click: periodic with another marker.";
}

void draw_pill(const Theme& theme, Role role, bool over, const ImVec2& min, const ImVec2& max) {
  const float pad = theme.px(6);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (role != Role::fixed)
    list.AddRectFilled(ImVec2(min.x, min.y + pad / 2), ImVec2(max.x, max.y - pad / 2),
                       role == Role::moves ? palette().accent : palette().accent_soft, theme.px(4));
  const char* text = words[static_cast<std::size_t>(role)];
  const float width = ImGui::CalcTextSize(text).x;
  const ImU32 ink = role == Role::moves   ? palette().on_accent
                    : over                ? palette().accent
                    : role == Role::fixed ? palette().text_faint
                                          : palette().text;
  list.AddText(ImVec2((min.x + max.x - width) / 2, min.y + pad), ink, text);
}

}  // namespace

float role_width(const Theme& theme) {
  return ImGui::CalcTextSize("gives way").x + 2 * theme.px(6);
}

void draw_role(const PanelContext& context, Index marker, const ImVec2& min, const ImVec2& max) {
  const std::string& name = context.topology()->markers()[static_cast<std::size_t>(marker)].name;
  const Role role = role_of(context, marker, name);
  ImGui::SetCursorScreenPos(min);
  const std::string id = "marker_role/" + name;
  const bool pressed = ImGui::InvisibleButton(id.c_str(), ImVec2(max.x - min.x, max.y - min.y));
  ui::note(id);
  const bool toggles = role != Role::moves && role != Role::listed;
  const bool over = ImGui::IsItemHovered() && toggles;
  ui::tooltip(tip_of(context, role, name));
  // Open the same menu as a right click on the rest of the row.
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right) || (role == Role::periodic && pressed))
    context.emit(action::ShowContextMenu{PickedPlace{{}, {marker}, {}, {}}});
  else if (pressed && toggles)
    toggle_sliding(context, role, name);
  draw_pill(context.theme, role, over, min, max);
}

ReferenceAsk reference_row(const Theme& theme, const std::string& id, const std::string& name,
                           const std::filesystem::path& reading) {
  std::string tip =
      "The surface that nodes slide on: that of the mesh as it is, or that of a file, from CAD or "
      "a scan, onto which they are put first. It must be in the unit of the mesh and lie where the "
      "mesh is, and be at least as fine: between its nodes its shape is a guess. Click to choose a "
      "file.";
  if (!name.empty()) tip = name + "\n" + tip;
  ui::row("Reference surface", tip);
  const std::string given = std::filesystem::path(name).filename().string();
  const std::string label = !reading.empty() ? "Reading " + reading.filename().string() + " ..."
                            : name.empty()   ? "The mesh's own"
                                             : given;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const bool clears = !name.empty() || !reading.empty();
  const float side = clears ? ImGui::GetFrameHeight() + gap : 0;
  const float room = std::max(ImGui::GetContentRegionAvail().x - side, theme.px(40));
  const float within = room - 2 * ImGui::GetStyle().FramePadding.x;
  if (ui::button(id, ui::elided(label, within), {.tooltip = tip, .width = room}))
    return ReferenceAsk::choose;
  if (!clears) return ReferenceAsk::nothing;
  ImGui::SameLine(0, gap);
  const bool clear = ui::button(id + "_none", "x",
                                {.tooltip = "Nodes slide on the mesh's own surface again.",
                                 .width = ImGui::GetFrameHeight()});
  return clear ? ReferenceAsk::clear : ReferenceAsk::nothing;
}

namespace {

void draw_reference(const PanelContext& context) {
  const SolverSettings& solver = context.session.solver_settings();
  switch (reference_row(context.theme, "markers/reference", solver.smooth_options().slide.reference,
                        solver.reading_reference())) {
    case ReferenceAsk::choose:
      return context.emit(action::ShowFileDialog{FilePurpose::reference});
    case ReferenceAsk::clear:
      return context.emit(action::ChooseReference{});
    case ReferenceAsk::nothing:
      break;
  }
}

/// Draws the spacing option, for nodes that slide along curves of the mesh (in space: along its
/// edges).
void draw_spacing(const PanelContext& context, SlideOptions slide) {
  const bool along_curves = context.session.kind() == MeshKind::plane || slide.features;
  if (!along_curves || !slide.reference.empty()) return;
  const char* tip =
      "Whether nodes keep their relative spacing along the curves that they slide on, as clusters "
      "at leading edges and walls need it: a closed curve then turns as a whole, other stretches "
      "follow their ends.\n"
      "Auto: held for walls, that is markers around a body and those with flat elements, and free "
      "for far fields.\n"
      "Held: of all sliding markers.\n"
      "Free: nodes go where the mesh draws them.";
  if (ui::choice("markers/spacing", "Spacing", {"Auto", "Held", "Free"}, slide.spacing, tip))
    edit_slide(context, slide);
}

void show_preview(const PanelContext& context, bool& previewed, bool on) {
  if (on != previewed) context.emit(action::PreviewRoles{on});
  previewed = on;
}

void draw_angle(const PanelContext& context, SlideOptions slide, bool& previewed) {
  const MeshKind kind = context.session.kind();
  const bool surface = kind == MeshKind::surface;
  const char* tip =
      surface
          ? "Edges at which the surface turns by more than this are feature lines: their nodes "
            "stay, or slide along them. They are drawn thick in the picture."
          : "Where a sliding marker turns by more than this is a corner or an edge, whose nodes "
            "stay. While it is edited, these are drawn.";
  ui::row("Feature angle", tip);
  if (ui::number("markers/feature_angle", slide.feature_angle, tip, "%.6g\xC2\xB0") &&
      slide.feature_angle >= 0 && slide.feature_angle <= 180)
    edit_slide(context, slide);
  // For a surface mesh feature lines are always drawn.
  const bool editing = !surface && ImGui::IsItemActive();
  if (kind != MeshKind::plane &&
      ui::checkbox("markers/features", surface ? "Slide along feature lines" : "Slide along edges",
                   slide.features,
                   surface ? "Nodes of feature lines and of the border slide along the curve "
                             "through them; off: they stay."
                           : "Nodes slide along the edges in which sliding surfaces meet; off: "
                             "they stay."))
    edit_slide(context, slide);
  if (kind != MeshKind::plane) draw_reference(context);
  if (!surface) draw_spacing(context, slide);
  show_preview(context, previewed, editing);
}

void draw_file_pairs(const PanelContext& context, SlideOptions slide) {
  const GivenPeriodicity* found = context.session.solver_settings().file_pairs();
  if (!found || found->pairs.empty()) return;
  std::string tip =
      "The file of the mesh names periodic sides: while the mesh is smoothed their "
      "nodes move together.";
  for (const GivenPairs& given : found->pairs)
    if (!given.halo)
      tip += "\n" + given.first + " and " + given.second +
             (given.fault.empty() ? "" : ", which cannot be used: " + given.fault);
  if (ui::checkbox("markers/file_pairs", "Periodic pairs of the file", slide.periodic_from_file,
                   tip))
    edit_slide(context, slide);
}

/// For a mesh of several regions: what the nodes do in which these meet.
void draw_interfaces(const PanelContext& context, SlideOptions slide) {
  const char* tip =
      "What nodes do in which regions of the mesh meet: its physical groups or references.\n"
      "Auto: they stay while the mesh is smoothed, and are free in a motion.\n"
      "Held: they stay.\n"
      "Slide: along the curve or the surface that the mesh has there; corners stay.\n"
      "Free: they move as any other node.";
  if (ui::choice("markers/interfaces", "Where regions meet", {"Auto", "Held", "Slide", "Free"},
                 slide.interfaces, tip))
    edit_slide(context, slide);
}

void draw_found(const PanelContext& context) {
  const auto roles = context.session.inspection().roles.find();
  if (roles && !roles->fault.empty()) {
    ui::text_wrapped(roles->fault, palette().danger);
    ui::note("markers/fault");
  }
  bool shown = context.view.roles;
  std::string tip = "Nodes in colours by what they do while the mesh is smoothed.";
  constexpr std::size_t most = 12;
  const std::vector<std::string> lines =
      roles ? told_once(roles->found) : std::vector<std::string>{};
  for (std::size_t k = 0; k < lines.size() && k < most; ++k) tip += "\n" + lines[k];
  if (lines.size() > most) tip += "\nand " + std::to_string(lines.size() - most) + " more";
  if (ui::checkbox("markers/roles", "Show what nodes do", shown, tip))
    context.edit_view([&](ViewOptions& view) { view.roles = shown; });
}

}  // namespace

void draw_role_settings(const PanelContext& context, bool& previewed) {
  const SlideOptions& slide = context.session.solver_settings().smooth_options().slide;
  const bool surface = context.session.kind() == MeshKind::surface;
  if (!surface) draw_file_pairs(context, slide);
  if (surface || !slide.markers.empty())
    draw_angle(context, slide, previewed);
  else
    show_preview(context, previewed, false);
  const bool regions_meet = !context.topology()->interfaces().empty();
  if (regions_meet) draw_interfaces(context, slide);
  const auto roles = roles_of_selection(context);
  const bool stands = roles && !(roles->give_way.empty() && roles->in_the_way.empty());
  if (surface || regions_meet || slide.given() || stands) draw_found(context);
}

}  // namespace winslow::gui
