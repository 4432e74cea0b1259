#pragma once

#include <utility>

#include "core/geometry/element_normals.h"
#include "core/geometry/sliding_boundary.h"
#include "core/mesh/coordinates.h"

namespace winslow {

/// What the nodes of a mesh that slide stay on: each a line or a plane of its own, or geometry that
/// it shares with others.
class SlidingNodes {
 public:
  /// A line (one direction) or a plane (two) through wherever the node is.
  void set(Index node, const TangentFrame& frame);
  /// Geometry, which says what it is at the places in x (a point for each node of the mesh).
  /// Returns the directions in which each node may move.
  std::vector<TangentFrame> set(std::span<const Index> nodes,
                                std::shared_ptr<const SlidingGeometry> geometry,
                                const Coordinates& x);
  /// The node no longer slides.
  void erase(Index node);

  /// Null for a node that does not slide.
  const TangentFrame* frame(Index node) const;
  /// Null for a node that slides on no geometry.
  const SlidingGeometry* geometry(Index node) const;

  /// Of a surface mesh, what tells elements that are turned over (null: nothing does).
  void set_element_normals(std::shared_ptr<const ElementNormals> normals) {
    element_normals_ = std::move(normals);
  }
  const std::shared_ptr<const ElementNormals>& element_normals() const { return element_normals_; }

  /// Whether the same nodes may move in the same directions on the same geometry.
  bool same_ways(const SlidingNodes& other) const {
    return frames_ == other.frames_ && geometry_ == other.geometry_;
  }

 private:
  std::map<Index, TangentFrame> frames_;
  // #nodes of the mesh; empty as long as no node slides on geometry.
  std::vector<std::shared_ptr<const SlidingGeometry>> geometry_;
  std::shared_ptr<const ElementNormals> element_normals_;
};

}  // namespace winslow
