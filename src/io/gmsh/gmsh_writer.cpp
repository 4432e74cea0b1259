#include <iterator>

#include "io/format/mesh_in_space.h"
#include "io/format/periodicity.h"
#include "io/gmsh/gmsh.h"
#include "io/gmsh/value_reader.h"
#include "io/text/numbers.h"

namespace winslow::io::gmsh {
namespace {

static_assert(std::endian::native == std::endian::little,
              "binary MSH files are written as they lie in memory");

/// Writes numbers as text, with blanks between, or as bytes: the counterpart of ValueReader.
class ValueWriter {
 public:
  ValueWriter(TextWriter& out, bool binary) : out_(out), binary_(binary) {}

  ValueWriter& integer(int value) { return put(value); }
  ValueWriter& size(std::int64_t value) { return put(value); }
  ValueWriter& real(double value) { return put(value); }
  void end() {
    if (!binary_) out_ << '\n';
    first_ = true;
  }
  /// End of the bytes of a section.
  void end_section() {
    if (binary_) out_ << '\n';
  }

 private:
  template <class Number>
  ValueWriter& put(Number value) {
    if (binary_) {
      out_.raw(value);
    } else {
      if (!first_) out_ << ' ';
      out_ << value;
    }
    first_ = false;
    return *this;
  }

  TextWriter& out_;
  bool binary_;
  bool first_ = true;
};

class Writer {
 public:
  Writer(std::ostream& out, const Mesh& mesh, const Details& details, bool binary)
      : out_(out),
        values_(out_, binary),
        binary_(binary),
        mesh_(mesh),
        details_(details),
        space_(mesh, &details) {}

  void write() {
    out_ << "$MeshFormat\n"
         << (details_.version_4 ? "4.1" : "2.2") << (binary_ ? " 1 8\n" : " 0 8\n");
    if (binary_) {
      out_.raw(std::int32_t{1});
      out_ << '\n';
    }
    out_ << "$EndMeshFormat\n";
    for (const auto& section : details_.sections) {
      if (!section.raw.empty()) {
        out_ << section.raw;
        continue;
      }
      out_ << '$' << section.name << '\n';
      if (section.name == "PhysicalNames") write_physical_names();
      if (section.name == "Entities") write_entities();
      if (section.name == "Nodes") details_.version_4 ? write_nodes_4() : write_nodes_2();
      if (section.name == "Elements") details_.version_4 ? write_elements_4() : write_elements_2();
      if (section.name == "Periodic") write_links();
      out_ << "$End" << section.name << '\n';
    }
  }

 private:
  void write_physical_names() {
    out_ << details_.physical_names.size() << '\n';
    for (const PhysicalName& name : details_.physical_names) {
      out_ << name.dimension << ' ' << name.tag << " \"" << name.name << "\"\n";
    }
  }

  void write_entities() {
    const EntityBoxes boxes = entity_boxes(details_, mesh_);
    for (const auto& entities : details_.entities) values_.size(count(entities));
    values_.end();
    for (std::size_t d = 0; d < 4; ++d) {
      for (std::size_t i = 0; i < details_.entities[d].size(); ++i) {
        const Entity& entity = details_.entities[d][i];
        // If the nodes' box has not changed since reading, keep the file's box (Gmsh pads boxes).
        const bool moved = boxes[d][i] && boxes[d][i] != entity.mesh_box;
        const auto& box = moved ? *boxes[d][i] : entity.box;
        values_.integer(entity.tag);
        for (std::size_t k = 0; k < box_numbers[d]; ++k) values_.real(box[k]);
        write_tags(entity.physicals);
        if (d > 0) write_tags(entity.boundary);
        values_.end();
      }
    }
    values_.end_section();
  }

  void write_tags(const std::vector<int>& tags) {
    values_.size(count(tags));
    for (const int tag : tags) values_.integer(tag);
  }

  template <class Container>
  static std::int64_t count(const Container& container) {
    return static_cast<std::int64_t>(container.size());
  }

  std::int64_t node_tag(Index node) const {
    return details_.node_tags.empty() ? node + 1
                                      : details_.node_tags[static_cast<std::size_t>(node)];
  }
  void write_point(Index node) {
    const Vec3 p = space_.node(node);
    values_.real(p.x()).real(p.y()).real(p.z());
  }

  void write_nodes_2() {
    out_ << mesh_.coordinates.size() << '\n';
    for (Index i = 0; i < mesh_.coordinates.size(); ++i) {
      values_.integer(static_cast<int>(node_tag(i)));
      write_point(i);
      values_.end();
    }
    values_.end_section();
  }

  void write_range(std::int64_t blocks, std::int64_t total, std::int64_t low, std::int64_t high) {
    values_.size(blocks).size(total).size(total > 0 ? low : 0).size(total > 0 ? high : 0);
    values_.end();
  }

  void write_nodes_4() {
    const Index n = mesh_.coordinates.size();
    std::int64_t low = 1;
    std::int64_t high = n;
    if (!details_.node_tags.empty()) {
      const auto [least, most] =
          std::minmax_element(details_.node_tags.begin(), details_.node_tags.end());
      low = *least;
      high = *most;
    }
    write_range(count(details_.node_blocks), n, low, high);
    Index first = 0;
    for (const NodeBlock& block : details_.node_blocks) {
      values_.integer(block.dimension).integer(block.entity).integer(0).size(block.count);
      values_.end();
      for (Index i = first; i < first + block.count; ++i) {
        values_.size(node_tag(i));
        values_.end();
      }
      for (Index i = first; i < first + block.count; ++i) {
        write_point(i);
        values_.end();
      }
      first += block.count;
    }
    values_.end_section();
  }

