#include "core/motion/sheets.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/command/command.h"
#include "core/mesh/mesh.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// The unit square with a sail without thickness at x = 0.5, between its tips at y = 1/6 and 5/6;
/// markers outer, sail.
MeshData sail_data(Cells cells) {
  MeshData data = opened(
      square(12, cells),
      [](const Vec3& p) {
        return std::abs(p.x() - 0.5) < 1e-9 && p.y() > 1.0 / 6 + 1e-9 && p.y() < 5.0 / 6 - 1e-9;
      },
      [](const Vec3& p) { return p.x() > 0.5; });
  data.markers.clear();
  mark_boundary(data, [](const Vec2& p) {
    return (p - Vec2(0.5, 0.5)).cwiseAbs().maxCoeff() > 0.5 - 1e-9 ? "outer" : "sail";
  });
  return data;
}
Mesh sail(Cells cells = Cells::triangles) { return make_mesh(sail_data(cells)); }

/// The unit cube with a square sail at z = 0.5 between its rim at x, y = 1/6 and 5/6; markers
/// outer, sail.
Mesh sail_in_space(Volumes volumes) {
  const auto inside = [](double c) { return c > 1.0 / 6 + 1e-9 && c < 5.0 / 6 - 1e-9; };
  MeshData data = opened(
      cube(6, volumes),
      [&](const Vec3& p) { return std::abs(p.z() - 0.5) < 1e-9 && inside(p.x()) && inside(p.y()); },
      [](const Vec3& p) { return p.z() > 0.5; });
  data.markers.clear();
  mark_volume(data, [](const Vec3& p) {
    return (p - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() > 0.5 - 1e-9 ? "outer" : "sail";
  });
  return make_mesh(data);
}

/// Nodes of the sail in the order of their numbers: those of the side below (in the plane: left),
/// which was there first, and their copies.
struct Sides {
  std::vector<Index> below, above;
};
Sides sides_of(const Mesh& mesh) {
  const std::vector<std::string> names{"sail"};
  Sides sides;
  for (const Index node : mesh.topology->markers().nodes_of(names)) {
    const Vec3 place = place_of(mesh.coordinates, node);
    for (const Index other : mesh.topology->markers().nodes_of(names))
      if (other > node && place_of(mesh.coordinates, other) == place) {
        sides.below.push_back(node);
        sides.above.push_back(other);
      }
  }
  return sides;
}

/// Displaces nodes in one direction, the middle of the sail most.
DisplacementTable bulge(const Mesh& mesh, std::span<const Index> nodes, const Vec3& by) {
  DisplacementTable table;
  for (const Index node : nodes) {
    const Vec3 place = place_of(mesh.coordinates, node);
    double share = 1;
    for (int k = 0; k < mesh.coordinates.dimension(); ++k)
      share *= std::cos(1.5 * pi * (place[k] - 0.5));
    table.entries.push_back(
        {node, {0, 0}, GivenVector::of(mesh.coordinates.dimension(), share * by), 0});
  }
  return table;
}

std::optional<Contact> contact_of(const Mesh& mesh, const DisplacementTable& table) {
  return find_contact(*mesh.topology, mesh.coordinates,
                      *make_motion(*mesh.topology, mesh.coordinates, {}, table));
}

void append(DisplacementTable& table, const DisplacementTable& more) {
  table.entries.insert(table.entries.end(), more.entries.begin(), more.entries.end());
}

CommandResult executed(const DeformCommand& deform, const Mesh& mesh) {
  RunOptions options;
  options.all_or_nothing = true;
  return execute(deform, make_state(mesh), options);
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (Index e = 0; e < mesh.topology->element_count(); ++e)
    sum += signed_area2(mesh.coordinates, mesh.topology->element(e)) / 2;
  return sum;
}

/// A distance that is positive up to 60 % of the way and negative after it.
class OpensAndCloses final : public Motion {
 public:
  explicit OpensAndCloses(std::vector<Index> nodes) : nodes_(std::move(nodes)) {}
  std::span<const Index> nodes() const override { return nodes_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    const double way = 0.2 * fraction * (0.6 - fraction);
    for (const Index node : nodes_) out.set_xy(node, rest.xy(node) - Vec2(way, 0));
  }

 private:
  std::vector<Index> nodes_;
};

}  // namespace

