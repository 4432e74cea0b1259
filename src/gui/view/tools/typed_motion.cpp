#include "gui/view/tools/typed_motion.h"

#include <charconv>
#include <cmath>

namespace winslow::gui {

bool TypedMotion::type(std::u32string_view text) {
  constexpr std::size_t longest = 24;
  bool taken = false;
  for (const char32_t c : text) {
    const bool digit = c >= U'0' && c <= U'9';
    if (!digit && c != U'.' && c != U',' && c != U'-' && c != U'+') continue;
    if (fields_[at_].size() == longest) continue;
    fields_[at_] += c == U',' ? '.' : static_cast<char>(c);
    taken = true;
  }
  return taken;
}

bool TypedMotion::erase() {
  if (fields_[at_].empty()) {
    if (at_ == 0) return false;
    --at_;
    return true;
  }
  fields_[at_].pop_back();
  return true;
}

void TypedMotion::next(std::size_t count) { at_ = count < 2 ? 0 : (at_ + 1) % count; }

std::optional<double> TypedMotion::value(std::size_t field) const {
  std::string_view text = fields_[field];
  if (text.empty()) return 0.0;
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace winslow::gui
