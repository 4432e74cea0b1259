#include "io/gmsh/section_readers.h"

namespace winslow::io::gmsh {

std::optional<Index> NodeTags::build(const std::vector<std::int64_t>& tags) {
  if (tags.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(tags.begin(), tags.end());
  // The reader lets only positive tags in, so the difference cannot overflow.
  const auto range = static_cast<std::uint64_t>(*high - *low);
  const bool dense = range < 8 * tags.size() + 1024;
  first_ = *low;
  if (dense) {
    dense_.assign(static_cast<std::size_t>(range) + 1, -1);
  } else {
    sparse_.reserve(tags.size());
  }
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const auto node = static_cast<Index>(i);
    if (dense) {
      Index& slot = dense_[static_cast<std::size_t>(tags[i] - first_)];
      if (slot >= 0) return node;
      slot = node;
    } else if (!sparse_.emplace(tags[i], node).second) {
      return node;
    }
  }
  return std::nullopt;
}

Index NodeTags::find(std::int64_t tag) const {
  if (!sparse_.empty()) {
    const auto found = sparse_.find(tag);
    return found == sparse_.end() ? -1 : found->second;
  }
  if (tag < first_ || static_cast<std::uint64_t>(tag - first_) >= dense_.size()) return -1;
  return dense_[static_cast<std::size_t>(tag - first_)];
}

void NodeReader::read() {
  ValueReader values(scan_, details_.binary);
  if (details_.version_4) {
    read_version_4(values);
  } else {
    read_version_2(values);
  }
  index_nodes();
}

void NodeReader::add_tag(std::int64_t tag, std::size_t offset) {
  if (tag <= 0)
    scan_.source().fail(offset, std::to_string(tag) + " as a node tag", "a positive number");
  details_.node_tags.push_back(tag);
  mesh_.where.nodes.push_back(offset);
}

void NodeReader::read_version_2(ValueReader& values) {
  scan_.skip_space();
  const Index n = scan_.count({"the number of nodes"}, values.binary() ? 28 : 8);
  scan_.end_line({"the end of the line"});
  details_.node_tags.reserve(static_cast<std::size_t>(n));
  mesh_.where.nodes.reserve(static_cast<std::size_t>(n));
  xyz_.reserve(3 * static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    const Expected expected{"node", i, n};
    const std::size_t at = values.begin();
    add_tag(values.integer(expected), at);
    for (int k = 0; k < 3; ++k) xyz_.push_back(values.real({"a coordinate of node", i, n}));
    values.end({"the end of the line after node", i, n});
  }
}

void NodeReader::read_version_4(ValueReader& values) {
  values.begin();
  const std::size_t at = values.offset();
  const Index blocks = values.count({"the number of node blocks"}, 8, 20);
  const Index total = values.count({"the number of nodes"}, 8, 32);
  values.size({"the smallest node tag"});
  values.size({"the largest node tag"});
  values.end({"the end of the line"});
  details_.node_tags.reserve(static_cast<std::size_t>(total));
  mesh_.where.nodes.reserve(static_cast<std::size_t>(total));
  xyz_.reserve(3 * static_cast<std::size_t>(total));
  for (Index b = 0; b < blocks; ++b) read_block(values, b, blocks, total);
  const auto found = static_cast<Index>(details_.node_tags.size());
  if (found != total) {
    scan_.source().fail(at, std::to_string(total) + " as the number of nodes",
                        std::to_string(found) + ", the sum over the blocks");
  }
}

void NodeReader::read_block(ValueReader& values, Index block, Index blocks, Index total) {
  const Expected header{"node block", block, blocks};
  const std::size_t at = values.begin();
  const int dimension = values.integer(header);
  const int entity = values.integer(header);
  const int parametric = values.integer(header);
  if (dimension < 0 || dimension > 3) {
    scan_.source().fail(at, std::to_string(dimension) + " as the dimension of a node block",
                        "0 to 3");
  }
  if (parametric != 0 && parametric != 1) {
    scan_.source().fail(at, std::to_string(parametric), "0 or 1 (parametric)");
  }
  const Index n = values.count({"the number of nodes of a block"}, 8, 32);
  values.end(header);
  const auto before = static_cast<Index>(details_.node_tags.size());
  if (n > total - before) {
    scan_.source().fail(at, std::to_string(n) + " nodes in a block",
                        "at most " + std::to_string(total - before) + ", the rest of all " +
                            std::to_string(total) + " nodes");
  }
  details_.node_blocks.push_back({dimension, entity, n});
  for (Index i = 0; i < n; ++i) {
    const Expected expected{"node tag", before + i, total};
    const std::size_t offset = values.begin();
    add_tag(values.size(expected), offset);
    values.end({"the end of the line after node tag", before + i, total});
  }
  const int extra = parametric == 1 ? dimension : 0;
  parametric_ = parametric_ || extra > 0;
  for (Index i = 0; i < n; ++i) {
    const Expected expected{"coordinates of node", before + i, total};
    // From here on the line of the node is that of its coordinates, where most mistakes are.
    mesh_.where.nodes[static_cast<std::size_t>(before + i)] = values.begin();
    for (int k = 0; k < 3; ++k) xyz_.push_back(values.real(expected));
    for (int k = 0; k < extra; ++k) values.real(expected);
    values.end({"the end of the line after node", before + i, total});
  }
}

void NodeReader::index_nodes() {
  auto& tags = details_.node_tags;
  if (const auto twice = tags_.build(tags)) {
    const auto i = static_cast<std::size_t>(*twice);
    scan_.source().fail(mesh_.where.nodes[i],
                        "node tag " + std::to_string(tags[i]) + " a second time", "each tag once");
  }
  bool counted = true;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    counted = counted && tags[i] == static_cast<std::int64_t>(i) + 1;
  }
  if (counted) tags = {};
}

