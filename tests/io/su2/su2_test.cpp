#include <algorithm>

#include "io/format/mesh_format.h"
#include "io/support/samples.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

const std::string sample = read_text(test::test_data("square.su2"));

}  // namespace

TEST_CASE("SU2: what the file says is what the mesh holds") {
  const io::MeshFile file = io::read_mesh(test::test_data("square.su2"));
  CHECK(file.format->name == "su2");
  const Topology& t = *file.mesh.topology;
  CHECK(file.mesh.coordinates.size() == 9);
  CHECK(file.mesh.coordinates.xy(5) == Vec2(1, 0.5));
  REQUIRE(t.element_count() == 6);
  CHECK(t.element_type(0) == ElementType::quadrilateral);
  CHECK(std::vector<Index>(t.element(5).begin(), t.element(5).end()) ==
        std::vector<Index>{5, 8, 7});
  REQUIRE(t.markers().size() == 2);
  CHECK(t.markers()[1].name == "upper");
  CHECK(t.markers()[1].tag == 2);
  CHECK(t.markers()[1].faces == std::vector<Face>{{8, 7}, {7, 6}});
}

TEST_CASE("SU2: tags of one name are one marker, and go back as they came") {
  const TemporaryFolder folder;
  const std::string text =
      "NDIME= 2\nNELEM= 2\n5 0 1 2\n5 0 2 3\nNPOIN= 4\n0 0\n1 0\n1 1\n0 1\n"
      "NMARK= 4\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n3 0 1\n% between\nMARKER_TAG= top\n"
      "MARKER_ELEMS= 1\n3 2 3\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n3 1 2\nMARKER_TAG= wall\n"
      "MARKER_ELEMS= 1\n3 3 0\n";
  write_text(folder / "a.su2", text);
  const io::MeshFile file = io::read_mesh(folder / "a.su2");
  const Markers& markers = file.mesh.topology->markers();
  REQUIRE(markers.size() == 2);
  CHECK(markers[0].name == "wall");
  CHECK(markers[0].faces == std::vector<Face>{{0, 1}, {1, 2}, {3, 0}});
  CHECK(markers[1].faces == std::vector<Face>{{2, 3}});
  CHECK(any_contains(file.warnings, "MARKER_TAG= wall stands there again"));
  io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.su2") == text);
  io::write_mesh(folder / "c.su2", file.mesh, nullptr);
  CHECK_CONTAINS(read_text(folder / "c.su2"), "NMARK= 2\nMARKER_TAG= wall\nMARKER_ELEMS= 3\n");
}

TEST_CASE("SU2: comments, order of sections and columns survive") {
  const TemporaryFolder folder;
  const std::string text =
      "% made by hand\n\nNDIME= 2\n% points first\nNPOIN= 4 4\n0 0\n1 0\n1 1\n0 1\n"
      "NMARK= 1\n%wall\nMARKER_TAG= wall\nMARKER_ELEMS= 2\n3 0 1\n3 1 2\nNELEM= 2\n"
      "5 0 1 2 0\n5 0 2 3 1\n";
  write_text(folder / "a.su2", text);
  const io::MeshFile file = io::read_mesh(folder / "a.su2");
  io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.su2") == text);
}

TEST_CASE("SU2: sections in any order, no numbers, blanks, comments, CRLF give the same mesh") {
  const io::MeshFile expected = io::read_mesh(test::test_data("square.su2"));
  const auto at = [](const char* key) { return sample.find(key); };
  const std::string head = sample.substr(0, at("NELEM"));
  const std::string elements = sample.substr(at("NELEM"), at("NPOIN") - at("NELEM"));
  const std::string points = sample.substr(at("NPOIN"), at("NMARK") - at("NPOIN"));
  const std::string markers = sample.substr(at("NMARK"));
  check_same_mesh(read_from_text("a.su2", points + elements + markers + head).mesh, expected.mesh);
  check_same_mesh(read_from_text("a.su2", markers + head + points + elements).mesh, expected.mesh);

  std::string crlf;
  for (const char c : sample) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const io::MeshFile from_crlf = read_from_text("a.su2", crlf);
  check_same_mesh(from_crlf.mesh, expected.mesh);
  CHECK(from_crlf.mesh.topology->markers()[0].name == "lower");

  std::string loose = replaced(sample, "0.5 0.5 4\n", "\n  +0.5\t5e-1   % middle\n\n% next\n");
  loose = replaced(loose, "NPOIN= 9", "NPOIN = 9 9 % nine");
  loose = replaced(loose, "3 0 1\n", "3 0 1 0\n");
  loose.pop_back();  // no newline at the end
  check_same_mesh(read_from_text("a.su2", loose).mesh, expected.mesh);
}

