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

/// Input of the studio: what happened since the frame before, however it came about. The window's
/// callbacks and the tests' scripts fill the same queue.
namespace winslow::gui {

enum class MouseButton { left = 0, right = 1, middle = 2 };

/// Keyboard and mouse as one frame sees them.
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

/// Events in the order in which they came. Several events may fall into one frame, but never two
/// that a frame could not tell apart: a press and its release, a press and a motion after it, a key
/// and the release of the Control key that was held with it, a character twice, or one that was
/// typed after Tab or Enter. What is typed after a command's key with Ctrl or Alt waits some frames
/// for the field that the command may open.
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
  /// Whether a frame takes keys that went down, or leaves them, and what came after them, in the
  /// queue: what the last key did is yet to be seen.
  enum class Keys { take, hold };
  /// Takes events off the queue, as many as one frame can hold.
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
  struct Frame;  // what the frame being filled holds already
  bool apply(const Event& event, Frame& frame);
  /// What is typed is kept back in this frame.
  bool waits() const { return waiting_ > 0; }

  std::deque<Event> events_;
  InputState state_;
  int waiting_ = 0;  // frames for which it is
};

}  // namespace winslow::gui