TEST_CASE("sides of a sheet may part but not pass through each other") {
  for (const Cells cells : {Cells::triangles, Cells::quads}) {
    const Mesh mesh = sail(cells);
    const Sides sides = sides_of(mesh);
    REQUIRE(sides.below.size() == 7);
    for (const auto* side : {&sides.below, &sides.above}) {
      const double away = side == &sides.below ? -1 : 1;
      CAPTURE(away);
      CHECK_FALSE(contact_of(mesh, bulge(mesh, *side, Vec3(0.1 * away, 0, 0))));
      const auto contact = contact_of(mesh, bulge(mesh, *side, Vec3(-0.1 * away, 0, 0)));
      REQUIRE(contact);
      CHECK(contact->fraction < 1e-4);
      CHECK(contact->edges.moving == "sail");
      CHECK(contact->edges.other == "sail");
      // Where the way is longest.
      CHECK((contact->edges.place - Vec3(0.5, 0.5, 0)).norm() < 1e-4);
      CHECK(describe_touch(contact->edges) ==
            "the two sides of sail would pass through each other at (0.5, 0.5)");
    }
  }
}

TEST_CASE("a single node of a side, also one beside the tip, is seen to pass through the other") {
  const Mesh mesh = sail();
  const Sides sides = sides_of(mesh);
  for (const Index node : sides.below) {
    CAPTURE(node);
    CHECK(contact_of(mesh, {{{node, {0, 0}, {0.02, 0}, 0}}, ""}));
    CHECK_FALSE(contact_of(mesh, {{{node, {0, 0}, {-0.02, 0}, 0}}, ""}));
    // Along the sheet, where neither parts from the other.
    CHECK_FALSE(contact_of(mesh, {{{node, {0, 0}, {0, 0.02}, 0}}, ""}));
  }
}

TEST_CASE("a sheet whose sides move together has no contact, nor if rounded differently") {
  const Mesh mesh = sail();
  const Sides sides = sides_of(mesh);
  DisplacementTable both = bulge(mesh, sides.below, Vec3(0.15, 0, 0));
  append(both, bulge(mesh, sides.above, Vec3(0.15, 0, 0)));
  CHECK_FALSE(contact_of(mesh, both));
  DisplacementTable rounded = bulge(mesh, sides.below, Vec3(0.15, 0, 0));
  append(rounded, bulge(mesh, sides.above, Vec3(0.15 - 1e-9, 0, 0)));
  CHECK_FALSE(contact_of(mesh, rounded));
  // Both go the same way, the one in front farther or less far.
  DisplacementTable parting = bulge(mesh, sides.below, Vec3(0.05, 0, 0));
  append(parting, bulge(mesh, sides.above, Vec3(0.15, 0, 0)));
  CHECK_FALSE(contact_of(mesh, parting));
  DisplacementTable passing = bulge(mesh, sides.below, Vec3(0.15, 0, 0));
  append(passing, bulge(mesh, sides.above, Vec3(0.05, 0, 0)));
  CHECK(contact_of(mesh, passing));
}

TEST_CASE("sides that part and come back pass through each other where they meet again") {
  const Mesh mesh = sail();
  const auto contact =
      find_contact(*mesh.topology, mesh.coordinates, OpensAndCloses(sides_of(mesh).below));
  REQUIRE(contact);
  CHECK(contact->fraction == doctest::Approx(0.6).epsilon(1e-3));
}