TEST_CASE("SU2: what it does not know is kept and warned about") {
  const std::string extra = "FFD_NBOX= 1\nFFD_TAG= BOX\nFFD_CORNER_POINTS= 2\n0 0\n1 1\n";
  const TemporaryFolder folder;
  write_text(folder / "a.su2", sample + extra);
  const io::MeshFile file = io::read_mesh(folder / "a.su2");
  CHECK(any_contains(file.warnings,
                     "keywords 'FFD_NBOX' (line 29), 'FFD_TAG' (line 30), 'FFD_CORNER_POINTS' "
                     "(line 31) are not understood"));
  io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.su2") == sample + extra);
  CHECK(any_contains(read_from_text("a.su2", sample + extra + "FFD_A= 1\nFFD_B= 2\n").warnings,
                     "'FFD_CORNER_POINTS' (line 31) and 2 more are not understood"));
}

TEST_CASE("SU2: SEND_RECEIVE is no boundary, but stays in the file") {
  const std::string text = replaced(sample, "NMARK= 2\n", "NMARK= 3\n") +
                           "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nSEND_TO= 1\n1 3 0\n";
  const TemporaryFolder folder;
  write_text(folder / "a.su2", text);
  const io::MeshFile file = io::read_mesh(folder / "a.su2");
  CHECK(file.mesh.topology->markers().size() == 2);
  CHECK(any_contains(file.warnings, "SEND_RECEIVE"));
  io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.su2") == text);
}

TEST_CASE("SU2: names that SU2 cannot hold are changed, with a warning, and stay unique") {
  MeshData data = grid_with_holes(2, Cells::quads, [](Index, Index) { return false; });
  data.markers = {{"a wall", 1, {{0, 1}}}, {"a_wall", 2, {{1, 2}}}};
  const TemporaryFolder folder;
  const auto warnings = io::write_mesh(folder / "a.su2", make_mesh(data), nullptr);
  CHECK(any_contains(warnings, "\"a wall\" is written as \"a_wall\""));
  const io::MeshFile file = io::read_mesh(folder / "a.su2");
  CHECK(file.mesh.topology->markers()[0].name == "a_wall");
  CHECK(file.mesh.topology->markers()[1].name == "a_wall_");
}

TEST_CASE("SU2: what follows the coordinates of a point means nothing, and goes back as it came") {
  const TemporaryFolder folder;
  std::string wide = sample;
  const auto begin = wide.find("NPOIN= 9\n") + 9;
  std::string points;
  for (std::size_t at = begin; at < wide.find("NMARK"); at = wide.find('\n', at) + 1) {
    const std::string line = wide.substr(at, wide.find('\n', at) - at);
    const auto number = line.rfind(' ');
    points += line.substr(0, number) + " 1e-1" + line.substr(number) + line.substr(number) + "\n";
  }
  wide.replace(begin, wide.find("NMARK") - begin, points);
  write_text(folder / "a.su2", wide);
  const io::MeshFile file = io::read_mesh(folder / "a.su2");
  check_same_mesh(file.mesh, io::read_mesh(test::test_data("square.su2")).mesh);
  io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.su2") == wide);
}

TEST_CASE("SU2: a point line short of a coordinate is no point, though it ends in a number") {
  CHECK(input_error("a.su2", replaced(sample, "0.5 1 7", "0.5 7")) ==
        "a.su2:18: found the end of the line, expected two coordinates before the number of the "
        "point");
  CHECK_CONTAINS(input_error("a.su2", replaced(sample, "0.5 1 7", "0.5")),
                 "a.su2:18: found the end of the line, expected y of point 8 of 9");
  // Every line lacks one; and three points that lie so by chance.
  const std::string square = "NDIME= 2\nNELEM= 1\n9 0 1 2 3\nNPOIN= 4\n0 0\n1 1\n1 2\n0 3\n";
  CHECK_CONTAINS(input_error("a.su2", square), "a.su2:5: found the end of the line, expected two");
  const auto file =
      read_from_text("a.su2", "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1 1\n0 2\n");
  CHECK(file.mesh.coordinates.xy(2) == Vec2(0, 2));
}

