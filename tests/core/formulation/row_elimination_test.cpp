#include "core/formulation/row_elimination.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/geometry/sliding_boundary.h"
#include "core/strategy/sliding.h"
#include "support/derivatives.h"
#include "support/meshes.h"
#include "support/periodic_meshes.h"
#include "support/space_meshes.h"

/// Nodes without unknowns of their own on boundaries that slide: derivatives are those of the
/// energy as a function of what is left, by differences.
namespace winslow::test {
namespace {

struct Moving {
  std::shared_ptr<NodeClasses> classes;
  MovingBoundary boundary;
};

Moving moving(const Mesh& mesh, const SlideOptions& slide) {
  Moving out{std::make_shared<NodeClasses>(mesh.topology), {}};
  out.boundary = make_boundary_move(slide, mesh, {}, *out.classes);
  hold_spacing(slide, mesh, out.boundary, *out.classes);
  return out;
}

VariationalWinslow plane_form(const Mesh& mesh, const Moving& of) {
  const VirtualControlVolumes vcv(mesh.topology);
  return {of.classes,
          TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1, {}, of.classes.get()),
          {},
          1};
}

VolumeWinslow space_form(const Mesh& mesh, const Moving& of) {
  return {of.classes,
          volume_targets(*mesh.topology, nullptr, TargetBlend::regular(), nullptr, 1, {},
                         {.classes = of.classes.get()}),
          {},
          1};
}

/// Hexahedra over the quadrilaterals of a plane mesh; all of the boundary in one marker, shell.
MeshData extruded(const MeshData& plane, Index layers, double height) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  const Index nodes = plane.node_count();
  for (Index k = 0; k <= layers; ++k)
    for (Index i = 0; i < nodes; ++i) {
      const Vec2 p = plane.coordinates.xy(i);
      data.coordinates.push_xyz(Vec3(p.x(), p.y(), height * k / layers));
    }
  for (Index k = 0; k < layers; ++k)
    for (Index e = 0; e < plane.element_count(); ++e) {
      std::vector<Index> corners;
      for (const Index level : {k, k + 1})
        for (const Index node : plane.element(e)) corners.push_back(level * nodes + node);
      data.add_element(ElementType::hexahedron, corners);
    }
  mark_volume(data, [](const Vec3&) { return "shell"; });
  return data;
}

/// Of the edges of the rows, over the whole.
std::vector<double> shares(const Moving& of, const Coordinates& x) {
  std::vector<double> out;
  for (const SlidingPart& part : of.boundary.sliding) {
    if (part.spacing == Spacing::free) continue;
    std::vector<Vec3> places;
    for (const Index node : part.row->nodes()) {
      if (x.dimension() == 3)
        places.emplace_back(x.xyz(node));
      else
        places.emplace_back(x.xy(node).x(), x.xy(node).y(), 0);
    }
    const std::vector<double> lengths = part.row->edge_lengths(places);
    double whole = 0;
    for (const double length : lengths) whole += length;
    for (const double length : lengths) out.push_back(length / whole);
  }
  return out;
}

double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  REQUIRE_FALSE(a.empty());
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] / b[k] - 1));
  return most;
}

/// A perturbed mesh whose unknowns were all moved by up to a share of an edge.
void check_plane(Mesh mesh, const SlideOptions& slide, std::size_t lost, double edge) {
  Random random(3);
  perturb(mesh, random, 0.2);
  const Moving of = moving(mesh, slide);
  const VariationalWinslow form = plane_form(mesh, of);
  std::size_t boundary = 0;
  for (Index node = 0; node < mesh.coordinates.size(); ++node)
    boundary += mesh.topology->on_boundary(node) && of.classes->moves(node);
  CHECK(form.unknowns() == 2 * (mesh.topology->interior_nodes().size() + boundary - lost));
  Coordinates x = mesh.coordinates;
  form.advance(direction(form, *of.classes, x, random, 0.5 * edge), 1, x);
  check_derivatives(form, *of.classes, x, edge);
  if (of.classes->tied().rows().empty()) return;
  CHECK(largest_change(shares(of, x), shares(of, mesh.coordinates)) < 1e-11);
}

/// The square of periodic_meshes.h with a bump in its bottom and top, so that these are no lines.
Mesh wavy(Index n) {
  MeshData data = square(n, Cells::triangles);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec2 p = data.coordinates.xy(i);
    data.coordinates.set_xy(i, {p.x() + 0.04 * std::sin(2 * pi * p.y()),
                                p.y() + 0.05 * std::sin(2 * pi * p.x()) + 0.03 * p.x()});
  }
  return make_mesh(data);
}

Mesh oval(Cells cells) {
  MeshData data = annulus(14, 3, 1.4, cells);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec2 p = data.coordinates.xy(i);
    data.coordinates.set_xy(i, {p.x(), 0.8 * p.y() + 0.05 * p.x() * p.x()});
  }
  return make_mesh(data);
}

}  // namespace

