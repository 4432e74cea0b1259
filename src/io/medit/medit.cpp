#include "io/medit/medit.h"

#include <set>

#include "core/types.h"
#include "io/format/foreign_formats.h"
#include "io/format/mesh_in_space.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io::medit {

std::span<const Kind> kinds() {
  static constexpr std::array<Kind, 7> all{{{"Edges", std::nullopt, 2, 1},
                                            {"Triangles", ElementType::triangle, 3, 2},
                                            {"Quadrilaterals", ElementType::quadrilateral, 4, 2},
                                            {"Tetrahedra", ElementType::tetrahedron, 4, 3},
                                            {"Pyramids", ElementType::pyramid, 5, 3},
                                            {"Prisms", ElementType::prism, 6, 3},
                                            {"Hexahedra", ElementType::hexahedron, 8, 3}}};
  return all;
}

namespace {

using Part = Details::Section::Part;

bool is_keyword(std::string_view word) {
  return !word.empty() &&
         ((word[0] >= 'A' && word[0] <= 'Z') || (word[0] >= 'a' && word[0] <= 'z'));
}

class Reader {
 public:
  explicit Reader(Source& source) : source_(source), scan_(source) { mesh_.details = details_; }

  ParsedMesh read() {
    find_cell_dimension();
    read_version();
    for (auto word = next_word(); !word.empty() && word != "End"; word = next_word())
      read_section(word);
    finish();
    return std::move(mesh_);
  }

 private:
  /// The next word that is no comment; comments give the names of groups.
  std::string_view next_word() {
    for (;;) {
      const auto word = scan_.next_word();
      if (word.empty() || word.front() != '#') return word;
      scan_.seek(source_.offset_of(word) + 1);
      read_name(trimmed(scan_.line()));
    }
  }

  void read_name(std::string_view comment) {
    const auto blank = comment.find(' ');
    if (blank == std::string_view::npos) return;
    const auto what = comment.substr(0, blank);
    if (what != "marker" && what != "region") return;
    const auto rest = trimmed(comment.substr(blank));
    const auto end = std::min(rest.find(' '), rest.size());
    const auto tag = parse_integer(rest.substr(0, end));
    const auto name = trimmed(rest.substr(end));
    if (!tag || *tag != static_cast<int>(*tag) || name.empty()) return;
    GroupIndex& groups = what == "marker" ? markers_ : regions_;
    if (groups.contains(static_cast<int>(*tag))) return;
    groups.add(static_cast<int>(*tag), std::string(name));
    details_->sections.push_back({Part::raw, "# " + std::string(comment) + "\n"});
  }

  /// Looks ahead at the later sections, which decide whether triangles are elements or sides.
  void find_cell_dimension() {
    details_->cell_dimension = 2;
    for (const Kind& kind : kinds()) {
      if (kind.dimension < 3) continue;
      const auto text = source_.text();
      for (auto start = text.find(kind.keyword); start != std::string_view::npos;
           start = text.find(kind.keyword, start + 1)) {
        const std::size_t begin = line_begin(text, start);
        if (!trimmed(text.substr(begin, start - begin)).empty()) continue;
        Scanner scan(source_, start);
        scan.word();
        const auto count = parse_integer(scan.next_word());
        if (count && *count > 0) details_->cell_dimension = 3;
      }
    }
  }

  std::int64_t integer(const Expected& expected) {
    word_ = next_word();
    const auto value = parse_integer(word_);
    if (!value) scan_.fail(word_, expected);
    return *value;
  }
  int reference(const Expected& expected) {
    const std::int64_t value = integer(expected);
    if (value != static_cast<int>(value)) scan_.fail(word_, expected);
    return static_cast<int>(value);
  }
  Index count(const Expected& expected, std::size_t bytes_each) {
    const std::int64_t value = integer(expected);
    return checked_count(source_, source_.offset_of(word_), value, bytes_each, scan_.bytes_left(),
                         expected);
  }

  void read_version() {
    const auto word = next_word();
    if (word != "MeshVersionFormatted") scan_.fail(word, "MeshVersionFormatted");
    const std::size_t start = scan_.offset();
    const std::int64_t version = integer({"the version: 1, 2, 3 or 4"});
    if (version < 1 || version > 4)
      source_.fail(start, std::to_string(version) + " as version", "1, 2, 3 or 4");
    details_->version = static_cast<int>(version);
  }

  bool has_section(Part part) const {
    return std::ranges::any_of(details_->sections, [&](const auto& s) { return s.part == part; });
  }

