#include "gui/files/assets.h"
#include "gui/files/file_kinds.h"
#include "gui/menu/user_command.h"
#include "gui/picture/capture/capture.h"

namespace winslow::gui {

namespace {

/// Saves to the file of the mesh; for a mesh of the program asks for another path.
void save(const PanelContext& context) {
  const Document* document = context.session.document();
  if (document && bundled(document->path()))
    context.emit(action::ShowFileDialog{FilePurpose::save_mesh});
  else
    context.emit(action::SaveMesh{});
}

/// Names of the mesh formats, as search terms of the commands that read and write them.
std::string format_names(FilePurpose purpose) {
  std::string names;
  for (const FileKind& kind : dialog_of(purpose).kinds) {
    names += kind.label + ' ';
    for (const std::string& extension : kind.extensions) names += extension + ' ';
  }
  return names;
}

UserCommand::Run dialog(FilePurpose purpose, const std::string& extension = {}) {
  return emits(action::ShowFileDialog{purpose, extension});
}

UserCommand::Text cannot_save() {
  return first_of({unless([](const PanelContext& c) { return !c.session.files().saving(); },
                          "The mesh is being saved."),
                   while_busy});
}

UserCommand::Text without_steps() {
  return unless(
      [](const PanelContext& c) { return c.session.document()->history().position() > 0; },
      "Nothing was done yet.");
}

UserCommand::Text while_recording() {
  return unless(
      [](const PanelContext& c) { return c.capture.recorder().state() == Recorder::State::idle; },
      "A recording is under way already.");
}

std::vector<UserCommand> recent_files(const PanelContext& context) {
  std::vector<UserCommand> items;
  for (const auto& [path, missing] : context.recent.files())
    items.push_back(
        entry("recent/" + path.string(), path.filename().string(), {}, path.string(),
              emits(action::OpenMesh{path}),
              {.blocked = unless([gone = missing](const PanelContext&) { return !gone; },
                                 "The file is not there any more.")}));
  items.push_back(entry("clear_recent", "Clear this list", {},
                        "Forget which files were open. The files stay.",
                        emits(action::ClearRecent{}), {.starts_section = true}));
  return items;
}

std::vector<UserCommand> bundled_files(const PanelContext&) {
  std::vector<UserCommand> items;
  for (const BundledMesh& mesh : bundled_meshes())
    items.push_back(entry("bundled/" + mesh.id, mesh.title, {}, mesh.about,
                          emits(action::OpenMesh{assets_folder() / mesh.file})));
  return items;
}

std::vector<UserCommand> export_formats(const PanelContext& context) {
  std::vector<UserCommand> items;
  const auto add = [&](FilePurpose purpose, const std::string& what) {
    for (const FileKind& kind : dialog_of(purpose, context.session.kind()).kinds) {
      if (kind.extensions.size() != 1) continue;
      const std::string& extension = kind.extensions[0];
      items.push_back(entry(
          what + extension, what + " as " + kind.label + " (" + extension + ")...", {},
          dialog_of(purpose).title + ".", dialog(purpose, extension), {.blocked = cannot_save()}));
    }
  };
  add(FilePurpose::export_mesh, "Mesh");
  const std::size_t meshes = items.size();
  add(FilePurpose::export_markers, "Markers");
  items[meshes].starts_section = true;
  return items;
}

std::vector<UserCommand> picture_commands() {
  return {
      entry("screenshot", "Save picture", {key(GLFW_KEY_F12)}, "Save a picture of this window.",
            emits(action::TakeScreenshot{}),
            {.words = "screenshot image png", .starts_section = true}),
      entry("screenshot_as", "Save picture as...", {shift(key(GLFW_KEY_F12))},
            "A picture of any size, with or without the panels, or vector graphics of the mesh.",
            emits(action::ShowPictureDialog{}), {.words = "screenshot image png svg pdf vector"}),
      entry("record", "Record...", {}, "Record the mesh as it moves: PNG frames, GIF or MP4.",
            emits(action::ShowRecordDialog{}),
            {.words = "film video animation movie",
             .blocked = first_of({without_mesh, while_recording()})}),
      entry("record_step", "Record the last step again...", {},
            "Carry out the last command again, from the mesh it found, and record it.",
            [](const PanelContext& c) {
              c.emit(action::ShowRecordDialog{c.session.document()->history().position()});
            },
            {.blocked = first_of({while_busy, while_recording(), without_steps()})}),
      entry("stop_recording", "Stop recording", {}, "End the recording and write it.",
            emits(action::StopRecording{}),
            {.blocked = unless(
                 [](const PanelContext& c) {
                   return c.capture.recorder().state() == Recorder::State::recording;
                 },
                 "Nothing is being recorded.")}),
      entry("quit", "Quit", {control(key('Q'))},
            "Leave the studio. It asks if there are changes that are not saved.",
            emits(action::Quit{}), {.starts_section = true}),
  };
}

}  // namespace

std::vector<UserCommand> file_commands() {
  std::vector<UserCommand> all{
      entry("open", "Open mesh...", {control(key('O'))},
            "Choose a mesh file. A file dropped on the window opens, too.",
            dialog(FilePurpose::open_mesh),
            {.words = "load read import " + format_names(FilePurpose::open_mesh)}),
      submenu("open_recent", "Open recent", "Meshes that were open before.", recent_files,
              {.blocked = unless([](const PanelContext& c) { return !c.recent.files().empty(); },
                                 "No mesh was open yet.")}),
      submenu("bundled", "Open a bundled mesh", "Meshes that come with the program.", bundled_files,
              {.blocked = unless([](const PanelContext&) { return !assets_folder().empty(); },
                                 "The bundled meshes are not installed.")}),
      entry("close", "Close mesh", {control(key('W'))},
            "Close the mesh. It asks if there are changes that are not saved.",
            emits(action::CloseMesh{}), {.blocked = without_mesh}),
      entry("save", "Save", {control(key('S'))}, "Save the mesh.", save,
            {.blocked = cannot_save(), .starts_section = true}),
      entry("save_as", "Save as...", {control(shift(key('S')))},
            "Save the mesh under another name or in another format.",
            dialog(FilePurpose::save_mesh),
            {.words = "write convert " + format_names(FilePurpose::save_mesh),
             .blocked = cannot_save()}),
      submenu("export", "Export", "Write a copy of the mesh in a format, or its markers as curves.",
              export_formats, {.words = "write convert format", .blocked = cannot_save()}),
      entry("recipe", "Export recipe...", {control(key('E'))},
            "Write the commands of this session to a file that \"winslow replay\" runs.",
            dialog(FilePurpose::export_recipe),
            {.blocked = first_of({without_mesh, without_steps()})}),
      entry("replay", "Replay recipe...", {},
            "Apply the commands of a recipe to the open mesh, one after the other.",
            dialog(FilePurpose::replay_recipe),
            {.blocked = first_of(
                 {without_mesh, unless([](const PanelContext& c) { return !c.session.in_motion(); },
                                       "Wait until the solver is done, or cancel it.")})}),
      entry("export_convergence", "Export iterations...", {},
            "Write the iterations that the plot shows as a CSV table.",
            dialog(FilePurpose::export_convergence),
            {.blocked = unless(
                 [](const PanelContext& c) { return !c.session.mesh().convergence().empty(); },
                 "There are no iterations yet.")}),
  };
  for (UserCommand& command : picture_commands()) all.push_back(std::move(command));
  return all;
}

namespace {

const History* history(const PanelContext& context) {
  const Document* document = context.session.document();
  return document ? &document->history() : nullptr;
}

bool busy(const PanelContext& context) { return context.session.in_motion(); }

/// The last override of a node of this mesh, which can be undone.
std::string undoable_override(const PanelContext& context) {
  const Document* document = context.session.document();
  return document && !busy(context)
             ? context.session.solver_settings().overrides().undoable(document->edits().revision())
             : std::string();
}
std::string redoable_override(const PanelContext& context) {
  const Document* document = context.session.document();
  return document
             ? context.session.solver_settings().overrides().redoable(document->edits().revision())
             : std::string();
}

bool can_undo(const PanelContext& c) {
  return busy(c) || history(c)->can_undo() || !undoable_override(c).empty();
}
bool can_redo(const PanelContext& c) {
  return history(c)->can_redo() || !redoable_override(c).empty();
}

/// "Undo: Smooth".
std::string undo_label(const PanelContext& c) {
  if (const auto what = undoable_override(c); !what.empty()) return "Undo: " + what;
  if (!history(c) || !history(c)->can_undo()) return "Undo";
  return "Undo: " + describe(history(c)->command(history(c)->position()));
}
std::string redo_label(const PanelContext& c) {
  if (const auto what = redoable_override(c); !what.empty()) return "Redo: " + what;
  if (!history(c) || !history(c)->can_redo()) return "Redo";
  return "Redo: " + describe(history(c)->command(history(c)->position() + 1));
}

}  // namespace

std::vector<UserCommand> edit_commands() {
  return {
      entry("undo", "Undo", {control(key('Z'))}, "Undo the last command.", emits(action::Undo{}),
            {.blocked = first_of({without_mesh, unless(can_undo, "There is nothing to undo.")}),
             .label_now = undo_label}),
      entry("redo", "Redo", {control(shift(key('Z'))), control(key('Y'))},
            "Do again what was undone.", emits(action::Redo{}),
            {.blocked = first_of({while_busy, unless(can_redo, "There is nothing to redo.")}),
             .label_now = redo_label}),
      entry("reset", "Revert to opened mesh", {control(key('R'))},
            "Back to the mesh as it was opened. Redo brings the commands back.",
            emits(action::GoToStep{0}),
            {.words = "reset original loaded undo all",
             .blocked = first_of({without_mesh, unless(
                                                    [](const PanelContext& c) {
                                                      return busy(c) || history(c)->position() > 0;
                                                    },
                                                    "This is the mesh as opened.")})}),
      entry("scramble", "Scramble the interior", {},
            "Put every interior node at a random place: a test of what smoothing can recover.",
            emits(action::Scramble{1}),
            {.words = "random shuffle", .blocked = while_busy, .starts_section = true}),
  };
}

}  // namespace winslow::gui
