#include "io/openfoam/new_mesh.h"

#include <Eigen/Geometry>
#include <set>
#include <tuple>

#include "core/options/option.h"
#include "core/types.h"
#include "io/format/cell_of_faces.h"
#include "io/format/mesh_in_space.h"

namespace winslow::io::openfoam {
namespace {

void add_inner_faces(const Topology& topology, NewMesh& list) {
  struct Inner {
    Index owner, neighbour;
    Face nodes;
  };
  std::vector<Inner> inner;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [nodes, elements] = topology.face(f);
    if (elements[1] < 0) continue;
    if (elements[0] < elements[1]) {
      inner.push_back({elements[0], elements[1], nodes});
    } else {
      inner.push_back({elements[1], elements[0], nodes.reversed()});
    }
  }
  std::ranges::sort(inner, [](const Inner& a, const Inner& b) {
    return std::tie(a.owner, a.neighbour) < std::tie(b.owner, b.neighbour);
  });
  for (const Inner& face : inner) {
    list.faces.push_back(face.nodes);
    list.owner.push_back(face.owner);
    list.neighbour.push_back(face.neighbour);
  }
}

/// Boundary faces by patches: for each marker its faces that no earlier marker has, then the faces
/// without a marker.
std::vector<NewPatch> patches_of(const Topology& topology, std::vector<std::string>& warnings) {
  std::vector<NewPatch> patches;
  std::vector<bool> taken(at(topology.face_count()), false);
  std::size_t inside = 0, twice = 0;
  if (topology.markers().from_file()) {
    for (const Marker& marker : topology.markers()) {
      NewPatch patch{marker.name, {}, {}};
      for (const Face& face : marker.faces) {
        const auto f = *topology.find_face(face);
        const auto [nodes, elements] = topology.face(f);
        inside += elements[1] >= 0 ? 1 : 0;
        twice += elements[1] < 0 && taken[at(f)] ? 1 : 0;
        if (elements[1] >= 0 || taken[at(f)]) continue;
        taken[at(f)] = true;
        patch.faces.push_back(same_direction(face, nodes) ? face : face.reversed());
      }
      patches.push_back(std::move(patch));
    }
  }
  NewPatch rest{"defaultFaces", {}, {}};
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [nodes, elements] = topology.face(f);
    if (elements[1] < 0 && !taken[at(f)]) rest.faces.push_back(nodes);
  }
  if (!rest.faces.empty()) {
    warnings.push_back(std::to_string(rest.faces.size()) +
                       " boundary faces in no marker are written as the patch defaultFaces");
    patches.push_back(std::move(rest));
  }
  if (inside > 0) {
    warnings.push_back(std::to_string(inside) +
                       " faces of markers lie between two cells: patches cannot hold them");
  }
  if (twice > 0)
    warnings.push_back(std::to_string(twice) + " faces in a second marker are in the first only");
  return patches;
}

/// Replaces blanks and punctuation in names, which would end a word of OpenFOAM.
void make_names_safe(std::vector<NewPatch>& patches, std::vector<std::string>& warnings) {
  std::set<std::string> taken;
  for (NewPatch& patch : patches) {
    std::string name = patch.name.empty() ? "unnamed" : as_word(patch.name, "\"'/;{}()[]$");
    while (!taken.insert(name).second) name += '_';
    if (name != patch.name) {
      warnings.push_back("marker \"" + patch.name + "\" is written as \"" + name +
                         "\": OpenFOAM allows no such name");
    }
    patch.name = name;
  }
}

/// Gives patches of the source their entries again.
void keep_entries(const Details* source, std::vector<NewPatch>& patches) {
  if (source == nullptr) return;
  for (NewPatch& patch : patches) {
    const auto own = std::ranges::find(source->mesh.patches, patch.name, &Patch::name);
    if (own != source->mesh.patches.end()) patch.entry = own->entry;
  }
}

}  // namespace

NewMesh new_volume_mesh(const Mesh& mesh, const Details* source) {
  NewMesh out;
  const auto values = mesh.coordinates.values();
  out.xyz.assign(values.begin(), values.end());
  add_inner_faces(*mesh.topology, out);
  out.patches = patches_of(*mesh.topology, out.warnings);
  make_names_safe(out.patches, out.warnings);
  keep_entries(source, out.patches);
  for (const NewPatch& patch : out.patches) {
    for (const Face& face : patch.faces) {
      out.faces.push_back(face);
      out.owner.push_back(mesh.topology->face(*mesh.topology->find_face(face)).elements[0]);
    }
  }
  return out;
}

