#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// The commands applied so far: to go back to any of them, to change one and run those after it
/// again, to write them as a recipe.
class HistoryPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_steps(const PanelContext& context);
  void draw_step(const PanelContext& context, std::size_t position);
  void draw_menu(const PanelContext& context, std::size_t position);
  void draw_buttons(const PanelContext& context);
  void draw_recipes(const PanelContext& context);
  void draw_queue(const PanelContext& context);
  void draw_kept(const PanelContext& context);

  std::size_t shown_size_ = 0;  // a new step scrolls into view
};

/// A dialog in which the numbers and options of a past command are changed.
class StepEditor : public Panel {
 public:
  /// Shows the dialog from the next frame on. position: of the command in the history.
  void open(std::size_t position, Command command);
  bool is_open() const { return open_; }
  void draw(const PanelContext& context) override;

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