TEST_CASE("closed curves turn as a whole: gradient and Hessian are the energy's by one unknown") {
  SlideOptions slide;
  slide.markers = {"outer", "inner"};
  slide.spacing = SlideSpacing::held;
  for (const Cells cells : {Cells::triangles, Cells::mixed}) {
    CAPTURE(name_of(cells));
    check_plane(oval(cells), slide, 2 * 13, 0.05);
    check_plane(make_mesh(annulus(14, 3, 1.4, cells)), slide, 2 * 13, 0.05);
  }
}

TEST_CASE("corners of periodic sides slide with their images: exact derivatives") {
  SlideOptions slide;
  slide.markers = {"bottom", "top"};
  slide.periodic = {"left", "right"};
  slide.spacing = SlideSpacing::free;
  // Images: 4 nodes inside the sides of 5, and 2 corners.
  check_plane(make_mesh(square(5, Cells::triangles)), slide, 6, 0.05);
  check_plane(wavy(6), slide, 7, 0.04);
  slide.markers = {"inner", "outer"};
  slide.periodic = {"begin", "end"};
  check_plane(make_mesh(sector(75, 5, 4, Vec2(0.5, 2))), slide, 3 + 2, 0.05);
  const Moving of = moving(make_mesh(sector(75, 5, 4, Vec2(0.5, 2))), slide);
  REQUIRE(of.boundary.periodic.size() == 1);
  CHECK(of.boundary.periodic[0].corners.size() == 2);
}

TEST_CASE("held rows between corners that slide: exact derivatives") {
  SlideOptions slide;
  slide.markers = {"bottom", "top"};
  slide.periodic = {"left", "right"};
  slide.spacing = SlideSpacing::held;
  check_plane(make_mesh(square(5, Cells::triangles)), slide, 6 + 2 * 4, 0.05);
  check_plane(wavy(6), slide, 7 + 2 * 5, 0.04);
  // Of the bottom one half between a corner that slides and one that stays, twice.
  MeshData data = square(6, Cells::triangles);
  data.markers.clear();
  mark_boundary(data, [](const Vec2& p) {
    if (p.x() < 1e-9) return "left";
    if (p.x() > 1 - 1e-9) return "right";
    if (p.y() > 0.5) return "top";
    return p.x() < 0.5 ? "first" : "second";
  });
  slide.markers = {"first", "second"};
  const Mesh mesh = make_mesh(data);
  const Moving of = moving(mesh, slide);
  CHECK(of.classes->tied().rows().size() == 2);
  // Images: 5 inside the side, 1 corner; following: 2 in each half.
  check_plane(mesh, slide, 6 + 4, 0.05);
}

TEST_CASE("in space: closed edges of sliding faces turn as a whole, exact derivatives") {
  const Mesh mesh = make_mesh(extruded(annulus(10, 3, 1.4, Cells::quads), 3, 1));
  SlideOptions slide;
  slide.markers = {"shell"};
  slide.features = true;
  slide.spacing = SlideSpacing::held;
  const Moving of = moving(mesh, slide);
  CHECK(of.classes->tied().rows().size() == 4);
  const VolumeWinslow form = space_form(mesh, of);
  // Four circles of 10 nodes have one unknown each.
  CHECK(form.unknowns() == 3 * (static_cast<std::size_t>(mesh.coordinates.size()) - 4 * 9));
  Random random(9);
  Coordinates x = mesh.coordinates;
  form.advance(direction(form, *of.classes, x, random, 0.05), 1, x);
  check_derivatives(form, *of.classes, x, 0.05);
  CHECK(largest_change(shares(of, x), shares(of, mesh.coordinates)) < 1e-11);
}

TEST_CASE("in space: corners of periodic sides slide on planes and cylinders with their images") {
  MeshData data = extruded(sector(75, 4, 3, Vec2(0, 0)), 3, 1);
  data.markers.clear();
  mark_volume(data, [](const Vec3& p) {
    const double phi = std::atan2(p.y(), p.x());
    if (p.z() < 1e-9) return "floor";
    if (p.z() > 1 - 1e-9) return "lid";
    if (phi < 1e-9) return "begin";
    if (phi > radians(75) - 1e-9) return "end";
    return p.head<2>().norm() < 1.5 ? "inner" : "outer";
  });
  const Mesh mesh = make_mesh(data);
  SlideOptions slide;
  slide.markers = {"outer", "lid"};
  slide.periodic = {"begin", "end"};
  const Moving of = moving(mesh, slide);
  REQUIRE(of.boundary.periodic.size() == 1);
  // 2 on the cylinder and 2 on the lid; at their edge, and at what stays, nodes stay.
  CHECK(of.boundary.periodic[0].corners.size() == 4);
  const VolumeWinslow form = space_form(mesh, of);
  Random random(9);
  Coordinates x = mesh.coordinates;
  form.advance(direction(form, *of.classes, x, random, 0.05), 1, x);
  check_derivatives(form, *of.classes, x, 0.05);
  const PeriodicPairs& pairs = of.boundary.periodic[0];
  for (const auto& [node, image] : pairs.corners) {
    CHECK((pairs.image.of(x.xyz(node)) - x.xyz(image)).norm() < 1e-14);
    const Vec3 before = mesh.coordinates.xyz(image), after = x.xyz(image);
    CHECK((after - before).norm() > 1e-4);
    if (before.z() > 1 - 1e-9)
      CHECK(std::abs(after.z() - 1) < 1e-14);
    else
      CHECK(std::abs(after.head<2>().norm() - 2) < 1e-12);
  }
}