namespace {

/// Extrudes a plane mesh by one cell.
class Extrusion {
 public:
  Extrusion(const Mesh& mesh, const FormatDetails* details, const Details* source)
      : mesh_(mesh), topology_(*mesh.topology), details_(details), source_(source) {
    thin_ = source != nullptr ? source->thin.get() : nullptr;
  }

  NewMesh make() {
    add_points();
    add_inner();
    std::vector<NewPatch> edges = patches_of(topology_, out_.warnings);
    make_names_safe(edges, out_.warnings);
    keep_entries(source_, edges);
    add_patches(edges);
    return std::move(out_);
  }

 private:
  void add_points() {
    const Index n = topology_.node_count();
    const double height = thickness();
    const MeshInSpace space(mesh_, details_);
    const Vec3 across = thin_ ? Vec3(0, 0, 0) : Vec3(space.normal() * height);
    base_.resize(at(n));
    copy_.resize(at(n));
    std::vector<bool> on_axis = axis_nodes();
    const auto add = [&](const Vec3& p) {
      out_.xyz.insert(out_.xyz.end(), {p.x(), p.y(), p.z()});
      return static_cast<Index>(out_.xyz.size() / 3) - 1;
    };
    for (Index i = 0; i < n; ++i)
      base_[at(i)] = add(thin_ ? thin_->base_point(mesh_.coordinates.xy(i)) : space.node(i));
    for (Index i = 0; i < n; ++i)
      copy_[at(i)] = on_axis[at(i)] ? base_[at(i)]
                                    : add(thin_ ? thin_->copy_point(mesh_.coordinates.xy(i))
                                                : Vec3(space.node(i) + across));
    if (!thin_)
      out_.warnings.push_back("the plane mesh is written one cell thick, over " +
                              number_text(height) + ", with patches front and back of type empty");
    // Elements are counter-clockwise seen from the side to which the copy lies, or from the other.
    const auto corners = topology_.element(0);
    const auto point = [&](Index p) { return Vec3(out_.xyz.data() + 3 * at(p)); };
    const Vec3 a = point(base_[at(corners[0])]);
    Vec3 normal(0, 0, 0);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      normal += (point(base_[at(corners[k])]) - a).cross(point(base_[at(corners[k + 1])]) - a);
    Vec3 up(0, 0, 0);
    for (const Index corner : corners) up += point(copy_[at(corner)]) - point(base_[at(corner)]);
    copy_above_ = normal.dot(up) > 0;
  }

  double thickness() const {
    const Bounds box = bounds(mesh_);
    return box.size().maxCoeff() / 10;
  }

  /// Whether each node is on the axis of a wedge.
  std::vector<bool> axis_nodes() const {
    std::vector<bool> on(at(topology_.node_count()), false);
    if (thin_ == nullptr || !thin_->is_wedge()) return on;
    for (const auto& role : source_->roles.symmetry) {
      const std::string& name = role.first;
      const auto marker = topology_.markers().find(name);
      const bool axis = std::ranges::none_of(source_->mesh.patches, [&](const Patch& patch) {
        return patch.name == name && patch.has_faces();
      });
      if (!marker || !axis) continue;
      for (const Index node : topology_.markers().nodes(*marker)) on[at(node)] = true;
    }
    return on;
  }

  /// The face over an edge that goes round counter-clockwise seen from outside the element on the
  /// left of the edge.
  Face wall(Index a, Index b) const {
    std::vector<Index> points{base_[at(a)], base_[at(b)], copy_[at(b)], copy_[at(a)]};
    if (!copy_above_) std::ranges::reverse(points);
    std::vector<Index> unique;
    for (const Index point : points)
      if (std::ranges::find(unique, point) == unique.end()) unique.push_back(point);
    return unique.size() < 3 ? Face() : Face(std::span<const Index>(unique));
  }

