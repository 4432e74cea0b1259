#include <cstdint>
#include <cstring>
#include <set>

#include "io/support/samples.h"
#include "io/support/volume_samples.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

const std::string square_2 = read_text(test::test_data("square_22.msh"));
const std::string square_4 = read_text(test::test_data("square_41.msh"));
const std::string binary_2 = read_text(test::test_data("square_22b.msh"));
const std::string binary_4 = read_text(test::test_data("square_41b.msh"));

/// A file by hand: points, node tags with gaps and out of order, a line in no group, a curve in
/// two groups of which one is reversed, groups without a name.
const std::string odd_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Comments
hello
$EndComments
$PhysicalNames
3
0 8 "corner"
1 6 "a wall"
1 9 "nothing here"
$EndPhysicalNames
$Entities
1 3 1 0
5 0 0 0 1 8
1 0 0 0 1 0 0 2 6 -3 2 5 -5
2 1 0 0 1 1 0 0 0
7 0 1 0 1 1 0 1 4 0
3 0 0 0 1 1 0 0 0
$EndEntities
$Nodes
3 4 10 1000000000000
0 5 0 1
10
0 0 0
1 1 0 1
700
1 0 0
2 3 0 2
1000000000000
12
0 1 0
1 1 0
$EndNodes
$Elements
5 6 1 99
0 5 15 1
1 10
1 1 1 1
4 10 700
1 2 1 1
2 700 12
1 7 1 1
3 12 1000000000000
2 3 2 2
99 10 700 12
98 10 12 1000000000000
$EndElements
$NodeData
1
"pressure"
1
0.5
3
0
1
1
10 0.25
$EndNodeData
)";

std::string set_int(std::string bytes, std::size_t at, std::int32_t value) {
  REQUIRE(at + sizeof value <= bytes.size());
  std::memcpy(bytes.data() + at, &value, sizeof value);
  return bytes;
}

}  // namespace

TEST_CASE("MSH: the four kinds of file hold the same mesh") {
  const io::MeshFile su2 = io::read_mesh(test::test_data("square.su2"));
  Comparison what;
  what.regions = false;
  for (const char* name : {"square_22.msh", "square_22b.msh", "square_41.msh", "square_41b.msh"}) {
    CAPTURE(name);
    const io::MeshFile file = io::read_mesh(test::test_data(name));
    check_same_mesh(file.mesh, su2.mesh, what);
    REQUIRE(file.mesh.topology->regions().size() == 1);
    CHECK(file.mesh.topology->regions()[0].name == "domain");
    CHECK(file.details->binary == contains(name, "b.msh"));
  }
}

