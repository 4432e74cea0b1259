#include "io/tables/boundary_file.h"

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

}  // namespace winslow::test
