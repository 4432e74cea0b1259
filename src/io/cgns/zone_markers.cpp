#include "io/cgns/zone_markers.h"

#include <set>

#include "core/mesh/face_pairs.h"

namespace winslow::io::cgns {
namespace {

/// Faces that belong to one element only, in the order of the elements.
std::vector<Face> boundary_faces(const MeshData& mesh) {
  struct Side {
    Face key;
    Index element, local;
  };
  std::vector<Side> sides;
  for (Index e = 0; e < mesh.element_count(); ++e) {
    for (Index f = 0; f < mesh.face_count(e); ++f)
      sides.push_back({face_of_side(mesh, e, f).sorted(), e, f});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key < b.key; });
  std::vector<Side> single;
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k + 1;
    while (end < sides.size() && sides[end].key == sides[k].key) ++end;
    if (end == k + 1) single.push_back(sides[k]);
    k = end;
  }
  std::sort(single.begin(), single.end(), [](const Side& a, const Side& b) {
    return std::pair(a.element, a.local) < std::pair(b.element, b.local);
  });
  std::vector<Face> found;
  for (const Side& side : single) found.push_back(face_of_side(mesh, side.element, side.local));
  return found;
}

}  // namespace

std::optional<PointSet> read_point_set(const NodeView& owner, std::size_t indices) {
  for (const char* name : {"PointRange", "PointList", "ElementRange", "ElementList"}) {
    const auto view = owner.child(name);
    if (!view) continue;
    PointSet set{*view, false, false, {}, view->integers()};
    set.range = view->name().ends_with("Range");
    set.elements = view->name().starts_with("Element");
    if (const auto location = owner.first("GridLocation_t")) set.location = location->text();
    const std::size_t per_point = set.elements ? 1 : indices;
    const bool whole =
        set.range ? set.values.size() == 2 * per_point : set.values.size() % per_point == 0;
    if (!whole) {
      view->fail(std::to_string(set.values.size()) + " numbers",
                 set.range ? std::to_string(2 * per_point)
                           : std::to_string(per_point) + " for each point");
    }
    return set;
  }
  return std::nullopt;
}

std::vector<Face> BoundaryByNodes::faces_between(const std::vector<bool>& nodes) const {
  if (!std::exchange(found_, true)) boundary_ = boundary_faces(mesh_);
  std::vector<Face> faces;
  std::copy_if(boundary_.begin(), boundary_.end(), std::back_inserter(faces), [&](const Face& f) {
    return std::all_of(f.begin(), f.end(), [&](Index node) { return nodes[at(node)]; });
  });
  return faces;
}

namespace {

using FaceKey = Face;

/// The family of a boundary condition or a part of a zone; empty: it has none.
std::string family_of(const NodeView& owner) {
  for (const char* label : {"FamilyName_t", "AdditionalFamilyName_t"}) {
    const auto family = owner.first(label);
    if (!family) continue;
    // "Base/Family" names a family of another base.
    const std::string path = family->text();
    if (!path.empty()) return path.substr(path.rfind('/') + 1);
  }
  return {};
}

std::string region_name(const NodeView& part) {
  std::string family = family_of(part);
  return family.empty() ? part.name() : family;
}

class MarkerMaker {
 public:
  MarkerMaker(const NodeView& base, const ZoneHead& head, const ZoneBoundary& boundary,
              const ZoneSides& sides, ParsedMesh& mesh, Details& details)
      : base_(base),
        indices_(head.vertices.size()),
        side_(side_name(head.cell_dimension)),
        boundary_(boundary),
        sides_(sides),
        mesh_(mesh),
        details_(details) {}

  void add_condition(const NodeView& condition) {
    const auto set = read_point_set(condition, indices_);
    if (!set) {
      mesh_.warnings.push_back("boundary condition \"" + condition.name() +
                               "\" says nothing of where it is: it is no marker");
      return;
    }
    const std::vector<Face> faces = boundary_.faces_of(*set, mesh_.warnings);
    if (faces.empty()) {
      mesh_.warnings.push_back("boundary condition \"" + condition.name() + "\" covers no " +
                               side_ + ": it is no marker");
      return;
    }
    std::string name = family_of(condition);
    if (name.empty()) name = condition.name();
    details_.conditions[add(name, faces)].push_back(condition.name());
    auto& symmetry = details_.roles.symmetry;
    if (const std::string type = type_of(condition);
        type == "BCSymmetryPlane" &&
        std::ranges::find(symmetry, std::pair(name, type)) == symmetry.end())
      symmetry.emplace_back(name, type);
  }

