#include <doctest/doctest.h>

#include <cmath>

#include "core/command/command.h"
#include "core/error.h"
#include "core/inspect/node_roles.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

/// Nodes in which regions of a mesh meet: held, sliding and free.
namespace winslow::test {
namespace {

constexpr Index n = 8;  // cells a side of the plane meshes

/// Gives each element the region whose number `region_of` returns for its middle; -1: none.
MeshData with_regions(MeshData data, const std::vector<std::string>& names,
                      const std::function<Index(const Vec3&)>& region_of) {
  for (const std::string& name : names)
    data.regions.push_back({name, static_cast<int>(data.regions.size()) + 1});
  for (Index e = 0; e < data.element_count(); ++e) {
    Vec3 middle(0, 0, 0);
    for (const Index node : data.element(e)) middle += place_of(data.coordinates, node);
    data.element_region.push_back(region_of(middle / static_cast<double>(data.element(e).size())));
  }
  return data;
}

Index halves(const Vec3& p) { return p.x() < 0.5 ? 0 : 1; }
Index thirds(const Vec3& p) { return p.x() < 0.5 ? 0 : p[p.z() > 0 ? 2 : 1] < 0.5 ? 1 : 2; }

/// The line between the halves of the bent square.
double line(double y) { return 0.5 + 0.05 * std::sin(pi * y); }

/// A square of two regions with a bent line between them, or of three of which two meet in the line
/// y = 0.5. Its interior is shaken; where regions meet along the line.
Mesh bent_square(bool three, std::uint64_t seed) {
  Mesh mesh =
      make_mesh(three ? with_regions(square(n, Cells::triangles), {"left", "low", "high"}, thirds)
                      : with_regions(square(n, Cells::triangles), {"left", "right"}, halves));
  Random random(seed);
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    const Vec2 p = mesh.coordinates.xy(i);
    const bool on_line = std::abs(p.x() - 0.5) < 1e-9;
    const bool across = three && p.x() > 0.5 && std::abs(p.y() - 0.5) < 1e-9;
    const bool inside = !mesh.topology->on_boundary(i);
    Vec2 q = p;
    if (inside && !(on_line && across) && !(three && on_line && std::abs(p.y() - 0.5) < 1e-9)) {
      if (!across) q.y() += 0.3 / n * random.uniform(-1, 1);
      if (!on_line) q.x() += 0.3 / n * random.uniform(-1, 1);
    }
    if (on_line) q.x() = line(q.y());
    mesh.coordinates.set_xy(i, q);
  }
  REQUIRE(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);
  return mesh;
}

/// regular: targets `element`; `auto` leaves hexahedra as they are.
CommandResult smoothed(const Mesh& mesh, Interfaces interfaces, bool regular = false) {
  SmoothCommand smooth;
  if (regular) smooth.smooth.targets = TargetBlend::regular();
  smooth.smooth.slide.interfaces = interfaces;
  CommandResult result = execute(smooth, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  return result;
}

std::vector<Index> moved(const Coordinates& a, const Coordinates& b) {
  std::vector<Index> nodes;
  for (Index i = 0; i < a.size(); ++i)
    if (!a.same_place(i, b)) nodes.push_back(i);
  return nodes;
}

std::string words(const CommandResult& result) {
  return text_of(result.smooth.boundary.interfaces);
}

}  // namespace

TEST_CASE(
    "smoothing holds nodes in which two regions of a plane mesh meet, lets them slide or go") {
  const Mesh mesh = bent_square(false, 1);
  const std::vector<Index> meeting = interface_nodes_inside(*mesh.topology);
  CHECK(meeting.size() == n - 1);
  const CommandResult held = smoothed(mesh, Interfaces::automatic);
  CHECK(words(held) == "holds 7 nodes in which the regions left and right meet");
  for (const Index node : meeting)
    CHECK(held.state.mesh.coordinates.same_place(node, mesh.coordinates));
  CHECK(moved(mesh.coordinates, held.state.mesh.coordinates).size() ==
        mesh.topology->interior_nodes().size() - meeting.size());
  CHECK(held.smooth.kept_outside == 0);
  CHECK(largest_difference(smoothed(mesh, Interfaces::held).state.mesh.coordinates,
                           held.state.mesh.coordinates) == 0);

  const CommandResult slides = smoothed(mesh, Interfaces::slide);
  CHECK(words(slides) == "slides 7 nodes in which the regions left and right meet");
  REQUIRE(slides.smooth.boundary.sliding.size() == 1);
  CHECK(slides.smooth.boundary.sliding[0].of_regions);
  CHECK(slides.smooth.boundary.sliding[0].marker == "left and right");
  for (const Index node : meeting) {
    const Vec2 p = slides.state.mesh.coordinates.xy(node);
    CHECK(std::abs(p.x() - line(p.y())) < 1e-3);  // the spline through the nodes
    CHECK((p - mesh.coordinates.xy(node)).norm() > 1e-4);
  }

  const CommandResult free = smoothed(mesh, Interfaces::free);
  CHECK(words(free) == "leaves free 7 nodes in which the regions left and right meet");
  double off = 0;
  for (const Index node : meeting) {
    const Vec2 p = free.state.mesh.coordinates.xy(node);
    off = std::max(off, std::abs(p.x() - line(p.y())));
  }
  CHECK(off > 1e-3);
  const auto worst = [](const CommandResult& result) {
    return measure_quality(result.state.mesh).of(Metric::normalized_jacobian).statistics.avg;
  };
  CHECK(worst(slides) > worst(held));
  CHECK(worst(free) > worst(slides));
}

TEST_CASE("where three regions of a plane mesh meet the node stays, the others slide") {
  const Mesh mesh = bent_square(true, 2);
  const CommandResult held = smoothed(mesh, Interfaces::automatic);
  CHECK(words(held) ==
        "holds 10 nodes in which regions meet (left and low 4, left and high 4, low and high 4)");
  for (const Index node : interface_nodes_inside(*mesh.topology))
    CHECK(held.state.mesh.coordinates.same_place(node, mesh.coordinates));
  const CommandResult slides = smoothed(mesh, Interfaces::slide);
  CHECK(
      words(slides) ==
      "slides 9 and holds 1 nodes in which regions meet (left and low 4, left and high 4, low and "
      "high 4)");
  REQUIRE(slides.smooth.boundary.interfaces.held.size() == 1);
  const Index triple = slides.smooth.boundary.interfaces.held.front();
  CHECK((mesh.coordinates.xy(triple) - Vec2(line(0.5), 0.5)).norm() < 1e-12);
  CHECK(slides.state.mesh.coordinates.same_place(triple, mesh.coordinates));
  for (const SlidingPart& part : slides.smooth.boundary.sliding)
    for (const Index node : part.nodes)
      if (part.marker == "low and high")
        CHECK(std::abs(slides.state.mesh.coordinates.xy(node).y() - 0.5) < 1e-12);
}

TEST_CASE("regions of a volume mesh: held, sliding on their plane, with a line of three, or free") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    CAPTURE(std::string(name_of(volumes)));
    Mesh mesh = make_mesh(with_regions(cube(4, volumes), {"left", "low", "high"}, thirds));
    Random random(3);
    for (const Index node : mesh.topology->interior_nodes()) {
      Vec3 p = mesh.coordinates.xyz(node);
      const Vec3 step = 0.06 * random_vector(random);
      const bool on_first = std::abs(p.x() - 0.5) < 1e-9;
      const bool on_second = p.x() > 0.5 - 1e-9 && std::abs(p.z() - 0.5) < 1e-9;
      if (!on_first) p.x() += step.x();
      if (!on_second) p.z() += step.z();
      p.y() += step.y();
      mesh.coordinates.set_xyz(node, p);
    }
    const std::vector<Index> meeting = interface_nodes_inside(*mesh.topology);
    CHECK(meeting.size() == 9 + 3);
    const CommandResult held = smoothed(mesh, Interfaces::automatic, true);
    CHECK(words(held) ==
          "holds 12 nodes in which regions meet (left and low 6, left and high 6, low and high 6)");
    for (const Index node : meeting)
      CHECK(held.state.mesh.coordinates.same_place(node, mesh.coordinates));

