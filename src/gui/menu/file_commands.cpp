#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/files/assets.h"
#include "gui/files/file_kinds.h"
#include "gui/menu/user_command.h"
#include "gui/picture/capture/capture.h"

namespace winslow::gui {

namespace {

std::string cannot_save(const PanelContext& context) {
  if (context.session.files().saving()) return "The mesh is being saved.";
  return while_busy(context);
}

/// Where it came from; a mesh that belongs to the program goes elsewhere.
void save(const PanelContext& context) {
  const Document* document = context.session.document();
  if (document && bundled(document->path()))
    context.emit(action::ShowFileDialog{FilePurpose::save_mesh});
  else
    context.emit(action::SaveMesh{});
}

std::string cannot_record_step(const PanelContext& context) {
  if (std::string busy = while_busy(context); !busy.empty()) return busy;
  if (context.capture.recorder().state() != Recorder::State::idle)
    return "A recording is under way already.";
  return context.session.document()->history().position() > 0 ? "" : "Nothing was done yet.";
}

/// What the mesh formats are called, so that a format's name finds what reads and writes it.
std::string format_names(FilePurpose purpose) {
  std::string names;
  for (const FileKind& kind : dialog_of(purpose).kinds) {
    names += kind.label + ' ';
    for (const std::string& extension : kind.extensions) names += extension + ' ';
  }
  return names;
}

std::function<void(const PanelContext&)> dialog(FilePurpose purpose,
                                                const std::string& extension = {}) {
  return [=](const PanelContext& c) { c.emit(action::ShowFileDialog{purpose, extension}); };
}

std::vector<UserCommand> recent_files(const PanelContext& context) {
  std::vector<UserCommand> items;
  for (const RecentFiles::File& file : context.recent.files())
    items.push_back(
        {.id = "recent/" + file.path.string(),
         .label = file.path.filename().string(),
         .group = CommandGroup::file,
         .tooltip = file.path.string(),
         .blocked = [missing = file.missing](const PanelContext&) -> std::string {
           return missing ? "The file is not there any more." : "";
         },
         .run = [path = file.path](const PanelContext& c) { c.emit(action::OpenMesh{path}); }});
  items.push_back({.id = "clear_recent",
                   .label = "Clear this list",
                   .group = CommandGroup::file,
                   .tooltip = "Forget which files were open. The files stay.",
                   .run = [](const PanelContext& c) { c.emit(action::ClearRecent{}); },
                   .starts_section = true});
  return items;
}

std::vector<UserCommand> bundled(const PanelContext&) {
  std::vector<UserCommand> items;
  for (const BundledMesh& mesh : bundled_meshes())
    items.push_back({.id = "bundled/" + mesh.id,
                     .label = mesh.title,
                     .group = CommandGroup::file,
                     .tooltip = mesh.about,
                     .run = [path = assets_folder() / mesh.file](const PanelContext& c) {
                       c.emit(action::OpenMesh{path});
                     }});
  return items;
}

std::vector<UserCommand> export_formats(const PanelContext& context) {
  std::vector<UserCommand> items;
  const auto add = [&](FilePurpose purpose, const char* what) {
    for (const FileKind& kind : dialog_of(purpose, context.session.kind()).kinds) {
      if (kind.extensions.size() != 1) continue;
      const std::string& extension = kind.extensions[0];
      items.push_back({.id = what + extension,
                       .label = std::string(what) + " as " + kind.label + " (" + extension + ")...",
                       .group = CommandGroup::file,
                       .tooltip = dialog_of(purpose).title + ".",
                       .blocked = cannot_save,
                       .run = dialog(purpose, extension)});
    }
  };
  add(FilePurpose::export_mesh, "Mesh");
  const std::size_t meshes = items.size();
  add(FilePurpose::export_markers, "Markers");
  items[meshes].starts_section = true;
  return items;
}

std::vector<UserCommand> opening_commands() {
  constexpr auto group = CommandGroup::file;
  return {
      {.id = "open",
       .label = "Open mesh...",
       .group = group,
       .keys = {control(key(GLFW_KEY_O))},
       .tooltip = "Choose a mesh file. A file dropped on the window opens, too.",
       .words = "load read import " + format_names(FilePurpose::open_mesh),
       .run = dialog(FilePurpose::open_mesh)},
      {.id = "open_recent",
       .label = "Open recent",
       .group = group,
       .tooltip = "Meshes that were open before.",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.recent.files().empty() ? "No mesh was open yet." : "";
       },
       .items = recent_files},
      {.id = "bundled",
       .label = "Open a bundled mesh",
       .group = group,
       .tooltip = "Meshes that come with the program.",
       .blocked = [](const PanelContext&) -> std::string {
         return assets_folder().empty() ? "The bundled meshes are not installed." : "";
       },
       .items = bundled},
      {.id = "close",
       .label = "Close mesh",
       .group = group,
       .keys = {control(key(GLFW_KEY_W))},
       .tooltip = "Close the mesh. It asks if there are changes that are not saved.",
       .blocked = without_mesh,
       .run = [](const PanelContext& c) { c.emit(action::CloseMesh{}); }},
  };
}

std::vector<UserCommand> saving_commands() {
  constexpr auto group = CommandGroup::file;
  return {
      {.id = "save",
       .label = "Save",
       .group = group,
       .keys = {control(key(GLFW_KEY_S))},
       .tooltip = "Save the mesh.",
       .blocked = cannot_save,
       .run = save,
       .starts_section = true},
      {.id = "save_as",
       .label = "Save as...",
       .group = group,
       .keys = {control(shift(key(GLFW_KEY_S)))},
       .tooltip = "Save the mesh under another name or in another format.",
       .words = "write convert " + format_names(FilePurpose::save_mesh),
       .blocked = cannot_save,
       .run = dialog(FilePurpose::save_mesh)},
      {.id = "export",
       .label = "Export",
       .group = group,
       .tooltip = "Write a copy of the mesh in a format, or its markers as curves.",
       .words = "write convert format",
       .blocked = cannot_save,
       .items = export_formats},
      {.id = "recipe",
       .label = "Export recipe...",
       .group = group,
       .keys = {control(key(GLFW_KEY_E))},
       .tooltip = "Write the commands of this session to a file that \"winslow replay\" runs.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (!c.session.document()) return without_mesh(c);
         return c.session.document()->history().position() > 0 ? "" : "Nothing was done yet.";
       },
       .run = dialog(FilePurpose::export_recipe)},
      {.id = "replay",
       .label = "Replay recipe...",
       .group = group,
       .tooltip = "Apply the commands of a recipe to the open mesh, one after the other.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (!c.session.document()) return without_mesh(c);
         return c.session.in_motion() ? "Wait until the solver is done, or cancel it." : "";
       },
       .run = dialog(FilePurpose::replay_recipe)},
      {.id = "export_convergence",
       .label = "Export iterations...",
       .group = group,
       .tooltip = "Write the iterations that the plot shows as a CSV table.",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.session.mesh().convergence().empty() ? "There are no iterations yet." : "";
       },
       .run = dialog(FilePurpose::export_convergence)},
  };
}

