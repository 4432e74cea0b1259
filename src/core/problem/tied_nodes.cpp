#include "core/problem/tied_nodes.h"

#include "core/error.h"

namespace winslow {

void TiedNodes::add(const NodeImage& image) {
  for (const Index either : {image.node, image.image})
    if (partner(either))
      throw UsageError("node " + std::to_string(either) + " is in two periodic pairs");
  images_[image.image] = image;
  image_of_[image.node] = image.image;
}

std::optional<Index> TiedNodes::partner(Index node) const {
  if (const auto found = images_.find(node); found != images_.end()) return found->second.node;
  if (const auto found = image_of_.find(node); found != image_of_.end()) return found->second;
  return std::nullopt;
}

std::optional<Index> TiedNodes::separate(Index node) {
  const std::optional<Index> other = partner(node);
  if (!other) return other;
  for (const Index either : {node, *other}) {
    images_.erase(either);
    image_of_.erase(either);
  }
  return other;
}

std::vector<NodeImage> TiedNodes::images() const {
  std::vector<NodeImage> list;
  for (const auto& [node, image] : images_) list.push_back(image);
  return list;
}

}  // namespace winslow
