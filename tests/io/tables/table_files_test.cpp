#include "io/tables/table_files.h"

#include <doctest/doctest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "io/support/files.h"
#include "support/paths.h"

namespace winslow::test {

using io::boundary_lines;
using io::BoundaryLine;
using io::read_mesh;
using io::write_boundary;

namespace {

Mesh square() { return read_mesh(test::test_data("square.su2")).mesh; }

std::vector<std::string> names_of(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Marker& marker : mesh.topology->markers()) names.push_back(marker.name);
  return names;
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// Every edge of the marker is in one line, once.
void check_edges(const Marker& marker, const std::vector<BoundaryLine>& lines) {
  std::multiset<std::set<Index>> wanted;
  std::multiset<std::set<Index>> found;
  for (const Face& edge : marker.faces) wanted.insert({edge[0], edge[1]});
  for (const auto& line : lines)
    for (std::size_t k = 0; k + 1 < line.nodes.size(); ++k)
      found.insert({line.nodes[k], line.nodes[k + 1]});
  CHECK(found == wanted);
}

}  // namespace

TEST_CASE("edges of a marker are joined to lines whatever their order and direction") {
  const Marker loop{"loop", 1, {{0, 1}, {3, 0}, {1, 2}, {3, 2}}};
  auto lines = boundary_lines(loop);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].closed);
  CHECK(lines[0].nodes.size() == 5);
  check_edges(loop, lines);

  const Marker two{"two", 1, {{5, 6}, {1, 2}, {0, 1}, {7, 6}}};
  lines = boundary_lines(two);
  REQUIRE(lines.size() == 2);
  CHECK_FALSE(lines[0].closed);
  CHECK(lines[0].nodes == std::vector<Index>{5, 6, 7});
  CHECK(lines[1].nodes == std::vector<Index>{0, 1, 2});

  const Marker fork{"fork", 1, {{0, 1}, {1, 2}, {1, 3}}};
  lines = boundary_lines(fork);
  CHECK(lines.size() == 3);  // three edges meet in node 1
  check_edges(fork, lines);
  CHECK(boundary_lines(Marker{"none", 1, {}}).empty());
}

TEST_CASE("markers written as CSV have every point of their lines, to the last digit") {
  const TemporaryFolder folder;
  const Mesh mesh = square();
  const auto path = folder.path() / "rim.csv";
  write_boundary(path, mesh, names_of(mesh));
  const auto rows = lines_of(path);
  std::size_t points = 0;
  for (const Marker& marker : mesh.topology->markers())
    for (const auto& line : boundary_lines(marker)) points += line.nodes.size();
  REQUIRE(rows.size() == points + 1);
  CHECK(rows[0] == "marker,line,node,x,y");
  for (std::size_t k = 1; k < rows.size(); ++k) {
    std::istringstream row(rows[k]);
    std::string name, line, node, x, y;
    std::getline(row, name, ',');
    std::getline(row, line, ',');
    std::getline(row, node, ',');
    std::getline(row, x, ',');
    std::getline(row, y, ',');
    CHECK(mesh.topology->markers().find(name).has_value());
    const Vec2 p = mesh.coordinates.xy(std::stoi(node));
    CHECK(std::stod(x) == p.x());
    CHECK(std::stod(y) == p.y());
  }
}

TEST_CASE("markers written as DAT and VTK hold one curve a line") {
  const TemporaryFolder folder;
  const Mesh mesh = square();
  const std::string name = mesh.topology->markers()[0].name;
  const auto curves = boundary_lines(mesh.topology->markers()[0]);
  REQUIRE(curves.size() == 1);
  write_boundary(folder.path() / "rim.dat", mesh, {name});
  const auto dat = lines_of(folder.path() / "rim.dat");
  REQUIRE(dat.size() == curves[0].nodes.size() + 1);
  CHECK(dat[0] == name);
  std::istringstream last(dat.back());
  double x = 0, y = 0;
  last >> x >> y;
  CHECK(Vec2(x, y) == mesh.coordinates.xy(curves[0].nodes.back()));

  write_boundary(folder.path() / "rim.VTK", mesh, {name});
  const auto vtk = lines_of(folder.path() / "rim.VTK");
  const std::string count = std::to_string(curves[0].nodes.size());
  CHECK(vtk[3] == "DATASET POLYDATA");
  CHECK(vtk[4] == "POINTS " + count + " double");
  CHECK(std::find(vtk.begin(), vtk.end(),
                  "LINES 1 " + std::to_string(curves[0].nodes.size() + 1)) != vtk.end());
}