/// The variational form with nodes that slide: its derivatives are those of the energy along the
/// curves and planes, by differences.
namespace {

std::shared_ptr<const NodeClasses> sliding(const Mesh& mesh, std::vector<std::string> markers) {
  auto classes = std::make_shared<NodeClasses>(mesh.topology);
  const auto boundary =
      SlidingBoundary::find(*mesh.topology, mesh.coordinates, markers, {.angle = 40});
  for (const SlidingPart& part : boundary.parts)
    classes->set_sliding(part.nodes, boundary.geometry, mesh.coordinates);
  return classes;
}

}  // namespace

TEST_CASE("sliding in the plane: gradient and Hessian are the energy's along the boundary") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    Mesh mesh = make_mesh(annulus(12, 3, 1.4, cells));
    Random random(2);
    const auto classes = sliding(mesh, {"outer", "inner"});
    perturb(mesh, random, 0.2);
    const VirtualControlVolumes vcv(mesh.topology);
    const VariationalWinslow form(
        classes, TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1, {}, classes.get()),
        {}, 1);
    CHECK(form.unknowns() == 2 * static_cast<std::size_t>(mesh.coordinates.size()));
    // Off the nodes' own places, so that gradients across the circles count.
    Coordinates x = mesh.coordinates;
    form.advance(direction(form, *classes, x, random, 0.05), 1, x);
    check_derivatives(form, *classes, x, 0.1);
    for (const Index node : mesh.topology->markers().nodes(0))
      CHECK(x.xy(node).norm() == doctest::Approx(mesh.coordinates.xy(node).norm()).epsilon(1e-12));
  }
}

TEST_CASE("sliding in space: gradient and Hessian are the energy's in the planes") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube_with_cavity(6, volumes));
    std::vector<std::string> names;
    for (const Marker& marker : mesh.topology->markers()) names.push_back(marker.name);
    const auto classes = sliding(mesh, names);
    const VolumeWinslow form(classes,
                             volume_targets(*mesh.topology, nullptr, TargetBlend::regular(),
                                            nullptr, 1, {}, {.classes = classes.get()}),
                             {}, 1);
    Random random(3);
    Coordinates x = mesh.coordinates;
    form.advance(direction(form, *classes, x, random, 0.03), 1, x);
    check_derivatives(form, *classes, x, 0.05);
  }
}

TEST_CASE("periodic pairs: gradient and Hessian are the energy's where both sides move as one") {
  Random random(7);
  const auto check = [&](Mesh mesh, const char* first, const char* second, double edge) {
    auto classes = std::make_shared<NodeClasses>(mesh.topology);
    const auto pairs = PeriodicPairs::find(*mesh.topology, mesh.coordinates, first, second);
    classes->set_periodic(pairs);
    const VirtualControlVolumes vcv(mesh.topology);
    const VariationalWinslow form(
        classes, TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1, {}, classes.get()),
        {}, 1);
    CHECK(form.unknowns() == 2 * (mesh.topology->interior_nodes().size() + pairs.pairs.size()));
    Coordinates x = mesh.coordinates;
    form.advance(direction(form, *classes, x, random, 0.3 * edge), 1, x);
    for (const auto& [node, image] : pairs.pairs) {
      const Vec2 p = x.xy(node);
      CHECK((pairs.image.of({p.x(), p.y(), 0}).head<2>() - x.xy(image)).norm() < 1e-14);
      CHECK((p - mesh.coordinates.xy(node)).norm() > 0);
    }
    check_derivatives(form, *classes, x, edge);
  };
  check(make_mesh(square(5, Cells::triangles)), "left", "right", 0.05);
  check(make_mesh(square(4, Cells::mixed)), "top", "bottom", 0.05);
  check(make_mesh(sector(75, 5, 4, Vec2(0.5, 2))), "begin", "end", 0.05);
}

TEST_CASE("a triangle whose nodes all slide has a target, one whose nodes all stay has none") {
  const Mesh mesh = make_mesh(square(3, Cells::triangles));
  const VirtualControlVolumes vcv(mesh.topology);
  const auto all = sliding(mesh, {"bottom", "top", "left", "right"});
  const auto with = TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1, {}, all.get());
  const auto without = TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1);
  CHECK(with.cells.size() > without.cells.size());
  TargetBlend by_vcv{0, 0, 1, 0};
  CHECK(TargetShapes::build(vcv, by_vcv, nullptr, 1, {}, all.get()).cells.size() ==
        with.cells.size());
}

}  // namespace winslow::test
