#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace winslow::gui {

/// Numbers typed while the mouse drags a body: "30" turns it by 30 degrees, "0.1 Tab 0.2" moves it
/// by (0.1, 0.2), in space "0.1 Tab 0.2 Tab 0.3". As long as there are any, they count in place of
/// the mouse.
class TypedMotion {
 public:
  void clear() { *this = TypedMotion(); }
  /// Takes the digits, signs and points of a text (a comma is a point); leaves the rest alone. True
  /// if it took any.
  bool type(std::u32string_view text);
  /// Takes the last character back; from an empty field it goes back to the one before.
  bool erase();
  /// Goes on to the next of `count` fields, from the last one to the first.
  void next(std::size_t count);

  bool active() const {
    return std::ranges::any_of(fields_, [](const std::string& text) { return !text.empty(); });
  }
  /// As typed.
  const std::string& text(std::size_t field) const { return fields_[field]; }
  std::size_t field() const { return at_; }
  /// 0 for a field with nothing in it; none for what is no number (yet): "-".
  std::optional<double> value(std::size_t field) const;

 private:
  std::array<std::string, 3> fields_;
  std::size_t at_ = 0;
};

}  // namespace winslow::gui
