#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "core/index.h"

namespace winslow {

/// The corners of one face in cyclic order: two of an edge, which is a face of plane and surface
/// elements; three or four of a face of volume elements.
class Face {
 public:
  constexpr Face() = default;
  constexpr Face(Index a, Index b) : nodes_{a, b, -1, -1}, count_(2) {}
  constexpr Face(Index a, Index b, Index c) : nodes_{a, b, c, -1}, count_(3) {}
  constexpr Face(Index a, Index b, Index c, Index d) : nodes_{a, b, c, d}, count_(4) {}
  /// Throws UsageError unless there are two, three or four nodes.
  explicit Face(std::span<const Index> nodes);

  constexpr std::size_t size() const { return static_cast<std::size_t>(count_); }
  constexpr Index operator[](std::size_t k) const { return nodes_[k]; }
  constexpr const Index* begin() const { return nodes_.data(); }
  constexpr const Index* end() const { return nodes_.data() + count_; }

  /// The two nodes of an edge. Throws UsageError for a face of a volume mesh.
  std::array<Index, 2> edge() const {
    if (count_ != 2) refuse_edge();
    return {nodes_[0], nodes_[1]};
  }

  /// The face as seen from its other side; the first node of three or four stays.
  constexpr Face reversed() const {
    if (count_ == 2) return {nodes_[1], nodes_[0]};
    return count_ == 3 ? Face(nodes_[0], nodes_[2], nodes_[1])
                       : Face(nodes_[0], nodes_[3], nodes_[2], nodes_[1]);
  }

  /// Ascending; ends in -1 where there are fewer than four. The same for every order of the nodes.
  std::array<Index, 4> sorted() const;

  constexpr bool operator==(const Face&) const = default;

 private:
  [[noreturn]] void refuse_edge() const;

  std::array<Index, 4> nodes_{-1, -1, -1, -1};
  Index count_ = 0;
};

/// A face given by the numbers of an element's corners, by the nodes at these corners.
constexpr Face by_nodes(const Face& face, std::span<const Index> corners) {
  const auto node = [&](std::size_t k) { return corners[static_cast<std::size_t>(face[k])]; };
  if (face.size() == 2) return {node(0), node(1)};
  return face.size() == 3 ? Face(node(0), node(1), node(2))
                          : Face(node(0), node(1), node(2), node(3));
}

/// "nodes 3 and 5", "nodes 3, 5 and 9": as messages name a face.
std::string nodes_text(const Face& face);

}  // namespace winslow