TEST_CASE("MSH: tags, entities, points, comments and unknown sections come back") {
  const io::MeshFile file = read_from_text("a.msh", odd_4);
  const auto& markers = file.mesh.topology->markers();
  REQUIRE(markers.size() == 4);
  CHECK(markers[0].name == "a wall");
  CHECK(markers[0].tag == 6);
  CHECK(markers[0].faces == std::vector<Face>{{0, 1}});
  CHECK(markers[1].name == "nothing here");
  CHECK(markers[1].faces.empty());
  CHECK(markers[2].name == "curve_3");
  CHECK(markers[2].faces == std::vector<Face>{{1, 0}});
  CHECK(markers[3].name == "curve_4");
  CHECK(markers[3].faces == std::vector<Face>{{3, 2}});
  CHECK(any_contains(file.warnings, "section $NodeData"));
  CHECK(any_contains(file.warnings, "1 line elements are in no physical group"));

  const TemporaryFolder folder;
  io::write_mesh(folder / "b.msh", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.msh") == odd_4);

  // A binary copy cannot take the unknown section along, and says so.
  io::WriteOptions binary;
  binary.binary = true;
  const auto warnings = io::write_mesh(folder / "c.msh", file.mesh, file.details.get(), binary);
  CHECK(any_contains(warnings, "unknown sections are not converted"));
  const io::MeshFile c = io::read_mesh(folder / "c.msh");
  check_same_mesh(c.mesh, file.mesh);
  io::WriteOptions ascii;
  ascii.keep_encoding = false;
  io::write_mesh(folder / "d.msh", c.mesh, c.details.get(), ascii);
  CHECK(read_text(folder / "d.msh") == odd_4.substr(0, odd_4.find("$NodeData")));
}

TEST_CASE("MSH: boxes of entities follow the nodes, and stay where no node moved") {
  const io::MeshFile file = read_from_text("a.msh", odd_4);
  Mesh moved = file.mesh;
  moved.coordinates.set_xy(1, {1.5, -0.25});
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.msh", moved, file.details.get());
  const std::string text = read_text(folder / "b.msh");
  CHECK_CONTAINS(text, "\n5 0 0 0 1 8\n");
  CHECK_CONTAINS(text, "\n1 0 -0.25 0 1.5 0 0 2 6 -3 2 5 -5\n");
  CHECK_CONTAINS(text, "\n7 0 1 0 1 1 0 1 4 0\n");
}

TEST_CASE("MSH 2.2: an element in two groups is there twice in the file, once in the mesh") {
  std::string text = replaced(square_2, "$Elements\n10\n", "$Elements\n11\n");
  text = replaced(text, "10 2 2 3 1 6 9 8\n", "10 2 2 3 1 6 9 8\n11 2 2 44 1 6 9 8\n");
  const TemporaryFolder folder;
  write_text(folder / "a.msh", text);
  const io::MeshFile file = io::read_mesh(folder / "a.msh");
  CHECK(file.mesh.topology->element_count() == 6);
  CHECK(file.mesh.topology->regions().size() == 2);
  io::write_mesh(folder / "b.msh", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.msh") == text);
}

TEST_CASE("MSH: the version asked for is written") {
  const io::MeshFile file = io::read_mesh(test::test_data("square_22.msh"));
  const TemporaryFolder folder;
  io::WriteOptions options;
  options.gmsh_version = "4.1";
  io::write_mesh(folder / "a.msh", file.mesh, file.details.get(), options);
  CHECK(read_text(folder / "a.msh") == square_4);
  options.gmsh_version = "3";
  CHECK_THROWS_AS(io::write_mesh(folder / "b.msh", file.mesh, nullptr, options), UsageError);
  CHECK_FALSE(std::filesystem::exists(folder / "b.msh"));
}

TEST_CASE("MSH: CRLF is accepted") {
  for (const std::string& text : {square_2, square_4}) {
    std::string crlf;
    for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    check_same_mesh(read_from_text("a.msh", crlf).mesh, read_from_text("a.msh", text).mesh);
  }
}

TEST_CASE("MSH 4.1: bad input is refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.msh", replaced(square_4, part, by));
  };
  CHECK_CONTAINS(input_error("a.msh", square_4.substr(0, square_4.find("0.5 0.5 0"))),
                 "a.msh:17: found 9 as the number of nodes, expected no more than the 8");
  CHECK_CONTAINS(error("1 9 1 9", "1 10 1 9"),
                 "a.msh:17: found 10 as the number of nodes, expected 9");
  CHECK_CONTAINS(error("2 1 0 9", "2 1 0 10"), "a.msh:18: found 10 nodes in a block");
  CHECK_CONTAINS(error("2 1 0 9", "2 1 0 8"), "a.msh:27: found the end of the line");
  CHECK_CONTAINS(error("4 10 1 10", "4 11 1 10"), "a.msh:39: found 11 as the number of elements");
  CHECK_CONTAINS(error("1 1 1 2", "1 1 1 3"), "a.msh:");
  CHECK(error("7 4 5 7\n", "7 4 5 70\n") ==
        "a.msh:50: found node 70, expected the tag of a node in $Nodes");
  CHECK_CONTAINS(input_error("a.msh", square_4.substr(0, square_4.find("1 1 0\n$EndN"))),
                 "a.msh:35: found the end of the file, expected coordinates of node 9 of 9");
  CHECK_CONTAINS(error("0.5 0.5 0", "0.5 nan 0"), "a.msh:32: found nan as a coordinate");
  CHECK(is_surface(
      *read_from_text("a.msh", replaced(square_4, "0.5 0.5 0", "0.5 0.5 0.25")).mesh.topology));
  CHECK_CONTAINS(error("0.5 0.5 0", "0.5 0.5"), "a.msh:32: found the end of the line, expected");
  CHECK_CONTAINS(error("0.5 0.5 0", "0.5 0.5 0 0"), "a.msh:32: found '0', expected the end");
  CHECK_CONTAINS(error("0.5 0.5 0", "0.5 0 0"), "a.msh:32: node 4 lies exactly where node 1");
  CHECK_CONTAINS(error("1\n2\n3\n", "1\n2\n2\n"), "node tag 2 a second time");
  CHECK_CONTAINS(error("1\n2\n3\n", "1\n2\n-3\n"), "a.msh:21: found -3 as a node tag");
  CHECK_CONTAINS(error("2 1 2 4", "2 1 4 4"),
                 "a.msh:50: found the end of the line, expected element 7");
  CHECK_CONTAINS(error("2 1 2 4", "2 1 9 4"), "a.msh:49: found element type 9 (second or higher");
  CHECK_CONTAINS(error("7 4 5 7\n", "7 4 4 7\n"), "a.msh:50: element 2 uses node 3 twice");
  CHECK_CONTAINS(error("1 9 1 9", "1 1000000000000 1 9"), "a.msh:17: found 1000000000000");
  CHECK_CONTAINS(error("2 1 0 9", "2 1 0 1000000000000"), "a.msh:18: found 1000000000000");
  CHECK_CONTAINS(error("4 10 1 10", "4 900000000000 1 10"), "a.msh:39: found 900000000000");
  CHECK_CONTAINS(error("0 2 1 0\n", "0 2 1 999999999\n"), "a.msh:11: found 999999999");
  CHECK_CONTAINS(error("$PhysicalNames\n3", "$PhysicalNames\n300000000"),
                 "a.msh:5: found 300000000");
  CHECK_CONTAINS(error("\"lower\"", "lower"), "a.msh:6: found 'lower', expected a name in quotes");
  CHECK_CONTAINS(error("4.1 0 8", "4.0 0 8"), "a.msh:2: found '4.0', expected MSH version");
  CHECK_CONTAINS(error("4.1 0 8", "4.1 0 4"), "a.msh:2: found '4', expected 8");
  CHECK_CONTAINS(error("$EndNodes", "$EndElements"), "found '$EndElements', expected $EndNodes");
  CHECK_CONTAINS(error("$Nodes", "$PartitionedEntities"), "expected the end of the line");
  CHECK_CONTAINS(error("$Nodes", "$Other"), "section $Other without end");
  CHECK_CONTAINS(input_error("a.msh", square_4.substr(0, square_4.find("$Elements"))),
                 "found no section $Elements");
  CHECK_CONTAINS(input_error("a.msh", "$NOD\n1\n"), "a.msh:1: found $NOD (MSH 1)");
}

