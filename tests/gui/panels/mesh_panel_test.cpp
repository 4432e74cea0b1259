#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "gui/support/rig.h"
#include "io/format/mesh_file.h"

namespace winslow::gui::test {

namespace {

std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// An SU2 file of two zones: the ring, and two bodies.
std::filesystem::path two_zones(const TemporaryFolder& folder) {
  const std::string first = content(write(folder, ring_mesh(), "first.su2"));
  const std::string second = content(write(folder, two_body_mesh(), "second.su2"));
  const auto path = folder / "zones.su2";
  std::ofstream(path) << "NZONE= 2\nIZONE= 1\n" << first << "\nIZONE= 2\n" << second;
  return path;
}

}  // namespace

TEST_CASE("the panel says what the mesh is: extents, elements by type, edges by marker") {
  Rig rig(1280, 1200);
  rig.open(two_body_mesh());
  CHECK_FALSE(rig.visible("mesh/counts"));
  rig.click("section/mesh");
  rig.frames();
  CHECK(rig.visible("mesh/extents"));
  CHECK(rig.visible("mesh/counts"));
  CHECK(rig.visible("mesh/markers"));
  // Lines: nodes, those on the boundary, elements, quadrilaterals; no triangles, none unused.
  const auto counts = rig.bench->widgets().find("mesh/counts");
  const auto extents = rig.bench->widgets().find("mesh/extents");
  const double line = (extents->max.y() - extents->min.y()) / 3;
  CHECK((counts->max.y() - counts->min.y()) / line == doctest::Approx(4).epsilon(0.1));
}

TEST_CASE("a file of several zones opens with its first and offers the others") {
  Rig rig;
  const auto path = two_zones(rig.folder);
  rig.bench->apply(action::OpenMesh{path});
  REQUIRE(rig.settle());
  REQUIRE(rig.session().document() != nullptr);
  CHECK(rig.session().messages().prompt() == nullptr);
  CHECK(rig.bench->title() == "zones.su2, zone 1 of 2 - winslow");
  CHECK(rig.mesh().topology->markers().find("flap").has_value());
  rig.click("mesh/zone");
  rig.click("mesh/zone/2 of 2");
  REQUIRE(rig.settle());
  CHECK(rig.bench->title() == "zones.su2, zone 2 of 2 - winslow");
  CHECK(rig.mesh().topology->markers().find("left").has_value());

  // What one zone has become is saved with the other as it was.
  rig.bench->apply(action::SelectMarkers{{rig.marker("left")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  REQUIRE(rig.settle());
  const Coordinates moved = rig.mesh().coordinates;
  rig.click("mesh/zone");
  rig.click("mesh/zone/1 of 2");
  REQUIRE(rig.session().messages().prompt() != nullptr);  // it would be lost
  rig.bench->apply(action::DismissPrompt{});
  rig.frames();
  const auto saved = rig.folder / "saved.su2";
  rig.bench->apply(action::SaveMesh{saved, true});
  REQUIRE(rig.settle());
  CHECK(io::read_mesh(saved, {.zone = 2}).mesh.coordinates == moved);
  CHECK(io::read_mesh(saved, {.zone = 1}).mesh.coordinates ==
        io::read_mesh(path, {.zone = 1}).mesh.coordinates);

  // The other zone is then taken from the file that was saved.
  rig.click("mesh/zone");
  rig.click("mesh/zone/1 of 2");
  REQUIRE(rig.settle());
  CHECK(rig.document().path() == saved);
  CHECK(rig.document().zone() == 1);
}

TEST_CASE("a file that is one mesh has no choice of zones") {
  Rig rig;
  rig.open(ring_mesh());
  CHECK_FALSE(rig.visible("mesh/zone"));
  CHECK(rig.document().zone() == 0);
  CHECK(rig.bench->title() == "mesh.su2 - winslow");
}

}  // namespace winslow::gui::test
