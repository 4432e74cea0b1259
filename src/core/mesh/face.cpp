#include "core/mesh/face.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/error.h"

namespace winslow {

Face::Face(std::span<const Index> nodes) : count_(static_cast<Index>(nodes.size())) {
  if (nodes.size() < 2 || nodes.size() > 4) {
    throw UsageError("a face of " + std::to_string(nodes.size()) + " nodes, expected 2 to 4");
  }
  std::copy(nodes.begin(), nodes.end(), nodes_.begin());
}

void Face::refuse_edge() const {
  throw UsageError("a face with " + nodes_text(*this) +
                   " where an edge of a plane or surface mesh is expected");
}

std::array<Index, 4> Face::sorted() const {
  std::array<Index, 4> all = nodes_;
  // As unsigned numbers, -1 comes last.
  const auto order = [&](std::size_t a, std::size_t b) {
    if (static_cast<std::uint32_t>(all[b]) < static_cast<std::uint32_t>(all[a]))
      std::swap(all[a], all[b]);
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return all;
}

std::string nodes_text(const Face& face) {
  std::string text = "nodes";
  for (std::size_t k = 0; k < face.size(); ++k) {
    text += k == 0 ? " " : k + 1 < face.size() ? ", " : " and ";
    text += std::to_string(face[k]);
  }
  return text;
}

}  // namespace winslow
