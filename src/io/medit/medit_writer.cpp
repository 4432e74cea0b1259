#include <algorithm>

#include "core/index.h"
#include "io/format/groups.h"
#include "io/format/mesh_in_space.h"
#include "io/medit/medit.h"
#include "io/text/text_writer.h"

namespace winslow::io::medit {
namespace {

using Part = Details::Section::Part;

/// The elements of the mesh in the order in which they are written.
using Order = std::vector<Index>;

class Writer {
 public:
  /// element_order: empty, if sections are ranges of the elements.
  Writer(std::ostream& out, const Mesh& mesh, const Details& details, const FormatDetails* place,
         Order element_order)
      : out_(out),
        mesh_(mesh),
        details_(details),
        space_(mesh, place),
        order_(std::move(element_order)) {}

  void write() {
    out_ << "MeshVersionFormatted " << std::max(details_.version, 2) << '\n';
    for (const auto& section : details_.sections) write(section);
    out_ << "End\n";
  }

 private:
  void write(const Details::Section& section) {
    switch (section.part) {
      case Part::raw:
        out_ << section.raw;
        break;
      case Part::dimension:
        out_ << "Dimension " << details_.dimension << '\n';
        break;
      case Part::vertices:
        write_vertices();
        break;
      case Part::cells:
        write_cells(section);
        break;
    }
  }

  void write_vertices() {
    out_ << "Vertices\n" << mesh_.coordinates.size() << '\n';
    const auto& references = details_.vertex_references;
    for (Index i = 0; i < mesh_.coordinates.size(); ++i) {
      const Vec3 p = space_.node(i);
      out_ << p.x() << ' ' << p.y() << ' ';
      if (details_.dimension == 3) out_ << p.z() << ' ';
      out_ << (references.empty() ? 0 : references[at(i)]) << '\n';
    }
  }

  void write_cells(const Details::Section& section) {
    out_ << section.kind->keyword << '\n' << section.count << '\n';
    const bool element = section.kind->dimension == details_.cell_dimension;
    for (Index k = section.first; k < section.first + section.count; ++k) {
      if (element) {
        const Index e = order_.empty() ? k : order_[at(k)];
        for (const Index node : space_.element(e)) out_ << node + 1 << ' ';
        out_ << details_.element_references[at(e)] << '\n';
      } else {
        for (const Index node : details_.sides[at(k)]) out_ << node + 1 << ' ';
        out_ << details_.side_references[at(k)] << '\n';
      }
    }
  }

  TextWriter out_;
  const Mesh& mesh_;
  const Details& details_;
  MeshInSpace space_;
  Order order_;
};

/// What is written of a mesh from another format.
struct Prepared {
  Details details;
  Order order;
};

std::vector<int> element_references(const Topology& topology, const std::vector<int>& tags) {
  std::vector<int> references(at(topology.element_count()), 0);
  const auto of = topology.element_regions();
  for (std::size_t e = 0; e < of.size(); ++e) {
    if (of[e] >= 0) references[e] = tags[at(of[e])];
  }
  return references;
}

void add_sides(const Markers& markers, const std::vector<int>& tags, const Kind& kind,
               Details& details) {
  const auto first = static_cast<Index>(details.sides.size());
  for (std::size_t m = 0; m < tags.size(); ++m) {
    for (const Face& face : markers[m].faces) {
      if (face.size() != kind.corners) continue;
      details.sides.push_back(face);
      details.side_references.push_back(tags[m]);
    }
  }
  const auto count = static_cast<Index>(details.sides.size()) - first;
  if (count > 0) details.sections.push_back({Part::cells, {}, &kind, first, count});
}

void add_elements(const Topology& topology, const Kind& kind, Prepared& made) {
  const auto first = static_cast<Index>(made.order.size());
  for (Index e = 0; e < topology.element_count(); ++e) {
    if (topology.element_type(e) == *kind.type) made.order.push_back(e);
  }
  const auto count = static_cast<Index>(made.order.size()) - first;
  if (count > 0) made.details.sections.push_back({Part::cells, {}, &kind, first, count});
}

/// Comments that hold names: they end with their line.
std::string name_lines(const char* what, std::span<const std::string> names,
                       const std::vector<int>& tags) {
  std::string lines;
  for (std::size_t k = 0; k < tags.size(); ++k) {
    std::string name = names[k];
    for (char& c : name) c = static_cast<unsigned char>(c) < ' ' ? '_' : c;
    lines += std::string("# ") + what + ' ' + std::to_string(tags[k]) + ' ' + name + '\n';
  }
  return lines;
}

template <class Group>
std::vector<std::string> names_of(const std::vector<Group>& groups) {
  std::vector<std::string> names;
  for (const Group& group : groups) names.push_back(group.name);
  return names;
}

Prepared prepare(const Mesh& mesh, const FormatDetails* source, const std::vector<int>& marker_tags,
                 const std::vector<int>& region_tags) {
  const Topology& topology = *mesh.topology;
  Prepared made;
  Details& details = made.details;
  details.cell_dimension = topology.cell_dimension();
  const bool in_space = source != nullptr && (source->plane || !source->plane_z.empty());
  details.dimension = topology.space_dimension() == 3 || in_space ? 3 : 2;
  details.element_references = element_references(topology, region_tags);
  details.sections = {{Part::dimension, {}}};
  const std::string names = name_lines("marker", names_of(topology.markers().list()), marker_tags) +
                            name_lines("region", names_of(topology.regions()), region_tags);
  if (!names.empty()) details.sections.push_back({Part::raw, names});
  details.sections.push_back({Part::vertices, {}});
  for (const Kind& kind : kinds()) {
    if (kind.dimension == details.cell_dimension) add_elements(topology, kind, made);
    if (kind.dimension == details.cell_dimension - 1)
      add_sides(topology.markers(), marker_tags, kind, details);
  }
  return made;
}

}  // namespace

std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* source) {
  std::vector<std::string> warnings;
  const auto* own = dynamic_cast<const Details*>(source);
  if (own != nullptr && own->fits(mesh)) {
    Writer(out, mesh, *own, own, {}).write();
    return warnings;
  }
  const Topology& topology = *mesh.topology;
  std::vector<int> marker_tags;
  if (topology.markers().from_file())
    marker_tags = usable_tags(tags_of(topology.markers().list()), "markers", warnings);
  const auto region_tags = usable_tags(tags_of(topology.regions()), "regions", warnings);
  const Prepared made = prepare(mesh, source, marker_tags, region_tags);
  if (!std::ranges::is_sorted(made.order)) {
    warnings.emplace_back("Medit holds elements by type: their order has changed");
  }
  if (own != nullptr)
    warnings.emplace_back("the mesh has changed: other sections of the source are not written");
  Writer(out, mesh, made.details, source, made.order).write();
  return warnings;
}

}  // namespace winslow::io::medit
