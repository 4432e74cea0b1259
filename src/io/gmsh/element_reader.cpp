#include "io/gmsh/element_reader.h"

#include <algorithm>

namespace winslow::io::gmsh {
namespace {

Index node_count(Shape shape) { return static_cast<Index>(shape) + 1; }

}  // namespace

Shape ElementReader::shape_of(int type, std::size_t offset) const {
  switch (type) {
    case 1:
      return Shape::line;
    case 2:
      return Shape::triangle;
    case 3:
      return Shape::quadrilateral;
    case 15:
      return Shape::point;
    default:
      break;
  }
  const bool solid = (type >= 4 && type <= 7) || type == 11 || type == 12 || type == 13 ||
                     type == 14 || (type >= 17 && type <= 19);
  const bool high_order = (type >= 8 && type <= 10) || type == 16 || (type >= 20 && type <= 28);
  source().fail(offset,
                "element type " + std::to_string(type) +
                    (solid        ? " (a 3D mesh)"
                     : high_order ? " (second or higher order)"
                                  : ""),
                "1 (line), 2 (triangle), 3 (quadrilateral) or 15 (point)");
}

void ElementReader::read() {
  ValueReader values(scan_, details_.binary);
  if (details_.version_4) return read_version_4(values);
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
    record.item.shape = shape_of(type, record.offset);
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
    const Shape shape = shape_of(values.integer(header), at);
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
    const Shape shape = shape_of(values.integer(header), begin);
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
  Item item = record.item;
  std::array<Index, 4> corners{};
  const Index size = node_count(item.shape);
  for (Index k = 0; k < size; ++k) {
    const std::size_t at = values.offset();
    // Nodes are 4 bytes in binary MSH 2, 8 in binary MSH 4.
    const std::int64_t tag =
        details_.version_4 ? values.size(record.expected) : values.integer(record.expected);
    const Index node = node_tags_.find(tag);
    if (node < 0) source().fail(at, "node " + std::to_string(tag), "the tag of a node in $Nodes");
    corners[static_cast<std::size_t>(k)] = node;
  }
  const std::span<const Index> nodes(corners.data(), static_cast<std::size_t>(size));
  if (item.shape == Shape::point) {
    item.index = static_cast<Index>(details_.points.size());
    details_.points.push_back(nodes[0]);
  } else if (item.shape == Shape::line) {
    item.index = static_cast<Index>(details_.lines.size());
    details_.lines.push_back({nodes[0], nodes[1]});
  } else if (repeats_last_element(nodes, item)) {
    item.index = mesh_.data.element_count() - 1;
  } else {
    item.index = mesh_.data.element_count();
    const bool triangle = item.shape == Shape::triangle;
    mesh_.data.add_element(triangle ? ElementType::triangle : ElementType::quadrilateral, nodes);
    mesh_.where.elements.push_back(record.offset);
  }
  details_.items.push_back(item);
  offsets_.push_back(record.offset);
}

/// MSH 2 holds an element that is in several physical groups once for each of them.
bool ElementReader::repeats_last_element(std::span<const Index> corners, const Item& item) const {
  if (details_.version_4 || details_.items.empty() || mesh_.data.element_count() == 0) return false;
  const Item& last = details_.items.back();
  if (last.shape != item.shape || last.entity != item.entity || last.physical == item.physical) {
    return false;
  }
  const auto previous = mesh_.data.element(mesh_.data.element_count() - 1);
  return std::equal(previous.begin(), previous.end(), corners.begin(), corners.end());
}

}  // namespace winslow::io::gmsh
