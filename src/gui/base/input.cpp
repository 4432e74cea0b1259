#include "gui/base/input.h"

#include <utility>

namespace winslow::gui {

namespace {

bool either(const std::bitset<512>& keys, int left, int right) {
  return keys[static_cast<std::size_t>(left)] || keys[static_cast<std::size_t>(right)];
}

bool is_modifier(int key) { return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER; }

/// True for keys that act on previously typed text: Enter, Tab, Backspace, arrows, function keys,
/// ...
bool types_nothing(int key) {
  return (key >= GLFW_KEY_ESCAPE && key <= GLFW_KEY_F25) || key == GLFW_KEY_KP_ENTER;
}

}  // namespace

bool InputState::control() const {
  return either(keys, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
}
bool InputState::shift() const { return either(keys, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT); }
bool InputState::alt() const { return either(keys, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT); }
bool InputState::super() const { return either(keys, GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER); }

struct InputQueue::Frame {
  std::array<bool, 3> button_changed{};
  bool any_button = false;
  std::bitset<512> key_changed;
  bool leads_elsewhere = false;  // a key went down that types no character
  bool chord = false;            // a key went down with Ctrl, Alt or Super, as for a command
  // A key went down: later changes of Control and Shift belong to the next frame.
  bool settled = false;
  Keys keys = Keys::take;
};

bool InputQueue::apply(const Event& event, Frame& frame) {
  if (const auto* move = std::get_if<Move>(&event)) {
    if (frame.any_button) return false;
    state_.mouse = move->position;
    state_.mouse_inside = move->inside;
  } else if (const auto* button = std::get_if<Button>(&event)) {
    const auto i = static_cast<std::size_t>(button->button);
    if (frame.settled || frame.button_changed[i]) return false;
    frame.button_changed[i] = frame.any_button = true;
    state_.buttons[i] = button->down;
  } else if (const auto* wheel = std::get_if<Wheel>(&event)) {
    state_.wheel += wheel->notches;
  } else if (const auto* key = std::get_if<Key>(&event)) {
    const auto k = static_cast<std::size_t>(key->key);
    if (frame.settled || frame.any_button || frame.key_changed[k]) return false;
    if (key->down && frame.keys == Keys::hold) return false;
    const bool chord = state_.control() || state_.alt() || state_.super();
    // A key that types a character is followed by its text event.
    const bool types = events_.size() > 1 && std::holds_alternative<Text>(events_[1]);
    if (key->down && waits() && !chord && types) return false;
    frame.key_changed[k] = true;
    frame.settled = key->down && !is_modifier(key->key);
    frame.leads_elsewhere = key->down && types_nothing(key->key);
    frame.chord = frame.settled && chord;
    state_.keys[k] = key->down;
  } else if (const auto* text = std::get_if<Text>(&event)) {
    // Text typed after Tab or Enter is for the next field.
    if (frame.leads_elsewhere || waits()) return false;
    // A frame cannot tell whether a character that is a command was typed once or twice.
    if (state_.text.find(text->character) != std::u32string::npos) return false;
    state_.text.push_back(text->character);
  } else if (const auto* drop = std::get_if<Drop>(&event)) {
    state_.dropped.insert(state_.dropped.end(), drop->files.begin(), drop->files.end());
  }
  return true;
}

InputState InputQueue::next_frame(Keys keys) {
  // Frames until a field has the keyboard focus.
  constexpr int frames_to_lead = 2;
  // The same for a field in a column that a command opens (Ctrl+G).
  constexpr int frames_to_open = 4;
  state_.wheel = Vec2(0, 0);
  state_.text.clear();
  state_.dropped.clear();
  const auto* pause = events_.empty() ? nullptr : std::get_if<Drop>(&events_.front());
  if (pause && pause->files.empty()) {
    events_.pop_front();
    return state_;
  }
  Frame frame;
  frame.keys = keys;
  while (!events_.empty() && apply(events_.front(), frame)) events_.pop_front();
  waiting_ = frame.chord ? frames_to_open : std::max(waiting_ - 1, 0);
  // A drop without files is an empty frame.
  if (frame.leads_elsewhere && !events_.empty() && std::holds_alternative<Text>(events_.front()))
    events_.insert(events_.begin(), frames_to_lead, Drop{});
  return state_;
}

}  // namespace winslow::gui
