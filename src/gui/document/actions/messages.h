#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "gui/document/actions/actions.h"
#include "gui/settings/view_state.h"

namespace winslow::gui {

/// A question or an error that waits for an answer.
struct Prompt {
  enum class Kind { error, question, information };
  struct Choice {
    std::string label;
    ActionQueue actions;  ///< carried out when it is chosen; the prompt goes in any case
    bool primary = false;
  };
  Kind kind = Kind::information;
  std::string title;
  std::string text;
  std::vector<Choice> choices;
};

/// What the present mesh's state calls for, shown above it until it is dealt with.
struct Banner {
  enum class Kind {
    inverted_result,
    inverted_input,
    not_converged,
    partial_motion,
    damaged,
    remark
  };
  Kind kind = Kind::inverted_result;
  std::string text;
  std::optional<MeshItem> worst = {};  ///< where to look, if it is about a place
};

/// A passing remark: what was just done.
struct Notice {
  enum class Kind { information, success, warning };
  Kind kind = Kind::information;
  std::string text;
  std::chrono::steady_clock::time_point since;
};

}  // namespace winslow::gui