    SmoothCommand smooth;
    smooth.smooth.targets = TargetBlend::regular();
    smooth.smooth.slide.interfaces = Interfaces::slide;
    for (const bool along_lines : {false, true}) {
      CAPTURE(along_lines);
      smooth.smooth.slide.features = along_lines;
      const CommandResult slides = execute(smooth, make_state(mesh));
      CHECK(slides.smooth.converged);
      const InterfaceReport& report = slides.smooth.boundary.interfaces;
      CHECK(report.all.sliding == (along_lines ? 12 : 9));
      CHECK(report.all.held == (along_lines ? 0 : 3));
      const Coordinates& x = slides.state.mesh.coordinates;
      for (const Index node : meeting) {
        const Vec3 before = mesh.coordinates.xyz(node), after = x.xyz(node);
        if (std::abs(before.x() - 0.5) < 1e-9) CHECK(std::abs(after.x() - 0.5) < 1e-12);
        if (before.x() > 0.5 - 1e-9 && std::abs(before.z() - 0.5) < 1e-9)
          CHECK(std::abs(after.z() - 0.5) < 1e-12);
        const bool stays = std::ranges::binary_search(report.held, node);
        CHECK(stays == x.same_place(node, mesh.coordinates));
      }
    }
    const CommandResult free = smoothed(mesh, Interfaces::free, true);
    CHECK(words(free).starts_with("leaves free 12 nodes"));
    CHECK(moved(mesh.coordinates, free.state.mesh.coordinates).size() ==
          mesh.topology->interior_nodes().size());
  }
}

