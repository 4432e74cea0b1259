#pragma once

#include <memory>

#include "io/text/source.h"

/// The tree of a CGNS file: named, labelled nodes with data ("CGNS File Mapping Manual"). The SIDS,
/// "CGNS Standard Interface Data Structures", define what the nodes mean; the other files of this
/// folder interpret them. Does not depend on libcgns.
namespace winslow::io::cgns {

struct Node;
using NodePtr = std::shared_ptr<const Node>;

/// A node never changes once it is part of a tree, so trees can share nodes.
struct Node {
  std::string name;
  std::string label;
  std::string type = "MT";         ///< "MT" (no data), "C1", "I4", "I8", "R4", "R8", ..., "LK"
  std::vector<std::int64_t> dims;  ///< the first index runs fastest
  std::string data;                ///< the values, as many as dims say, in their memory layout
  std::vector<NodePtr> children;

  // Only for a link ("LK"), for which the name is the only member above that is set:
  std::string link_file;             ///< empty: the link leads to a node of this file
  std::string link_path;             ///< "/Base/Zone/..."
  std::weak_ptr<const Node> target;  ///< the node at that path in this file, once resolved

  bool is_link() const { return type == "LK"; }
  /// The node that a link leads to; this node, if it is no link or leads nowhere in this file.
  const Node& content() const;
};

/// Size of a value in bytes; 0: no type of CGNS.
std::size_t size_of(std::string_view type);
/// Product of the dimensions; 0 without dimensions.
std::int64_t value_count(const Node& node);

/// The first child of that name or label; null: there is none.
NodePtr child_named(const Node& parent, std::string_view name);
NodePtr child_labelled(const Node& parent, std::string_view label);

/// Values of a node of type R4 or R8; empty for other types.
std::vector<double> reals_of(const Node& node);
/// Values of a node of type I4 or I8; empty for other types.
std::vector<std::int64_t> integers_of(const Node& node);
/// Values of a node of type C1, without blanks at the end; empty for other types.
std::string text_of(const Node& node);

/// Sets the targets of the given links of a new tree.
void resolve_links(const NodePtr& root, const std::vector<std::shared_ptr<Node>>& links);

// Functions that make nodes.
std::shared_ptr<Node> make_node(std::string name, std::string label);
std::shared_ptr<Node> make_text(std::string name, std::string label, std::string_view text);
/// Empty dims: one dimension, the number of values.
std::shared_ptr<Node> make_integers(std::string name, std::string label,
                                    const std::vector<std::int32_t>& values,
                                    std::vector<std::int64_t> dims = {});
std::shared_ptr<Node> make_reals(std::string name, std::string label,
                                 const std::vector<double>& values,
                                 std::vector<std::int64_t> dims = {});
std::shared_ptr<Node> make_single_reals(std::string name, std::string label,
                                        const std::vector<float>& values,
                                        std::vector<std::int64_t> dims = {});

/// A copy of a node that may be changed. For a link: a copy of its target, named like the link.
std::shared_ptr<Node> own_copy(const Node& node);

/// A copy in which new_child replaces old_child; if new_child is null, old_child is left out.
std::shared_ptr<Node> with_child(const Node& parent, const Node& old_child, NodePtr new_child);

/// A node of a tree and its path in the file, for readers. Follows links within the file. The
/// source and the tree must outlive the view.
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

  /// Children in the order of the file. Throws InputError for a link that leads out of the file,
  /// because its target would be missing.
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
  /// From now on, messages of the source name this node as the place.
  void set_part() const { source_->set_part(path_.empty() ? "/" : path_); }

 private:
  Source* source_;
  const Node* node_;
  std::string path_;
};

/// The two ways in which a CGNS file can hold its tree.
enum class Container { hdf5, adf };

struct TreeFile {
  NodePtr root;
  Container container = Container::hdf5;
};

/// Finds the container by the signature at the beginning of a file (in HDF5 it may come after 512,
/// 1024, 2048, ... bytes of user data). Returns nothing if it is neither.
std::optional<Container> container_of(std::string_view bytes);

/// Reads the whole tree with libcgns, which is not thread-safe: other threads wait. Throws
/// InputError for what libcgns cannot read, and if the file is too small for the data that it
/// declares.
TreeFile read_tree(Source& source);

/// The bytes of a file that holds the tree. Throws OutputError.
std::string write_tree(const Node& root, Container container);

/// Why this build of the program has no CGNS support; empty: it has.
extern const std::string_view no_library;

}  // namespace winslow::io::cgns
