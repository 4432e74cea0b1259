#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <bitset>
#include <deque>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/types.h"
#include "gui/base/screen.h"

/// Input of the studio since the previous frame. The window's callbacks and the tests' scripts fill
/// the same queue.
namespace winslow::gui {

enum class MouseButton { left = 0, right = 1, middle = 2 };

/// State of keyboard and mouse in one frame.
struct InputState {
  ScreenPoint mouse{-1, -1};
  bool mouse_inside = false;
  std::array<bool, 3> buttons{};               ///< by MouseButton
  Vec2 wheel{0, 0};                            ///< notches since the last frame, y up
  std::bitset<512> keys;                       ///< by GLFW key code
  std::u32string text;                         ///< typed since the last frame
  std::vector<std::filesystem::path> dropped;  ///< files dropped on the window

  bool down(MouseButton b) const { return buttons[static_cast<std::size_t>(b)]; }
  bool control() const;
  bool shift() const;
  bool alt() const;
  bool super() const;
};

/// Events in order of arrival. One frame may contain several events, but no two that it could not
/// distinguish. These are: a press and its release, a press and a later motion, a key and the
/// release of its Control key, the same character twice, a character after Tab or Enter. Text typed
/// after a command's key with Ctrl or Alt waits some frames for a field that the command may open.
class InputQueue {
 public:
  void move(const ScreenPoint& position) { events_.push_back(Move{position, true}); }
  void leave() { events_.push_back(Move{ScreenPoint(-1, -1), false}); }
  void button(MouseButton button, bool down) { events_.push_back(Button{button, down}); }
  void wheel(const Vec2& notches) { events_.push_back(Wheel{notches}); }
  void key(int glfw_key, bool down) {
    if (glfw_key >= 0 && glfw_key < 512) events_.push_back(Key{glfw_key, down});
  }
  void text(char32_t character) { events_.push_back(Text{character}); }
  void drop(std::vector<std::filesystem::path> files) { events_.push_back(Drop{std::move(files)}); }

  bool empty() const { return events_.empty(); }
  /// Whether a frame takes pressed keys, or holds them and all later events in the queue until the
  /// effect of the last key was shown.
  enum class Keys { take, hold };
  /// Takes as many events from the queue as one frame can contain.
  InputState next_frame(Keys keys = Keys::take);

 private:
  struct Move {
    ScreenPoint position;
    bool inside;
  };
  struct Button {
    MouseButton button;
    bool down;
  };
  struct Wheel {
    Vec2 notches;
  };
  struct Key {
    int key;
    bool down;
  };
  struct Text {
    char32_t character;
  };
  struct Drop {
    std::vector<std::filesystem::path> files;
  };
  using Event = std::variant<Move, Button, Wheel, Key, Text, Drop>;
  struct Frame;  // content so far of the frame being filled
  bool apply(const Event& event, Frame& frame);
  /// True while typed text is held back.
  bool waits() const { return waiting_ > 0; }

  std::deque<Event> events_;
  InputState state_;
  int waiting_ = 0;  // number of frames for which text is held back
};

}  // namespace winslow::gui
