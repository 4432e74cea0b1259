#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/vcv/sphere/link_matching.h"
#include "gui/base/background.h"
#include "gui/document/session/live_mesh.h"

namespace winslow::gui {

/// The nodes of a volume mesh that can take the VCV of one of them (matching_stars()), looked for
/// in the background, in the mesh of the history: a whole mesh has many.
class StarMatches {
 public:
  explicit StarMatches(const LiveMesh& mesh) : mesh_(mesh) {}
  ~StarMatches() { stop(); }
  StarMatches(const StarMatches&) = delete;
  StarMatches& operator=(const StarMatches&) = delete;

  struct Wish {
    Index node = -1;
    std::optional<std::vector<Index>> among = std::nullopt;  ///< none: all inner nodes
    std::optional<double> radius = std::nullopt;             ///< as far as this from the node
    bool operator==(const Wish&) const = default;
  };
  using Found = std::vector<MatchedStar>;
  /// Null: they are being looked for. Valid until the next call.
  const Found* find(const Wish& wish) const;

  /// True if some were found.
  bool poll();
  bool busy() const { return worker_.busy(); }

 private:
  /// A wish, and the mesh that it is of.
  struct Question {
    Wish wish;
    std::uint64_t generation = 0, shape = 0;
    bool operator==(const Question&) const = default;
  };
  struct Answer {
    Question question;
    Found found;
  };
  void stop() const {
    if (stop_) *stop_ = true;
  }

  const LiveMesh& mesh_;
  mutable Question asked_;
  mutable std::optional<Answer> answer_;
  mutable std::shared_ptr<std::atomic<bool>> stop_;
  mutable Background<Answer> worker_;
};

}  // namespace winslow::gui
