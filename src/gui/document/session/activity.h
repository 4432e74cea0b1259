#pragma once

#include <string>

#include "gui/document/session/session.h"

namespace winslow::gui {

/// What the studio is at, as the status bar says it.
struct Activity {
  enum class Kind { idle, busy, blocked };
  Kind kind = Kind::idle;
  std::string text;  ///< empty if idle
};
Activity activity_of(const Session& session);

}  // namespace winslow::gui
