#include <array>

#include "io/support/samples.h"
#include "support/paths.h"
#include "support/space_meshes.h"

namespace winslow::test {
namespace {

const std::string passage_2 = read_text(test::test_data("periodic_22.msh"));
const std::string passage_4 = read_text(test::test_data("periodic_41.msh"));

/// Pairs of a file as "lower upper: 0-3 4-5", with " held ..." and the fault of each.
std::string pairs_text(const io::MeshFile& file) {
  std::string text;
  for (const GivenPairs& given : file.details->periodic->pairs) {
    text += (text.empty() ? "" : "; ") + given.first + " " + given.second + ":";
    for (const auto& [node, image] : given.pairs)
      text += " " + std::to_string(node) + "-" + std::to_string(image);
    if (!given.held.empty()) text += " held";
    for (const Index node : given.held) text += " " + std::to_string(node);
    if (!given.fault.empty()) text += " fault";
  }
  return text;
}

std::string section(const std::string& text) {
  const auto begin = text.find("$Periodic\n");
  return begin == std::string::npos ? "" : text.substr(begin);
}

/// The fault of the last pair of a file, from its name on.
std::string fault_of(const std::string& text) {
  const io::MeshFile file = read_from_text("a.msh", text);
  REQUIRE(!file.details->periodic->pairs.empty());
  const std::string fault = file.details->periodic->pairs.back().fault;
  const auto name = fault.find("a.msh:");
  REQUIRE(name != std::string::npos);
  return fault.substr(name);
}

void move_node(io::MeshFile& file, Index node, const Vec2& by) {
  file.mesh.coordinates.set_xy(node, file.mesh.coordinates.xy(node) + by);
}

}  // namespace

TEST_CASE("MSH: entities that Gmsh made periodic are pairs of the markers they are in") {
  for (const char* name : {"22", "22b", "41", "41b"}) {
    CAPTURE(name);
    const io::MeshFile file = io::read_mesh(test::test_data("periodic_") + name + ".msh");
    CHECK(file.warnings.empty());
    // Two curves of each marker, whose common node both list.
    CHECK(pairs_text(file) == "lower upper: 0-3 1-2 4-5");
    const PeriodicPairs pairs = PeriodicPairs::of(*file.mesh.topology, file.mesh.coordinates,
                                                  file.details->periodic->pairs[0]);
    CHECK(pairs.description == "translation by (0, 1)");
    CHECK(pairs.pairs == std::vector<PeriodicPair>{{4, 5}});
  }
}

TEST_CASE("MSH: one marker may hold both sides, turned by any angle") {
  const io::MeshFile file = io::read_mesh(test::test_data("periodic_sides.msh"));
  CHECK(pairs_text(file) == "sides sides: 0-3 1-2 4-7");
  const PeriodicPairs pairs = PeriodicPairs::of(*file.mesh.topology, file.mesh.coordinates,
                                                file.details->periodic->pairs[0]);
  CHECK(pairs.description == "rotation by 30 degrees");
  CHECK(pairs.pairs == std::vector<PeriodicPair>{{4, 7}});
}

TEST_CASE("MSH: one marker may be periodic in two directions, whose corners stay") {
  std::string text = passage_4;
  for (const char* rest : {" 2 2 -3", " 2 3 -6", " 2 4 -1", " 2 6 -4"}) {
    const std::string tag = std::string(rest) == " 2 2 -3"   ? "1 14"
                            : std::string(rest) == " 2 4 -1" ? "1 13"
                                                             : "1 12";
    text = replaced(text, tag + rest, "1 11" + std::string(rest));
  }
  text = replaced(replaced(text, "$Periodic\n5\n", "$Periodic\n6\n"), "$EndPeriodic",
                  "1 2 4\n16 1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1\n3\n2 1\n3 4\n7 8\n$EndPeriodic");
  const io::MeshFile file = read_from_text("a.msh", text);
  CHECK(pairs_text(file) ==
        "lower lower: 0-3 1-2 4-5 held 0 1 2 3; lower lower: 0-1 3-2 7-6 held 0 1 2 3");
  const PeriodicPairs across = PeriodicPairs::of(*file.mesh.topology, file.mesh.coordinates,
                                                 file.details->periodic->pairs[1]);
  CHECK(across.description == "translation by (1, 0)");
  CHECK(across.pairs == std::vector<PeriodicPair>{{7, 6}});
}

TEST_CASE("MSH: $Periodic comes back byte by byte, and as numbers in another encoding or version") {
  const TemporaryFolder folder;
  for (const char* name : {"22", "22b", "41", "41b"}) {
    CAPTURE(name);
    const std::string path = test::test_data("periodic_") + name + ".msh";
    const io::MeshFile file = io::read_mesh(path);
    CHECK(io::write_mesh(folder / "same.msh", file.mesh, file.details.get()).empty());
    CHECK(section(read_text(folder / "same.msh")) == section(read_text(path)));
    for (const char* version : {"2.2", "4.1"}) {
      for (const bool binary : {false, true}) {
        CAPTURE(version);
        CAPTURE(binary);
        io::WriteOptions options;
        options.gmsh_version = version;
        options.binary = binary;
        options.keep_encoding = false;
        const auto warnings =
            io::write_mesh(folder / "other.msh", file.mesh, file.details.get(), options);
        CHECK_FALSE(any_contains(warnings, "periodic"));
        const io::MeshFile other = io::read_mesh(folder / "other.msh");
        CHECK(pairs_text(other) == pairs_text(file));
        CHECK(!section(read_text(folder / "other.msh")).empty());
      }
    }
  }
}

TEST_CASE("MSH: pairs from another format are written as links of entities") {
  io::MeshFile file = io::read_mesh(test::test_data("periodic_41.msh"));
  io::FormatDetails foreign;
  foreign.periodic = file.details->periodic;
  const TemporaryFolder folder;
  io::write_mesh(folder / "a.msh", file.mesh, &foreign);
  CHECK(section(read_text(folder / "a.msh")) ==
        "$Periodic\n1\n1 2 1\n16 1 0 0 0 0 1 0 1 0 0 1 0 0 0 0 1\n3\n4 1\n3 2\n6 5\n"
        "$EndPeriodic\n");
  CHECK(pairs_text(io::read_mesh(folder / "a.msh")) == "lower upper: 0-3 1-2 4-5");
}

TEST_CASE("MSH: surfaces of volume meshes are paired, in every encoding and version") {
  MeshData data = cube(3, Volumes::tetrahedra);
  data.markers.clear();
  mark_volume(data, [](const Vec3& p) {
    return p.x() < 1e-9 ? "first" : p.x() > 1 - 1e-9 ? "second" : "rest";
  });
  const TemporaryFolder folder;
  io::write_mesh(folder / "a.su2", make_mesh(data), nullptr);
  write_text(folder / "b.su2", read_text(folder / "a.su2") +
                                   "NPERIODIC= 2\nPERIODIC_INDEX= 0\n0 0 0\n0 0 0\n0 0 0\n"
                                   "PERIODIC_INDEX= 1\n0 0 0\n0 0 0\n1 0 0\n");
  const io::MeshFile su2 = io::read_mesh(folder / "b.su2");
  REQUIRE(su2.details->periodic->pairs.size() == 1);
  CHECK(su2.details->periodic->pairs[0].pairs.size() == 16);
  for (const char* version : {"2.2", "4.1"}) {
    for (const bool binary : {false, true}) {
      CAPTURE(version);
      CAPTURE(binary);
      io::WriteOptions options;
      options.gmsh_version = version;
      options.binary = binary;
      CHECK(io::write_mesh(folder / "a.msh", su2.mesh, su2.details.get(), options).empty());
      const io::MeshFile msh = io::read_mesh(folder / "a.msh");
      CHECK(pairs_text(msh) == pairs_text(su2));
      const PeriodicPairs pairs = PeriodicPairs::of(*msh.mesh.topology, msh.mesh.coordinates,
                                                    msh.details->periodic->pairs[0]);
      CHECK(pairs.description == "translation by (1, 0, 0)");
      CHECK(pairs.pairs.size() == 4);
    }
  }
}

TEST_CASE("MSH: formats without periodic sides say that they are lost, SU2 how to say them there") {
  const io::MeshFile file = io::read_mesh(test::test_data("periodic_41.msh"));
  const TemporaryFolder folder;
  CHECK(any_contains(io::write_mesh(folder / "a.vtk", file.mesh, file.details.get()),
                     "the periodic pairs of the source (\"lower\" and \"upper\") are not written"));
  CHECK(any_contains(io::write_mesh(folder / "a.su2", file.mesh, file.details.get()),
                     "as MARKER_PERIODIC= ( lower, upper, 0, 0, 0, 0, 0, 0, 0, 1, 0 )"));
}

TEST_CASE("MSH: a side that moved away from its image is told when the file is written") {
  io::MeshFile file = io::read_mesh(test::test_data("periodic_41.msh"));
  const TemporaryFolder folder;
  const auto warnings_now = [&] {
    return io::write_mesh(folder / "a.msh", file.mesh, file.details.get());
  };
  move_node(file, 4, Vec2(0.001, 0));
  CHECK(any_contains(warnings_now(), "\"lower\" and \"upper\" no longer match"));
  move_node(file, 5, Vec2(0.001, 0));
  CHECK(warnings_now().empty());
  move_node(file, 5, Vec2(0.2, 0));
  CHECK(any_contains(warnings_now(), "is paired with node 5"));
}

TEST_CASE("MSH: a marker that is periodic in part is a fault of its pair, with file and line") {
  const std::string one =
      replaced(replaced(passage_4, "1 8 1\n16 1 0 0 0 0 1 0 1 0 0 1 0 0 0 0 1\n2\n4 1\n6 5\n", ""),
               "$Periodic\n5\n", "$Periodic\n4\n");
  CHECK(fault_of(one) ==
        "a.msh:114: found marker \"lower\" periodic in part only: curve 1 is in no link of "
        "$Periodic, expected all of it");
  const io::MeshFile file = read_from_text("a.msh", one);
  CHECK_THROWS_AS(PeriodicPairs::of(*file.mesh.topology, file.mesh.coordinates,
                                    file.details->periodic->pairs[0]),
                  UsageError);
  // Nodes of entities that were not saved are in no $Nodes: Gmsh lists them all the same.
  CHECK(fault_of(replaced(passage_4, "\n4 1\n6 5\n$EndPeriodic", "\n4 99\n6 5\n$EndPeriodic")) ==
        "a.msh:114: found no pair with node 0 of marker \"lower\", expected one for each of its "
        "nodes");
  // A curve in no physical group.
  CHECK(fault_of(replaced(passage_4, "8 0 1 0 0.5 1 0 1 12 2", "8 0 1 0 0.5 1 0 0 2")) ==
        "a.msh:119: found curve 1 of marker \"lower\" periodic with curve 8 in no physical group, "
        "expected both in physical groups");
}

TEST_CASE("MSH: links that no nodes match are a fault of their pair") {
  const io::MeshFile file =
      read_from_text("a.msh", replaced(passage_4, "0.5 1 0\n1 1 0 0", "0.7 1 0\n1 1 0 0"));
  CHECK_CONTAINS(file.details->periodic->pairs[0].fault,
                 "the markers \"lower\" and \"upper\" are not periodic: node 4 at (0.5, 0) is "
                 "paired with node 5 at (0.7, 1)");
}

TEST_CASE("MSH: links of entities that are no markers are none") {
  const std::string others =
      replaced(replaced(passage_2, "\n1 3 7\n", "\n1 33 77\n"), "\n1 8 1\n", "\n1 88 1\n");
  CHECK(pairs_text(read_from_text("a.msh", replaced(others, "\n1 88 1\n", "\n1 88 11\n"))) == "");
  CHECK(pairs_text(read_from_text("a.msh", replaced(passage_2, "\n1 3 7\n", "\n0 3 7\n"))) ==
        "lower upper: 0-3 4-5 fault");
  CHECK(read_from_text("a.msh", passage_2.substr(0, passage_2.find("$Periodic")))
            .details->periodic->pairs.empty());
}

TEST_CASE("MSH: a bad $Periodic is refused with file and line") {
  struct Bad {
    std::string text, error;
  };
  const auto changed_4 = [](const char* part, const char* by) {
    return replaced(passage_4, part, by);
  };
  const auto changed_2 = [](const char* part, const char* by) {
    return replaced(passage_2, part, by);
  };
  const std::string tail = passage_4.substr(passage_4.find("$Periodic"));
  for (const Bad& bad : std::vector<Bad>{
           {changed_4("$Periodic\n5\n", "$Periodic\nfive\n"),
            "a.msh:101: found 'five', expected the number of periodic entities"},
           {changed_4("$Periodic\n5\n", "$Periodic\n900000\n"), "a.msh:101: found 900000"},
           {changed_4("$Periodic\n5\n", "$Periodic\n6\n"),
            "a.msh:124: found '$EndPeriodic', expected dimension of periodic entity 6 of 6"},
           {changed_4("$Periodic\n5\n0 3 2", "$Periodic\n5\n4 3 2"),
            "a.msh:102: found dimension 4, expected a dimension from 0 to 3"},
           {changed_4("$Periodic\n5\n0 3 2", "$Periodic\n5\n0 3 0"),
            "a.msh:102: found 0, expected the tag of its master entity"},
           {changed_4("1 8 1\n16 1 0", "1 8 1\n7 1 0"),
            "a.msh:120: found 7 values of an affine transform, expected 0 or 16"},
           {changed_4("\n4 1\n6 5\n$EndPeriodic", "\n4 1\n6\n$EndPeriodic"),
            "a.msh:123: found the end of the line, expected master node of pair 2 of 2"},
           {passage_4 + tail, "a.msh:125: found a second section $Periodic, expected one only"},
           {passage_4.substr(0, passage_4.size() - 20),
            "a.msh:121: found 2 as the number of pairs of nodes, expected no more than"},
           {changed_2("Affine 1 0", "Affine one 0"), "expected value of an affine transform 1 of"},
           {changed_2("Affine 1 0", "Affine 1"), "expected value of an affine transform 16 of"},
       }) {
    CAPTURE(bad.text.substr(bad.text.find("$Periodic")));
    CHECK_CONTAINS(input_error("a.msh", bad.text), bad.error);
  }
}

}  // namespace winslow::test
