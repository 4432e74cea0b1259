#pragma once

#include "core/error.h"

namespace winslow {

/// Targets were to keep the shapes of a mesh, the rest mesh, and an element of it is inverted or
/// flat: it has no shape to keep. A client that wants to go on does without those targets:
///
///     try {
///       result = execute(command, state);
///     } catch (const winslow::TangledRest& error) {
///       smooth.targets = {.automatic = 1};  // or `keep`, which bears with single such elements
///       ...
///     }
///
/// The program ends with a status of its own. index() is the first such element, counted from 0.
class TangledRest : public MeshError {
 public:
  /// fault: "inverted", for instance.
  TangledRest(Index element, const std::string& fault)
      : MeshError(
            MeshEntity::element, element,
            "the rest mesh, whose shapes the targets keep, is tangled: element " +
                std::to_string(element) + " is " + fault +
                "; start from a valid mesh, or choose other targets (auto, element or keep)") {}
};

}  // namespace winslow
