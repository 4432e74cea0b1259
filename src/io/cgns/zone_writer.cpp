#include "io/cgns/cgns.h"

#include <set>

#include "io/cgns/face_sections.h"
#include "io/cgns/zones.h"
#include "io/format/mesh_in_space.h"
#include "io/format/parsed_mesh.h"

namespace winslow::io::cgns {
namespace {

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// One coordinate of every vertex of a zone.
class MovedCoordinate {
 public:
  MovedCoordinate(const Node& array, const Mesh& mesh, const Details& details, int direction)
      : values_(reals_of(array)), single_(array.type == "R4") {
    const std::vector<double> old = values_;
    std::vector<std::size_t> first(static_cast<std::size_t>(mesh.coordinates.size()), old.size());
    for (std::size_t v = 0; v < old.size(); ++v) {
      const Index node =
          details.node_of_vertex.empty() ? static_cast<Index>(v) : details.node_of_vertex[v];
      if (first[at(node)] == old.size()) first[at(node)] = v;
      const double value = place_in_space(&details, mesh.coordinates, node)[direction];
      // Compares bits, so that -0 is kept as well. The vertices of a closed cut may lie slightly
      // apart; they keep their places while their node does not move.
      if (bits(value) == bits(old[first[at(node)]])) continue;
      values_[v] = value;
      moved_ = true;
    }
  }

  bool moved() const { return moved_; }
  bool single() const { return single_; }
  bool fits_single() const {
    for (const double value : values_)
      if (static_cast<double>(static_cast<float>(value)) != value) return false;
    return true;
  }

  NodePtr node(const Node& array, bool as_single) const {
    auto moved = as_single ? make_single_reals(array.name, array.label,
                                               std::vector<float>(values_.begin(), values_.end()),
                                               array.dims)
                           : make_reals(array.name, array.label, values_, array.dims);
    moved->children = array.children;
    return moved;
  }

 private:
  std::vector<double> values_;
  bool single_, moved_ = false;
};

/// Removes normals, which are wrong once the mesh has moved. Returns null if there are none.
NodePtr without_normals(const Node& zone, std::vector<std::string>& dropped) {
  const NodePtr all = child_labelled(zone, "ZoneBC_t");
  if (!all || all->is_link()) return nullptr;
  auto copy = own_copy(*all);
  bool changed = false;
  for (NodePtr& condition : copy->children) {
    if (const NodePtr normals = child_named(*condition, "InwardNormalList")) {
      dropped.push_back(condition->name);
      condition = with_child(*condition, *normals, nullptr);
      changed = true;
    }
  }
  return changed ? with_child(zone, *all, copy) : nullptr;
}

NodePtr without_stale(NodePtr zone, std::vector<std::string>& warnings) {
  std::vector<std::string> solutions, normals;
  for (const NodePtr& child : zone->children)
    if (child->content().label == "FlowSolution_t") solutions.push_back(child->name);
  if (!solutions.empty()) {
    warnings.push_back(listed_names(solutions) +
                       " of the file was computed before the mesh moved: it is kept as it was, as "
                       "a solution to start from");
  }
  if (const NodePtr clean = without_normals(*zone, normals)) {
    zone = clean;
    warnings.push_back("the normals (InwardNormalList) of " + listed_names(normals) +
                       " were those before the mesh moved: they are not written");
  }
  return zone;
}

}  // namespace

std::string listed_names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) text += k + 1 == names.size() ? " and " : ", ";
    text += '"' + names[k] + '"';
  }
  return text;
}

NodePtr moved_zone(const NodePtr& zone, const Mesh& mesh, const Details& details,
                   std::vector<std::string>& warnings) {
  const NodePtr grid = child_named(zone->content(), "GridCoordinates");
  auto moved_grid = own_copy(*grid);
  std::vector<std::pair<NodePtr, MovedCoordinate>> coordinates;
  bool moved = false, single = true, fits = true;
  constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
  // Nodes that move in a plane z = constant keep their z.
  const int directions = details.plane ? 3 : mesh.coordinates.dimension();
  for (int direction = 0; direction < directions; ++direction) {
    const NodePtr array = child_named(*moved_grid, names[at(direction)]);
    coordinates.emplace_back(array, MovedCoordinate(array->content(), mesh, details, direction));
    moved = moved || coordinates.back().second.moved();
    single = single && coordinates.back().second.single();
    fits = fits && coordinates.back().second.fits_single();
  }
  if (!moved) return zone;
  if (single && !fits) {
    warnings.emplace_back(
        "the coordinates were in single precision (R4): they are written in double (R8), for the "
        "new ones need it");
  }
  for (const auto& [array, values] : coordinates) {
    *moved_grid = *with_child(*moved_grid, *array, values.node(*own_copy(*array), single && fits));
  }
  return without_stale(with_child(*zone, *grid, moved_grid), warnings);
}