  void add_interface(const NodeView& interface) {
    const auto set = read_point_set(interface, indices_);
    if (!set) return;
    std::vector<Face> faces = boundary_.faces_of(*set, mesh_.warnings);
    std::erase_if(faces, [&](const Face& face) { return named_.contains(face.sorted()); });
    if (!faces.empty()) add(unused(interface.name()), faces);
  }

  void add_sections() {
    for (const auto& section : sides_.sections) {
      std::vector<Face> faces;
      for (std::size_t k = 0; k < section.count; ++k) {
        const Face& face = sides_.faces[section.first + k];
        if (!named_.contains(face.sorted())) faces.push_back(face);
      }
      if (!faces.empty()) add(unused(section.name), faces);
    }
  }

 private:
  /// The type of a condition, or that of its family where the condition leaves it to this.
  std::string type_of(const NodeView& condition) const {
    std::string type = condition.text();
    if (type != "FamilySpecified") return type;
    // A base may have thousands of zones beside the family: no views of all are made.
    const NodePtr family = child_named(base_.node().content(), family_of(condition));
    const NodePtr said = family ? child_labelled(family->content(), "FamilyBC_t") : nullptr;
    return said ? text_of(said->content()) : type;
  }

  /// The name, or a variant of it that no marker has.
  std::string unused(std::string name) const {
    const auto taken = [&] {
      return std::any_of(mesh_.data.markers.begin(), mesh_.data.markers.end(),
                         [&](const Marker& marker) { return marker.name == name; });
    };
    while (taken()) name += '_';
    return name;
  }

  /// Adds faces to the marker of that name, which is made if missing. Returns its index.
  std::size_t add(const std::string& name, const std::vector<Face>& faces) {
    auto& markers = mesh_.data.markers;
    const auto found = std::find_if(markers.begin(), markers.end(),
                                    [&](const Marker& marker) { return marker.name == name; });
    const auto m = static_cast<std::size_t>(found - markers.begin());
    if (found == markers.end()) {
      markers.push_back({name, static_cast<int>(m) + 1, {}});
      details_.conditions.emplace_back();
    }
    markers[m].faces.insert(markers[m].faces.end(), faces.begin(), faces.end());
    for (const Face& face : faces) named_.insert(face.sorted());
    return m;
  }

  NodeView base_;
  std::size_t indices_;
  std::string side_;  // name of a boundary side, "edge" or "face"
  const ZoneBoundary& boundary_;
  const ZoneSides& sides_;
  ParsedMesh& mesh_;
  Details& details_;
  std::set<FaceKey> named_;
};

}  // namespace

void make_markers(const ZonePlace& place, const ZoneHead& head, const ZoneBoundary& boundary,
                  const ZoneSides& sides, const std::vector<std::string>& joined, ParsedMesh& mesh,
                  Details& details) {
  const NodeView& zone = place.zone;
  MarkerMaker maker(place.base, head, boundary, sides, mesh, details);
  for (const NodeView& all : zone.children("ZoneBC_t"))
    for (const NodeView& condition : all.children("BC_t")) maker.add_condition(condition);
  for (const NodeView& interface : connections_of(zone))
    if (std::ranges::find(joined, interface.name()) == joined.end()) maker.add_interface(interface);
  maker.add_sections();
}

void read_regions(const NodeView& zone, const ElementNumbers& numbers, MeshData& mesh,
                  std::vector<std::string>& warnings) {
  for (const NodeView& part : zone.children("ZoneSubRegion_t")) {
    const auto set = read_point_set(part, 1);
    if (!set || (!set->elements && set->location != "CellCenter")) continue;
    const std::string name = region_name(part);
    const auto known = std::ranges::find(mesh.regions, name, &Region::name);
    const auto region = static_cast<Index>(known - mesh.regions.begin());
    if (known == mesh.regions.end()) mesh.regions.push_back({name, region + 1});
    std::int64_t others = 0;
    mesh.element_region.resize(mesh.types.size(), -1);
    set->for_each_number([&](std::int64_t number) {
      const ElementPlace place = numbers.find(number);
      if (place.kind == ElementPlace::Kind::none) {
        set->view.fail("element " + std::to_string(number),
                       "1 to " + std::to_string(numbers.last()) + ", as the sections have them");
      }
      const bool free =
          place.kind == ElementPlace::Kind::cell && mesh.element_region[at(place.index)] < 0;
      if (free) mesh.element_region[at(place.index)] = region;
      others += free ? 0 : 1;
    });
    if (others > 0) {
      warnings.push_back(std::to_string(others) + " elements of region \"" + name +
                         "\" are no cells or in another region, too: they stay out of it");
    }
  }
}

}  // namespace winslow::io::cgns
