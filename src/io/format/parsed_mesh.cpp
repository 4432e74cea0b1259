#include "io/format/parsed_mesh.h"

#include <set>

#include "io/format/mesh_in_space.h"
#include "io/text/numbers.h"

namespace winslow::io {
namespace {

std::string shown(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

void require_finite(const Source& source, std::size_t offset, std::size_t node, double value) {
  if (std::isfinite(value)) return;
  source.fail(offset, shown(value) + " as a coordinate of node " + std::to_string(node),
              "a finite number");
}

/// The first node that leaves the plane z = constant; the number of nodes if none does.
std::size_t first_off_level(const std::vector<double>& xyz) {
  const std::size_t n = xyz.size() / 3;
  double extent = 0;
  for (std::size_t i = 0; i < n; ++i) {
    extent = std::max({extent, std::abs(xyz[3 * i] - xyz[0]), std::abs(xyz[3 * i + 1] - xyz[1])});
  }
  constexpr double noise = 1e-9;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::abs(xyz[3 * i + 2] - xyz[2]) > noise * extent) return i;
  }
  return n;
}

/// Sets the nodes of a mesh in a plane z = constant.
void set_level_nodes(const std::vector<double>& xyz, ParsedMesh& mesh) {
  const std::size_t n = xyz.size() / 3;
  bool exact = true;
  for (std::size_t i = 0; i < n; ++i) {
    mesh.data.coordinates.set_xy(static_cast<Index>(i), {xyz[3 * i], xyz[3 * i + 1]});
    const double z = xyz[3 * i + 2];
    // The sign of zero counts, so that the file is written back unchanged.
    exact = exact && z == xyz[2] && std::signbit(z) == std::signbit(xyz[2]);
  }
  auto& kept = mesh.details->plane_z;
  if (n > 0 && (!exact || xyz[2] != 0 || std::signbit(xyz[2]))) {
    kept.resize(exact ? 1 : n);
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = xyz[3 * i + 2];
  }
}

/// Sum of the signed areas of all elements whose nodes exist.
double total_area(const MeshData& data) {
  if (data.coordinates.empty()) return 0;
  const PlanePoints x(data.coordinates);
  const auto known = [&](Index node) { return node >= 0 && node < data.node_count(); };
  double area2 = 0;
  for (Index e = 0; e < data.element_count(); ++e) {
    const auto corners = data.element(e);
    if (!std::ranges::all_of(corners, known)) continue;  // make_mesh reports the error
    const Vec2 origin = x[corners[0]];
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const Vec2 a = x[corners[k]] - origin, b = x[corners[k + 1]] - origin;
      area2 += a.x() * b.y() - a.y() * b.x();
    }
  }
  return area2 / 2;
}

}  // namespace

void check_finite(const Source& source, const ParsedMesh& mesh) {
  const auto values = mesh.data.coordinates.values();
  const auto dimension = static_cast<std::size_t>(mesh.data.coordinates.dimension());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      require_finite(source, mesh.where.nodes[i / dimension], i / dimension, values[i]);
  }
}

namespace {

/// Sets in-plane coordinates. Returns false without changes if the nodes lie in no plane.
bool set_in_plane(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh) {
  const std::size_t n = xyz.size() / 3;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      require_finite(source, mesh.where.nodes[i], i, xyz[3 * i + k]);
  }
  if (first_off_level(xyz) == n) {
    mesh.data.coordinates = Coordinates(2, index_count(n, "nodes"));
    set_level_nodes(xyz, mesh);
    return true;
  }
  auto plane = PlanePlacement::find(xyz);
  if (!plane) return false;
  mesh.data.coordinates = Coordinates(2, index_count(n, "nodes"));
  for (Index i = 0; i < plane->size(); ++i) mesh.data.coordinates.set_xy(i, plane->in_plane(i));
  mesh.warnings.push_back("the mesh lies in " + plane->plane_text() +
                          " of space: its coordinates are " + plane->axes_text());
  mesh.details->plane = std::make_shared<PlanePlacement>(std::move(*plane));
  return true;
}

}  // namespace

void set_planar_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh) {
  if (set_in_plane(source, xyz, mesh)) return;
  const std::size_t off = first_off_level(xyz);
  source.fail(mesh.where.nodes[off],
              "z = " + shown(xyz[3 * off + 2]) + " after z = " + shown(xyz[2]) +
                  " (a surface in space), nodes up to " + shown(distance_from_plane(xyz)) +
                  " away from the nearest plane",
              "a plane mesh, all nodes in one plane, or a mesh of volume elements");
}

