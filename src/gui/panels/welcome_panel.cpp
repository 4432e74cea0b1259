#include "gui/panels/welcome_panel.h"

#include "gui/base/text.h"
#include "gui/demos/demo_player.h"
#include "gui/menu/user_command.h"
#include "gui/panels/panels.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr std::size_t most_recent = 6;
constexpr float lowest_demo = 31, highest_demo = 44;  // of a row with its picture
// Rows of text are as wide as four cards.
constexpr float row_gap = 16, row_width = (WelcomePanel::page_width - row_gap) / 2;

/// Rows of text are in two columns if there is room.
struct Columns {
  std::size_t count;
  float width, gap;  // pixels
};

Columns columns_of(const PanelContext& context) {
  const float room = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
  const float gap = context.theme.px(row_gap);
  if (room < context.theme.px(640)) return {1, room, gap};
  return {2, std::min((room - gap) / 2, context.theme.px(row_width)), gap};
}

void heading(const PanelContext& context, const char* text) {
  ImGui::Dummy(ImVec2(0, context.theme.px(10)));
  ui::text_in(context.theme.bold, text);
}

/// Text in a rectangle of a draw list.
void put(ImDrawList& list, ImFont* font, const ImVec2& at, ImU32 color, const std::string& text) {
  list.AddText(font, font->FontSize, at, color, text.c_str());
}

void draw_head(const PanelContext& context) {
  ui::text_in(context.theme.title, "Open a mesh");
  ui::text_wrapped("Drop a file here, choose one, or begin with one of those below.");
  ImGui::Spacing();
  if (ui::button("welcome/open", "Open mesh...",
                 {tooltip_of(user_command("open")), ui::ButtonStyle::primary, true,
                  context.theme.px(150)}))
    context.emit(action::ShowFileDialog{FilePurpose::open_mesh});
  ImGui::SameLine();
  if (context.session.document()) {
    if (ui::button("welcome/back", "Back to the mesh", {"Leave this page."}))
      context.emit(action::ShowWelcome{});
    ImGui::SameLine();
  }
  ImGui::AlignTextToFramePadding();
  ui::text_colored(palette().text_faint, "SU2, Gmsh MSH, CGNS, VTK, VTU, OBJ, OFF, PLY, STL");
}

bool draw_file(const PanelContext& context, const RecentFiles::File& file, float width) {
  const Theme& theme = context.theme;
  const std::string name = file.path.filename().string();
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 size(width, theme.px(24));
  ImGui::BeginDisabled(file.missing);
  const bool pressed = ImGui::InvisibleButton(("recent/" + file.path.string()).c_str(), size);
  ui::note("welcome/recent/" + name);
  ImGui::EndDisabled();
  const bool over = ImGui::IsItemHovered();
  ui::tooltip(file.path.string() + (file.missing ? "\nThe file is not there any more." : ""));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (over)
    list.AddRectFilled(min, ImVec2(min.x + size.x, min.y + size.y), palette().accent_soft,
                       theme.px(5));
  ImFont* const font = theme.regular;
  const float y = min.y + (size.y - font->FontSize) / 2;
  const float room = width - theme.px(8);
  const std::string title = ui::elided(name, room);
  put(list, font, ImVec2(min.x + theme.px(4), y),
      file.missing ? palette().text_faint : palette().accent, title);
  const float used = font->CalcTextSizeA(font->FontSize, 1e6f, 0, title.c_str()).x + theme.px(12);
  if (room - used > theme.px(30))
    put(list, font, ImVec2(min.x + theme.px(4) + used, y), palette().text_faint,
        ui::elided(file.path.parent_path().string(), room - used));
  return pressed;
}

void draw_recent(const PanelContext& context) {
  heading(context, "Recent");
  const Columns columns = columns_of(context);
  std::size_t shown = 0;
  for (const RecentFiles::File& file : context.recent.files()) {
    if (shown == most_recent) break;
    if (shown++ % columns.count != 0) ImGui::SameLine(0, columns.gap);
    if (draw_file(context, file, columns.width)) context.emit(action::OpenMesh{file.path});
  }
}

}  // namespace