  FileCorners nodes_of(const Item& item) const {
    const std::span<const Index> nodes = details_.nodes_beside(item);
    if (nodes.empty()) return space_.element(item.index);
    return FileCorners(nodes);
  }

  void write_elements_2() {
    out_ << details_.items.size() << '\n';
    const auto& items = details_.items;
    for (std::size_t begin = 0; begin < items.size();) {
      std::size_t end = begin + 1;
      while (end < items.size() && items[end].shape == items[begin].shape) ++end;
      const int type = info_of(items[begin].shape).type;
      if (binary_) values_.integer(type).integer(static_cast<int>(end - begin)).integer(2);
      for (; begin < end; ++begin) {
        const Item& item = items[begin];
        values_.integer(static_cast<int>(item.tag));
        if (!binary_) values_.integer(type).integer(2);
        values_.integer(item.physical).integer(item.entity);
        for (const Index node : nodes_of(item)) values_.integer(static_cast<int>(node_tag(node)));
        values_.end();
      }
    }
    values_.end_section();
  }

  static bool same_block(const Item& a, const Item& b) {
    return a.shape == b.shape && a.entity == b.entity;
  }

  void write_elements_4() {
    const auto& items = details_.items;
    std::int64_t blocks = 0;
    std::int64_t low = items.empty() ? 0 : items[0].tag;
    std::int64_t high = low;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i == 0 || !same_block(items[i], items[i - 1])) ++blocks;
      low = std::min(low, items[i].tag);
      high = std::max(high, items[i].tag);
    }
    write_range(blocks, count(items), low, high);
    for (std::size_t begin = 0; begin < items.size();) {
      std::size_t end = begin + 1;
      while (end < items.size() && same_block(items[end], items[begin])) ++end;
      const ShapeInfo& shape = info_of(items[begin].shape);
      values_.integer(shape.dimension).integer(items[begin].entity);
      values_.integer(shape.type).size(static_cast<std::int64_t>(end - begin));
      values_.end();
      for (; begin < end; ++begin) {
        values_.size(items[begin].tag);
        for (const Index node : nodes_of(items[begin])) values_.size(node_tag(node));
        values_.end();
      }
    }
    values_.end_section();
  }

  void write_links() {
    ValueWriter values(out_, binary_ && details_.version_4);  // text in MSH 2
    values.size(count(details_.links)).end();
    for (const PeriodicLink& link : details_.links) {
      values.integer(link.dimension).integer(link.entity).integer(link.master).end();
      if (details_.version_4) {
        values.size(count(link.affine));
        for (const double value : link.affine) values.real(value);
        values.end();
      } else if (!link.affine.empty()) {
        out_ << "Affine";
        for (const double value : link.affine) out_ << ' ' << value;
        out_ << '\n';
      }
      values.size(count(link.nodes)).end();
      for (const auto& [node, master] : link.nodes) values.size(node).size(master).end();
    }
    values.end_section();
  }

  TextWriter out_;
  ValueWriter values_;
  bool binary_;
  const Mesh& mesh_;
  const Details& details_;
  MeshInSpace space_;
};

}  // namespace

std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                               const WriteOptions& options) {
  std::vector<std::string> warnings;
  const auto* details = dynamic_cast<const Details*>(source);
  const bool newest = details == nullptr || details->version_4;
  const bool version_4 = options.gmsh_version.empty() ? newest : options.gmsh_version == "4.1";
  const bool same_version = details != nullptr && details->version_4 == version_4;
  // Partitions are bytes in one encoding.
  const bool cut = same_version && details->binary != options.binary &&
                   std::ranges::any_of(details->parts, [](const auto& of) { return !of.empty(); });
  const bool kept = same_version && !cut && details->fits(mesh);
  if (details != nullptr && !kept) {
    warnings.emplace_back(
        cut            ? "another encoding than the source's: partitions, entities and tags are "
                         "not written"
        : same_version ? "the mesh has changed: entities, tags and unknown sections of the "
                         "source are not written"
                       : "another MSH version than the source's: entities, tags, points and "
                         "unknown sections are "
                         "not written");
  }
  if (kept) warnings = stale_pairs(*details, mesh);
  if (kept && details->binary != options.binary) {
    // Unknown sections are bytes in one encoding and cannot be converted to the other.
    Details converted = *details;
    for (auto& section : converted.sections)
      if (section.name == "Periodic") section.raw.clear();
    const auto removed = std::erase_if(
        converted.sections, [](const auto& s) { return !s.raw.empty() && s.name != "Comments"; });
    if (removed > 0) warnings.emplace_back("unknown sections are not converted and not written");
    Writer(out, mesh, converted, options.binary).write();
    return warnings;
  }
  if (kept) {
    Writer(out, mesh, *details, options.binary).write();
  } else {
    Details made = make_details(mesh, version_4, warnings);
    if (source != nullptr) {
      made.plane_z = source->plane_z;
      made.plane = source->plane;
      made.links = links_of(*source, mesh);
      if (!made.links.empty()) made.sections.push_back({"Periodic", {}});
      const auto side = [](const GivenPairs& given) { return !given.halo; };
      if (source->periodic &&
          std::ranges::count_if(source->periodic->pairs, side) > std::ssize(made.links))
        warnings.push_back("periodic pairs of the source (" + named_pairs(*source->periodic) +
                           ") are not written" +
                           (made.links.empty() ? "" : " where nodes do not match"));
    }
    Writer(out, mesh, made, options.binary).write();
  }
  return warnings;
}

}  // namespace winslow::io::gmsh