TEST_CASE("what cannot be written as a boundary is refused and writes nothing") {
  const TemporaryFolder folder;
  const Mesh mesh = square();
  const std::string name = mesh.topology->markers()[0].name;
  CHECK_THROWS_AS(write_boundary(folder.path() / "rim.su2", mesh, {name}), UsageError);
  CHECK_THROWS_AS(write_boundary(folder.path() / "rim.csv", mesh, {}), UsageError);
  CHECK_THROWS_AS(write_boundary(folder.path() / "rim.csv", mesh, {"no such"}), UsageError);
  CHECK_THROWS_AS(write_boundary(folder.path() / "no" / "rim.csv", mesh, {name}), OutputError);
  CHECK(std::filesystem::is_empty(folder.path()));
}

namespace {

DisplacementTable read(const std::string& text) {
  const TemporaryFolder folder;
  write_text(folder / "d.csv", text);
  return io::read_displacements(folder / "d.csv");
}

std::string error(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(what.find("d.csv"));
  }
  return "no error";
}

}  // namespace

TEST_CASE("displacements: a byte order mark is no part of the first name; Fortran's exponents") {
  const DisplacementTable table = read("\xEF\xBB\xBFnode,dx,dy\r\n7,0.5D0,-1.0D-03\r\n");
  REQUIRE(table.entries.size() == 1);
  CHECK(table.entries[0].node == 7);
  CHECK(table.entries[0].displacement == Vec2(0.5, -1e-3));
}

TEST_CASE("displacements: columns by name, by number, with any separator") {
  const DisplacementTable a = read("# moved\nnode,dx,dy\n7,0.5,-1e-3\n\n8,+1,2\n");
  REQUIRE(a.entries.size() == 2);
  CHECK(a.entries[0].node == 7);
  CHECK(a.entries[0].displacement == Vec2(0.5, -1e-3));
  CHECK(a.entries[0].line == 3);
  CHECK(a.entries[1].line == 5);
  CHECK_CONTAINS(a.source, "d.csv");

  const DisplacementTable b = read("\"dy\";\"X\";\"y\";\"dz\";\"dx\"\r\n4;1;2;0;3\r\n");
  REQUIRE(b.entries.size() == 1);
  CHECK_FALSE(b.entries[0].node.has_value());
  CHECK(b.entries[0].position == Vec2(1, 2));
  CHECK(b.entries[0].displacement == Vec2(3, 4));

  CHECK(read("3 0.1 0.2").entries[0].node == 3);
  CHECK(read("1\t2\t 0.1  0.2 # wall\n").entries[0].position == Vec2(1, 2));
  CHECK(read("1 , 2, 0.1 ,0.2\n").entries[0].displacement == Vec2(0.1, 0.2));
}

TEST_CASE("displacements: z and dz by name, and six columns without names") {
  const DisplacementTable named = read("dz,node,dx,dy\n3,7,1,2\n");
  CHECK(named.entries[0].displacement == Vec3(1, 2, 3));
  CHECK(named.entries[0].displacement.numbers(0) == 3);
  CHECK(named.entries[0].position.numbers(0) == 2);
  for (const char* text : {"x,y,z,dx,dy,dz\n1,2,3,4,5,6\n", "1 2 3 4 5 6\n"}) {
    const DisplacementEntry entry = read(text).entries[0];
    CHECK(entry.position == Vec3(1, 2, 3));
    CHECK(entry.position.numbers(0) == 3);
    CHECK(entry.displacement == Vec3(4, 5, 6));
    CHECK(entry.displacement.numbers(0) == 3);
  }
  CHECK(read("1,2,0.1,0.2\n").entries[0].displacement.numbers(0) == 2);
  CHECK_CONTAINS(error("node,dx,dy,dz\n1,2,3,far\n"), "d.csv:2: found 'far'");
  CHECK_CONTAINS(error("node,dx,dy,dz,dz\n1,2,3,4,5\n"), "d.csv:1: found other columns");
  CHECK_CONTAINS(error("1,2,3,4,5\n"), "d.csv:1: found 5 columns");
}