void WelcomePanel::draw(const PanelContext& context) {
  if (context.session.files().loading()) {
    ui::text_in(context.theme.title, "Reading the mesh ...");
    ui::text_dim(context.session.files().loading_path().filename().string());
    return;
  }
  thumbnails_.update(static_cast<double>(ImGui::GetIO().DeltaTime));
  draw_head(context);
  if (!context.recent.files().empty()) draw_recent(context);
  if (assets_folder().empty()) return;
  draw_bundled(context);
  draw_demos(context);
}

void WelcomePanel::draw_bundled(const PanelContext& context) {
  heading(context, "Bundled meshes");
  const float gap = context.theme.px(card_gap);
  const float room = ImGui::GetContentRegionAvail().x;
  const std::size_t all = bundled_meshes().size();
  const std::size_t columns = room > context.theme.px(640) ? all : (all + 1) / 2;
  const auto n = static_cast<float>(columns);
  const float width = std::min((std::min(room, context.theme.px(page_width)) - (n - 1) * gap) / n,
                               context.theme.px(card_width));
  std::size_t k = 0;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(gap, gap));
  for (const BundledMesh& mesh : bundled_meshes()) {
    if (k++ % columns != 0) ImGui::SameLine();
    if (draw_card(context, mesh, width, 0.625f * width + context.theme.px(30)))
      context.emit(action::OpenMesh{bundled_path(assets_folder(), mesh.file)});
  }
  ImGui::PopStyleVar();
}

bool WelcomePanel::draw_card(const PanelContext& context, const BundledMesh& mesh, float width,
                             float height) {
  const Theme& theme = context.theme;
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 max(min.x + width, min.y + height);
  const bool pressed = ImGui::InvisibleButton(mesh.id.c_str(), ImVec2(width, height));
  ui::note("welcome/" + mesh.id);
  const bool over = ImGui::IsItemHovered();
  ui::tooltip(mesh.about);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float round = theme.px(6);
  list.AddRectFilled(min, max, palette().panel, round);
  const ImVec2 foot(max.x, max.y - theme.px(30));
  if (const Texture* picture = thumbnails_.find(mesh.id))
    list.AddImageRounded(picture->id(), min, foot, ImVec2(0, 0), ImVec2(1, 1), IM_COL32_WHITE,
                         round, ImDrawFlags_RoundCornersTop);
  list.AddRect(min, max, over ? palette().accent : palette().border, round, 0,
               over ? theme.px(2) : theme.px(1));
  put(list, theme.regular,
      ImVec2(min.x + theme.px(10), foot.y + (theme.px(30) - theme.regular->FontSize) / 2),
      palette().text, ui::elided(mesh.title, width - theme.px(20)));
  return pressed;
}

void WelcomePanel::draw_demos(const PanelContext& context) {
  heading(context, "Guided demos: the cases of the paper, and three in space");
  const Columns columns = columns_of(context);
  // The largest height that needs no scrolling in a small window.
  const std::size_t full_rows = (demos().size() + columns.count - 1) / columns.count;
  const auto rows = static_cast<float>(full_rows);
  const float room = (ImGui::GetContentRegionAvail().y + ImGui::GetStyle().ItemSpacing.y) / rows -
                     ImGui::GetStyle().ItemSpacing.y;
  const float height =
      std::clamp(room, context.theme.px(lowest_demo), context.theme.px(highest_demo));
  std::size_t k = 0;
  for (const Demo& demo : demos()) {
    if (k++ % columns.count != 0) ImGui::SameLine(0, columns.gap);
    if (draw_demo(context, demo, columns.width, height)) context.emit(action::StartDemo{demo.id});
  }
}