TEST_CASE("a row by place moves both sides of a sheet: no hole opens and nothing overlaps") {
  const Mesh mesh = sail();
  DisplacementTable table;
  for (const Index node : sides_of(mesh).below)
    table.entries.push_back({std::nullopt, mesh.coordinates.xy(node), {0.1, 0}, 0});
  for (const std::vector<std::string>& markers :
       {std::vector<std::string>{"sail"}, std::vector<std::string>{}}) {
    DeformCommand deform;
    deform.markers = markers;
    deform.shape = table;
    const CommandResult result = executed(deform, mesh);
    CHECK(result.smooth.fraction_reached == 1);
    CHECK(result.smooth.inverted == 0);
    CHECK(area_of(result.state.mesh) == doctest::Approx(1).epsilon(1e-12));
    for (const auto& side : {sides_of(mesh).below, sides_of(mesh).above})
      for (const Index node : side)
        CHECK(result.state.mesh.coordinates.xy(node) ==
              Vec2(mesh.coordinates.xy(node) + Vec2(0.1, 0)));
  }
}

TEST_CASE("a crack opens if the nodes of one side move, and is refused the other way") {
  const Mesh mesh = sail();
  DeformCommand deform;
  deform.shape = bulge(mesh, sides_of(mesh).below, Vec3(-0.1, 0, 0));
  const CommandResult opened = executed(deform, mesh);
  CHECK(opened.smooth.fraction_reached == 1);
  CHECK(opened.smooth.inverted == 0);
  CHECK(area_of(opened.state.mesh) < 0.97);
  deform.shape = bulge(mesh, sides_of(mesh).below, Vec3(0.1, 0, 0));
  const CommandResult refused = executed(deform, mesh);
  CHECK(refused.smooth.fraction_reached == 0);
  REQUIRE(refused.smooth.contact);
  CHECK(refused.smooth.contact->edges.one_sheet);
  CHECK(refused.state.mesh.coordinates == mesh.coordinates);
  // A crack that is open may close again.
  const Mesh& open = opened.state.mesh;
  const auto motion = make_motion(*open.topology, open.coordinates, {},
                                  bulge(mesh, sides_of(mesh).below, Vec3(0.09, 0, 0)));
  CHECK_FALSE(find_contact(*open.topology, open.coordinates, *motion));
}

TEST_CASE("at a corner and at a fork of sheets each side is one side") {
  // A sheet down to the middle of the square, and one across it that ends there or goes on.
  for (const double end : {0.5, 0.75}) {
    CAPTURE(end);
    const auto across = [&](const Vec3& p) {
      return std::abs(p.y() - 0.5) < 1e-9 && p.x() > 0.25 - 1e-9 && p.x() < end + 1e-9;
    };
    const auto down = [](const Vec3& p) {
      return std::abs(p.x() - 0.5) < 1e-9 && p.y() > 0.5 - 1e-9 && p.y() < 0.75 + 1e-9;
    };
    const bool fork = end > 0.5;
    MeshData data = square(8, Cells::quads);
    if (fork) {
      data = opened(data, across, [](const Vec3& p) { return p.y() > 0.5; });
      data = opened(data, down, [](const Vec3& p) { return p.x() > 0.5 && p.y() > 0.5; });
    } else {
      data = opened(
          data, [&](const Vec3& p) { return across(p) || down(p); },
          [](const Vec3& p) { return p.x() < 0.5 && p.y() > 0.5; });
    }
    data.markers.clear();
    mark_boundary(data, [](const Vec2& p) {
      return (p - Vec2(0.5, 0.5)).cwiseAbs().maxCoeff() > 0.5 - 1e-9 ? "outer" : "sheet";
    });
    const Mesh mesh = make_mesh(data);
    std::vector<Index> middle;
    for (Index node = 0; node < mesh.coordinates.size(); ++node)
      if (mesh.topology->used(node) && (mesh.coordinates.xy(node) - Vec2(0.5, 0.5)).norm() < 1e-9)
        middle.push_back(node);
    REQUIRE(middle.size() == (fork ? 3u : 2u));
    for (const Index node : middle) {
      // Towards the elements of the node the sheets part, away from them they are passed.
      Vec2 own(0, 0);
      for (const Index e : mesh.topology->star(node))
        own += element_centre(mesh, e).head<2>() - Vec2(0.5, 0.5);
      const Vec2 way = 0.02 * own.normalized();
      CAPTURE(node);
      CHECK_FALSE(contact_of(mesh, {{{node, {0, 0}, way, 0}}, ""}));
      CHECK(contact_of(mesh, {{{node, {0, 0}, Vec2(-way), 0}}, ""}));
    }
  }
}

