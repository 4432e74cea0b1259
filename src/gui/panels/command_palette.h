#pragma once

#include "gui/menu/panel_context.h"
#include "gui/menu/user_command.h"

namespace winslow::gui {

/// All commands by name: a few letters find one, Enter runs it. What was run last comes first.
class CommandPalette : public Panel {
 public:
  void draw(const PanelContext& context) override;

  void open() { wanted_ = true; }
  /// Ids of the rows, best first, as last drawn.
  const std::vector<std::string>& shown() const { return shown_; }

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
  std::vector<std::string> shown_;
};

}  // namespace winslow::gui