bool WelcomePanel::draw_demo(const PanelContext& context, const Demo& demo, float width,
                             float height) {
  const Theme& theme = context.theme;
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 size(width, height);
  const bool pressed = ImGui::InvisibleButton(("demo" + demo.id).c_str(), size);
  ui::note("welcome/demo/" + demo.id);
  ui::tooltip("Play this case step by step on " + demo.mesh + ".");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 max(min.x + size.x, min.y + size.y);
  const bool over = ImGui::IsItemHovered();
  const float round = theme.px(5);
  if (over) list.AddRectFilled(min, max, palette().accent_soft, round);
  // Width from the height and the aspect ratio of the pictures.
  const ImVec2 foot(min.x + 1.6f * size.y, max.y);
  list.AddRectFilled(min, foot, palette().panel, round);
  if (const Texture* picture = thumbnails_.find("demo/" + demo.id)) {
    list.AddImageRounded(picture->id(), min, foot, ImVec2(0, 0), ImVec2(1, 1), IM_COL32_WHITE,
                         round);
    ui::note("welcome/demo_picture/" + demo.id, min, foot);
  }
  list.AddRect(min, foot, over ? palette().accent : palette().border, round);
  const float middle = (min.y + max.y) / 2;
  const ImVec2 badge(foot.x + theme.px(20), middle);
  list.AddCircleFilled(badge, theme.px(10), palette().accent);
  const ImVec2 letter = theme.bold->CalcTextSizeA(theme.bold->FontSize, 1e6f, 0, demo.id.c_str());
  put(list, theme.bold, ImVec2(badge.x - letter.x / 2, middle - letter.y / 2), palette().card,
      demo.id);
  const float left = badge.x + theme.px(18);
  put(list, theme.regular, ImVec2(left, middle - theme.regular->FontSize / 2), palette().text,
      ui::elided(demo.title, max.x - left - theme.px(6)));
  return pressed;
}

namespace {

void draw_numbers(const PanelContext& context) {
  const auto& measured = context.session.quality().latest();
  const bool known = measured && measured->shape == context.session.shape();
  if (!known || !context.picture_follows()) return ui::text_dim(" ");
  const QualityReport& report = measured->report;
  const std::string inverted = counted(report.inverted, "inverted element");
  ui::text_colored(report.inverted > 0 ? palette().danger : palette().success, inverted);
  ui::note("demo/inverted");
  ImGui::SameLine();
  const bool in_space = context.session.in_space();
  ui::text_dim((in_space ? "smallest scaled Jacobian " : "smallest sine ") +
               short_number(report.of(Metric::normalized_jacobian).statistics.min) +
               (in_space ? ", largest R/3r " : ", largest R/2r ") +
               short_number(report.of(Metric::aspect_ratio).statistics.max));
}

void draw_buttons(const PanelContext& context) {
  const DemoPlayer& player = context.demo;
  const std::size_t steps = player.demo()->steps.size();
  const bool ready = player.ready(context.session);
  const bool last = player.step() + 1 == steps;
  const float width = context.theme.px(86);
  if (ui::button("demo/back", "Back",
                 {tooltip_of(user_command("demo_back")), ui::ButtonStyle::normal,
                  ready && player.step() > 0, width}))
    context.emit(action::StepDemo{-1});
  ImGui::SameLine();
  if (ui::button("demo/next", last ? "Finish" : "Next",
                 {tooltip_of(user_command("demo_next")), ui::ButtonStyle::primary, ready, width}))
    context.emit(action::StepDemo{1});
  ImGui::SameLine();
  if (ui::button("demo/play", player.automatic() ? "Wait" : "Auto-play",
                 {"Go on by itself, or wait at each step.", ui::ButtonStyle::normal, !last, width}))
    context.emit(action::PlayDemo{!player.automatic()});
  ImGui::SameLine();
  if (ui::button("demo/end", "End",
                 {"Leave the demo; the mesh stays open. (Esc)", ui::ButtonStyle::flat, true,
                  context.theme.px(60)}))
    context.emit(action::EndDemo{});
}

}  // namespace

float demo_height(const PanelContext& context, float width) {
  const Demo* demo = context.demo.demo();
  if (!demo) return 0;
  const std::string& text = demo->steps[context.demo.step()].text;
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  return 3 * ImGui::GetTextLineHeightWithSpacing() + gap +
         ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y + ImGui::GetFrameHeight();
}

void draw_demo(const PanelContext& context) {
  const Demo* demo = context.demo.demo();
  if (!demo) return;
  const DemoStep& step = demo->steps[context.demo.step()];
  const std::string place = "Step " + std::to_string(context.demo.step() + 1) + " of " +
                            std::to_string(demo->steps.size()) + " of case " + demo->id + ": ";
  ui::text_colored(palette().text_faint,
                   ui::elided(place + demo->title, ImGui::GetContentRegionAvail().x));
  ui::note("demo/step/" + std::to_string(context.demo.step() + 1));
  ui::text_in(context.theme.bold, step.title);
  ui::text_wrapped(step.text);
  if (context.demo.ready(context.session))
    draw_numbers(context);
  else
    ui::text_dim(context.session.files().loading() ? "Reading the mesh ..." : "At work ...");
  draw_buttons(context);
}

}  // namespace winslow::gui