TEST_CASE("meshes without regions or of one region are smoothed as ever, and nothing is said") {
  Mesh mesh = make_mesh(square(n, Cells::mixed));
  Random random(4);
  perturb(mesh, random);
  const CommandResult none = smoothed(mesh, Interfaces::automatic);
  CHECK(words(none).empty());
  const Mesh one = {Topology::build(with_regions(square(n, Cells::mixed), {"all"},
                                                 [](const Vec3&) { return 0; })),
                    mesh.coordinates};
  for (const Interfaces interfaces :
       {Interfaces::automatic, Interfaces::held, Interfaces::slide, Interfaces::free}) {
    const CommandResult result = smoothed(one, interfaces);
    CHECK(words(result).empty());
    CHECK(result.smooth.boundary.sliding.empty());
    CHECK(moved(none.state.mesh.coordinates, result.state.mesh.coordinates).empty());
  }
}

TEST_CASE(
    "a marker between regions holds its nodes itself, and boundaries that slide end at regions") {
  MeshData data = with_regions(square(n, Cells::triangles), {"left", "right"}, halves);
  const Mesh plain = make_mesh(data);
  REQUIRE(plain.topology->interfaces().size() == 1);
  SmoothCommand smooth;
  smooth.smooth.slide.markers = {"top"};
  smooth.smooth.slide.spacing = SlideSpacing::free;
  const Mesh bent = bent_square(false, 5);
  for (const Interfaces interfaces : {Interfaces::held, Interfaces::slide, Interfaces::free}) {
    smooth.smooth.slide.interfaces = interfaces;
    const CommandResult result = execute(smooth, make_state(bent));
    CHECK(result.smooth.converged);
    Index end = 0;
    while ((bent.coordinates.xy(end) - Vec2(0.5, 1)).norm() > 1e-9) ++end;
    CHECK(result.state.mesh.coordinates.same_place(end, bent.coordinates) ==
          (interfaces != Interfaces::free));
    Index top = 0;
    for (const SlidingPart& part : result.smooth.boundary.sliding)
      if (part.marker == "top") top += static_cast<Index>(part.nodes.size());
    CHECK(top == (interfaces == Interfaces::free ? n - 1 : n - 2));
    for (const Index node : bent.topology->markers().nodes(*bent.topology->markers().find("top")))
      CHECK(std::abs(result.state.mesh.coordinates.xy(node).y() - 1) < 1e-12);
  }

  data.markers.push_back({"baffle", 9, plain.topology->interfaces()[0].faces});
  const Mesh marked = make_mesh(data);
  CHECK(marked.topology->interfaces().empty());
  CHECK(words(smoothed(marked, Interfaces::automatic)).empty());
}

TEST_CASE("motions leave nodes in which regions meet free unless they are to be held") {
  MeshData data = with_regions(square_with_hole(10, Cells::triangles), {"low", "high"},
                               [](const Vec3& p) { return p.y() < 0.7 ? 0 : 1; });
  const Mesh mesh = make_mesh(data);
  const std::vector<Index> meeting = interface_nodes_inside(*mesh.topology);
  REQUIRE(meeting.size() == 9);
  MoveCommand move;
  move.bodies[0].markers = {"hole"};
  move.bodies[0].motion.translate = Vec3(0.05, 0.03, 0);
  const auto after = [&](Interfaces interfaces) {
    move.smooth.slide.interfaces = interfaces;
    CommandResult result = execute(move, make_state(mesh));
    CHECK(result.smooth.fraction_reached == 1);
    CHECK(result.smooth.inverted == 0);
    return result;
  };
  const CommandResult automatic = after(Interfaces::automatic), free = after(Interfaces::free);
  CHECK(words(automatic) == "leaves free 9 nodes in which the regions low and high meet");
  CHECK(moved(automatic.state.mesh.coordinates, free.state.mesh.coordinates).empty());
  const CommandResult held = after(Interfaces::held);
  CHECK(words(held) == "holds 9 nodes in which the regions low and high meet");
  for (const Index node : meeting) {
    CHECK(held.state.mesh.coordinates.same_place(node, mesh.coordinates));
    CHECK_FALSE(free.state.mesh.coordinates.same_place(node, mesh.coordinates));
  }
  move.smooth.slide.hold_nodes = meeting;
  CHECK(moved(after(Interfaces::free).state.mesh.coordinates, held.state.mesh.coordinates).empty());
  move.smooth.slide.hold_nodes.clear();
  const CommandResult slides = after(Interfaces::slide);
  for (const Index node : meeting)
    CHECK(std::abs(slides.state.mesh.coordinates.xy(node).y() - 0.7) < 1e-12);
}

