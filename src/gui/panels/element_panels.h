#pragma once

#include "gui/menu/panel_context.h"
#include "gui/settings/view_state.h"

namespace winslow::gui {

/// Goes to a node, an element or a face by its id, and says what it is.
class GoToPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_field(const PanelContext& context);
  void draw_item(const PanelContext& context);

  std::array<char, 128> text_{};
  std::string error_;
  // What is said of an item, until it or the mesh is another.
  std::optional<MeshItem> described_;
  std::uint64_t generation_ = 0, shape_ = 0;
  std::vector<std::pair<std::string, std::string>> lines_;
};

/// Isolates the elements on one side of a threshold of the metric that is shown.
class IsolatePanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  bool draw_threshold(const PanelContext& context, Isolation& isolation);
};

/// The list of the worst elements: a click goes to one.
class WorstPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_choices(const PanelContext& context);
  void draw_steps(const PanelContext& context);
  void draw_list(const PanelContext& context);

  std::vector<WorstElement> list_;  // as drawn
  std::uint64_t list_generation_ = 0;
  ElementField list_field_ = Metric::normalized_jacobian;
  bool hovered_ = false;                 // in the last frame
  std::optional<MeshItem> scrolled_to_;  // the list is scrolled once to what comes into focus
};

}  // namespace winslow::gui
