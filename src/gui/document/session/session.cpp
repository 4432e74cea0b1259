#include "gui/document/session/session.h"

namespace winslow::gui {

Session::Session() {
  mesh_.when_rebuilt([this](const auto& before, const auto& now) {
    quality_.clear();
    if (now) return selection_.follow(before, now);
    selection_.clear();
    jobs_.layer_preview().want({});
  });
}

void Session::apply(const DocumentAction& action) {
  std::visit([this](const auto& group) { apply_group(group); }, action);
}

bool Session::poll() {
  bool changed = files_.poll();
  changed |= history_.poll();
  changed |= quality_.poll();
  changed |= jobs_.poll();
  changed |= stars_.poll();
  changed |= roles_.poll();
  return changed;
}

bool Session::working() const {
  return files_.busy() || history_.busy() || quality_.busy() || jobs_.working() || stars_.busy() ||
         roles_.busy();
}

}  // namespace winslow::gui