namespace {

using Integers = std::vector<std::int32_t>;

constexpr std::size_t longest_name = 32;

/// Nodes have names of 32 characters at most, without '/'.
std::string node_name(const std::string& wanted, const std::set<std::string>& taken) {
  std::string name = within_line(wanted.substr(0, longest_name), "/");
  if (name.empty() || name.find_first_not_of(" .") == std::string::npos) name = "unnamed";
  for (int k = 2; taken.contains(name); ++k) {
    const std::string suffix = "_" + std::to_string(k);
    name = name.substr(0, longest_name - suffix.size()) + suffix;
  }
  return name;
}

/// True for children of a boundary condition that give its location or hold values there.
bool of_place(const Node& child) {
  constexpr std::array labels{"IndexRange_t", "IndexArray_t", "GridLocation_t", "BCDataSet_t",
                              "InwardNormalIndex_t"};
  return std::find(labels.begin(), labels.end(), child.content().label) != labels.end() ||
         child.name.starts_with("InwardNormal");
}

/// True for a part of the old zone that is a region of the mesh, and is written from the region.
bool names_cells(const Node& part) {
  const NodePtr location = child_labelled(part, "GridLocation_t");
  return part.label == "ZoneSubRegion_t" && location && text_of(*location) == "CellCenter";
}

class ZoneMaker {
 public:
  ZoneMaker(const Mesh& mesh, const NewZoneSource& source, std::vector<std::string>& warnings)
      : mesh_(mesh),
        in_space_(mesh, source.place),
        topology_(*mesh.topology),
        source_(source),
        warnings_(warnings) {
    if (topology_.markers().from_file()) markers_ = topology_.markers().list();
  }

  NewZone make() {
    zone_ = make_integers(source_.name, "Zone_t",
                          {topology_.node_count(), topology_.element_count(), 0}, {1, 3});
    zone_->children.push_back(make_text("ZoneType", "ZoneType_t", "Unstructured"));
    add_coordinates();
    if (source_.old != nullptr) carry();
    for (const NodePtr& child : zone_->children) taken_.insert(child->name);
    taken_.insert("ZoneBC");
    add_elements();
    if (!markers_.empty()) add_markers();
    if (!topology_.regions().empty()) add_regions();
    return {zone_, std::move(families_)};
  }

 private:
  void add_coordinates() {
    auto grid = make_node("GridCoordinates", "GridCoordinates_t");
    const Index n = mesh_.coordinates.size();
    constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
    for (int k = 0; k < source_.physical_dimension; ++k) {
      std::vector<double> values(at(n));
      for (Index i = 0; i < n; ++i) values[at(i)] = in_space_.node(i)[k];
      grid->children.push_back(make_reals(names[at(k)], "DataArray_t", values));
    }
    zone_->children.push_back(std::move(grid));
  }

  /// Copies the nodes of the old zone that do not depend on its elements.
  void carry() {
    constexpr std::array replaced{"ZoneType_t", "Elements_t", "ZoneBC_t"};
    constexpr std::array lost{"FlowSolution_t",  "DiscreteData_t",      "ZoneGridConnectivity_t",
                              "ZoneSubRegion_t", "ZoneIterativeData_t", "ArbitraryGridMotion_t"};
    const auto among = [](const auto& labels, const std::string& label) {
      return std::find(labels.begin(), labels.end(), label) != labels.end();
    };
    std::vector<std::string> dropped;
    for (const NodePtr& child : source_.old->children) {
      const std::string& label = child->content().label;
      if (among(replaced, label) || names_cells(*child)) continue;
      if (label == "GridCoordinates_t" && child->name == "GridCoordinates") {
        carry_units(child->content());
      } else if (among(lost, label) || label == "GridCoordinates_t") {
        dropped.push_back(child->name);
      } else {
        zone_->children.push_back(child);
      }
    }
    if (!dropped.empty()) {
      warnings_.push_back("the mesh has changed: " + listed_names(dropped) + " of the zone \"" +
                          source_.old->name + "\" " + (dropped.size() == 1 ? "is" : "are") +
                          " not written");
    }
    const NodePtr type = child_labelled(*source_.old, "ZoneType_t");
    if (!type || text_of(*type) != "Unstructured") {
      warnings_.push_back("the mesh has changed: the structured zone \"" + source_.old->name +
                          "\" is written as an unstructured one");
    }
  }

  /// Copies units, classes and remarks of the coordinates.
  void carry_units(const Node& old_grid) {
    const NodePtr made = zone_->children.back();
    auto grid = std::make_shared<Node>(*made);
    for (NodePtr& array : grid->children) {
      const NodePtr old = child_named(old_grid, array->name);
      if (!old) continue;
      auto copy = std::make_shared<Node>(*array);
      copy->children = old->content().children;
      array = std::move(copy);
    }
    for (const NodePtr& child : old_grid.children)
      if (child->content().label != "DataArray_t") grid->children.push_back(child);
    *zone_ = *with_child(*zone_, *made, grid);
  }