TEST_CASE("a motion takes nodes from where regions meet, whatever these are to do") {
  const Mesh mesh = bent_square(false, 6);
  const std::vector<Index> meeting = interface_nodes_inside(*mesh.topology);
  const std::vector<Index> moving{meeting[2], meeting[4]};
  SlideOptions slide;
  for (const Interfaces interfaces : {Interfaces::held, Interfaces::slide}) {
    slide.interfaces = interfaces;
    NodeClasses classes(mesh.topology);
    const MovingBoundary boundary = make_boundary_move(slide, mesh, moving, classes);
    classes.set_prescribed(moving);
    CHECK(boundary.interfaces.all.count() == n - 3);
    for (const Index node : meeting) {
      const bool taken = std::ranges::binary_search(moving, node);
      CHECK(classes[node] == (taken                             ? NodeClass::prescribed
                              : interfaces == Interfaces::slide ? NodeClass::on_curve
                                                                : NodeClass::fixed));
    }
  }
}

TEST_CASE(
    "single nodes where regions meet are held or made smooth, and the pointwise form refuses") {
  const Mesh mesh = bent_square(false, 7);
  const std::vector<Index> meeting = interface_nodes_inside(*mesh.topology);
  SmoothCommand smooth;
  smooth.smooth.slide.interfaces = Interfaces::slide;
  smooth.smooth.slide.hold_nodes = {meeting[3]};
  const CommandResult one = execute(smooth, make_state(mesh));
  CHECK(words(one) == "slides 6 and holds 1 nodes in which the regions left and right meet");
  CHECK(one.state.mesh.coordinates.same_place(meeting[3], mesh.coordinates));
  smooth.smooth.slide.hold_nodes.clear();
  smooth.smooth.slide.feature_angle = 0;  // corners all
  smooth.smooth.slide.smooth_nodes = {meeting[1]};
  CHECK(execute(smooth, make_state(mesh)).smooth.boundary.interfaces.all.sliding == 1);
  smooth.smooth.slide.smooth_nodes = {0};
  CHECK_THROWS_WITH_AS(execute(smooth, make_state(mesh)),
                       doctest::Contains("no two regions meet there"), UsageError);

  smooth.smooth = {};
  smooth.smooth.formulation = Formulation::pointwise;
  const CommandResult held = execute(smooth, make_state(mesh));
  CHECK(words(held) == "holds 7 nodes in which the regions left and right meet");
  for (const Index node : meeting)
    CHECK(held.state.mesh.coordinates.same_place(node, mesh.coordinates));
  smooth.smooth.slide.interfaces = Interfaces::slide;
  CHECK_THROWS_WITH_AS(execute(smooth, make_state(mesh)),
                       doctest::Contains("where regions meet, is to slide"), UsageError);
}

TEST_CASE("a scramble leaves nodes in which regions meet, so that smoothing untangles the mesh") {
  const Mesh mesh = bent_square(true, 8);
  const MeshState tangled = execute(ScrambleCommand{}, make_state(mesh)).state;
  for (const Index node : interface_nodes_inside(*mesh.topology))
    CHECK(tangled.mesh.coordinates.same_place(node, mesh.coordinates));
  CHECK(check_validity(*mesh.topology, tangled.mesh.coordinates).inverted > 0);
  smoothed(tangled.mesh, Interfaces::automatic);
  smoothed(tangled.mesh, Interfaces::slide);
}