TEST_CASE("MSH 2.2: bad input is refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.msh", replaced(square_2, part, by));
  };
  CHECK_CONTAINS(input_error("a.msh", square_2.substr(0, square_2.find("5 0.5 0.5"))),
                 "a.msh:11: found 9 as the number of nodes, expected no more than the 5");
  CHECK(
      contains(error("$Nodes\n9", "$Nodes\n10"), "a.msh:21: found '$EndNodes', expected node 10"));
  CHECK_CONTAINS(error("$Nodes\n9", "$Nodes\n8"), "a.msh:20: found '9', expected $EndNodes");
  CHECK_CONTAINS(error("$Elements\n10", "$Elements\n11"), "expected element 11 of 11");
  CHECK_CONTAINS(error("$Elements\n10", "$Elements\n9"), "expected $EndElements");
  CHECK_CONTAINS(error("6 9 8\n", "6 9 99\n"), "found node 99, expected the tag of a node");
  CHECK_CONTAINS(error("5 0.5 0.5 0", "5 0.5 inf 0"), "a.msh:16: found inf as a coordinate");
  CHECK(is_surface(
      *read_from_text("a.msh", replaced(square_2, "5 0.5 0.5 0", "5 0.5 0.5 1")).mesh.topology));
  CHECK_CONTAINS(error("5 0.5 0.5 0", "4 0.5 0.5 0"), "a.msh:16: found node tag 4 a second time");
  CHECK_CONTAINS(error("$Nodes\n9", "$Nodes\n99999999999"), "a.msh:11: found 99999999999");
  CHECK_CONTAINS(error("10 2 2 3 1 6 9 8", "10 4 2 3 1 6 9 8 7"), "expected a face of an element");
  CHECK_CONTAINS(error("10 2 2 3 1 6 9 8", "10 2 2 3 1 6 9"), "found the end of the line");
}