  Face directed_wall(const Topology::Edge& edge, Index element) const {
    const auto corners = topology_.element(element);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Index a = corners[k], b = corners[(k + 1) % corners.size()];
      if ((a == edge.nodes[0] && b == edge.nodes[1]) || (a == edge.nodes[1] && b == edge.nodes[0]))
        return wall(a, b);
    }
    return {};
  }

  void add_inner() {
    struct Inner {
      Index owner, neighbour;
      Face face;
    };
    std::vector<Inner> inner;
    for (const Topology::Edge& edge : topology_.edges()) {
      if (edge.elements[1] < 0) continue;
      const Index low = std::min(edge.elements[0], edge.elements[1]);
      inner.push_back(
          {low, std::max(edge.elements[0], edge.elements[1]), directed_wall(edge, low)});
    }
    std::ranges::sort(inner, [](const Inner& a, const Inner& b) {
      return std::tie(a.owner, a.neighbour) < std::tie(b.owner, b.neighbour);
    });
    for (const Inner& face : inner) {
      out_.faces.push_back(face.face);
      out_.owner.push_back(face.owner);
      out_.neighbour.push_back(face.neighbour);
    }
  }

  void add_walls(NewPatch patch) {
    std::vector<Face> edges = std::move(patch.faces);
    patch.faces.clear();
    for (const Face& edge : edges) {
      const Topology::Edge shared = topology_.edges()[at(*topology_.find_face(edge))];
      const Face face = directed_wall(shared, shared.elements[0]);
      if (face.size() == 0) continue;  // on the axis
      patch.faces.push_back(face);
      out_.faces.push_back(face);
      out_.owner.push_back(shared.elements[0]);
    }
    out_.patches.push_back(std::move(patch));
  }

  /// Adds the faces of one side to the last patch.
  void add_side(bool base) {
    for (Index e = 0; e < topology_.element_count(); ++e) {
      std::vector<Index> points;
      for (const Index node : topology_.element(e))
        points.push_back(base ? base_[at(node)] : copy_[at(node)]);
      if (base == copy_above_) std::reverse(points.begin() + 1, points.end());
      const Face face{std::span<const Index>(points)};
      out_.patches.back().faces.push_back(face);
      out_.faces.push_back(face);
      out_.owner.push_back(e);
    }
  }

  void add_patches(const std::vector<NewPatch>& edges) {
    std::vector<NewPatch> left = edges;
    const auto take = [&](const std::string& name) {
      const auto found = std::ranges::find(left, name, &NewPatch::name);
      if (found == left.end()) return;
      add_walls(std::move(*found));
      left.erase(found);
    };
    if (thin_) {
      const auto& patches = source_->mesh.patches;
      for (std::size_t p = 0; p < patches.size(); ++p) {
        if (!thin_->is_side(p)) {
          take(patches[p].name);
          continue;
        }
        out_.patches.push_back({patches[p].name, {}, patches[p].entry});
        const auto [base, copy] = thin_->sides_of(p);
        if (base) add_side(true);
        if (copy) add_side(false);
      }
    }
    while (!left.empty()) {
      if (thin_ && left.front().entry.empty() && all_on_axis(left.front()))
        left.erase(left.begin());
      else
        take(left.front().name);
    }
    if (thin_) return;
    for (const char* name : {"front", "back"}) {
      std::string free = name;
      while (std::ranges::find(out_.patches, free, &NewPatch::name) != out_.patches.end())
        free += '_';
      out_.patches.push_back({free, {}, "\n        type            empty;\n    "});
      add_side(name == std::string_view("back"));
    }
  }

  bool all_on_axis(const NewPatch& patch) const {
    return std::ranges::all_of(patch.faces, [&](const Face& edge) {
      return base_[at(edge[0])] == copy_[at(edge[0])] && base_[at(edge[1])] == copy_[at(edge[1])];
    });
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const FormatDetails* details_;
  const Details* source_;
  const ThinMesh* thin_ = nullptr;
  NewMesh out_;
  std::vector<Index> base_, copy_;  // points of each node
  bool copy_above_ = true;
};

}  // namespace

NewMesh new_thin_mesh(const Mesh& mesh, const FormatDetails* details, const Details* source) {
  return Extrusion(mesh, details, source).make();
}

}  // namespace winslow::io::openfoam
