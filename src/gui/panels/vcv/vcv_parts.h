#pragma once

#include <imgui.h>

#include "core/vcv/vcv_edit.h"
#include "gui/base/text.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Draws the field for the number of the inspected node, and its pin. typed: content of the field.
void draw_node_header(const PanelContext& context, int& typed);
/// Draws a hint while no node is inspected.
void draw_node_hint();
/// Draws a value with its label.
void draw_figure(const char* id, const char* label, const std::string& value, const char* tip,
                 ImU32 color = palette().text);
/// Draws the reason why a node has no VCV, in place of its values.
void draw_no_vcv(const std::string& why);
/// Changes one VCV and smooths.
void edit_vcv(const PanelContext& context, VcvEdit edit);
/// Gives an edge of a VCV the length that was typed and smooths. Invalid input leaves the length
/// unchanged and is no edit.
void edit_length(const PanelContext& context, VcvEdit edit, std::size_t edge, double length);
/// The radius of a neighbour's disc, in units of the layout.
inline constexpr float disc_size = 7.5f;
/// Draws the number of a neighbour, from 1, at the centre of its disc.
void draw_number(ImDrawList& list, const Theme& theme, const ImVec2& at, std::size_t neighbour,
                 bool lit);

/// Draws labels without overlaps: omits a label that would touch another one.
class LabelPlacer {
 public:
  LabelPlacer(ImDrawList& list, ImFont* font, const ImVec2& min, const ImVec2& max)
      : list_(list), font_(font), min_(min), max_(max) {}

  /// Reserves a square in which no label is placed.
  void block(const ImVec2& centre, float half);
  /// Text around a point. True if there was room. background: behind the text; 0: none.
  bool place(const ImVec2& centre, const std::string& text, ImU32 color, ImU32 background = 0);

 private:
  struct Rect {
    ImVec2 min, max;
  };
  bool is_free(const Rect& rect) const;

  ImDrawList& list_;
  ImFont* font_;
  ImVec2 min_, max_;
  std::vector<Rect> taken_;
};

/// Result of the mouse input in a picture of a VCV, in the plane or in space.
struct VcvPlotOutcome {
  std::optional<std::size_t> hovered;  ///< neighbour under the mouse
  std::optional<VcvEdit> edit;         ///< the VCV during the drag
  bool ended = false;                  ///< the drag is over
  bool cancelled = false;              ///< by Esc
};
/// Emits the changes of the VCV. edge: the chosen edge, updated by a press of the mouse.
void take_outcome(const PanelContext& context, const VcvPlotOutcome& outcome, std::size_t& edge);
/// The highlighted neighbour: the given one, or that under the mouse in the mesh.
std::optional<std::size_t> lit_neighbour(const PanelContext& context,
                                         std::span<const Index> neighbours,
                                         const std::optional<std::size_t>& hovered);

/// Draws buttons that reset the VCV of the node, and those of all edited nodes. reset: edit for the
/// node. edited: the node has an edited VCV. tips: of both buttons.
void draw_resets(const PanelContext& context, const VcvEdit& reset, bool edited,
                 const std::vector<Index>& all_edited, const std::array<const char*, 2>& tips);

}  // namespace winslow::gui
