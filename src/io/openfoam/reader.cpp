#include <set>

#include "core/error.h"
#include "io/format/cell_of_faces.h"
#include "io/openfoam/cells.h"
#include "io/openfoam/openfoam.h"

namespace winslow::io::openfoam {
namespace {

class Reader {
 public:
  Reader(Source& source, MeshPlace place) : source_(source) {
    out_.details = details_;
    details_->place = std::move(place);
  }

  ParsedMesh read() {
    details_->mesh = read_poly_mesh(source_, details_->place);
    details_->binary = mesh().points_form.binary;
    if (mesh().cells == 0) source_.fail(mesh().owner_place, "no cells", "a mesh");
    const ThinMesh::Found found = ThinMesh::find(mesh());
    details_->thin = found.mesh;
    if (!found.why.empty()) out_.warnings.push_back(found.why + ": read as a volume mesh");
    details_->thin ? read_plane() : read_volume();
    read_cell_zones(source_, details_->place, out_);
    add_roles();
    add_pairs();
    details_->markers = out_.data.markers;
    details_->mesh.faces = {};
    details_->mesh.owner = details_->mesh.neighbour = {};
    details_->mesh.point_places = {};
    return std::move(out_);
  }

 private:
  const PolyMesh& mesh() const { return details_->mesh; }
  const ThinMesh& thin() const { return *details_->thin; }

  void read_volume() {
    out_.where.nodes = mesh().point_places;
    add_cells(source_, mesh(), out_);
    set_space_nodes(source_, mesh().xyz, out_);
    give_faces_to_flat_cells(out_);
    for (const Patch& patch : mesh().patches) {
      Marker& marker = add_marker(patch.name);
      for (std::int64_t f = patch.first; f < patch.first + patch.count; ++f) {
        const auto face = static_cast<Index>(f);
        marker.faces.emplace_back(mesh().faces[face]);
        out_.where.marker_edges.back().push_back(mesh().faces.places[at(face)]);
      }
    }
  }

  Marker& add_marker(const std::string& name) {
    out_.data.markers.push_back({name, static_cast<int>(out_.data.markers.size()) + 1, {}});
    out_.where.marker_edges.emplace_back();
    return out_.data.markers.back();
  }

  void read_plane() {
    for (Index point = 0; point < mesh().point_count(); ++point)
      if (const Index node = thin().node_of(point);
          node == static_cast<Index>(out_.where.nodes.size()))
        out_.where.nodes.push_back(mesh().point_places[at(point)]);
    set_nodes_of_plane();
    add_plane_elements();
    for (std::size_t p = 0; p < mesh().patches.size(); ++p)
      if (!thin().is_side(p)) add_plane_marker(mesh().patches[p]);
    if (thin().is_wedge()) add_axis();
  }

  void set_nodes_of_plane() {
    const std::vector<double>& xyz = thin().places();
    set_planar_nodes(source_, xyz, out_);
    if (thin().is_wedge()) out_.warnings.push_back(thin().description());
  }

  void add_plane_elements() {
    const PlanePoints x(out_.data.coordinates);
    double area2 = 0;
    std::vector<std::vector<Index>> cells;
    for (Index cell = 0; cell < mesh().cells; ++cell) {
      const Index f = thin().base_faces()[at(cell)];
      std::vector<Index>& corners = cells.emplace_back();
      for (const Index point : mesh().faces[f]) corners.push_back(thin().node_of(point));
      if (corners.size() < 3 || corners.size() > most_polygon_corners)
        source_.fail(mesh().faces.places[at(f)],
                     "cell " + std::to_string(cell) + ", a polygon of " +
                         std::to_string(corners.size()) + " corners one cell thick",
                     "3 to " + std::to_string(most_polygon_corners));
      for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const Vec2 a = x[corners[k]] - x[corners[0]], b = x[corners[k + 1]] - x[corners[0]];
        area2 += a.x() * b.y() - a.y() * b.x();
      }
      out_.where.elements.push_back(mesh().faces.places[at(f)]);
    }
    // Beside polygons, one with four corners may be a triangle with a hanging node.
    const bool many = std::ranges::any_of(cells, [](const auto& c) { return c.size() > 4; });
    for (std::vector<Index>& corners : cells) {
      // Faces of one side all go round in one direction.
      if (area2 < 0) std::reverse(corners.begin() + 1, corners.end());
      out_.data.add_element(corners.size() == 3 ? ElementType::triangle
                            : many              ? ElementType::polygon
                                                : ElementType::quadrilateral,
                            corners);
    }
  }

  void add_plane_marker(const Patch& patch) {
    Marker& marker = add_marker(patch.name);
    for (std::int64_t f = patch.first; f < patch.first + patch.count; ++f) {
      const auto face = static_cast<Index>(f);
      const std::size_t place = mesh().faces.places[at(face)];
      const auto edge = thin().edge_of(mesh().faces[face]);
      if (!edge)
        source_.fail(place, "face " + std::to_string(face) + " of patch " + in_quotes(patch.name),
                     "a face between the two sides of a mesh one cell thick");
      marker.faces.push_back(*edge);
      out_.where.marker_edges.back().push_back(place);
    }
  }