void set_space_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh) {
  mesh.data.coordinates = Coordinates(3, index_count(xyz.size() / 3, "nodes"));
  std::ranges::copy(xyz, mesh.data.coordinates.values().begin());
  check_finite(source, mesh);
}

void set_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh) {
  if (mesh.data.cell_dimension() == 3 || !set_in_plane(source, xyz, mesh))
    set_space_nodes(source, xyz, mesh);
}

void turn_to_viewer(ParsedMesh& mesh) {
  PlanePlacement* plane = mesh.details->plane.get();
  if (plane == nullptr || !(total_area(mesh.data) < 0)) return;
  plane->from_behind = true;
  MeshData& data = mesh.data;
  for (Index e = 0; e < data.element_count(); ++e) {
    const auto first = static_cast<std::size_t>(data.element_offsets[static_cast<std::size_t>(e)]);
    const auto corners = std::span(data.element_nodes).subspan(first, data.element(e).size());
    std::ranges::reverse(corners.subspan(1));  // the first corner stays the first
  }
}

Face BoundaryDetails::face(Index coded) const {
  const Face& side = sides[static_cast<std::size_t>(coded < 0 ? ~coded : coded)];
  return coded < 0 ? side.reversed() : side;
}

bool BoundaryDetails::fits(const Mesh& mesh) const {
  const Topology& topology = *mesh.topology;
  if (!same_size(topology)) return false;
  if (!topology.markers().from_file()) return marker_sides.empty();
  const auto& markers = topology.markers();
  if (markers.size() != marker_sides.size()) return false;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto& own = marker_sides[m];
    const auto same_nodes = [&](Index coded, const Face& other) { return face(coded) == other; };
    if (!std::equal(own.begin(), own.end(), markers[m].faces.begin(), markers[m].faces.end(),
                    same_nodes)) {
      return false;
    }
  }
  return true;
}

bool MarkerDetails::fits(const Mesh& mesh) const {
  const Topology& topology = *mesh.topology;
  if (!same_size(topology)) return false;
  if (!topology.markers().from_file()) return markers.empty();
  return std::ranges::equal(
      topology.markers().list(), markers,
      [](const Marker& a, const Marker& b) { return a.name == b.name && a.faces == b.faces; });
}

std::size_t GroupIndex::add(int tag, std::string name) {
  while (name.empty() || names_.contains(name)) name += "_" + std::to_string(tag);
  names_.insert(name);
  index_[tag] = groups_.size();
  groups_.push_back({std::move(name), tag});
  return groups_.size() - 1;
}

std::size_t GroupIndex::find(int tag) {
  const auto found = index_.find(tag);
  return found != index_.end() ? found->second : add(tag, prefix_ + std::to_string(tag));
}

void add_marker_side(std::size_t marker, Index side, std::size_t offset, BoundaryDetails& details,
                     ParsedMesh& mesh) {
  if (marker >= details.marker_sides.size()) {
    details.marker_sides.resize(marker + 1);
    mesh.where.marker_edges.resize(marker + 1);
  }
  details.marker_sides[marker].push_back(side);
  mesh.where.marker_edges[marker].push_back(offset);
}

void make_markers(const std::vector<Region>& groups, BoundaryDetails& details, ParsedMesh& mesh) {
  details.marker_sides.resize(groups.size());
  mesh.where.marker_edges.resize(groups.size());
  for (std::size_t m = 0; m < groups.size(); ++m) {
    Marker marker{groups[m].name, groups[m].tag, {}};
    marker.faces.reserve(details.marker_sides[m].size());
    for (const Index side : details.marker_sides[m]) marker.faces.push_back(details.face(side));
    mesh.data.markers.push_back(std::move(marker));
  }
}

std::vector<int> usable_tags(std::vector<int> tags, const char* what,
                             std::vector<std::string>& warnings) {
  std::set<int> seen;
  bool usable = true;
  for (const int tag : tags) usable = usable && tag > 0 && seen.insert(tag).second;
  if (usable) return tags;
  for (std::size_t i = 0; i < tags.size(); ++i) tags[i] = static_cast<int>(i) + 1;
  warnings.push_back(std::string("the tags of ") + what +
                     " are not positive and unique: numbered 1, 2, ...");
  return tags;
}

}  // namespace winslow::io
