#pragma once

#include <imgui.h>

#include "core/vcv/vcv_edit.h"
#include "gui/base/text.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// The number of the node that is inspected, which can be typed, and its pin. typed: what stands in
/// the field.
void draw_node_header(const PanelContext& context, int& typed);
/// What to do while no node is inspected.
void draw_node_hint();
/// A value with what it is.
void draw_figure(const char* id, const char* label, const std::string& value, const char* tip,
                 ImU32 color = palette().text);
/// A sentence in the place of a node's figures: why it has no VCV.
void draw_no_vcv(const std::string& why);
/// Changes one VCV and smooths.
void edit_vcv(const PanelContext& context, VcvEdit edit);
/// The radius of a neighbour's disc, in units of the layout.
inline constexpr float disc_size = 7.5f;
/// The number of a neighbour, from 1, in the middle of its disc.
void draw_number(ImDrawList& list, const Theme& theme, const ImVec2& at, std::size_t neighbour,
                 bool lit);

/// Writes labels where there is room: one that would touch another is left out.
class LabelPlacer {
 public:
  LabelPlacer(ImDrawList& list, ImFont* font, const ImVec2& min, const ImVec2& max)
      : list_(list), font_(font), min_(min), max_(max) {}

  /// Keeps a square free of labels.
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

/// What the mouse does in a picture of a VCV, of the plane or of space.
struct VcvPlotOutcome {
  std::optional<std::size_t> hovered;  ///< neighbour under the mouse
  std::optional<VcvEdit> edit;         ///< the VCV as it is dragged
  bool ended = false;                  ///< the drag is over
  bool cancelled = false;              ///< by Esc
};
/// Emits what has become of the VCV. edge: the one that is chosen, by a press of the mouse.
void take_outcome(const PanelContext& context, const VcvPlotOutcome& outcome, std::size_t& edge);
/// The neighbour that is lit up: the one given, or that under the mouse in the mesh.
std::optional<std::size_t> lit_neighbour(const PanelContext& context,
                                         std::span<const Index> neighbours,
                                         const std::optional<std::size_t>& hovered);

/// Buttons that give the node its own VCV again, and all nodes that were edited. reset: of the
/// node; edited: it was. tips: of both.
void draw_resets(const PanelContext& context, const VcvEdit& reset, bool edited,
                 const std::vector<Index>& all_edited, const std::array<const char*, 2>& tips);

}  // namespace winslow::gui
