#include "io/gmsh/node_reader.h"

namespace winslow::io::gmsh {

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

}  // namespace winslow::io::gmsh
