#pragma once

#include <imgui.h>

#include <map>
#include <set>

#include "gui/base/input.h"
#include "gui/render/imgui_renderer.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// Where the widgets of the last frame are: for scripts that work the studio as a user would.
class WidgetMap {
 public:
  struct Rect {
    ScreenPoint min, max;
    bool enabled = true;
    bool shown = true;  ///< its centre is in sight: neither scrolled away nor cut off
    bool cut = false;   ///< its label does not fit into it
    ScreenPoint centre() const { return midpoint(min, max); }
  };
  void clear() { rects_.clear(); }
  void note(std::string_view id, const Rect& rect) { rects_[std::string(id)] = rect; }
  /// Of a widget that is noted: its label does not fit.
  void mark_cut(std::string_view id) { rects_[std::string(id)].cut = true; }
  std::optional<Rect> find(std::string_view id) const;
  /// The widget that its window is to be scrolled to while frames are drawn; empty: none.
  void want(std::string_view id) { wanted_ = id; }
  bool wanted(std::string_view id) const { return !wanted_.empty() && wanted_ == id; }
  const std::map<std::string, Rect, std::less<>>& all() const { return rects_; }

 private:
  std::map<std::string, Rect, std::less<>> rects_;
  std::string wanted_;
};

/// A Dear ImGui context of our own, fed from InputState alone. Needs a current OpenGL context.
class UiLayer {
 public:
  explicit UiLayer(float scale);
  ~UiLayer();
  UiLayer(const UiLayer&) = delete;
  UiLayer& operator=(const UiLayer&) = delete;

  /// Starts a frame of a framebuffer's size, `seconds` after the last one.
  void begin(const InputState& input, int width, int height, double seconds);
  void end();
  /// Draws the frame last ended into the bound framebuffer.
  void paint();

  /// Makes this the context that widgets are drawn in. begin() and paint() do it too.
  void make_current();
  /// Draws a part of the frame last ended: what lies from (x, y) on, as large as given.
  void paint_part(float x, float y, float width, float height);
  /// Takes over colours, and what was folded and scrolled, from another layer.
  void resemble(const UiLayer& other);

  const Theme& theme() const { return theme_; }
  /// Pixels per unit of the layout, from the next frame on: between frames only.
  void set_scale(float scale);
  /// The colours from the next frame on.
  void set_palette(const Palette& colors) { palette_ = &colors; }
  /// Sections of panels that are folded, by id.
  std::set<std::string>& folded() { return folded_; }
  const std::set<std::string>& folded() const { return folded_; }
  /// The section that its window is to be scrolled to when it is drawn next.
  void reveal(std::string_view id) { revealed_ = id; }
  /// True, once, if it is this one.
  bool take_reveal(std::string_view id);
  /// The mouse has been over that item long enough for a word about it. The item has it now.
  bool rested_on(const ScreenBox& item);
  const WidgetMap& widgets() const { return widgets_; }
  WidgetMap& widgets() { return widgets_; }
  /// The field of that id takes the keyboard when it is drawn next, and the section that it is in
  /// unfolds ("section/motion" for "motion/rotate"). Forgotten if it is not drawn in a few frames.
  void want_keyboard(std::string_view field);
  const std::string& keyboard_wanted() const { return keyboard_wanted_; }
  void keyboard_taken() { keyboard_wanted_.clear(); }
  /// The layer whose context is current: for widgets, which are drawn within a frame.
  static UiLayer& current();
  /// The mouse belongs to a window, a widget or a popup rather than to what lies behind.
  bool wants_mouse() const;
  bool wants_keyboard() const;
  /// What the mouse cursor should look like (ImGuiMouseCursor).
  int cursor() const;

 private:
  ImGuiContext* context_;
  Theme theme_;
  const Palette* palette_ = &light_palette();
  std::set<std::string> folded_;
  std::string revealed_;
  std::optional<ScreenBox> item_;  // under the mouse, that has a word to say
  double rested_ = 0;              // seconds that the mouse has been over it
  bool over_item_ = false;         // in this frame
  WidgetMap widgets_;
  std::string keyboard_wanted_;
  int keyboard_frames_ = 0;  // for which it is still waited for
  std::unique_ptr<ImGuiRenderer> renderer_;
};

}  // namespace winslow::gui
