#pragma once

#include "gui/menu/panel_context.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// What the nodes of markers do while the mesh is smoothed, in the list of markers: a word in every
/// row, which a click changes, and below the list what belongs to it.
class MarkerRoles {
 public:
  static float width(const Theme& theme);

  struct Place {
    ImVec2 min, max;
  };
  /// The word: a click has a marker that stays slide, and the other way round; that of a periodic
  /// side offers what it can be periodic with.
  static void draw_word(const PanelContext& context, Index marker, const Place& place);
  /// The list of markers that one can be periodic with, while it is open. Where the words are
  /// drawn.
  void draw_partners(const PanelContext& context);
  /// Pairs of the file, feature angle, spacing, what slides along edges, and why the boundary
  /// cannot move so: below the list.
  void draw_settings(const PanelContext& context);

 private:
  void draw_angle(const PanelContext& context, SlideOptions slide);
  static void draw_file_pairs(const PanelContext& context, SlideOptions slide);
  static void draw_spacing(const PanelContext& context, SlideOptions slide);
  static void draw_reference(const PanelContext& context);
  void draw_found(const PanelContext& context);
  void show_preview(const PanelContext& context, bool on);

  bool previewed_ = false;
};

/// What a click on a row "Reference surface" asks for.
enum class ReferenceAsk { nothing, choose, clear };

/// The file whose surface nodes slide on: a button that chooses one, and, where there is one, a
/// cross that lets go of it. id: of the button, that of the cross has "_none" behind it. name:
/// empty: the mesh's own surface. reading: a file that is being read; empty: none.
ReferenceAsk reference_row(const Theme& theme, const std::string& id, const std::string& name,
                           const std::filesystem::path& reading = {});

}  // namespace winslow::gui