Shape ElementReader::find_shape(int type, std::size_t offset) const {
  for (std::size_t k = 0; k <= static_cast<std::size_t>(Shape::pyramid); ++k) {
    const auto shape = static_cast<Shape>(k);
    if (info_of(shape).type == type) return shape;
  }
  const bool high_order = type >= 8 && type <= 31;
  source().fail(
      offset,
      "element type " + std::to_string(type) + (high_order ? " (second or higher order)" : ""),
      "1 (line), 2 (triangle), 3 (quadrilateral), 4 (tetrahedron), 5 (hexahedron), "
      "6 (prism), 7 (pyramid) or 15 (point)");
}

void ElementReader::read() {
  ValueReader values(scan_, details_.binary);
  if (details_.version_4) {
    read_version_4(values);
  } else {
    read_version_2(values);
  }
  distribute();
}

void ElementReader::read_version_2(ValueReader& values) {
  scan_.skip_space();
  const Index n = scan_.count({"the number of elements"}, values.binary() ? 8 : 6);
  scan_.end_line({"the end of the line"});
  details_.items.reserve(static_cast<std::size_t>(n));
  if (values.binary()) {
    read_version_2_binary(values, n);
  } else {
    read_version_2_text(values, n);
  }
}

void ElementReader::skip_tag(ValueReader& values, int position, Item& item,
                             const Expected& expected) {
  const int tag = values.integer(expected);
  if (position == 0) item.physical = tag;
  if (position == 1) item.entity = tag;
  partitioned_ = partitioned_ || position > 1;
}

void ElementReader::read_version_2_text(ValueReader& values, Index count) {
  for (Index i = 0; i < count; ++i) {
    Record record{{0, 0, 0, 0, Shape::point}, values.begin(), {"element", i, count}};
    record.item.tag = values.integer(record.expected);
    const int type = values.integer({"type of element", i, count});
    record.item.shape = find_shape(type, record.offset);
    const int tags = values.integer({"number of tags of element", i, count});
    for (int k = 0; k < tags; ++k) skip_tag(values, k, record.item, {"tag of element", i, count});
    read_element_nodes(values, record);
    values.end({"the end of the line after element", i, count});
  }
}

void ElementReader::read_version_2_binary(ValueReader& values, Index count) {
  for (Index done = 0; done < count;) {
    const Expected header{"element block at element", done, count};
    const std::size_t at = values.begin();
    const Shape shape = find_shape(values.integer(header), at);
    const int in_block = values.integer(header);
    const int tags = values.integer(header);
    if (in_block <= 0 || in_block > count - done) {
      source().fail(at, std::to_string(in_block) + " elements in a block",
                    "1 to " + std::to_string(count - done) + ", the rest of all elements");
    }
    if (tags < 0) source().fail(at, std::to_string(tags) + " tags", "0 or more");
    for (int i = 0; i < in_block; ++i, ++done) {
      Record record{{0, 0, 0, 0, shape}, values.begin(), {"element", done, count}};
      record.item.tag = values.integer(record.expected);
      for (int k = 0; k < tags; ++k) skip_tag(values, k, record.item, record.expected);
      read_element_nodes(values, record);
    }
  }
}