TEST_CASE("SU2: MARKERTAG= is MARKER_TAG=") {
  const io::MeshFile file =
      read_from_text("a.su2", replaced(sample, "MARKER_TAG= upper", "MARKERTAG= upper"));
  CHECK(file.mesh.topology->markers()[1].name == "upper");
}

TEST_CASE("SU2: what is kept as text is kept to the byte, and Windows line ends stay") {
  std::string text = "% made  by hand \t\n\n" + sample + "FFD_NBOX=1   % one\n\tx  y\n\n";
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const TemporaryFolder folder;
  for (const std::string& content : {text, crlf}) {
    write_text(folder / "a.su2", content);
    const io::MeshFile file = io::read_mesh(folder / "a.su2");
    io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
    CHECK(read_text(folder / "b.su2") == content);
  }
}

TEST_CASE("SU2: only a mesh that has changed and had comments is written with a warning") {
  const TemporaryFolder folder;
  MeshData data = grid_with_holes(2, Cells::quads, [](Index, Index) { return false; });
  const Mesh other = make_mesh(data);
  const std::string bare = sample.substr(sample.find("NDIME"));
  const auto warnings_for = [&](const std::string& text) {
    write_text(folder / "a.su2", text);
    return io::write_mesh(folder / "b.su2", other, io::read_mesh(folder / "a.su2").details.get());
  };
  REQUIRE(bare.find('%') == std::string::npos);
  CHECK(warnings_for("\n" + bare + "\n").empty());
  CHECK(any_contains(warnings_for("% by hand\n" + bare), "comments and unknown keywords"));
}

TEST_CASE("SU2: a box whose surface points have moved is told of, once") {
  const TemporaryFolder folder;
  const std::string box =
      "FFD_NBOX= 1\nFFD_TAG= BOX\nFFD_CORNER_POINTS= 0\nFFD_SURFACE_POINTS= 3\n"
      "lower 0 0.0 0.0 0.5\nlower 1 0.5 0.0 0.5\nelsewhere 4 0.5 0.5 0.5\n";
  write_text(folder / "a.su2", sample + box);
  io::MeshFile file = io::read_mesh(folder / "a.su2");
  const auto told = [&] {
    const auto warnings = io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
    return std::count_if(warnings.begin(), warnings.end(), [](const std::string& text) {
      return contains(text, "FFD_SURFACE_POINTS");
    });
  };
  CHECK(told() == 0);
  file.mesh.coordinates.set_xy(4, {0.5, 0.51});  // none of the box's points
  CHECK(told() == 0);
  file.mesh.coordinates.set_xy(0, {-0.1, 0});
  file.mesh.coordinates.set_xy(1, {0.4, 0});
  CHECK(told() == 1);
}

TEST_CASE("SU2: edges in two markers, or twice in one, are a warning") {
  const io::MeshFile file = read_from_text(
      "a.su2", replaced(replaced(sample, "MARKER_ELEMS= 2\n3 8", "MARKER_ELEMS= 4\n3 8"), "3 7 6\n",
                        "3 7 6\n3 7 8\n3 1 0\n"));
  CHECK(any_contains(file.warnings, "marker \"upper\" names 1 edge again"));
  CHECK(any_contains(file.warnings, "markers \"lower\" and \"upper\" share 1 edge"));
  CHECK_FALSE(any_contains(io::read_mesh(test::test_data("square.su2")).warnings, "share"));
}

