#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gui/panels/panel.h"
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

}  // namespace winslow::gui