TEST_CASE("MSH binary: bad input is refused with the byte") {
  for (const std::string& bytes : {binary_2, binary_4}) {
    const std::size_t one = bytes.find("8\n") + 2;
    CHECK_CONTAINS(
        input_error("a.msh", set_int(bytes, one, 0x01000000)),
        "a.msh: byte " + std::to_string(one) + ": found numbers in big-endian byte order");
    CHECK(
        contains(input_error("a.msh", set_int(bytes, one, 7)), "found 7, expected the integer 1"));
    for (const std::size_t keep : {bytes.size() - 30, bytes.size() / 2, bytes.size() / 3}) {
      CHECK_CONTAINS(input_error("a.msh", bytes.substr(0, keep)), "a.msh: byte ");
    }
  }
  // 4.1: blocks (8 bytes), nodes (8), smallest, largest.
  const std::size_t nodes = binary_4.find("$Nodes\n") + 7;
  std::string huge = binary_4;
  const std::int64_t count = 1LL << 60;
  std::memcpy(huge.data() + nodes + 8, &count, sizeof count);
  CHECK_CONTAINS(input_error("a.msh", huge),
                 "a.msh: byte " + std::to_string(nodes + 8) + ": found 1152921504606846976");
  // 2.2: the first element block: type, number of elements, number of tags.
  const std::size_t block = binary_2.find("$Elements\n10\n") + 13;
  CHECK_CONTAINS(input_error("a.msh", set_int(binary_2, block, 11)), "element type 11 (second");
  CHECK_CONTAINS(input_error("a.msh", set_int(binary_2, block + 4, 11)), "found 11 elements");
  CHECK_CONTAINS(input_error("a.msh", set_int(binary_2, block + 8, -1)), "found -1 tags");
}

namespace {

/// Two tetrahedra in two volumes; a surface in a group, one that a group holds reversed, and a
/// curve, which means nothing to a mesh of volumes.
const std::string two_volumes =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n3\n2 7 \"wall\"\n3 1 \"left\"\n3 2 \"right\"\n$EndPhysicalNames\n"
    "$Entities\n0 1 2 2\n1 0 0 0 1 0 0 0 0\n1 0 0 0 1 1 0 1 7 0\n2 0 0 0 0 1 1 1 -7 0\n"
    "1 0 0 0 1 1 1 1 1 0\n2 0 0 0 1 1 1 1 2 0\n$EndEntities\n"
    "$Nodes\n1 5 1 9\n3 1 0 5\n1\n2\n3\n4\n9\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
    "$Elements\n5 6 1 6\n1 1 1 1\n1 1 2\n2 1 2 1\n2 1 3 2\n2 2 2 1\n3 1 3 4\n"
    "3 1 4 1\n4 1 2 3 4\n3 2 4 1\n6 2 3 4 9\n$EndElements\n";

}  // namespace

TEST_CASE("MSH 4.1: physical volumes are regions, physical surfaces are markers") {
  const std::string text = replaced(two_volumes, "5 6 1 6", "5 5 1 6");
  const io::MeshFile file = read_from_text("a.msh", text);
  const Topology& topology = *file.mesh.topology;
  CHECK(topology.cell_dimension() == 3);
  REQUIRE(topology.regions().size() == 2);
  CHECK(topology.regions()[1].name == "right");
  CHECK(topology.element_regions()[1] == 1);
  REQUIRE(topology.markers().size() == 1);
  CHECK(topology.markers()[0].name == "wall");
  CHECK(topology.markers()[0].tag == 7);
  REQUIRE(topology.markers()[0].faces.size() == 2);
  CHECK(topology.markers()[0].faces[0] == Face(0, 2, 1));
  CHECK(topology.markers()[0].faces[1] == Face(0, 2, 3).reversed());
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.msh", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.msh") == text);
}

TEST_CASE("MSH: surfaces in no group are kept, but are no marker") {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
      "$EndNodes\n$Elements\n3\n1 1 2 0 1 1 2\n2 2 2 0 1 1 3 2\n3 4 2 5 1 1 2 3 4\n$EndElements\n";
  const io::MeshFile file = read_from_text("a.msh", text);
  CHECK(any_contains(file.warnings, "1 surface elements are in no physical group"));
  CHECK(file.mesh.topology->regions()[0].name == "volume_5");
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.msh", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.msh") == text);
}

TEST_CASE("MSH without physical groups of elements: several entities are the regions") {
  const auto text_2 = [](const std::string& physical, const std::string& entity) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
           "$EndNodes\n$Elements\n2\n1 2 2 " +
           physical + " 5 1 2 3\n2 2 2 0 " + entity + " 1 3 4\n$EndElements\n";
  };
  const std::string text_4 =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 5 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n"
      "1 1 0\n0 1 0\n$EndNodes\n$Elements\n2 2 1 2\n2 5 2 1\n1 1 2 3\n2 8 2 1\n2 1 3 4\n"
      "$EndElements\n";
  for (const std::string& text : {text_2("0", "8"), text_4}) {
    const io::MeshFile file = read_from_text("a.msh", text);
    const Topology& topology = *file.mesh.topology;
    REQUIRE(topology.interfaces().size() == 1);
    CHECK(topology.name_of(topology.interfaces()[0]) == "surface_entity_5 and surface_entity_8");
    const TemporaryFolder folder;
    io::write_mesh(folder / "b.msh", file.mesh, file.details.get());
    CHECK(read_text(folder / "b.msh") == text);
  }
  CHECK(read_from_text("a.msh", text_2("0", "5")).mesh.topology->regions().empty());
  const Mesh partly = read_from_text("a.msh", text_2("3", "8")).mesh;
  REQUIRE(partly.topology->interfaces().size() == 1);
  CHECK(partly.topology->name_of(partly.topology->interfaces()[0]) == "surface_3 and no region");
}