std::vector<UserCommand> picture_commands() {
  constexpr auto group = CommandGroup::file;
  return {
      {.id = "screenshot",
       .label = "Save picture",
       .group = group,
       .keys = {key(GLFW_KEY_F12)},
       .tooltip = "Save a picture of this window.",
       .words = "screenshot image png",
       .run = [](const PanelContext& c) { c.emit(action::TakeScreenshot{}); },
       .starts_section = true},
      {.id = "screenshot_as",
       .label = "Save picture as...",
       .group = group,
       .keys = {shift(key(GLFW_KEY_F12))},
       .tooltip =
           "A picture of any size, with or without the panels, or vector graphics of the mesh.",
       .words = "screenshot image png svg pdf vector",
       .run = [](const PanelContext& c) { c.emit(action::ShowPictureDialog{}); }},
      {.id = "record",
       .label = "Record...",
       .group = group,
       .tooltip = "Record the mesh as it moves: PNG frames, GIF or MP4.",
       .words = "film video animation movie",
       .blocked = [](const PanelContext& c) -> std::string {
         if (!c.session.document()) return without_mesh(c);
         return c.capture.recorder().state() == Recorder::State::idle
                    ? ""
                    : "A recording is under way already.";
       },
       .run = [](const PanelContext& c) { c.emit(action::ShowRecordDialog{}); }},
      {.id = "record_step",
       .label = "Record the last step again...",
       .group = group,
       .tooltip = "Carry out the last command again, from the mesh it found, and record it.",
       .blocked = cannot_record_step,
       .run =
           [](const PanelContext& c) {
             c.emit(action::ShowRecordDialog{c.session.document()->history().position()});
           }},
      {.id = "stop_recording",
       .label = "Stop recording",
       .group = group,
       .tooltip = "End the recording and write it.",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.capture.recorder().state() == Recorder::State::recording
                    ? ""
                    : "Nothing is being recorded.";
       },
       .run = [](const PanelContext& c) { c.emit(action::StopRecording{}); }},
  };
}

