#pragma once

#include "gui/document/actions/actions.h"
#include "gui/menu/user_command.h"

/// Dialogs and popups of the studio. draw() is called in every frame; the dialog is visible from
/// the frame after open(). The file dialog is in gui/panels/files/file_dialog.h.
namespace winslow::gui {

/// Draws the question or error that waits for an answer, as a dialog.
void draw_prompt(const PanelContext& context);

/// A searchable list of all commands: a few letters find one, Enter runs it. Recent commands come
/// first.
class CommandPalette {
 public:
  void open() { wanted_ = true; }
  void draw(const PanelContext& context);

 private:
  struct Row {
    UserCommand command;
    std::string label, reason;  ///< why it is unavailable; empty: available
    int score = 0;
  };
  std::vector<Row> rows(const PanelContext& context) const;
  void draw_query(const PanelContext& context);
  void draw_rows(const PanelContext& context, const std::vector<Row>& rows);
  bool draw_row(const PanelContext& context, const Row& row, bool chosen);
  void run(const PanelContext& context, const Row& row);

  bool wanted_ = false;
  bool scroll_ = false;  // to the chosen row, moved by keys
  std::string query_;
  std::size_t chosen_ = 0;
  std::deque<std::string> recent_;  // ids, last run first
};

/// The list of all keys and mouse actions, above everything else; Esc or any click closes it.
class HelpPanel {
 public:
  void open() { wanted_ = true; }
  void draw(const PanelContext& context);

 private:
  bool wanted_ = false;
};

/// Information on the program: versions, graphics, licence.
class AboutPanel {
 public:
  void open() { wanted_ = true; }
  void draw(const PanelContext& context);
  /// One line per component: "OpenGL  4.5 ...". Needs a current OpenGL context.
  static std::vector<std::pair<std::string, std::string>> facts();

 private:
  bool wanted_ = false;
  std::vector<std::pair<std::string, std::string>> facts_;
};

/// The context menu: commands on the body, the node and the element under the mouse.
class ContextMenu {
 public:
  /// Opens beside the mouse.
  void open(const PickedPlace& place);
  void draw(const PanelContext& context);

 private:
  PickedPlace place_;
  std::shared_ptr<const Topology> topology_;  ///< to which the indices of place_ refer
  bool wanted_ = false;
};

/// The controls for a PictureSpec in dialogs.
class PictureSettings {
 public:
  /// Starts from a spec. on_screen: the window's size, pixels.
  void set(const PictureSpec& spec, const ScreenVector& on_screen);
  /// Draws the controls; their ids begin with `id`. film: no transparency. window, mesh: their
  /// sizes on screen, pixels.
  void draw(const std::string& id, bool film, const ScreenVector& window, const ScreenVector& mesh);
  /// What is wrong with the size; empty: nothing.
  const std::string& error() const { return error_; }
  const PictureSpec& spec() const { return spec_; }

 private:
  PictureSpec spec_;
  int width_ = 1600, height_ = 1200;  // as typed
  std::string error_;
};

/// Content and size of a picture; its file is chosen next.
class PictureDialog {
 public:
  void open() { wanted_ = opened_ = true; }
  /// window, mesh: their sizes on screen, pixels.
  void draw(const PanelContext& context, const ScreenVector& window, const ScreenVector& mesh);

 private:
  bool wanted_ = false, opened_ = false;
  PictureSettings settings_;
};

/// Options of a recording; its file is chosen next.
class RecordDialog {
 public:
  /// step: of the history, to rerun and record.
  void open(std::optional<std::size_t> step);
  /// window, mesh: their sizes on screen, pixels.
  void draw(const PanelContext& context, const ScreenVector& window, const ScreenVector& mesh);

 private:
  bool wanted_ = false, opened_ = false;
  std::optional<std::size_t> step_;
  PictureSettings settings_;
  RecordingSpec spec_;
};

/// A dialog that edits the numbers and options of a past command.
class StepEditor {
 public:
  /// position: of the command in the history.
  void open(std::size_t position, Command command);
  bool is_open() const { return open_; }
  void draw(const PanelContext& context);

  /// The file whose surface the nodes of the command slide on; empty: none.
  std::string reference();
  void set_reference(const std::filesystem::path& file);
  /// Reopens if it was hidden for a file dialog, which is now closed.
  void show_again() { wanted_ = wanted_ || std::exchange(aside_, false); }

 private:
  void draw_fields(const PanelContext& context);
  void draw_footer(const PanelContext& context);
  void close();

  bool open_ = false, wanted_ = false;
  bool aside_ = false;  // while a file is chosen
  std::size_t position_ = 0;
  std::uint64_t generation_ = 0;  // of the mesh whose command it is; 0: not known yet
  std::string title_;
  Command command_;
};

}  // namespace winslow::gui
