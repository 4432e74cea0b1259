#include "io/cgns/zone_markers.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace winslow::io::cgns {
namespace {

using FaceKey = std::array<Index, 4>;

class MarkerMaker {
 public:
  MarkerMaker(const ZoneHead& head, const ZoneBoundary& boundary, const ZoneSides& sides,
              ParsedMesh& mesh, Details& details)
      : indices_(head.vertices.size()),
        side_(head.cell_dimension == 2 ? "edge" : "face"),
        boundary_(boundary),
        sides_(sides),
        mesh_(mesh),
        details_(details) {
    for (std::size_t s = 0; s < sides.sections.size(); ++s) {
      const auto& section = sides.sections[s];
      for (std::size_t k = 0; k < section.count; ++k)
        section_of_.emplace(sides.faces[section.first + k].sorted(), s);
    }
  }

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
    if (name.empty()) name = section_covered(faces);
    if (name.empty()) name = condition.name();
    details_.conditions[add(name, faces)].push_back(condition.name());
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
  static std::string family_of(const NodeView& condition) {
    for (const char* label : {"FamilyName_t", "AdditionalFamilyName_t"}) {
      const auto family = condition.first(label);
      if (!family) continue;
      // "Base/Family" names one of another base.
      const std::string path = family->text();
      if (!path.empty()) return path.substr(path.rfind('/') + 1);
    }
    return {};
  }

  /// Name of the section that these faces are, all of it and nothing else; empty: of none.
  std::string section_covered(const std::vector<Face>& faces) const {
    const auto first = section_of_.find(faces.front().sorted());
    if (first == section_of_.end()) return {};
    const auto in_same = [&](const Face& face) {
      const auto found = section_of_.find(face.sorted());
      return found != section_of_.end() && found->second == first->second;
    };
    const auto& section = sides_.sections[first->second];
    return faces.size() == section.count && std::all_of(faces.begin(), faces.end(), in_same)
               ? section.name
               : "";
  }

  /// The name, or one made of it that no marker has.
  std::string unused(std::string name) const {
    const auto taken = [&] {
      return std::any_of(mesh_.data.markers.begin(), mesh_.data.markers.end(),
                         [&](const Marker& marker) { return marker.name == name; });
    };
    while (taken()) name += '_';
    return name;
  }

  /// Adds faces to the marker of that name, a new one if there is none. Returns its index.
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

  std::size_t indices_;
  std::string side_;  // what the boundary is made of
  const ZoneBoundary& boundary_;
  const ZoneSides& sides_;
  ParsedMesh& mesh_;
  Details& details_;
  std::map<FaceKey, std::size_t> section_of_;
  std::set<FaceKey> named_;
};

}  // namespace

void make_markers(const NodeView& zone, const ZoneHead& head, const ZoneBoundary& boundary,
                  const ZoneSides& sides, const std::vector<std::string>& joined, ParsedMesh& mesh,
                  Details& details) {
  MarkerMaker maker(head, boundary, sides, mesh, details);
  for (const NodeView& all : zone.children("ZoneBC_t"))
    for (const NodeView& condition : all.children("BC_t")) maker.add_condition(condition);
  for (const NodeView& all : zone.children("ZoneGridConnectivity_t")) {
    for (const NodeView& interface : all.children()) {
      const bool known = interface.label() == "GridConnectivity_t" ||
                         interface.label() == "GridConnectivity1to1_t";
      const bool closed = std::find(joined.begin(), joined.end(), interface.name()) != joined.end();
      if (known && !closed) maker.add_interface(interface);
    }
  }
  maker.add_sections();
}

}  // namespace winslow::io::cgns
