#pragma once

#include "gui/document/actions/actions.h"
#include "gui/menu/user_command.h"

/// What comes up over the studio when it is asked for. Each is drawn in every frame, from the next
/// one after open() on it is seen. The dialog of files is gui/panels/files/file_dialog.h.
namespace winslow::gui {

/// The question or the error that waits for an answer, as a dialog.
void draw_prompt(const PanelContext& context);

/// All commands by name: a few letters find one, Enter runs it. What was run last comes first.
class CommandPalette {
 public:
  void open() { wanted_ = true; }
  void draw(const PanelContext& context);

 private:
  struct Row {
    UserCommand command;
    std::string label, reason;  ///< why it cannot be run; empty: it can
    int score = 0;
  };
  std::vector<Row> rows(const PanelContext& context) const;
  void draw_query(const PanelContext& context);
  void draw_rows(const PanelContext& context, const std::vector<Row>& rows);
  bool draw_row(const PanelContext& context, const Row& row, bool chosen);
  void run(const PanelContext& context, const Row& row);

  bool wanted_ = false;
  bool scroll_ = false;  // to the row chosen, which keys have moved
  std::string query_;
  std::size_t chosen_ = 0;
  std::deque<std::string> recent_;  // ids, the last one run first
};

/// All keys and what the mouse does, over everything else; Esc or any click closes it.
class HelpPanel {
 public:
  void open() { wanted_ = true; }
  void draw(const PanelContext& context);

 private:
  bool wanted_ = false;
};

/// What the studio is made of: versions, graphics, licence.
class AboutPanel {
 public:
  void open() { wanted_ = true; }
  void draw(const PanelContext& context);
  /// A line a part: "OpenGL  4.5 ...". Needs a current OpenGL context.
  static std::vector<std::pair<std::string, std::string>> facts();

 private:
  bool wanted_ = false;
  std::vector<std::pair<std::string, std::string>> facts_;
};

/// The menu of a right click: what can be done with the body, the node and the element there.
class ContextMenu {
 public:
  /// Comes up beside the mouse.
  void open(const PickedPlace& place);
  void draw(const PanelContext& context);

 private:
  PickedPlace place_;
  std::shared_ptr<const Topology> topology_;  ///< that the numbers of the place belong to
  bool wanted_ = false;
};

/// The controls of a PictureSpec, for the dialogs that have one.
class PictureSettings {
 public:
  /// Starts from a spec. on_screen: the window's size there, pixels.
  void set(const PictureSpec& spec, const ScreenVector& on_screen);
  /// Draws the controls; their ids begin with `id`. film: no transparency. window, mesh: their
  /// sizes on screen, pixels.
  void draw(const std::string& id, bool film, const ScreenVector& window, const ScreenVector& mesh);
  /// What is wrong with the size; empty if nothing is.
  const std::string& error() const { return error_; }
  const PictureSpec& spec() const { return spec_; }

 private:
  PictureSpec spec_;
  int width_ = 1600, height_ = 1200;  // as typed
  std::string error_;
};

/// What a picture shows and how large it is; its file is chosen next.
class PictureDialog {
 public:
  void open() { wanted_ = opened_ = true; }
  /// window, mesh: their sizes on screen, pixels.
  void draw(const PanelContext& context, const ScreenVector& window, const ScreenVector& mesh);

 private:
  bool wanted_ = false, opened_ = false;
  PictureSettings settings_;
};

/// How the mesh is recorded; where to is chosen next.
class RecordDialog {
 public:
  /// step: of the history, that is to be carried out again and recorded.
  void open(std::optional<std::size_t> step);
  /// window, mesh: their sizes on screen, pixels.
  void draw(const PanelContext& context, const ScreenVector& window, const ScreenVector& mesh);

 private:
  bool wanted_ = false, opened_ = false;
  std::optional<std::size_t> step_;
  PictureSettings settings_;
  RecordingSpec spec_;
};

/// A dialog in which the numbers and options of a past command are changed.
class StepEditor {
 public:
  /// position: of the command in the history.
  void open(std::size_t position, Command command);
  bool is_open() const { return open_; }
  void draw(const PanelContext& context);

  /// The file whose surface the nodes of the command slide on; empty: none.
  std::string reference();
  void set_reference(const std::filesystem::path& file);
  /// Comes up again if it made room for a dialog of files, which is closed by now.
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