void ElementReader::read_version_4(ValueReader& values) {
  const std::size_t at = values.begin();
  const Index blocks = values.count({"the number of element blocks"}, 8, 20);
  const Index total = values.count({"the number of elements"}, 4, 16);
  values.size({"the smallest element tag"});
  values.size({"the largest element tag"});
  values.end({"the end of the line"});
  details_.items.reserve(static_cast<std::size_t>(total));
  Index done = 0;
  for (Index b = 0; b < blocks; ++b) {
    const Expected header{"element block", b, blocks};
    const std::size_t begin = values.begin();
    values.integer(header);
    const int entity = values.integer(header);
    const Shape shape = find_shape(values.integer(header), begin);
    const Index n = values.count({"the number of elements of a block"}, 4, 16);
    values.end(header);
    if (n > total - done) {
      source().fail(begin, std::to_string(n) + " elements in a block",
                    "at most " + std::to_string(total - done) + ", the rest of all " +
                        std::to_string(total) + " elements");
    }
    for (Index i = 0; i < n; ++i, ++done) {
      Record record{{0, 0, entity, 0, shape}, values.begin(), {"element", done, total}};
      record.item.tag = values.size(record.expected);
      read_element_nodes(values, record);
      values.end({"the end of the line after element", done, total});
    }
  }
  if (done != total) {
    source().fail(at, std::to_string(total) + " as the number of elements",
                  std::to_string(done) + ", the sum over the blocks");
  }
}

void ElementReader::read_element_nodes(ValueReader& values, const Record& record) {
  const Index size = info_of(record.item.shape).corners;
  for (Index k = 0; k < size; ++k) {
    const std::size_t at = values.offset();
    // Nodes are 4 bytes in binary MSH 2, 8 in binary MSH 4.
    const std::int64_t tag =
        details_.version_4 ? values.size(record.expected) : values.integer(record.expected);
    const Index node = node_tags_.find(tag);
    if (node < 0) source().fail(at, "node " + std::to_string(tag), "the tag of a node in $Nodes");
    corners_.push_back(node);
  }
  details_.items.push_back(record.item);
  offsets_.push_back(record.offset);
}

/// Elements of the mesh are those of the highest dimension.
void ElementReader::distribute() {
  for (const Item& item : details_.items)
    details_.dimension = std::max(details_.dimension, info_of(item.shape).dimension);
  const std::span<const Index> all(corners_);
  std::size_t at = 0;
  const Item* last = nullptr;
  for (std::size_t i = 0; i < details_.items.size(); ++i) {
    const auto size = static_cast<std::size_t>(info_of(details_.items[i].shape).corners);
    place(i, all.subspan(at, size), last);
    at += size;
    last = &details_.items[i];
  }
  corners_ = {};
}

void ElementReader::place(std::size_t i, std::span<const Index> corners, const Item* last) {
  Item& item = details_.items[i];
  const int dimension = info_of(item.shape).dimension;
  if (dimension == 0) {
    item.index = static_cast<Index>(details_.points.size());
    details_.points.push_back(corners[0]);
  } else if (dimension < details_.dimension) {
    item.index = static_cast<Index>(details_.sides.size());
    details_.sides.emplace_back(corners);
  } else if (last != nullptr && repeats(*last, item, corners)) {
    item.index = mesh_.data.element_count() - 1;
  } else {
    item.index = mesh_.data.element_count();
    mesh_.data.add_element(element_of(item.shape), corners);
    mesh_.where.elements.push_back(offsets_[i]);
  }
}

/// MSH 2 holds an element that is in several physical groups once for each of them.
bool ElementReader::repeats(const Item& last, const Item& item,
                            std::span<const Index> corners) const {
  if (details_.version_4 || mesh_.data.element_count() == 0) return false;
  if (last.shape != item.shape || last.entity != item.entity || last.physical == item.physical) {
    return false;
  }
  const auto previous = mesh_.data.element(mesh_.data.element_count() - 1);
  return std::equal(previous.begin(), previous.end(), corners.begin(), corners.end());
}

}  // namespace winslow::io::gmsh
