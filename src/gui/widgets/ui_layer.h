#pragma once

#include <imgui.h>

#include <map>
#include <set>

#include "gui/base/input.h"
#include "gui/render/imgui_renderer.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// Positions of the widgets of the last frame, for scripts that operate the studio like a user.
class WidgetMap {
 public:
  struct Rect {
    ScreenPoint min, max;
    bool enabled = true;
    bool shown = true;  ///< its centre is visible, neither scrolled away nor clipped
    bool cut = false;   ///< its label does not fit into it
    ScreenPoint centre() const { return midpoint(min, max); }
  };
  void clear() { rects_.clear(); }
  void note(std::string_view id, const Rect& rect) { rects_[std::string(id)] = rect; }
  /// Records that the label of a noted widget does not fit.
  void mark_cut(std::string_view id) { rects_[std::string(id)].cut = true; }
  std::optional<Rect> find(std::string_view id) const;
  /// Sets the widget to scroll to while frames are drawn; empty: none.
  void want(std::string_view id) { wanted_ = id; }
  bool wanted(std::string_view id) const { return !wanted_.empty() && wanted_ == id; }
  const std::map<std::string, Rect, std::less<>>& all() const { return rects_; }

 private:
  std::map<std::string, Rect, std::less<>> rects_;
  std::string wanted_;
};

/// A Dear ImGui context with input only from InputState. Needs a current OpenGL context.
class UiLayer {
 public:
  explicit UiLayer(float scale);
  ~UiLayer();
  UiLayer(const UiLayer&) = delete;
  UiLayer& operator=(const UiLayer&) = delete;

  /// Starts a frame for a framebuffer of the given size, `seconds` after the last one.
  void begin(const InputState& input, int width, int height, double seconds);
  void end();
  /// Draws the last ended frame into the bound framebuffer.
  void paint();

  /// Makes this context the current one for widgets. begin() and paint() do so, too.
  void make_current();
  /// Draws a part of the last ended frame: width x height pixels from (x, y) on.
  void paint_part(float x, float y, float width, float height);
  /// Copies colours, folded sections and scroll positions from another layer.
  void resemble(const UiLayer& other);

  const Theme& theme() const { return theme_; }
  /// Sets the pixels per unit of the layout from the next frame on; call it only between frames.
  void set_scale(float scale);
  /// Sets the colours from the next frame on.
  void set_palette(const Palette& colors) { palette_ = &colors; }
  /// Folded sections of panels, by id.
  std::set<std::string>& folded() { return folded_; }
  const std::set<std::string>& folded() const { return folded_; }
  /// Sets the section to scroll to when it is drawn next.
  void reveal(std::string_view id) { revealed_ = id; }
  /// True, once, if `id` is the section set by reveal().
  bool take_reveal(std::string_view id);
  /// True if the mouse has been over that item, which it is now over, long enough for its tooltip.
  bool rested_on(const ScreenBox& item);
  const WidgetMap& widgets() const { return widgets_; }
  WidgetMap& widgets() { return widgets_; }
  /// Gives the keyboard focus to the field with that id when it is drawn next, and unfolds its
  /// section ("section/motion" for "motion/rotate"). Expires after a few frames.
  void want_keyboard(std::string_view field);
  const std::string& keyboard_wanted() const { return keyboard_wanted_; }
  void keyboard_taken() { keyboard_wanted_.clear(); }
  /// The layer with the current context, for widgets drawn within a frame.
  static UiLayer& current();
  /// True if a window, a widget or a popup uses the mouse, not the scene behind.
  bool wants_mouse() const;
  bool wants_keyboard() const;
  /// Shape of the mouse cursor (ImGuiMouseCursor).
  int cursor() const;

 private:
  ImGuiContext* context_;
  Theme theme_;
  const Palette* palette_ = &light_palette();
  std::set<std::string> folded_;
  std::string revealed_;
  std::optional<ScreenBox> item_;  // item under the mouse that has a tooltip
  double rested_ = 0;              // seconds for which the mouse has been over it
  bool over_item_ = false;         // in this frame
  WidgetMap widgets_;
  std::string keyboard_wanted_;
  int keyboard_frames_ = 0;  // remaining frames of this request
  std::unique_ptr<ImGuiRenderer> renderer_;
};

}  // namespace winslow::gui
