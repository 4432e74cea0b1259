#include "io/gmsh/gmsh_reader.h"

#include "io/gmsh/gmsh.h"
#include "io/gmsh/gmsh_periodic.h"
#include "io/text/numbers.h"

namespace winslow::io::gmsh {

ParsedMesh read(Source& source) { return Reader(source).read(); }

ParsedMesh Reader::read() {
  read_header();
  for (scan_.skip_space(); !scan_.at_end(); scan_.skip_space()) read_section();
  finish();
  return std::move(mesh_);
}

void Reader::read_header() {
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
    const std::size_t at = scan_.offset();
    source_.set_binary_from(at);
    ValueReader values(scan_, true);
    const int one = values.integer({"the integer 1"});
    if (one == 0x01000000) {
      source_.fail(at, "numbers in big-endian byte order",
                   "little-endian (save the file as ASCII)");
    }
    if (one != 1)
      source_.fail(at, std::to_string(one), "the integer 1, which tells the byte order");
  }
  end_section("MeshFormat");
}

bool Reader::seen(std::string_view section) const {
  return std::any_of(details_->sections.begin(), details_->sections.end(),
                     [&](const auto& s) { return s.name == section; });
}

void Reader::read_section() {
  const std::size_t begin = scan_.offset();
  const auto line = trimmed(scan_.line());
  if (line.size() < 2 || line[0] != '$' || line.starts_with("$End")) {
    source_.fail(begin, in_quotes(line), "the start of a section, such as $Nodes");
  }
  const std::string name(line.substr(1));
  const bool known = name == "PhysicalNames" || name == "Entities" || name == "Nodes" ||
                     name == "Elements" || name == "Periodic";
  if (known && seen(name)) source_.fail(begin, "a second section $" + name, "one only");
  if (name == "PartitionedEntities") {
    source_.fail(begin, "$PartitionedEntities", "a mesh that is not partitioned");
  }
  if (name == "ParametricNodes") {
    source_.fail(begin, "$ParametricNodes", "$Nodes (save without parametric coordinates)");
  }
  if (!known) return read_raw(name, begin);
  details_->sections.push_back({name, {}});
  if (name == "PhysicalNames") read_physical_names();
  if (name == "Entities") read_entities();
  if (name == "Nodes") nodes_.read();
  if (name == "Elements") {
    if (!seen("Nodes")) source_.fail(scan_.offset(), "$Elements before $Nodes", "$Nodes first");
    elements_.read();
  }
  if (name == "Periodic") {
    details_->links = read_links(scan_, details_->version_4, details_->binary);
    end_section(name);
    // For the way back byte by byte.
    details_->sections.back().raw = source_.text().substr(begin, scan_.offset() - begin);
    return;
  }
  end_section(name);
}

void Reader::read_raw(const std::string& name, std::size_t begin) {
  const std::string end = "$End" + name;
  const auto text = source_.text();
  auto at = text.find(end, begin);
  while (at != std::string_view::npos && text[at - 1] != '\n') at = text.find(end, at + 1);
  if (at == std::string_view::npos) {
    source_.fail(begin, "section $" + name + " without end", end);
  }
  scan_.seek(at);
  scan_.line();
  details_->sections.push_back({name, std::string(text.substr(begin, at - begin)) + end + "\n"});
  if (name != "Comments") {
    mesh_.warnings.push_back("section $" + name + " is not understood; it is kept as it is");
  }
}

void Reader::end_section(const std::string& name) {
  scan_.skip_space();
  const auto word = scan_.word();
  if (word != "$End" + name) scan_.fail(word, "$End" + name);
  scan_.end_line({"the end of the line"});
}

void Reader::read_physical_names() {
  scan_.skip_space();
  const Index n = scan_.count({"the number of physical names"}, 6);
  scan_.end_line({"the end of the line"});
  for (Index i = 0; i < n; ++i) {
    scan_.skip_space();
    const std::size_t at = scan_.offset();
    ValueReader values(scan_, false);
    PhysicalName entry{};
    entry.dimension = values.integer({"dimension of physical name", i, n});
    entry.tag = values.integer({"tag of physical name", i, n});
    if (entry.dimension < 0 || entry.dimension > 3) {
      source_.fail(at, std::to_string(entry.dimension), "a dimension from 0 to 3");
    }
    const auto rest = trimmed(scan_.line());
    if (rest.size() < 2 || rest.front() != '"' || rest.back() != '"') {
      source_.fail(at, rest.empty() ? "the end of the line" : in_quotes(rest), "a name in quotes");
    }
    entry.name = rest.substr(1, rest.size() - 2);
    if (!named_groups_.emplace(entry.dimension, entry.tag).second) {
      source_.fail(at, "a second name for physical group " + std::to_string(entry.tag), "one only");
    }
    details_->physical_names.push_back(std::move(entry));
  }
}

std::vector<int> Reader::read_tags(ValueReader& values, const char* what) {
  const Index n = values.count({what}, 2, 4);
  std::vector<int> tags(static_cast<std::size_t>(n));
  for (int& tag : tags) tag = values.integer({what});
  return tags;
}

void Reader::read_entities() {
  const std::size_t begin = scan_.offset();
  if (!details_->version_4) source_.fail(begin, "$Entities in MSH 2", "$Nodes");
  ValueReader values(scan_, details_->binary);
  values.begin();
  std::array<Index, 4> counts{};
  for (Index& n : counts) n = values.count({"a number of entities"}, 8, 36);
  values.end({"the end of the line"});
  for (int dimension = 0; dimension < 4; ++dimension) {
    const Index n = counts[static_cast<std::size_t>(dimension)];
    for (Index i = 0; i < n; ++i) read_entity(values, dimension, i, n);
  }
}

void Reader::read_entity(ValueReader& values, int dimension, Index index, Index count) {
  static constexpr std::array<const char*, 4> names{"point entity", "curve entity",
                                                    "surface entity", "volume entity"};
  const Expected expected{names[static_cast<std::size_t>(dimension)], index, count};
  values.begin();
  Entity entity;
  entity.tag = values.integer(expected);
  const std::size_t numbers = dimension == 0 ? 3 : 6;
  for (std::size_t k = 0; k < numbers; ++k) entity.box[k] = values.real(expected);
  entity.physicals = read_tags(values, "a physical tag");
  if (dimension > 0) entity.boundary = read_tags(values, "the tag of a bounding entity");
  values.end(expected);
  details_->entities[static_cast<std::size_t>(dimension)].push_back(std::move(entity));
}

void Reader::finish() {
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
  if (elements_.partitioned()) {
    mesh_.warnings.emplace_back("the partitions of elements are not kept");
  }
  details_->nodes = mesh_.data.node_count();
  details_->elements = mesh_.data.element_count();
  if (details_->version_4) {
    const EntityBoxes boxes = entity_boxes(*details_, mesh_.data);
    for (std::size_t d = 0; d < 4; ++d) {
      auto& entities = details_->entities[d];
      for (std::size_t i = 0; i < entities.size(); ++i) entities[i].mesh_box = boxes[d][i];
    }
  }
}

}  // namespace winslow::io::gmsh