TEST_CASE("sides of a sheet in space may part but not pass through each other") {
  for (const Volumes volumes : {Volumes::hexahedra, Volumes::tetrahedra, Volumes::prisms}) {
    const Mesh mesh = sail_in_space(volumes);
    const Sides sides = sides_of(mesh);
    REQUIRE(sides.below.size() >= 9);
    CHECK_FALSE(contact_of(mesh, bulge(mesh, sides.below, Vec3(0, 0, -0.1))));
    CHECK_FALSE(contact_of(mesh, bulge(mesh, sides.above, Vec3(0, 0, 0.1))));
    const auto contact = contact_of(mesh, bulge(mesh, sides.below, Vec3(0, 0, 0.1)));
    REQUIRE(contact);
    CHECK(contact->fraction < 1e-4);
    CHECK((contact->edges.place - Vec3(0.5, 0.5, 0.5)).norm() < 1e-4);
    CHECK(describe_touch(contact->edges) ==
          "the two sides of sail would pass through each other at (0.5, 0.5, 0.5)");
    for (const Index node : sides.above) {
      CHECK(contact_of(mesh, {{{node, {0, 0}, {0, 0, -0.02}, 0}}, ""}));
      CHECK_FALSE(contact_of(mesh, {{{node, {0, 0}, {0, 0, 0.02}, 0}}, ""}));
    }
    DisplacementTable both = bulge(mesh, sides.below, Vec3(0, 0, 0.1));
    append(both, bulge(mesh, sides.above, Vec3(0, 0, 0.1)));
    CHECK_FALSE(contact_of(mesh, both));
  }
}

TEST_CASE("the name of the other side's marker is given, and a mesh in one piece has no sheets") {
  const Mesh mesh = sail();
  const Sides sides = sides_of(mesh);
  MeshData data = sail_data(Cells::triangles);
  Marker left{"left", 8, {}}, right{"right", 9, {}};
  for (Marker& marker : data.markers) {
    if (marker.name != "sail") continue;
    for (const Face& face : marker.faces) {
      const bool copy = std::ranges::any_of(
          face, [&](Index node) { return std::ranges::binary_search(sides.above, node); });
      (copy ? right : left).faces.push_back(face);
    }
  }
  std::erase_if(data.markers, [](const Marker& marker) { return marker.name == "sail"; });
  data.markers.push_back(left);
  data.markers.push_back(right);
  const Mesh two = make_mesh(data);
  const auto contact = contact_of(two, bulge(two, sides.above, Vec3(-0.1, 0, 0)));
  REQUIRE(contact);
  CHECK(describe_touch(contact->edges) ==
        "right would pass through left, on which it lies, at (0.5, 0.5)");
  // A row by place takes the nodes of the chosen marker alone.
  const DisplacementTable at_place{{{std::nullopt, {0.5, 0.5}, {0.05, 0}, 0}}, ""};
  const auto motion = make_motion(*two.topology, two.coordinates, {"right"}, at_place);
  CHECK_FALSE(find_contact(*two.topology, two.coordinates, *motion));
  CHECK(std::ranges::binary_search(motion->nodes(), sides.above[3]));
  CHECK_FALSE(std::ranges::binary_search(motion->nodes(), sides.below[3]));

  const Mesh whole = make_mesh(square_with_two_holes(10, Cells::quads));
  RigidMotion shift{0, Vec2(0, 0), Vec2(0.05, 0)};
  const auto moved = make_motion(*whole.topology, whole.coordinates, {"hole_a"}, shift);
  CHECK_FALSE(find_passage<2>(*whole.topology, whole.coordinates, *moved, {}));
}
