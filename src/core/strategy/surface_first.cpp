#include "core/strategy/surface_first.h"

#include "core/error.h"
#include "core/geometry/boundary_kinds.h"
#include "core/quality/quality.h"
#include "core/strategy/run_sequence.h"
#include "core/strategy/sliding.h"
#include "core/strategy/smooth_run.h"
#include "core/strategy/surface_shape.h"

namespace winslow {

namespace {

/// The geometry of a volume mesh, accessed by the node numbers of its surface mesh.
class OfSurface final : public SlidingGeometry {
 public:
  OfSurface(std::shared_ptr<const SlidingGeometry> geometry, std::vector<Index> nodes)
      : geometry_(std::move(geometry)), nodes_(std::move(nodes)) {}
  Foot foot(Index node, const Vec3& point) const override {
    return geometry_->foot(nodes_[at(node)], point);
  }

 private:
  std::shared_ptr<const SlidingGeometry> geometry_;
  std::vector<Index> nodes_;  // of the volume mesh
};

/// Motion of boundary nodes between two positions along their sliding geometry.
class AlongBoundary final : public Motion {
 public:
  AlongBoundary(const SlidingBoundary& boundary, const Coordinates& from, Coordinates to)
      : geometry_(boundary.geometry), to_(std::move(to)) {
    for (const SlidingPart& part : boundary.parts)
      for (const Index node : part.nodes)
        if (!from.same_place(node, to_)) nodes_.push_back(node);
    std::ranges::sort(nodes_);
  }
  std::span<const Index> nodes() const override { return nodes_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    for (const Index node : nodes_) {
      if (fraction == 1) {
        out.copy_node(node, to_);
        continue;
      }
      const Vec3 on_chord = rest.xyz(node) + fraction * (to_.xyz(node) - rest.xyz(node));
      out.set_xyz(node, geometry_->foot(node, on_chord).point);
    }
  }

 private:
  std::shared_ptr<const SlidingGeometry> geometry_;
  Coordinates to_;
  std::vector<Index> nodes_;
};

/// Reports iterations with the unchanged volume mesh.
class StillMonitor final : public SolverMonitor {
 public:
  StillMonitor(SolverMonitor* monitor, const Coordinates& x) : monitor_(monitor), x_(x) {}
  bool on_iteration(const IterationRecord& record, const Coordinates&) override {
    return !monitor_ || monitor_->on_iteration(record, x_);
  }
  bool cancelled() override { return monitor_ && monitor_->cancelled(); }