  /// True if the elements of each type are consecutive, so that no MIXED section is needed.
  bool in_runs() const {
    std::set<ElementType> seen;
    for (Index e = 0; e < topology_.element_count(); ++e) {
      const ElementType type = topology_.element_type(e);
      const bool new_run = e == 0 || type != topology_.element_type(e - 1);
      if (new_run && !seen.insert(type).second) return false;
    }
    return true;
  }

  void add_elements() {
    const Index count = topology_.element_count();
    if (topology_.has_polyhedra()) return add_by_faces();
    if (!in_runs()) return add_mixed();
    for (Index e = 0; e < count;) {
      const ElementType type = topology_.element_type(e);
      const Index first = e;
      Integers nodes;
      for (; e < count && topology_.element_type(e) == type; ++e)
        for (const Index node : in_space_.element(e)) nodes.push_back(node + 1);
      constexpr std::array names{"TriElements",  "QuadElements",  "TetraElements",
                                 "PyraElements", "PentaElements", "HexaElements"};
      add_section(names[static_cast<std::size_t>(type)], element_number(type), first, e - first,
                  nodes);
    }
  }

  void add_by_faces() {
    by_faces_ = make_face_sections(topology_, markers_, source_.start_offsets);
    for (const auto& section : {by_faces_.faces, by_faces_.cells}) {
      section->name = own_name(section->name);
      zone_->children.push_back(section);
    }
  }

  void add_mixed() {
    Integers entries, starts{0};
    for (Index e = 0; e < topology_.element_count(); ++e) {
      entries.push_back(static_cast<std::int32_t>(element_number(topology_.element_type(e))));
      for (const Index node : in_space_.element(e)) entries.push_back(node + 1);
      starts.push_back(index_count(entries.size(), "numbers in a section of a CGNS file"));
    }
    add_section("MixedElements", mixed, 0, topology_.element_count(), entries);
    add_starts(starts);
  }

  /// Adds the offsets of the MIXED section that was added last.
  void add_starts(const Integers& starts) {
    if (!source_.start_offsets) return;
    auto section = std::make_shared<Node>(*zone_->children.back());
    section->children.push_back(make_integers("ElementStartOffset", "DataArray_t", starts));
    zone_->children.back() = std::move(section);
  }

  /// Adds the section of a marker, with elements numbered after `first`. Returns its name.
  std::string add_sides(const Marker& marker, Index first) {
    const auto number = [](const Face& face) {
      if (face.size() == 2) return std::int64_t{bar_2};
      return element_number(face.size() == 3 ? ElementType::triangle : ElementType::quadrilateral);
    };
    const std::int64_t type = number(marker.faces.front());
    const bool even =
        std::ranges::all_of(marker.faces, [&](const Face& face) { return number(face) == type; });
    Integers entries, starts{0};
    for (const Face& face : marker.faces) {
      if (!even) entries.push_back(static_cast<std::int32_t>(number(face)));
      for (const Index node : face) entries.push_back(node + 1);
      starts.push_back(index_count(entries.size(), "numbers in a section of a CGNS file"));
    }
    const auto count = static_cast<Index>(marker.faces.size());
    std::string name = add_section(marker.name, even ? type : mixed, first, count, entries);
    if (!even) add_starts(starts);
    return name;
  }

  std::string add_section(const std::string& name, std::int64_t type, Index first, Index count,
                          const Integers& entries) {
    std::string own = own_name(name);
    zone_->children.push_back(make_section(own, type, first, count, entries));
    return own;
  }

  /// A name that no other node of the zone has, from now on taken.
  std::string own_name(const std::string& wanted) {
    std::string name = node_name(wanted, taken_);
    taken_.insert(name);
    return name;
  }

  static NodePtr make_range(Index first, Index last) {
    return make_integers("PointRange", "IndexRange_t", {first, last}, {1, 2});
  }
  /// A range if the numbers follow each other, else a list.
  static NodePtr numbered(const Integers& numbers) {
    const bool follow = std::ranges::adjacent_find(numbers, [](std::int32_t a, std::int32_t b) {
                          return a + 1 != b;
                        }) == numbers.end();
    if (follow) return make_range(numbers.front(), numbers.back());
    return make_integers("PointList", "IndexArray_t", numbers,
                         {1, static_cast<std::int64_t>(numbers.size())});
  }

