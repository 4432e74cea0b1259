#include <doctest/doctest.h>

#include "core/drag/drag_session.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"
#include "support/wait.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// The surface of a cube around (0.5, 0.5, 0.5), in a file by name.
ReferenceSurface box_surface(double size, const Vec3& away = Vec3(0, 0, 0)) {
  const MeshData data = skin(cube(4, Volumes::hexahedra));
  ReferenceSurface out;
  out.source = "box.obj";
  for (Index i = 0; i < data.node_count(); ++i)
    out.points.push_back(Vec3::Constant(0.5) +
                         size * (data.coordinates.xyz(i) - Vec3::Constant(0.5)) + away);
  for (Index e = 0; e < data.element_count(); ++e) out.faces.emplace_back(data.element(e));
  return out;
}

/// A cavity in a cube, whose outside slides on a surface that was not read.
struct Cavity {
  explicit Cavity(const Vec3& away = Vec3(0, 0, 0), Index n = 6)
      : state(make_state(mesh(away, n))) {
    options.slide.markers = {"outer"};
    options.slide.reference.name = "box.obj";
    wanted.translate = Vec3(0.05, 0.02, 0);
    wanted.pivot = Vec3::Constant(0.5) + away;
  }
  static Mesh mesh(const Vec3& away, Index n) {
    Mesh mesh = make_mesh(cube_with_cavity(n, Volumes::tetrahedra));
    for (Index i = 0; i < mesh.coordinates.size(); ++i)
      mesh.coordinates.set_xyz(i, mesh.coordinates.xyz(i) + away);
    return mesh;
  }
  /// What the command makes of it that ends the drag.
  Coordinates moved(const ReferenceSurface& surface) const {
    MoveCommand command{{"cavity"}, wanted, {}, options};
    command.smooth.slide.reference.surface = std::make_shared<ReferenceSurface>(surface);
    return execute(command, state).state.mesh.coordinates;
  }

  MeshState state;
  SmoothOptions options;
  SpaceMotion wanted;
};

/// Largest distance of the outer nodes from the box of that size.
double off_box(const Mesh& mesh, const Coordinates& x, double size, const Vec3& away) {
  double largest = 0;
  const std::vector<std::string> outer{"outer"};
  for (const Index node : mesh.topology->markers().nodes_of(outer)) {
    const Vec3 p = x.xyz(node) - away - Vec3::Constant(0.5);
    largest = std::max(largest, std::abs(p.cwiseAbs().maxCoeff() - size / 2));
  }
  return largest;
}

}  // namespace

TEST_CASE(
    "a drag slides on the reference surface that it reads, as the command that ends it does") {
  for (const Vec3& away : {Vec3(0, 0, 0), Vec3(4.5e5, 5.1e6, 300)}) {
    CAPTURE(away.transpose());
    const Cavity cavity(away);
    const ReferenceSurface surface = box_surface(1.02, away);
    int reads = 0;
    SpaceDragSession drag(cavity.state, DragGrip{{"cavity"}, {}, {}}, cavity.options, {},
                          [&](const std::string& name) {
                            CHECK(name == "box.obj");
                            ++reads;
                            return std::make_shared<ReferenceSurface>(surface);
                          });
    REQUIRE(wait_until([&] {
      drag.to(cavity.wanted);
      return drag.settled() || !drag.error().empty();
    }));
    REQUIRE(drag.error() == "");
    CHECK(reads == 1);
    const SpaceDragFrame& frame = drag.to(cavity.wanted);
    CHECK_FALSE(frame.held);
    CHECK(check_validity(*cavity.state.mesh.topology, frame.coordinates, 1).inverted == 0);
    // Nodes on edges, which do not slide, stay where they were.
    CHECK(off_box(cavity.state.mesh, frame.coordinates, 1, away) ==
          doctest::Approx(0.01).epsilon(1e-6));
    CHECK(largest_difference(frame.coordinates, cavity.moved(surface)) < 1e-7);
  }
}

TEST_CASE("a drag that goes on from a mesh beside the reference surface comes to the same mesh") {
  const Cavity cavity;
  const ReferenceSurface surface = box_surface(1.02);
  SpaceDragSession drag(cavity.state, DragGrip{{"cavity"}, {}, {}}, cavity.options,
                        SpaceDragSession::Start{cavity.state.mesh.coordinates, {}},
                        [&](const auto&) { return std::make_shared<ReferenceSurface>(surface); });
  REQUIRE(wait_until([&] {
    drag.to(cavity.wanted);
    return drag.settled() || !drag.error().empty();
  }));
  REQUIRE(drag.error() == "");
  CHECK(largest_difference(drag.to(cavity.wanted).coordinates, cavity.moved(surface)) < 1e-7);
}

TEST_CASE("a drag whose reference surface cannot be read, or does not fit, says why and stays") {
  const Cavity cavity(Vec3(0, 0, 0), 12);
  const auto error_with = [&](SpaceDragSession::ReadReference read) {
    SpaceDragSession drag(cavity.state, DragGrip{{"cavity"}, {}, {}}, cavity.options, {},
                          std::move(read));
    REQUIRE(wait_until([&] {
      drag.to(cavity.wanted);
      return !drag.error().empty();
    }));
    const SpaceDragFrame& frame = drag.to(cavity.wanted);
    CHECK(frame.held);
    CHECK(frame.coordinates == cavity.state.mesh.coordinates);
    return drag.error();
  };
  CHECK(error_with([](const auto&) -> std::shared_ptr<const ReferenceSurface> {
          throw InputError("box.obj:3: found \"v\"");
        }) == "box.obj:3: found \"v\"");
  CHECK(error_with({}).find("box.obj: this reference surface was not read") != std::string::npos);
  const std::string fault =
      error_with([](const auto&) { return std::make_shared<ReferenceSurface>(box_surface(0.8)); });
  CAPTURE(fault);
  CHECK(fault.find("smooth the mesh on it first") != std::string::npos);
}