  void read_section(std::string_view word) {
    if (!is_keyword(word)) scan_.fail(word, "a keyword, such as Vertices or Tetrahedra");
    if (!keywords_.insert(std::string(word)).second) scan_.fail(word, "each keyword once");
    if (word == "Dimension") return read_dimension(word);
    if (word == "Vertices") return read_vertices(word);
    for (const Kind& kind : kinds()) {
      if (word == kind.keyword) return read_cells(word, kind);
    }
    keep_unknown(word);
  }

  void read_dimension(std::string_view word) {
    const std::int64_t dimension = integer({"the dimension: 2 or 3"});
    if (dimension != 2 && dimension != 3) {
      source_.fail(source_.offset_of(word), "Dimension " + std::to_string(dimension), "2 or 3");
    }
    details_->dimension = static_cast<int>(dimension);
    details_->sections.push_back({Part::dimension, {}});
  }

  void read_vertices(std::string_view word) {
    if (!has_section(Part::dimension)) scan_.fail(word, "Dimension before it");
    const Index n = count({"the number of vertices"}, 6);
    for (Index i = 0; i < n; ++i) {
      for (int k = 0; k < details_->dimension; ++k) {
        const auto number = next_word();
        const auto value = parse_number(number);
        if (!value) scan_.fail(number, Expected{"a coordinate of vertex", i, n});
        if (k == 0) mesh_.where.nodes.push_back(source_.offset_of(number));
        xyz_.push_back(*value);
      }
      xyz_.resize(3 * at(i + 1));  // z is 0 if the file has none
      details_->vertex_references.push_back(reference({"the reference of vertex", i, n}));
    }
    details_->sections.push_back({Part::vertices, {}});
  }

  void read_cells(std::string_view word, const Kind& kind) {
    const Index n = count({"the number of entries"}, 2 * (kind.corners + 1));
    if (n > 0 && kind.dimension > details_->cell_dimension)
      scan_.fail(word, std::string(kind.keyword) + " at the beginning of a line");
    const bool element = kind.dimension == details_->cell_dimension;
    const auto first =
        static_cast<Index>(element ? mesh_.data.types.size() : details_->sides.size());
    for (Index e = 0; e < n; ++e) {
      std::array<Index, 8> corners{};
      const std::span<Index> used(corners.data(), kind.corners);
      std::size_t place = 0;
      for (std::size_t k = 0; k < used.size(); ++k) {
        used[k] = read_vertex({kind.keyword.data(), e, n});
        if (k == 0) place = last_;
      }
      const int ref = reference({"a reference at the end of the entry", e, n});
      if (element) {
        mesh_.data.add_element(*kind.type, used);
        mesh_.where.elements.push_back(place);
        details_->element_references.push_back(ref);
      } else {
        details_->sides.emplace_back(used);
        side_places_.push_back(place);
        details_->side_references.push_back(ref);
      }
    }
    details_->sections.push_back({Part::cells, {}, &kind, element, first, n});
  }

  /// Vertices are numbered from 1; they may come later in the file.
  Index read_vertex(const Expected& expected) {
    const auto word = next_word();
    const auto value = parse_integer(word);
    if (!value) scan_.fail(word, "a vertex of entry " + expected.text());
    last_ = source_.offset_of(word);
    const std::int64_t most = std::numeric_limits<Index>::max();
    if (*value < 1 || *value > most)
      source_.fail(last_, "vertex " + std::to_string(*value), "1 or more");
    return static_cast<Index>(*value - 1);
  }

  /// Keeps the text up to the next keyword.
  void keep_unknown(std::string_view word) {
    const std::size_t begin = source_.offset_of(word);
    std::size_t end = scan_.offset();
    for (auto next = scan_.next_word(); !next.empty() && !is_keyword(next);
         next = scan_.next_word()) {
      if (next.front() == '#') scan_.line();
      end = scan_.offset();
    }
    scan_.seek(end);
    unknown_ += (unknown_.empty() ? "" : ", ") + std::string(word);
    details_->sections.push_back(
        {Part::raw, std::string(source_.text().substr(begin, end - begin)) + "\n"});
  }

  void finish() {
    if (!has_section(Part::vertices))
      source_.fail(source_.text().size(), "no Vertices", "the nodes of the mesh");
    if (mesh_.data.types.empty()) {
      const bool second = unknown_.find("P2") != std::string::npos;
      source_.fail(source_.text().size(),
                   second ? "only elements of second order (" + unknown_ + ")" : "no elements",
                   std::string("triangles, tetrahedra or the like") +
                       (second ? first_order_hint(source_.name()) : ""));
    }
    const auto nodes = static_cast<Index>(xyz_.size() / 3);
    for (std::size_t s = 0; s < details_->sides.size(); ++s) {
      for (const Index node : details_->sides[s]) {
        if (node >= nodes)
          source_.fail(side_places_[s], "vertex " + std::to_string(node + 1),
                       "1 to " + std::to_string(nodes));
      }
    }
    set_nodes(source_, xyz_, mesh_);
    collect_groups();
    if (!unknown_.empty()) mesh_.warnings.push_back(unknown_ + " of the file are kept as they are");
  }

