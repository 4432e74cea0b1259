#include "io/cgns/tree.h"

#include <cstring>

namespace winslow::io::cgns {
namespace {

template <class To, class From>
std::vector<To> values_of(const std::string& data) {
  std::vector<To> values(data.size() / sizeof(From));
  for (std::size_t i = 0; i < values.size(); ++i) {
    From value;
    std::memcpy(&value, data.data() + i * sizeof(From), sizeof(From));
    values[i] = static_cast<To>(value);
  }
  return values;
}

NodePtr find_path(const NodePtr& root, std::string_view path) {
  NodePtr node = root;
  while (node && !path.empty()) {
    if (path.front() == '/') {
      path.remove_prefix(1);
      continue;
    }
    const std::string_view name = path.substr(0, path.find('/'));
    path.remove_prefix(name.size());
    const auto found = std::find_if(node->children.begin(), node->children.end(),
                                    [&](const NodePtr& child) { return child->name == name; });
    node = found == node->children.end() ? nullptr : *found;
  }
  return node;
}

/// The final target of a chain of links; null if it is not in this file or the chain is cyclic.
NodePtr target_of(const NodePtr& root, const Node& link) {
  constexpr int longest_chain = 100;  // the limit of CGNS
  NodePtr node;
  const Node* here = &link;
  for (int i = 0; i < longest_chain && here->link_file.empty(); ++i) {
    node = find_path(root, here->link_path);
    if (!node || !node->is_link()) return node;
    here = node.get();
  }
  return nullptr;
}

template <class Value>
std::shared_ptr<Node> make_values(std::string name, std::string label, const char* type,
                                  const std::vector<Value>& values,
                                  std::vector<std::int64_t> dims) {
  auto node = make_node(std::move(name), std::move(label));
  node->type = type;
  node->dims = std::move(dims);
  if (node->dims.empty()) node->dims = {static_cast<std::int64_t>(values.size())};
  node->data.assign(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
  return node;
}

}  // namespace

const Node& Node::content() const {
  const NodePtr there = target.lock();
  return there ? *there : *this;
}

NodePtr child_named(const Node& parent, std::string_view name) {
  for (const NodePtr& child : parent.children)
    if (child->name == name) return child;
  return nullptr;
}

NodePtr child_labelled(const Node& parent, std::string_view label) {
  for (const NodePtr& child : parent.children)
    if (child->content().label == label) return child;
  return nullptr;
}

std::vector<double> reals_of(const Node& node) {
  if (node.type == "R4") return values_of<double, float>(node.data);
  if (node.type == "R8") return values_of<double, double>(node.data);
  return {};
}

std::vector<std::int64_t> integers_of(const Node& node) {
  if (node.type == "I4") return values_of<std::int64_t, std::int32_t>(node.data);
  if (node.type == "I8") return values_of<std::int64_t, std::int64_t>(node.data);
  return {};
}

std::string text_of(const Node& node) {
  if (node.type != "C1") return {};
  return std::string(trimmed(std::string_view(node.data).substr(0, node.data.find('\0'))));
}

std::size_t size_of(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 12> sizes{{{"C1", 1},
                                                                            {"B1", 1},
                                                                            {"U1", 1},
                                                                            {"I1", 1},
                                                                            {"I4", 4},
                                                                            {"U4", 4},
                                                                            {"R4", 4},
                                                                            {"I8", 8},
                                                                            {"U8", 8},
                                                                            {"R8", 8},
                                                                            {"X4", 8},
                                                                            {"X8", 16}}};
  for (const auto& [name, size] : sizes)
    if (name == type) return size;
  return 0;
}

std::int64_t value_count(const Node& node) {
  if (node.dims.empty()) return 0;
  std::int64_t count = 1;
  for (const std::int64_t dim : node.dims) count *= dim;
  return count;
}

void resolve_links(const NodePtr& root, const std::vector<std::shared_ptr<Node>>& links) {
  for (const auto& link : links) link->target = target_of(root, *link);
}

std::shared_ptr<Node> make_node(std::string name, std::string label) {
  auto node = std::make_shared<Node>();
  node->name = std::move(name);
  node->label = std::move(label);
  return node;
}

std::shared_ptr<Node> make_text(std::string name, std::string label, std::string_view text) {
  auto node = make_node(std::move(name), std::move(label));
  node->type = "C1";
  node->dims = {static_cast<std::int64_t>(text.size())};
  node->data = text;
  return node;
}

std::shared_ptr<Node> make_integers(std::string name, std::string label,
                                    const std::vector<std::int32_t>& values,
                                    std::vector<std::int64_t> dims) {
  return make_values(std::move(name), std::move(label), "I4", values, std::move(dims));
}

std::shared_ptr<Node> make_reals(std::string name, std::string label,
                                 const std::vector<double>& values,
                                 std::vector<std::int64_t> dims) {
  return make_values(std::move(name), std::move(label), "R8", values, std::move(dims));
}

std::shared_ptr<Node> make_single_reals(std::string name, std::string label,
                                        const std::vector<float>& values,
                                        std::vector<std::int64_t> dims) {
  return make_values(std::move(name), std::move(label), "R4", values, std::move(dims));
}

std::shared_ptr<Node> own_copy(const Node& node) {
  auto copy = std::make_shared<Node>(node.content());
  copy->name = node.name;
  return copy;
}

std::shared_ptr<Node> with_child(const Node& parent, const Node& old_child, NodePtr new_child) {
  auto copy = own_copy(parent);
  const auto place = std::find_if(copy->children.begin(), copy->children.end(),
                                  [&](const NodePtr& child) { return child.get() == &old_child; });
  if (place == copy->children.end()) return copy;
  if (new_child) {
    *place = std::move(new_child);
  } else {
    copy->children.erase(place);
  }
  return copy;
}

std::vector<NodeView> NodeView::children() const {
  std::vector<NodeView> found;
  for (const NodePtr& child : node_->content().children) {
    NodeView view(*this);
    view.node_ = child.get();
    view.path_ += '/';
    for (const char c : child->name)
      view.path_ +=
          static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f ? '?' : c;
    if (child->is_link() && &child->content() == child.get()) {
      const bool inside = child->link_file.empty();
      view.fail("a link to " + in_quotes(child->link_file + (inside ? "" : ":") + child->link_path),
                inside ? "a node of this file" : "the data themselves in this file");
    }
    found.push_back(std::move(view));
  }
  return found;
}

std::vector<NodeView> NodeView::children(std::string_view wanted) const {
  std::vector<NodeView> found;
  for (NodeView& view : children())
    if (view.label() == wanted) found.push_back(std::move(view));
  return found;
}

std::optional<NodeView> NodeView::child(std::string_view wanted) const {
  for (NodeView& view : children())
    if (view.name() == wanted) return std::move(view);
  return std::nullopt;
}

std::optional<NodeView> NodeView::first(std::string_view wanted) const {
  for (NodeView& view : children())
    if (view.label() == wanted) return std::move(view);
  return std::nullopt;
}

std::string NodeView::text() const { return text_of(node_->content()); }

std::vector<std::int64_t> NodeView::integers() const {
  if (type() == "I4" || type() == "I8") return integers_of(node_->content());
  fail("data of type " + in_quotes(type()), "integers (I4 or I8)");
}

std::vector<double> NodeView::reals() const {
  if (type() == "R4" || type() == "R8") return reals_of(node_->content());
  fail("data of type " + in_quotes(type()), "real numbers (R4 or R8)");
}

void NodeView::fail(const std::string& found, const std::string& expected) const {
  set_part();
  source_->fail(0, found, expected);
}

}  // namespace winslow::io::cgns