UserCommand quit() {
  return {.id = "quit",
          .label = "Quit",
          .group = CommandGroup::file,
          .keys = {control(key(GLFW_KEY_Q))},
          .tooltip = "Leave the studio. It asks if there are changes that are not saved.",
          .run = [](const PanelContext& c) { c.emit(action::Quit{}); },
          .starts_section = true};
}

}  // namespace

std::vector<UserCommand> file_commands() {
  std::vector<UserCommand> all = opening_commands();
  for (const auto& part : {saving_commands(), picture_commands()})
    all.insert(all.end(), part.begin(), part.end());
  all.push_back(quit());
  return all;
}

namespace {

const History* history(const PanelContext& context) {
  const Document* document = context.session.document();
  return document ? &document->history() : nullptr;
}

bool busy(const PanelContext& context) { return context.session.in_motion(); }

/// What was told to a node last, at this mesh.
std::string undoable_override(const PanelContext& context) {
  const Document* document = context.session.document();
  return document && !busy(context)
             ? context.session.jobs().overrides().undoable(document->edits().revision())
             : std::string();
}
std::string redoable_override(const PanelContext& context) {
  const Document* document = context.session.document();
  return document ? context.session.jobs().overrides().redoable(document->edits().revision())
                  : std::string();
}

UserCommand undo() {
  return {.id = "undo",
          .label = "Undo",
          .group = CommandGroup::edit,
          .keys = {control(key(GLFW_KEY_Z))},
          .tooltip = "Undo the last command.",
          .blocked = [](const PanelContext& c) -> std::string {
            if (!history(c)) return without_mesh(c);
            return busy(c) || history(c)->can_undo() || !undoable_override(c).empty()
                       ? ""
                       : "There is nothing to undo.";
          },
          .run = [](const PanelContext& c) { c.emit(action::Undo{}); },
          .label_now = [](const PanelContext& c) -> std::string {
            if (const auto what = undoable_override(c); !what.empty()) return "Undo: " + what;
            if (!history(c) || !history(c)->can_undo()) return "Undo";
            return "Undo: " + describe(history(c)->command(history(c)->position()));
          }};
}

UserCommand redo() {
  return {.id = "redo",
          .label = "Redo",
          .group = CommandGroup::edit,
          .keys = {control(shift(key(GLFW_KEY_Z))), control(key(GLFW_KEY_Y))},
          .tooltip = "Do again what was undone.",
          .blocked = [](const PanelContext& c) -> std::string {
            if (!while_busy(c).empty()) return while_busy(c);
            return history(c)->can_redo() || !redoable_override(c).empty()
                       ? ""
                       : "There is nothing to redo.";
          },
          .run = [](const PanelContext& c) { c.emit(action::Redo{}); },
          .label_now = [](const PanelContext& c) -> std::string {
            if (const auto what = redoable_override(c); !what.empty()) return "Redo: " + what;
            if (!history(c) || !history(c)->can_redo()) return "Redo";
            return "Redo: " + describe(history(c)->command(history(c)->position() + 1));
          }};
}

UserCommand reset() {
  return {.id = "reset",
          .label = "Revert to opened mesh",
          .group = CommandGroup::edit,
          .keys = {control(key(GLFW_KEY_R))},
          .tooltip = "Back to the mesh as it was opened. Redo brings the commands back.",
          .words = "reset original loaded undo all",
          .blocked = [](const PanelContext& c) -> std::string {
            if (!history(c)) return without_mesh(c);
            return busy(c) || history(c)->position() > 0 ? "" : "This is the mesh as opened.";
          },
          .run = [](const PanelContext& c) { c.emit(action::GoToStep{0}); }};
}

UserCommand scramble() {
  return {.id = "scramble",
          .label = "Scramble the interior",
          .group = CommandGroup::edit,
          .tooltip =
              "Put every interior node at a random place: a test of what smoothing can "
              "recover.",
          .words = "random shuffle",
          .blocked = while_busy,
          .run = [](const PanelContext& c) { c.emit(action::Scramble{1}); },
          .starts_section = true};
}

}  // namespace

std::vector<UserCommand> edit_commands() { return {undo(), redo(), reset(), scramble()}; }

}  // namespace winslow::gui