TEST_CASE("SU2: bad input is refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.su2", replaced(sample, part, by));
  };
  CHECK(input_error("a.su2", sample.substr(0, sample.find("0 1 6"))) ==
        "a.su2:16: found the end of the file, expected point 7 of 9");
  CHECK(error("NPOIN= 9", "NPOIN= 10") == "a.su2:20: found 'NMARK=', expected point 10 of 10");
  CHECK(error("NPOIN= 9", "NPOIN= 8") ==
        "a.su2:19: found '1 1 8', expected a keyword: NDIME=, NELEM=, NPOIN=, NMARK=, MARKER_TAG= "
        "or MARKER_ELEMS=");
  CHECK(error("NELEM= 6", "NELEM= 7") == "a.su2:10: found 'NPOIN=', expected element 7 of 7");
  CHECK(error("NMARK= 2", "NMARK= 3") == "a.su2:20: found 2 markers, expected 3 as NMARK= says");
  CHECK_CONTAINS(error("MARKER_ELEMS= 2\n3 8", "MARKER_ELEMS= 3\n3 8"),
                 "a.su2:28: found the end of the file, expected marker edge 3 of 3");
  CHECK(error("5 3 4 6 2", "5 3 4 9 2") == "a.su2:6: element 2 uses node 9, expected 0 to 8");
  CHECK(error("5 3 4 6 2", "5 3 4 -6 2") ==
        "a.su2:6: found '-6', expected a node number of element 3 of 6");
  CHECK_CONTAINS(error("3 8 7", "3 8 77"), "a.su2:27: ");
  CHECK_CONTAINS(error("3 8 7", "3 8 4"), "a.su2:27: ");
  CHECK_CONTAINS(error("0.5 1 7", "nan 1 7"), "a.su2:18: found nan as a coordinate of node 7");
  CHECK_CONTAINS(error("0.5 1 7", "1e999 1 7"), "a.su2:18: found inf as a coordinate");
  CHECK_CONTAINS(error("0.5 1 7", "0.5 0.5 7"), "duplicate node");
  CHECK_CONTAINS(error("5 3 4 6 2", "5 3 4 4 2"), "a.su2:6: element 2 uses node 4 twice");
  CHECK_CONTAINS(error("5 5 8 7 5", "5 4 5 7 5"), "a.su2:9: ");
  CHECK_CONTAINS(error("0.5 1 7", "x 1 7"), "a.su2:18: found 'x', expected point 8 of 9");
  CHECK_CONTAINS(error("5 3 4 6 2", "5 3 4 6 2 2"), "a.su2:6: found '2', expected the end");
  CHECK_CONTAINS(error("5 3 4 6 2", "10 3 4 6 2"), "element type 10 (a 3D mesh)");
  CHECK_CONTAINS(error("5 3 4 6 2", "22 3 4 6 2"), "element type 22 (second order)");
  CHECK_CONTAINS(error("5 3 4 6 2", "305 3 4 6 2"), "element type 305 (order 4)");
  CHECK_CONTAINS(error("3 8 7", "303 8 7 6 5"), "marker element type 303 (order 4)");
  CHECK_CONTAINS(error("3 8 7", "5 8 7 6"),
                 "a.su2:27: found marker element type 5 (a 3D mesh), expected 3 (line)");
  CHECK(error("NDIME= 2", "NDIME= 3") ==
        "a.su2:11: found the end of the line, expected three coordinates before the number of the "
        "point");
  CHECK_CONTAINS(error("NDIME= 2", "NDIME= 1"), "found NDIME= 1, expected NDIME= 2 or NDIME= 3");
  CHECK_CONTAINS(error("NDIME= 2\n", ""), "found no NDIME=");
  CHECK_CONTAINS(error("NMARK= 2", "NELEM= 2"), "a.su2:20: found a second NELEM=");
  CHECK_CONTAINS(error("MARKER_TAG= upper\n", ""), "found MARKER_ELEMS=, expected MARKER_TAG=");
  CHECK_CONTAINS(error("NDIME= 2", "NZONE= 2\nNDIME= 2"), "a.su2:2: found 0 IZONE= in the file");
  CHECK(error("NPOIN= 9", "NPOIN= 1000000000000") ==
        "a.su2:10: found 1000000000000 as the number of points, expected no more than the 42 that "
        "the rest of the file can hold (a wrong count, or a truncated file)");
  CHECK_CONTAINS(error("NELEM= 6", "NELEM= -6"), "a.su2:3: found -6, expected");
  CHECK_CONTAINS(error("NELEM= 6", "NELEM= 99999999999999999999"), "a.su2:3: found ");
}

TEST_CASE("SU2: numbers that do not count from zero are ignored, as SU2 does") {
  const io::MeshFile file = read_from_text("a.su2", replaced(sample, "0.5 1 7", "0.5 1 17"));
  CHECK(any_contains(file.warnings, "do not count from 0"));
  CHECK(file.mesh.coordinates.xy(7) == Vec2(0.5, 1));
}

}  // namespace winslow::test