TEST_CASE("MSH of volumes: bad input is refused with file and line") {
  const std::string good = replaced(two_volumes, "5 6 1 6", "5 5 1 6");
  const auto error = [&](const std::string& part, const std::string& by) {
    return input_error("a.msh", replaced(good, part, by));
  };
  CHECK_CONTAINS(error("4 1 2 3 4\n", "4 1 2 3\n"), "found the end of the line, expected element");
  CHECK_CONTAINS(error("4 1 2 3 4\n", "4 1 2 3 5\n"), "found node 5, expected the tag of a node");
  CHECK_CONTAINS(error("2 1 3 2\n", "2 1 3 9\n"), "expected a face of an element");
  CHECK_CONTAINS(error("1 1 1\n$EndN", "1 1 inf\n$EndN"), "found inf as a coordinate of node 4");
  CHECK_CONTAINS(error("1 1 1\n$EndN", "0 0 1\n$EndN"), "node");
}

namespace {

/// The places of the nodes of a marker: Gmsh renumbers nodes when it cuts a mesh into partitions.
std::set<std::pair<double, double>> places_of(const Mesh& mesh, std::size_t marker) {
  std::set<std::pair<double, double>> places;
  for (const Index node : mesh.topology->markers().nodes(static_cast<Index>(marker)))
    places.emplace(mesh.coordinates.xy(node).x(), mesh.coordinates.xy(node).y());
  return places;
}

}  // namespace

TEST_CASE("MSH 4.1 of several partitions: one mesh with its groups, partitions go back") {
  const io::MeshFile whole = io::read_mesh(test_data("partitioned_whole.msh"));
  for (const char* name : {"partitioned_41.msh", "partitioned_41b.msh"}) {
    CAPTURE(name);
    const io::MeshFile file = io::read_mesh(test_data(name));
    CHECK(any_contains(file.warnings, "the file has 2 partitions: read as one mesh"));
    const Topology& topology = *file.mesh.topology;
    CHECK(file.mesh.topology->node_count() == whole.mesh.topology->node_count());
    CHECK(topology.element_count() == whole.mesh.topology->element_count());
    REQUIRE(topology.markers().size() == 2);
    for (std::size_t m = 0; m < 2; ++m) {
      CHECK(topology.markers()[m].name == whole.mesh.topology->markers()[m].name);
      CHECK(places_of(file.mesh, m) == places_of(whole.mesh, m));
      CHECK(topology.markers()[m].faces.size() == 4);
    }
    CHECK(topology.markers().unmarked_faces() == 0);
    REQUIRE(topology.regions().size() == 1);
    CHECK(topology.regions()[0].name == "air");
    const TemporaryFolder folder;
    io::write_mesh(folder / "b.msh", file.mesh, file.details.get());
    const io::MeshFile back = io::read_mesh(folder / "b.msh");
    check_same_mesh(back.mesh, file.mesh);
    CHECK(back.warnings.size() == file.warnings.size());
    // Into the other encoding the mesh goes without its partitions.
    io::WriteOptions other;
    other.binary = !file.details->binary;
    other.keep_encoding = false;
    CHECK(any_contains(io::write_mesh(folder / "c.msh", file.mesh, file.details.get(), other),
                       "partitions, entities and tags are not written"));
    CHECK(io::read_mesh(folder / "c.msh").mesh.coordinates == file.mesh.coordinates);
  }
  const std::string text = read_text(test_data("partitioned_41.msh"));
  CHECK_CONTAINS(input_error("a.msh", replaced(text, "6 7 2 0\n", "900000 7 2 0\n")),
                 "a.msh:25: found 900000 as a number of partitioned entities");
  CHECK_CONTAINS(input_error("a.msh", replaced(text, "6 7 2 0\n", "7 7 2 0\n")), "a.msh:");
}

}  // namespace winslow::test