  void add_markers() {
    constexpr std::array locations{"", "", "EdgeCenter", "FaceCenter"};
    const char* location = locations[at(topology_.cell_dimension())];
    auto conditions = make_node("ZoneBC", "ZoneBC_t");
    std::set<std::string> condition_names;
    Index first = topology_.element_count();
    for (std::size_t m = 0; m < markers_.size(); ++m) {
      const Marker& marker = markers_[m];
      if (marker.faces.empty()) {
        warnings_.push_back("marker \"" + marker.name + "\" has no " +
                            side_name(topology_.cell_dimension()) + "s: it is not written");
        continue;
      }
      const auto count = static_cast<Index>(marker.faces.size());
      const std::string name =
          topology_.has_polyhedra() ? own_name(marker.name) : add_sides(marker, first);
      if (name != marker.name) warn_renamed("marker", marker.name, name);
      auto condition = make_condition(marker, name, condition_names);
      condition_names.insert(condition->name);
      condition->children.push_back(topology_.has_polyhedra()
                                        ? numbered(by_faces_.markers[m])
                                        : make_range(first + 1, first + count));
      condition->children.push_back(make_text("GridLocation", "GridLocation_t", location));
      conditions->children.push_back(std::move(condition));
      first += count;
    }
    zone_->children.push_back(std::move(conditions));
  }

  /// Regions become parts of the zone that list cells, because sections would need another order of
  /// the elements.
  void add_regions() {
    const auto of_element = topology_.element_regions();
    std::vector<Integers> elements(topology_.regions().size());
    for (std::size_t e = 0; e < of_element.size(); ++e) {
      if (of_element[e] >= 0)
        elements[at(of_element[e])].push_back(by_faces_.face_count + static_cast<std::int32_t>(e) +
                                              1);
    }
    for (std::size_t r = 0; r < elements.size(); ++r) {
      const std::string& wanted = topology_.regions()[r].name;
      if (elements[r].empty()) continue;
      const std::string name = own_name(wanted);
      if (name != wanted) warn_renamed("region", wanted, name);
      auto part = make_integers(name, "ZoneSubRegion_t", {topology_.cell_dimension()});
      part->children.push_back(make_text("GridLocation", "GridLocation_t", "CellCenter"));
      const auto count = static_cast<std::int64_t>(elements[r].size());
      part->children.push_back(make_integers("PointList", "IndexArray_t", elements[r], {1, count}));
      zone_->children.push_back(std::move(part));
    }
  }

  void warn_renamed(const char* what, const std::string& wanted, const std::string& name) {
    warnings_.push_back(std::string(what) + " \"" + wanted + "\" is written as \"" + name +
                        "\": CGNS allows no such name here");
  }

  /// The marker's condition in the old zone without its location, or a new one.
  std::shared_ptr<Node> make_condition(const Marker& marker, const std::string& name,
                                       const std::set<std::string>& taken) {
    if (const NodePtr old = old_condition(marker.name)) {
      auto condition = std::make_shared<Node>(old->content());
      condition->name = old->name;
      std::erase_if(condition->children, [](const NodePtr& child) { return of_place(*child); });
      return condition;
    }
    auto condition = make_text(node_name(name, taken), "BC_t", "FamilySpecified");
    condition->children.push_back(make_text("FamilyName", "FamilyName_t", name));
    auto family = make_node(name, "Family_t");
    family->children.push_back(make_text("FamBC", "FamilyBC_t", "UserDefined"));
    families_.push_back(std::move(family));
    return condition;
  }

  NodePtr old_condition(const std::string& marker) {
    if (source_.old == nullptr || source_.details == nullptr) return nullptr;
    const auto& markers = source_.details->markers;
    const auto found = std::find_if(markers.begin(), markers.end(),
                                    [&](const Marker& old) { return old.name == marker; });
    if (found == markers.end()) return nullptr;
    const auto& names =
        source_.details->conditions[static_cast<std::size_t>(found - markers.begin())];
    const NodePtr all = child_labelled(*source_.old, "ZoneBC_t");
    if (names.empty() || !all) return nullptr;
    if (names.size() > 1) {
      warnings_.push_back("the mesh has changed: the boundary conditions " + listed_names(names) +
                          " of the marker \"" + marker + "\" become one, the first");
    }
    return child_named(all->content(), names.front());
  }

  const Mesh& mesh_;
  MeshInSpace in_space_;
  const Topology& topology_;
  const NewZoneSource& source_;
  std::vector<std::string>& warnings_;
  std::vector<Marker> markers_;
  std::shared_ptr<Node> zone_;
  std::vector<NodePtr> families_;
  std::set<std::string> taken_;
  FaceSections by_faces_;  // of a mesh with polyhedra; else without nodes
};

}  // namespace

NewZone make_zone(const Mesh& mesh, const NewZoneSource& source,
                  std::vector<std::string>& warnings) {
  return ZoneMaker(mesh, source, warnings).make();
}

}  // namespace winslow::io::cgns