TEST_CASE("positions: by name, and three or four columns without names, as SU2 writes them") {
  const auto read_positions = [](const std::string& text) {
    const TemporaryFolder folder;
    write_text(folder / "p.csv", text);
    return io::read_positions(folder / "p.csv");
  };
  const PositionTable plane = read_positions("id,x,y\n4,0.5,-1e-3\n\n# more\n7,1,2\n");
  REQUIRE(plane.entries.size() == 2);
  CHECK(plane.entries[0].node == 4);
  CHECK(plane.entries[0].position == Vec2(0.5, -1e-3));
  CHECK(plane.entries[0].position.numbers(0) == 2);
  CHECK(plane.entries[1].line == 5);
  CHECK_CONTAINS(plane.source, "p.csv");
  CHECK(read_positions("4 0.5 1").entries[0].position == Vec2(0.5, 1));
  for (const char* text : {"z,node,x,y\n3,4,1,2\n", "4\t1\t2\t3\n"}) {
    const PositionEntry entry = read_positions(text).entries[0];
    CHECK(entry.node == 4);
    CHECK(entry.position == Vec3(1, 2, 3));
    CHECK(entry.position.numbers(0) == 3);
  }
  const auto complaint = [&](const std::string& text) {
    try {
      read_positions(text);
    } catch (const InputError& error) {
      const std::string what = error.what();
      return what.substr(what.find("p.csv"));
    }
    return std::string("no error");
  };
  CHECK_CONTAINS(complaint("x,y,z\n1,2,3\n"), "p.csv:1: found other columns, expected node,x,y");
  CHECK_CONTAINS(complaint("node,x,y\n1.5,2,3\n"), "p.csv:2: found '1.5', expected the number");
  CHECK_CONTAINS(complaint("0.5,0.5,0.1,0.2\n"), "p.csv:1: found '0.5', expected the number of");
  CHECK_CONTAINS(complaint("1,2,3,4,5,6\n"),
                 "p.csv:1: found 6 columns, expected 3 (node,x,y) or 4 (node,x,y,z)");
  CHECK_CONTAINS(complaint("node,x,y\n"), "found no position");
}

TEST_CASE("positions are not read as displacements, nor displacements as positions") {
  CHECK_CONTAINS(error("node,x,y\n1,2,3\n"),
                 "d.csv:1: found columns of positions, expected node,dx,dy or x,y,dx,dy, in space "
                 "with z and dz; give this file as positions (--positions), not as displacements");
  CHECK_CONTAINS(error("id,x,y,z\n1,2,3,4\n"), "found columns of positions");
  const TemporaryFolder folder;
  for (const char* names :
       {"node,dx,dy\n1,2,3\n", "x,y,dx,dy\n1,2,3,4\n", "node,x,y,dx\n1,2,3,4\n"}) {
    write_text(folder / "d.csv", names);
    try {
      io::read_positions(folder / "d.csv");
      FAIL("accepted");
    } catch (const InputError& refused) {
      CHECK_CONTAINS(
          std::string(refused.what()),
          "found columns of displacements, expected node,x,y, in space with z; give this "
          "file as displacements (--displacements), not as positions");
    }
  }
}

TEST_CASE("displacements: bad files are refused with the line") {
  CHECK_CONTAINS(error("node,dx,dy\n1,2\n"), "d.csv:2: found 2 columns, expected 3");
  CHECK_CONTAINS(error("node,dx,dy\n1,2,x\n"), "d.csv:2: found 'x', expected a finite number");
  CHECK_CONTAINS(error("node,dx,dy\n1,2,nan\n"), "d.csv:2: found 'nan'");
  CHECK_CONTAINS(error("node,dx,dy\n1,,2\n"), "d.csv:2: found an empty field");
  CHECK_CONTAINS(error("node,dx,dy\n1,2,\n"), "d.csv:2: found an empty field");
  CHECK_CONTAINS(error("node,dx,dy\n-1,2,3\n"), "d.csv:2: found '-1'");
  CHECK_CONTAINS(error("1.5,2,3\n"), "d.csv:1: found '1.5', expected the number of a node");
  CHECK_CONTAINS(error("1,2\n"),
                 "d.csv:1: found 2 columns, expected 3 (node,dx,dy), 4 (x,y,dx,dy) or 6");
  CHECK_CONTAINS(error("a,b,c\n1,2,3\n"), "d.csv:1: found other columns");
  CHECK_CONTAINS(error("node,x,dx,dy\n"), "d.csv:1: found other columns");
  CHECK_CONTAINS(error("node,dx,dy\n"), "found no displacement");
  CHECK_CONTAINS(error(""), "found an empty file");
}

}  // namespace winslow::test
