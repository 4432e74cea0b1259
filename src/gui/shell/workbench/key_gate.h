#pragma once

#include <bitset>
#include <cstdint>
#include <optional>

#include "gui/base/input.h"

namespace winslow::gui {

/// Has a key wait until the mesh that the key before it led to has been seen: the user answers to
/// what is in the picture. Meshes are told apart by LiveMesh::shape().
class KeyGate {
 public:
  /// Whether the next frame takes keys off the queue.
  InputQueue::Keys keys() const {
    return seen_ >= wanted_ ? InputQueue::Keys::take : InputQueue::Keys::hold;
  }
  /// After every frame. input: that it took. shape: of the open mesh; none: there is none. seen: of
  /// the mesh in the picture; none: there is no picture yet.
  void after_frame(const InputState& input, std::optional<std::uint64_t> shape,
                   std::optional<std::uint64_t> seen);

 private:
  std::bitset<512> down_;     // keys in the last frame
  std::uint64_t wanted_ = 0;  // the mesh when a key last went down
  std::uint64_t seen_ = 0;
};

}  // namespace winslow::gui