TEST_CASE("layers divide the regions at their wall, and hold where these meet beyond") {
  const MeshData data = with_regions(square(10, Cells::triangles), {"left", "right"}, halves);
  LayersCommand layers;
  layers.layers.walls.resize(1);
  layers.layers.walls[0].markers = {"bottom"};
  layers.layers.walls[0].spacing.first = 0.005;
  layers.layers.walls[0].spacing.count = 3;
  const Mesh mesh = make_mesh(data);
  const CommandResult result = execute(layers, make_state(mesh));
  CHECK(result.smooth.inverted == 0);
  const Topology& topology = *result.state.mesh.topology;
  REQUIRE(topology.element_count() > mesh.topology->element_count());
  for (Index e = 0; e < topology.element_count(); ++e) {
    const double x = element_centre(result.state.mesh, e).x();
    CHECK(topology.element_regions()[at(e)] == (x < 0.5 ? 0 : 1));
  }
  for (const Index node : interface_nodes_inside(*mesh.topology))
    CHECK(result.state.mesh.coordinates.same_place(node, mesh.coordinates));
  CHECK(words(result).starts_with("holds 12 nodes"));  // 9 of before, 2 of layers and their rim
}

TEST_CASE("roles show the nodes that stay because regions meet there") {
  const Mesh mesh = bent_square(false, 9);
  SlideOptions slide;
  const auto count = [](const NodeRoles& roles, NodeRole role) {
    return roles.counts[static_cast<std::size_t>(role)];
  };
  const NodeRoles held = node_roles(mesh, slide, {});
  CHECK(held.fault.empty());
  CHECK(count(held, NodeRole::regions) == n - 1);
  REQUIRE(held.found.size() == 1);
  CHECK(held.found[0] == "left and right: 7 nodes stay where these regions meet");
  const NodeRoles moving = node_roles(mesh, slide, {"top"});
  CHECK(count(moving, NodeRole::regions) == 0);
  CHECK(count(moving, NodeRole::free) == (n - 1) * (n - 1));
  slide.interfaces = Interfaces::slide;
  const NodeRoles slides = node_roles(mesh, slide, {});
  CHECK(count(slides, NodeRole::regions) == 0);
  CHECK(count(slides, NodeRole::on_curve) == n - 1);
  slide.interfaces = Interfaces::free;
  CHECK(count(node_roles(mesh, slide, {}), NodeRole::free) == (n - 1) * (n - 1));
}

TEST_CASE("borders of regions of a surface mesh are held, slide along their curve, or are free") {
  const auto dome = [](const Vec2& p) {
    return Vec3(p.x(), p.y(), 0.3 * p.x() * (1 - p.x()) + 0.2 * p.y() * (1 - p.y()));
  };
  MeshData plane = with_regions(square(n, Cells::triangles), {"left", "right"}, halves);
  Random random(10);
  for (Index i = 0; i < plane.node_count(); ++i) {
    const Vec2 p = plane.coordinates.xy(i);
    if ((p - Vec2(0.5, 0.5)).cwiseAbs().maxCoeff() > 0.5 - 1e-9) continue;
    const Vec2 step = 0.25 / n * random.vector();
    plane.coordinates.set_xy(
        i, {p.x() + (std::abs(p.x() - 0.5) < 1e-9 ? 0 : step.x()), p.y() + step.y()});
  }
  const Mesh mesh = make_mesh(lifted(plane, dome));
  REQUIRE(is_surface(*mesh.topology));
  const std::vector<Index> meeting = interface_nodes_inside(*mesh.topology);
  REQUIRE(meeting.size() == n - 1);
  const CommandResult held = smoothed(mesh, Interfaces::automatic);
  CHECK(words(held) == "holds 9 nodes in which the regions left and right meet");
  for (const Index node : meeting)
    CHECK(held.state.mesh.coordinates.same_place(node, mesh.coordinates));
  const CommandResult slides = smoothed(mesh, Interfaces::slide);
  CHECK(slides.smooth.boundary.interfaces.all.sliding == n - 1);
  for (const Index node : meeting) {
    const Vec3 p = slides.state.mesh.coordinates.xyz(node);
    CHECK(std::abs(p.x() - 0.5) < 1e-9);
    CHECK((p - mesh.coordinates.xyz(node)).norm() > 1e-5);
  }
  const CommandResult free = smoothed(mesh, Interfaces::free);
  double off = 0;
  for (const Index node : meeting)
    off = std::max(off, std::abs(free.state.mesh.coordinates.xyz(node).x() - 0.5));
  CHECK(off > 1e-4);
  // The shape is that of the mesh as given, whatever was held before.
  const CommandResult again = execute(SmoothCommand{}, free.state);
  CHECK(words(again).starts_with("holds 9 nodes"));
  const NodeRoles roles = node_roles(make_state(mesh), {}, {});
  CHECK(roles.counts[static_cast<std::size_t>(NodeRole::regions)] == n + 1);
}

}  // namespace winslow::test
