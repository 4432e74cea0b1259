#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/cgns/tree.h"
#include "io/text/source.h"

namespace winslow::io::cgns {

/// A node of a tree and where in the file it is, as readers walk over it. Links within the file are
/// followed. The source and the tree have to outlive it.
class NodeView {
 public:
  NodeView(Source& source, const NodePtr& root) : source_(&source), node_(root.get()) {}

  const std::string& name() const { return node_->name; }
  const std::string& label() const { return node_->content().label; }
  const std::string& type() const { return node_->content().type; }
  const std::vector<std::int64_t>& dims() const { return node_->content().dims; }
  /// The node itself, which may be a link.
  const Node& node() const { return *node_; }
  const std::string& path() const { return path_; }
  std::string file() const { return source_->name(); }
  Source& source() const { return *source_; }

  /// In the order of the file. Throws InputError for a link that leads out of the file: what is
  /// behind it would be missing.
  std::vector<NodeView> children() const;
  std::vector<NodeView> children(std::string_view label) const;
  std::optional<NodeView> child(std::string_view name) const;
  /// The first one of that label.
  std::optional<NodeView> first(std::string_view label) const;

  /// Values of text, without blanks at the end; empty if the node holds no text.
  std::string text() const;
  /// Values of I4 and I8 data. Throws InputError for other types.
  std::vector<std::int64_t> integers() const;
  /// Values of R4 and R8 data. Throws InputError for other types.
  std::vector<double> reals() const;

  /// Throws InputError "FILE: /Base/Zone/...: found FOUND, expected EXPECTED".
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;
  /// Has places in messages of the source named by this node.
  void set_part() const { source_->set_part(path_.empty() ? "/" : path_); }

 private:
  Source* source_;
  const Node* node_;
  std::string path_;
};

}  // namespace winslow::io::cgns
