#include "io/cgns/node_view.h"

#include <utility>

namespace winslow::io::cgns {
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
