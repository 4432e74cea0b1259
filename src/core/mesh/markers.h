#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/compressed_rows.h"
#include "core/mesh/mesh_data.h"
#include "core/types.h"

namespace winslow {

/// The markers of a mesh, numbered from 0 on, with the nodes of each.
class Markers {
 public:
  /// Those of the file or, if it has none at all, one for each connected part of the boundary, in
  /// which case from_file() is false and writers leave them out: "loop_1", ... of a plane or
  /// surface mesh, "boundary_1", ... of a volume mesh.
  const std::vector<Marker>& list() const { return list_; }
  bool from_file() const { return from_file_; }

  std::size_t size() const { return list_.size(); }
  bool empty() const { return list_.empty(); }
  const Marker& operator[](std::size_t marker) const { return list_[marker]; }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

  /// Index of the marker of that name, if any.
  std::optional<Index> find(std::string_view name) const;
  /// Sorted unique nodes of a marker.
  std::span<const Index> nodes(Index marker) const { return nodes_[marker]; }
  /// Sorted unique nodes of several markers by name. Throws UsageError naming the known markers.
  std::vector<Index> nodes_of(std::span<const std::string> names) const;
  /// Boundary faces that belong to no marker.
  Index unmarked_faces() const { return unmarked_faces_; }

 private:
  friend class TopologyBuilder;

  std::vector<Marker> list_;
  bool from_file_ = true;
  CompressedRows nodes_;
  Index unmarked_faces_ = 0;
};

}  // namespace winslow