  void collect_groups() {
    Index loose = 0;
    for (std::size_t s = 0; s < details_->sides.size(); ++s) {
      const int ref = details_->side_references[s];
      if (!is_side(details_->sides[s], details_->cell_dimension)) continue;
      if (ref == 0) {
        ++loose;
        continue;
      }
      add_marker_side(markers_.find(ref), static_cast<Index>(s), side_places_[s], *details_, mesh_);
    }
    make_markers(markers_.all(), *details_, mesh_);
    auto& of = mesh_.data.element_region;
    for (const int ref : details_->element_references)
      of.push_back(ref == 0 ? -1 : static_cast<Index>(regions_.find(ref)));
    mesh_.data.regions = regions_.all();
    if (mesh_.data.regions.empty()) of.clear();
    if (loose > 0) {
      mesh_.warnings.push_back(std::to_string(loose) +
                               " faces have the reference 0: they are kept, but are no marker");
    }
  }

  Source& source_;
  Scanner scan_;
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  std::vector<double> xyz_;
  std::vector<std::size_t> side_places_;
  std::set<std::string> keywords_;
  GroupIndex markers_{"marker_"}, regions_{"region_"};
  std::string unknown_;
  std::string_view word_;  // last word read by integer()
  std::size_t last_ = 0;   // offset of the vertex number read last
};

ParsedMesh read(Source& source) { return Reader(source).read(); }

/// The elements of the mesh in the order in which they are written.
using Order = std::vector<Index>;

class Writer {
 public:
  /// element_order: empty if each section is a range of the elements.
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
      for (int k = 0; k < details_.dimension; ++k) out_ << p[k] << ' ';
      out_ << (references.empty() ? 0 : references[at(i)]) << '\n';
    }
  }

  void write_cells(const Details::Section& section) {
    out_ << section.kind->keyword << '\n' << section.count << '\n';
    for (Index k = section.first; k < section.first + section.count; ++k) {
      if (section.elements) {
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

/// Details and element order for a mesh from another format.
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
  if (count > 0) details.sections.push_back({Part::cells, {}, &kind, false, first, count});
}

void add_elements(const Topology& topology, const Kind& kind, Prepared& made) {
  const auto first = static_cast<Index>(made.order.size());
  for (Index e = 0; e < topology.element_count(); ++e) {
    if (topology.element_type(e) == *kind.type) made.order.push_back(e);
  }
  const auto count = static_cast<Index>(made.order.size()) - first;
  if (count > 0) made.details.sections.push_back({Part::cells, {}, &kind, true, first, count});
}

/// Writes comments that hold names. A line end in a name would end the comment.
template <class Group>
std::string name_lines(const char* what, const std::vector<Group>& groups,
                       const std::vector<int>& tags) {
  std::string lines;
  for (std::size_t k = 0; k < tags.size(); ++k) {
    lines += std::string("# ") + what + ' ' + std::to_string(tags[k]) + ' ' +
             within_line(groups[k].name) + '\n';
  }
  return lines;
}

Prepared prepare(const Mesh& mesh, const FormatDetails* source, const std::vector<int>& marker_tags,
                 const std::vector<int>& region_tags) {
  const Topology& topology = *mesh.topology;
  Prepared made;
  Details& details = made.details;
  details.cell_dimension = topology.cell_dimension();
  details.dimension = coordinates_in_file(mesh, source);
  details.element_references = element_references(topology, region_tags);
  details.sections = {{Part::dimension, {}}};
  const std::string names = name_lines("marker", topology.markers().list(), marker_tags) +
                            name_lines("region", topology.regions(), region_tags);
  if (!names.empty()) details.sections.push_back({Part::raw, names});
  details.sections.push_back({Part::vertices, {}});
  for (const Kind& kind : kinds()) {
    if (kind.dimension == details.cell_dimension) add_elements(topology, kind, made);
    if (kind.dimension == details.cell_dimension - 1)
      add_sides(topology.markers(), marker_tags, kind, details);
  }
  return made;
}

std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                               const WriteOptions&) {
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

}  // namespace

const MeshFormat format{.name = "mesh",
                        .title = "Medit",
                        .markers = "yes, tag, and name in a comment",
                        .regions = "yes, tag, and name in a comment",
                        .recognise =
                            [](const Content& content) {
                              return keyword_on_line(content, [](std::string_view line) {
                                return starts_with_word(line, "MeshVersionFormatted");
                              });
                            },
                        .read = read,
                        .write = write};

}  // namespace winslow::io::medit
