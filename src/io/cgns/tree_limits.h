#pragma once

#include "io/cgns/tree.h"

namespace winslow::io::cgns {

/// Path of a node for messages; in damaged files, names may hold any bytes.
std::string child_path(const std::string& parent, const std::string& name);

/// What a tree may hold at most, by the size of its file: a damaged file must neither end in
/// endless nodes nor demand more memory than its bytes justify.
class TreeLimits {
 public:
  static constexpr int most_dimensions = 12;

  TreeLimits(Source& source, Container container);

  /// Throws InputError "FILE: PATH: found FOUND, expected EXPECTED".
  [[noreturn]] void fail(const std::string& path, const std::string& found,
                         const std::string& expected) const;

  /// Counts a node. depth: of the node below the root.
  void count_node(const std::string& path, int depth);
  /// True if the file has room for so many more nodes.
  bool has_room_for(std::size_t nodes) const { return nodes <= nodes_left_; }
  /// Counts the values of a node of that type and these dimensions; returns their bytes.
  std::size_t count_data(const std::string& path, std::string_view type,
                         const std::vector<std::int64_t>& dims);

 private:
  Source& source_;
  std::size_t nodes_left_, bytes_left_;
};

}  // namespace winslow::io::cgns