  /// The edges on the axis of a wedge, for which no face stands, become a marker: a patch without
  /// faces if there is one, which is what blockMesh leaves of the axis.
  void add_axis() {
    std::set<Face> edges;
    for (Index e = 0; e < out_.data.element_count(); ++e) {
      const auto corners = out_.data.element(e);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const Face edge(corners[k], corners[(k + 1) % corners.size()]);
        if (thin().on_axis(edge[0]) && thin().on_axis(edge[1])) edges.insert(edge.sorted());
      }
    }
    if (edges.empty()) return;
    auto& markers = out_.data.markers;
    const auto named = [](const char* name) {
      return [name](const Marker& marker) { return marker.name == name; };
    };
    auto axis = std::ranges::find_if(markers, [&](const Marker& marker) {
      const auto patch = std::ranges::find(mesh().patches, marker.name, &Patch::name);
      return marker.faces.empty() && (marker.name == "axis" || patch->type == "empty");
    });
    if (axis == markers.end()) {
      std::string name = "axis";
      while (std::ranges::any_of(markers, named(name.c_str()))) name += '_';
      add_marker(name);
      axis = markers.end() - 1;
    }
    for (const auto& nodes : edges) {
      axis->faces.emplace_back(std::max(nodes[0], nodes[1]), std::min(nodes[0], nodes[1]));
      const Index lower = std::min(nodes[0], nodes[1]);
      out_.where.marker_edges[static_cast<std::size_t>(axis - markers.begin())].push_back(
          out_.where.nodes[at(lower)]);
    }
    details_->roles.symmetry.push_back({axis->name, "the axis of the wedge"});
  }

  void add_roles() {
    MarkerRoles& roles = details_->roles;
    for (const Patch& patch : mesh().patches) {
      const bool marker = std::ranges::any_of(
          out_.data.markers, [&](const Marker& of) { return of.name == patch.name; });
      if (!marker) continue;
      if (patch.has_faces() && (patch.type == "symmetryPlane" || patch.type == "symmetry"))
        roles.symmetry.push_back({patch.name, patch.type});
      for (const std::string& group : patch.groups) roles.groups[group].push_back(patch.name);
    }
  }

  /// The node of a point of the mesh.
  Index node_of(Index point) const { return details_->thin ? thin().node_of(point) : point; }

  void add_pairs() {
    auto periodic = std::make_shared<GivenPeriodicity>();
    const auto& patches = mesh().patches;
    for (auto first = patches.begin(); first != patches.end(); ++first) {
      if (first->type != "cyclic" || !first->has_faces()) continue;
      const auto second = std::ranges::find(patches, first->neighbour, &Patch::name);
      if (second == patches.end() || second->type != "cyclic")
        source_.fail(first->place,
                     "neighbourPatch " + in_quotes(first->neighbour) + " of the cyclic patch " +
                         in_quotes(first->name),
                     "another cyclic patch");
      if (first < second) periodic->pairs.push_back(pairs_of(*first, *second));
    }
    if (periodic->pairs.empty()) return;
    details_->roles.pairs_move = true;
    details_->periodic = periodic;
  }

  /// Pairs the points of the faces of two cyclic patches: face k of one is the image of face k of
  /// the other, in the opposite direction and from the same point on.
  GivenPairs pairs_of(const Patch& first, const Patch& second) const {
    GivenPairs given{first.name, second.name, {}, {}};
    const std::string names = in_quotes(first.name) + " and " + in_quotes(second.name);
    if (first.count != second.count) {
      given.fault = source_.where(first.place) + ": the cyclic patches " + names + " have " +
                    std::to_string(first.count) + " and " + std::to_string(second.count) +
                    " faces, expected as many";
      return given;
    }
    std::map<Index, Index> image;
    bool unique = true;
    for (std::int64_t k = 0; k < first.count; ++k) {
      const auto a = mesh().faces[static_cast<Index>(first.first + k)];
      const auto b = mesh().faces[static_cast<Index>(second.first + k)];
      unique = unique && a.size() == b.size();
      for (std::size_t i = 0; unique && i < a.size(); ++i) {
        const Index node = node_of(a[i]), other = node_of(b[(a.size() - i) % a.size()]);
        unique = image.try_emplace(node, other).first->second == other;
      }
    }
    if (!unique)
      given.fault = source_.where(first.place) + ": the faces of the cyclic patches " + names +
                    " do not match one another in their order";
    for (const auto& [node, other] : image)
      if (unique && node != other) given.pairs.push_back({node, other});
    return given;
  }

  Source& source_;
  ParsedMesh out_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
};

}  // namespace

ParsedMesh read(Source& source, const std::filesystem::path& path, const std::string& time) {
  const auto place = place_to_read(path, time);
  if (!place) throw InputError(path.string() + ": found no mesh of OpenFOAM, expected a case");
  ParsedMesh mesh = Reader(source, *place).read();
  if (const std::string text = time.empty() ? about_times(path, *place) : ""; !text.empty())
    mesh.warnings.push_back(text);
  return mesh;
}

}  // namespace winslow::io::openfoam