 private:
  SolverMonitor* monitor_;
  const Coordinates& x_;
};

/// The sliding faces of a volume mesh as a separate mesh.
struct SurfaceOfMesh {
  MeshState state;
  std::vector<Index> nodes;  ///< of the volume mesh, one for each of the surface
};

SurfaceOfMesh surface_of(const Mesh& volume, const SlidingBoundary& boundary,
                         const ResolvedSlide& slide) {
  std::vector<Index> markers;
  for (const std::string& name : slide.markers)
    markers.push_back(*volume.topology->markers().find(name));
  const SlidingFaces sliding =
      sliding_faces(*volume.topology, {*volume.topology, markers, Interfaces::free});
  std::vector<Index> all;
  for (std::size_t f = 0; f < sliding.faces.size(); ++f) all.push_back(static_cast<Index>(f));
  SurfaceOfMesh out;
  out.nodes = nodes_of_faces(sliding.faces, all);
  const auto number = [&](Index node) {
    return static_cast<Index>(std::ranges::lower_bound(out.nodes, node) - out.nodes.begin());
  };
  for (const SurfaceFace& face : sliding.faces)
    if (face.nodes.size() > 4)
      throw UsageError("surface_first: the face of " + nodes_text(face.nodes) + " has " +
                       std::to_string(face.nodes.size()) +
                       " corners, and surface meshes have triangles and quadrilaterals only: "
                       "without it the boundary is smoothed together with the interior");
  MeshData data;
  data.coordinates = Coordinates(3, static_cast<Index>(out.nodes.size()));
  for (std::size_t i = 0; i < out.nodes.size(); ++i)
    data.coordinates.set_xyz(static_cast<Index>(i), volume.coordinates.xyz(out.nodes[i]));
  for (const SurfaceFace& face : sliding.faces) {
    std::vector<Index> corners;
    for (const Index node : face.nodes) corners.push_back(number(node));
    data.add_element(corners.size() == 3 ? ElementType::triangle : ElementType::quadrilateral,
                     corners);
  }
  out.state = make_state(make_mesh(data));
  auto shape = std::make_shared<SurfaceShape>();
  shape->given = data.coordinates;
  shape->rules = feature_rules(slide);
  shape->reference = slide.files().reference;
  for (const SlidingPart& part : boundary.parts) {
    SlidingPart renumbered{part.marker, part.description, {}};
    for (const Index node : part.nodes) renumbered.nodes.push_back(number(node));
    shape->boundary.parts.push_back(std::move(renumbered));
  }
  shape->boundary.geometry = std::make_shared<const OfSurface>(boundary.geometry, out.nodes);
  shape->normals = std::make_shared<const ElementNormals>(out.state.mesh.topology, shape->given,
                                                          shape->boundary);
  out.state.surface = std::move(shape);
  return out;
}

/// Smooths the surface. Returns the volume mesh with the new positions of its boundary nodes.
Coordinates smooth_surface(const Mesh& volume, const SlidingBoundary& boundary,
                           const SmoothOptions& options, const RunOptions& run,
                           SmoothResult& result) {
  const SurfaceOfMesh surface = surface_of(volume, boundary, {options.slide, run.files});
  SmoothOptions of_surface = options;
  of_surface.slide = {};  // applies to the volume mesh; the surface has its shape in the state
  of_surface.vcv = VcvKind::automatic;  // the other kinds exist only for volume meshes
  StillMonitor monitor(run.monitor, volume.coordinates);
  RunOptions own = run;
  own.monitor = &monitor;
  own.start = nullptr;
  own.cache = nullptr;
  Coordinates y = surface.state.mesh.coordinates;
  append(result, smooth_interior(surface.state, of_surface, y, own));
  Coordinates x = volume.coordinates;
  for (std::size_t i = 0; i < surface.nodes.size(); ++i)
    x.set_xyz(surface.nodes[i], y.xyz(static_cast<Index>(i)));
  return x;
}

}  // namespace

SmoothResult smooth_surface_first(const MeshState& state, const SmoothOptions& options,
                                  Coordinates& x, const RunOptions& run) {
  const Mesh& mesh = state.mesh;
  const ResolvedSlide slide(options.slide, run.files);
  require_volume(*mesh.topology, "surface_first: for a volume mesh, and this is a ");
  if (slide.markers.empty())
    throw UsageError("surface_first: no marker slides: name those whose surface is to be smoothed");
  if (!slide.periodic.empty())
    throw UsageError("surface_first: periodic pairs are smoothed together with the interior");
  const SlidingBoundary boundary =
      SlidingBoundary::find(*mesh.topology, mesh.coordinates, slide.markers, feature_rules(slide),
                            slide.files().reference.get());
  SmoothResult result;
  const Coordinates there = smooth_surface(mesh, boundary, options, run, result);
  const bool surface_converged = result.converged;
  SmoothOptions held = options;
  held.targets = options.targets.or_else(TargetBlend::automatically());
  held.slide = {};
  held.slide.hold_nodes = slide.hold_nodes;
  held.slide.interfaces = interfaces_in(slide.interfaces, false);
  const AlongBoundary motion(boundary, mesh.coordinates, there);
  const bool valid = check_validity(*mesh.topology, x, options.threads).inverted == 0;
  RunSequence sequence(run, result);
  // A mesh with inverted elements has no path to follow.
  sequence.move(state, motion, {.increments = valid ? 0 : 1}, held, nullptr, x);
  result.converged = result.converged && surface_converged;
  auto& sliding = result.boundary.sliding;  // so far those where regions meet
  sliding.insert(sliding.begin(), boundary.parts.begin(), boundary.parts.end());
  result.boundary.held = static_cast<Index>(slide.hold_nodes.size());
  return result;
}

}  // namespace winslow
