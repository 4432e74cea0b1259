#include <set>

#include "io/format/foreign_formats.h"
#include "io/gmsh/gmsh.h"
#include "io/gmsh/value_reader.h"
#include "io/text/numbers.h"

namespace winslow::io::gmsh {

std::optional<Index> NodeTags::build(const std::vector<std::int64_t>& tags) {
  if (tags.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(tags.begin(), tags.end());
  // The reader accepts only positive tags, so the difference cannot overflow.
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

namespace {

/// Reads $Nodes.
class NodeReader {
 public:
  /// Reads into `details` and `mesh`; these and the scanner must outlive the reader.
  NodeReader(Scanner& scan, Details& details, ParsedMesh& mesh)
      : scan_(scan), details_(details), mesh_(mesh) {}

  void read() {
    ValueReader values(scan_, details_.binary);
    if (details_.version_4) {
      read_version_4(values);
    } else {
      read_version_2(values);
    }
    index_nodes();
  }

  const NodeTags& tags() const { return tags_; }
  /// x, y, z of each node.
  const std::vector<double>& xyz() const { return xyz_; }
  /// True if some nodes have parametric coordinates, which are not kept.
  bool parametric() const { return parametric_; }

 private:
  void read_version_2(ValueReader& values) {
    scan_.skip_space();
    const Index n = scan_.count({"the number of nodes"}, values.binary() ? 28 : 8);
    scan_.end_line({"the end of the line"});
    details_.node_tags.reserve(static_cast<std::size_t>(n));
    mesh_.where.nodes.reserve(static_cast<std::size_t>(n));
    xyz_.reserve(3 * static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) {
      const Expected expected{"node", i, n};
      const std::size_t start = values.begin();
      add_tag(values.integer(expected), start);
      for (int k = 0; k < 3; ++k) xyz_.push_back(values.real({"a coordinate of node", i, n}));
      values.end({"the end of the line after node", i, n});
    }
  }

  void read_version_4(ValueReader& values) {
    values.begin();
    const std::size_t start = values.offset();
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
      source().fail(start, std::to_string(total) + " as the number of nodes",
                    std::to_string(found) + ", the sum over the blocks");
    }
  }

  void read_block(ValueReader& values, Index block, Index blocks, Index total) {
    const Expected header{"node block", block, blocks};
    const std::size_t start = values.begin();
    const int dimension = values.integer(header);
    const int entity = values.integer(header);
    const int parametric = values.integer(header);
    if (dimension < 0 || dimension > 3) {
      source().fail(start, std::to_string(dimension) + " as the dimension of a node block",
                    "0 to 3");
    }
    if (parametric != 0 && parametric != 1) {
      source().fail(start, std::to_string(parametric), "0 or 1 (parametric)");
    }
    const Index n = values.count({"the number of nodes of a block"}, 8, 32);
    values.end(header);
    const auto before = static_cast<Index>(details_.node_tags.size());
    if (n > total - before) {
      source().fail(start, std::to_string(n) + " nodes in a block",
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
      // From now on errors name the line of the node's coordinates, where most mistakes are.
      mesh_.where.nodes[static_cast<std::size_t>(before + i)] = values.begin();
      for (int k = 0; k < 3; ++k) xyz_.push_back(values.real(expected));
      for (int k = 0; k < extra; ++k) values.real(expected);
      values.end({"the end of the line after node", before + i, total});
    }
  }

  void add_tag(std::int64_t tag, std::size_t offset) {
    if (tag <= 0)
      source().fail(offset, std::to_string(tag) + " as a node tag", "a positive number");
    details_.node_tags.push_back(tag);
    mesh_.where.nodes.push_back(offset);
  }

  void index_nodes() {
    auto& tags = details_.node_tags;
    if (const auto twice = tags_.build(tags)) {
      const auto i = static_cast<std::size_t>(*twice);
      source().fail(mesh_.where.nodes[i], "node tag " + std::to_string(tags[i]) + " a second time",
                    "each tag once");
    }
    bool counted = true;
    for (std::size_t i = 0; i < tags.size(); ++i) {
      counted = counted && tags[i] == static_cast<std::int64_t>(i) + 1;
    }
    if (counted) tags = {};
  }

  const Source& source() const { return scan_.source(); }

  Scanner& scan_;
  Details& details_;
  ParsedMesh& mesh_;
  NodeTags tags_;
  std::vector<double> xyz_;
  bool parametric_ = false;
};

/// Reads $Elements.
class ElementReader {
 public:
  /// Reads into `details` and `mesh`; these, the scanner and the node tags must outlive the reader.
  ElementReader(Scanner& scan, const NodeTags& node_tags, Details& details, ParsedMesh& mesh)
      : scan_(scan), node_tags_(node_tags), details_(details), mesh_(mesh) {}

  void read() {
    ValueReader values(scan_, details_.binary);
    if (details_.version_4) {
      read_version_4(values);
    } else {
      read_version_2(values);
    }
    distribute();
  }

  /// Byte offset of each of Details::items in the file.
  const std::vector<std::size_t>& offsets() const { return offsets_; }
  /// True if some elements belong to partitions, which are not kept.
  bool partitioned() const { return partitioned_; }

 private:
  struct Record {
    Item item;
    std::size_t offset;
    Expected expected;
  };

  void read_version_2(ValueReader& values) {
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

  void read_version_2_text(ValueReader& values, Index count) {
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

  void read_version_2_binary(ValueReader& values, Index count) {
    for (Index done = 0; done < count;) {
      const Expected header{"element block at element", done, count};
      const std::size_t start = values.begin();
      const Shape shape = find_shape(values.integer(header), start);
      const int in_block = values.integer(header);
      const int tags = values.integer(header);
      if (in_block <= 0 || in_block > count - done) {
        source().fail(start, std::to_string(in_block) + " elements in a block",
                      "1 to " + std::to_string(count - done) + ", the rest of all elements");
      }
      if (tags < 0) source().fail(start, std::to_string(tags) + " tags", "0 or more");
      for (int i = 0; i < in_block; ++i, ++done) {
        Record record{{0, 0, 0, 0, shape}, values.begin(), {"element", done, count}};
        record.item.tag = values.integer(record.expected);
        for (int k = 0; k < tags; ++k) skip_tag(values, k, record.item, record.expected);
        read_element_nodes(values, record);
      }
    }
  }

  void read_version_4(ValueReader& values) {
    const std::size_t start = values.begin();
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
      source().fail(start, std::to_string(total) + " as the number of elements",
                    std::to_string(done) + ", the sum over the blocks");
    }
  }

  Shape find_shape(int type, std::size_t offset) const {
    for (std::size_t k = 0; k <= static_cast<std::size_t>(Shape::pyramid); ++k) {
      const auto shape = static_cast<Shape>(k);
      if (info_of(shape).type == type) return shape;
    }
    const bool high_order = type >= 8 && type <= 31;
    source().fail(
        offset,
        "element type " + std::to_string(type) + (high_order ? " (second or higher order)" : ""),
        std::string("1 (line), 2 (triangle), 3 (quadrilateral), 4 (tetrahedron), 5 (hexahedron), "
                    "6 (prism), 7 (pyramid) or 15 (point)") +
            (high_order ? first_order_hint(source().name()) : ""));
  }

  void skip_tag(ValueReader& values, int position, Item& item, const Expected& expected) {
    const int tag = values.integer(expected);
    if (position == 0) item.physical = tag;
    if (position == 1) item.entity = tag;
    partitioned_ = partitioned_ || position > 1;
  }

  void read_element_nodes(ValueReader& values, const Record& record) {
    const Index size = info_of(record.item.shape).corners;
    for (Index k = 0; k < size; ++k) {
      const std::size_t start = values.offset();
      // Nodes are 4 bytes in binary MSH 2, 8 in binary MSH 4.
      const std::int64_t tag =
          details_.version_4 ? values.size(record.expected) : values.integer(record.expected);
      const Index node = node_tags_.find(tag);
      if (node < 0)
        source().fail(start, "node " + std::to_string(tag), "the tag of a node in $Nodes");
      corners_.push_back(node);
    }
    details_.items.push_back(record.item);
    offsets_.push_back(record.offset);
  }

  /// Sorts the items: those of the highest dimension become the elements of the mesh.
  void distribute() {
    for (const Item& item : details_.items)
      details_.dimension = std::max(details_.dimension, info_of(item.shape).dimension);
    const std::span<const Index> all(corners_);
    std::size_t start = 0;
    const Item* last = nullptr;
    for (std::size_t i = 0; i < details_.items.size(); ++i) {
      const auto size = static_cast<std::size_t>(info_of(details_.items[i].shape).corners);
      place(i, all.subspan(start, size), last);
      start += size;
      last = &details_.items[i];
    }
    corners_ = {};
  }

  void place(std::size_t i, std::span<const Index> corners, const Item* last) {
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

  /// True if an item repeats the last one: MSH 2 lists an element once for each of its physical
  /// groups.
  bool repeats(const Item& last, const Item& item, std::span<const Index> corners) const {
    if (details_.version_4 || mesh_.data.element_count() == 0) return false;
    if (last.shape != item.shape || last.entity != item.entity || last.physical == item.physical) {
      return false;
    }
    const auto previous = mesh_.data.element(mesh_.data.element_count() - 1);
    return std::equal(previous.begin(), previous.end(), corners.begin(), corners.end());
  }

  const Source& source() const { return scan_.source(); }

  Scanner& scan_;
  const NodeTags& node_tags_;
  Details& details_;
  ParsedMesh& mesh_;
  std::vector<std::size_t> offsets_;
  std::vector<Index> corners_;  // of all items; the elements among them are known only at the end
  bool partitioned_ = false;
};

/// Reads the sections of one MSH file in their order.
class Reader {
 public:
  explicit Reader(Source& source) : source_(source), scan_(source) { mesh_.details = details_; }

  ParsedMesh read() {
    read_header();
    for (scan_.skip_space(); !scan_.at_end(); scan_.skip_space()) read_section();
    finish();
    return std::move(mesh_);
  }

 private:
  void read_header() {
    scan_.skip_space();
    const std::size_t begin = scan_.offset();
    const auto first = trimmed(scan_.line());
    if (first == "$NOD") source_.fail(begin, "$NOD (MSH 1)", "MSH 2.2 or 4.1");
    if (first == "$Comments") {
      read_raw("Comments", begin);
      return read_header();
    }
    if (first != "$MeshFormat") source_.fail(begin, in_quotes(first), "$MeshFormat");
    const auto version = scan_.next_word();
    const auto number = parse_number(version);
    const bool version_2 = number && *number >= 2 && *number < 3;
    if (!version_2 && version != "4.1") {
      scan_.fail(version, "MSH version 2.2 or 4.1 (Gmsh saves it with -format msh41)");
    }
    details_->version_4 = !version_2;
    const auto type = scan_.integer({"0 (ASCII) or 1 (binary)"});
    if (type != 0 && type != 1) {
      source_.fail(begin, std::to_string(type) + " as file type", "0 (ASCII) or 1 (binary)");
    }
    details_->binary = type == 1;
    const auto size = scan_.word();
    if (size != "8") scan_.fail(size, "8 as the size of a number");
    scan_.end_line({"the end of the line"});
    if (details_->binary) {
      const std::size_t start = scan_.offset();
      source_.set_binary_from(start);
      ValueReader values(scan_, true);
      const int one = values.integer({"the integer 1"});
      if (one == 0x01000000) {
        source_.fail(start, "numbers in big-endian byte order",
                     "little-endian (save the file as ASCII)");
      }
      if (one != 1)
        source_.fail(start, std::to_string(one), "the integer 1, which tells the byte order");
    }
    end_section("MeshFormat");
  }

  void read_section() {
    const std::size_t begin = scan_.offset();
    const auto line = trimmed(scan_.line());
    if (line.size() < 2 || line[0] != '$' || line.starts_with("$End")) {
      source_.fail(begin, in_quotes(line), "the start of a section, such as $Nodes");
    }
    const std::string name(line.substr(1));
    const bool known = name == "PhysicalNames" || name == "Entities" || name == "Nodes" ||
                       name == "Elements" || name == "Periodic" || name == "PartitionedEntities";
    if (known && seen(name)) source_.fail(begin, "a second section $" + name, "one only");
    if (name == "ParametricNodes") {
      source_.fail(begin, "$ParametricNodes", "$Nodes (save without parametric coordinates)");
    }
    if (!known) return read_raw(name, begin);
    details_->sections.push_back({name, {}});
    if (name == "PhysicalNames") read_physical_names();
    if (name == "Entities") read_entities(scan_, *details_);
    if (name == "Nodes") nodes_.read();
    if (name == "Elements") {
      if (!seen("Nodes")) source_.fail(scan_.offset(), "$Elements before $Nodes", "$Nodes first");
      elements_.read();
    }
    const bool kept = name == "Periodic" || name == "PartitionedEntities";
    if (name == "Periodic")
      details_->links = read_links(scan_, details_->version_4, details_->binary);
    if (name == "PartitionedEntities") partitions_ = read_parts(scan_, *details_);
    if (kept) {
      end_section(name);
      // Keep the bytes, to write them back unchanged.
      details_->sections.back().raw = source_.text().substr(begin, scan_.offset() - begin);
      return;
    }
    end_section(name);
  }

  void read_raw(const std::string& name, std::size_t begin) {
    const std::string end = "$End" + name;
    const auto text = source_.text();
    auto start = text.find(end, begin);
    while (start != std::string_view::npos && text[start - 1] != '\n')
      start = text.find(end, start + 1);
    if (start == std::string_view::npos) {
      source_.fail(begin, "section $" + name + " without end", end);
    }
    scan_.seek(start);
    scan_.line();
    details_->sections.push_back(
        {name, std::string(text.substr(begin, start - begin)) + end + "\n"});
    if (name != "Comments") {
      mesh_.warnings.push_back("section $" + name + " is not understood; it is kept as it is");
    }
  }

  void read_physical_names() {
    scan_.skip_space();
    const Index n = scan_.count({"the number of physical names"}, 6);
    scan_.end_line({"the end of the line"});
    for (Index i = 0; i < n; ++i) {
      scan_.skip_space();
      const std::size_t start = scan_.offset();
      ValueReader values(scan_, false);
      PhysicalName entry{};
      entry.dimension = values.integer({"dimension of physical name", i, n});
      entry.tag = values.integer({"tag of physical name", i, n});
      if (entry.dimension < 0 || entry.dimension > 3) {
        source_.fail(start, std::to_string(entry.dimension), "a dimension from 0 to 3");
      }
      const auto rest = trimmed(scan_.line());
      if (rest.size() < 2 || rest.front() != '"' || rest.back() != '"') {
        source_.fail(start, rest.empty() ? "the end of the line" : in_quotes(rest),
                     "a name in quotes");
      }
      entry.name = rest.substr(1, rest.size() - 2);
      if (!named_groups_.emplace(entry.dimension, entry.tag).second) {
        source_.fail(start, "a second name for physical group " + std::to_string(entry.tag),
                     "one only");
      }
      details_->physical_names.push_back(std::move(entry));
    }
  }

  void end_section(const std::string& name) {
    scan_.skip_space();
    const auto word = scan_.word();
    if (word != "$End" + name) scan_.fail(word, "$End" + name);
    scan_.end_line({"the end of the line"});
  }

  bool seen(std::string_view section) const {
    return std::any_of(details_->sections.begin(), details_->sections.end(),
                       [&](const auto& s) { return s.name == section; });
  }

  void finish() {
    const std::size_t end = source_.text().size();
    if (!seen("Nodes")) source_.fail(end, "no section $Nodes", "the nodes of the mesh");
    if (!seen("Elements")) source_.fail(end, "no section $Elements", "the elements of the mesh");
    set_nodes(source_, nodes_.xyz(), mesh_);
    collect_groups(elements_.offsets(), *details_, mesh_);
    details_->periodic = std::make_shared<GivenPeriodicity>();
    details_->periodic->pairs = pairs_of(source_, *details_, nodes_.tags(), mesh_.data);
    if (nodes_.parametric()) {
      mesh_.warnings.emplace_back("parametric coordinates of nodes are not kept");
    }
    if (partitions_ > 0) {
      mesh_.warnings.push_back("the file has " + std::to_string(partitions_) +
                               " partitions: read as one mesh, they are kept as they are");
    }
    if (elements_.partitioned()) {
      mesh_.warnings.emplace_back("the partitions of elements are not kept");
    }
    if (details_->version_4) {
      const EntityBoxes boxes = entity_boxes(*details_, mesh_.data);
      for (std::size_t d = 0; d < 4; ++d) {
        auto& entities = details_->entities[d];
        for (std::size_t i = 0; i < entities.size(); ++i) entities[i].mesh_box = boxes[d][i];
      }
    }
  }

  Source& source_;
  Scanner scan_;
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  NodeReader nodes_{scan_, *details_, mesh_};
  ElementReader elements_{scan_, nodes_.tags(), *details_, mesh_};
  std::int64_t partitions_ = 0;
  std::set<std::pair<int, int>> named_groups_;  ///< dimension and tag
};

}  // namespace

ParsedMesh read(Source& source) { return Reader(source).read(); }

}  // namespace winslow::io::gmsh
