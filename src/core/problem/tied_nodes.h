#pragma once

#include <map>

#include "core/geometry/curve.h"
#include "core/geometry/periodic_pairs.h"
#include "core/types.h"

namespace winslow {

/// A node that goes where another takes it across a periodic boundary.
struct NodeImage {
  Index image, node;
  std::shared_ptr<const RigidImage> transform;  ///< takes the node to the image
  bool operator==(const NodeImage& other) const {
    return image == other.image && node == other.node && *transform == *other.transform;
  }
};

/// Nodes of a mesh that have no unknowns of their own, because others take them along: images
/// across periodic boundaries, and nodes in rows along curves.
class TiedNodes {
 public:
  /// Throws UsageError if one of the nodes is in a pair already.
  void add(const NodeImage& image);
  /// Ends the pair that a node is in; the other node of the pair, if there was one.
  std::optional<Index> separate(Index node);
  /// The other node of the pair that a node is in.
  std::optional<Index> partner(Index node) const;
  bool has_image(Index node) const { return image_of_.contains(node); }
  /// Ascending by the image.
  std::vector<NodeImage> images() const;

  void add(std::shared_ptr<const CurveRow> row) { rows_.push_back(std::move(row)); }
  /// In the order in which they were added.
  std::span<const std::shared_ptr<const CurveRow>> rows() const { return rows_; }

  bool operator==(const TiedNodes&) const = default;

 private:
  std::map<Index, NodeImage> images_;  // by the image
  std::map<Index, Index> image_of_;    // by the node
  std::vector<std::shared_ptr<const CurveRow>> rows_;
};

}  // namespace winslow
