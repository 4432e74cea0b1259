#include "io/openfoam/thin_mesh.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/quality/quality.h"
#include "io/openfoam/openfoam.h"
#include "io/support/files.h"
#include "io/support/samples.h"
#include "support/meshes.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

namespace fs = std::filesystem;
namespace foam = io::openfoam;

/// Copies a case of the test data to a folder.
fs::path copy_of(const char* name, const TemporaryFolder& folder) {
  const fs::path root = folder / name;
  fs::copy(fs::path(test_data("openfoam")) / name, root, fs::copy_options::recursive);
  return root;
}

/// The points of a text file, by a parser that knows nothing of the program's.
std::vector<std::array<double, 3>> points_in(const fs::path& file) {
  const std::string text = read_text(file);
  std::vector<std::array<double, 3>> points;
  for (std::size_t at = text.find("\n("); at != std::string::npos; at = text.find("\n(", at + 1)) {
    std::array<double, 3> p{};
    if (std::sscanf(text.c_str() + at + 1, "(%lf %lf %lf)", &p[0], &p[1], &p[2]) == 3)
      points.push_back(p);
  }
  return points;
}

/// A case with a wedge of `degrees` about the x-axis: n by m cells from the axis to radius 1.
fs::path write_wedge(const fs::path& root, double angle, int n, int m) {
  const fs::path mesh = root / "constant/polyMesh";
  fs::create_directories(mesh);
  const double half = angle / 2 * std::numbers::pi / 180;
  std::ostringstream points, faces, owner, neighbour, boundary;
  points.precision(17);
  // Points: axis i, then for each side (i, j) with j from 1 on.
  const auto point = [&](int side, int i, int j) {
    return j == 0 ? i : (n + 1) + (side * (n + 1) + i) * m + j - 1;
  };
  points << (n + 1) * (1 + 2 * m) << "\n(\n";
  for (int i = 0; i <= n; ++i) points << '(' << i << " 0 0)\n";
  for (const int side : {0, 1})
    for (int i = 0; i <= n; ++i)
      for (int j = 1; j <= m; ++j)
        points << '(' << i << ' ' << double(j) / m * std::cos(half) << ' '
               << (side == 0 ? -1 : 1) * double(j) / m * std::sin(half) << ")\n";
  points << ")\n";
  struct Made {
    std::vector<int> nodes;
    int owner, neighbour;
  };
  std::vector<Made> inner;
  const auto cell = [&](int i, int j) { return i * m + j; };
  const auto polygon = [](std::vector<int> nodes) {
    std::vector<int> unique;
    for (const int node : nodes)
      if (std::ranges::find(unique, node) == unique.end()) unique.push_back(node);
    return unique;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      if (j + 1 < m)
        inner.push_back({polygon({point(0, i, j + 1), point(1, i, j + 1), point(1, i + 1, j + 1),
                                  point(0, i + 1, j + 1)}),
                         cell(i, j), cell(i, j + 1)});
      if (i + 1 < n)
        inner.push_back({polygon({point(0, i + 1, j), point(0, i + 1, j + 1),
                                  point(1, i + 1, j + 1), point(1, i + 1, j)}),
                         cell(i, j), cell(i + 1, j)});
    }
  std::vector<Made> all = inner;
  std::vector<std::pair<std::string, int>> patches;  // entry, faces
  const auto begin = [&](const std::string& entry) { patches.push_back({entry, 0}); };
  const auto add = [&](std::vector<int> nodes, int of) {
    all.push_back({polygon(std::move(nodes)), of, -1});
    ++patches.back().second;
  };
  begin("inlet { type patch;");
  for (int j = 0; j < m; ++j)
    add({point(0, 0, j), point(1, 0, j), point(1, 0, j + 1), point(0, 0, j + 1)}, cell(0, j));
  begin("outlet { type patch;");
  for (int j = 0; j < m; ++j)
    add({point(0, n, j), point(0, n, j + 1), point(1, n, j + 1), point(1, n, j)}, cell(n - 1, j));
  begin("wall { type wall;");
  for (int i = 0; i < n; ++i)
    add({point(0, i, m), point(1, i, m), point(1, i + 1, m), point(0, i + 1, m)}, cell(i, m - 1));
  begin("axis { type empty;");
  for (const int side : {0, 1}) {
    begin(side == 0 ? "back { type wedge;" : "front { type wedge;");
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < m; ++j) {
        std::vector<int> nodes{point(side, i, j), point(side, i, j + 1), point(side, i + 1, j + 1),
                               point(side, i + 1, j)};
        if (side == 1) std::ranges::reverse(nodes);
        add(nodes, cell(i, j));
      }
  }
  faces << all.size() << "\n(\n";
  owner << all.size() << "\n(\n";
  for (const Made& face : all) {
    faces << face.nodes.size() << '(';
    for (const int node : face.nodes) faces << node << ' ';
    faces << ")\n";
    owner << face.owner << '\n';
  }
  faces << ")\n";
  owner << ")\n";
  neighbour << inner.size() << "\n(\n";
  for (const Made& face : inner) neighbour << face.neighbour << '\n';
  neighbour << ")\n";
  boundary << patches.size() << "\n(\n";
  std::size_t first = inner.size();
  for (const auto& [entry, count] : patches) {
    boundary << entry << " nFaces " << count << "; startFace " << first << "; }\n";
    first += static_cast<std::size_t>(count);
  }
  boundary << ")\n";
  write_text(mesh / "points", points.str());
  write_text(mesh / "faces", faces.str());
  write_text(mesh / "owner", owner.str());
  write_text(mesh / "neighbour", neighbour.str());
  write_text(mesh / "boundary", boundary.str());
  return root;
}

}  // namespace

TEST_CASE("OpenFOAM: a mesh one cell thick between empty patches is a plane mesh") {
  const TemporaryFolder folder;
  const fs::path root = copy_of("ellipse", folder);
  io::MeshFile file = io::read_mesh(root);
  CHECK(file.warnings.empty());
  const Topology& topology = *file.mesh.topology;
  CHECK(topology.kind() == MeshKind::plane);
  CHECK(topology.node_count() == 190);
  CHECK(topology.element_count() == 340);
  CHECK(topology.reversed_elements() == 0);
  REQUIRE(topology.markers().size() == 2);
  CHECK(topology.markers()[0].name == "airfoil");
  CHECK(topology.markers()[0].faces.size() == 9);
  CHECK(topology.markers()[1].faces.size() == 31);
  CHECK(check_validity(topology, file.mesh.coordinates).min_sine > 0.1);
  // Nodes move in their plane, and all else is as it was.
  const auto before = points_in(root / "constant/polyMesh/points");
  REQUIRE(before.size() == 380);
  const Index node = topology.interior_nodes()[17];
  const Vec2 from = file.mesh.coordinates.xy(node), to = from + Vec2(0.03125, -0.015625);
  file.mesh.coordinates.set_xy(node, to);
  CHECK(io::write_mesh(root / "0.5", file.mesh, file.details.get()).empty());
  std::vector<fs::path> written;
  for (const auto& entry : fs::recursive_directory_iterator(root / "0.5"))
    if (entry.is_regular_file()) written.push_back(entry.path());
  CHECK(written == std::vector<fs::path>{root / "0.5/polyMesh/points"});
  CHECK_CONTAINS(read_text(written[0]), "location    \"0.5/polyMesh\";");
  const auto after = points_in(written[0]);
  REQUIRE(after.size() == before.size());
  int moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(after[i][2] == before[i][2]);
    if (after[i] == before[i]) continue;
    ++moved;
    CHECK(before[i][0] == from.x());
    CHECK(after[i] == std::array<double, 3>{to.x(), to.y(), before[i][2]});
  }
  CHECK(moved == 2);
  CHECK(io::read_mesh(root / "0.5").mesh.coordinates == file.mesh.coordinates);
  CHECK(io::read_mesh(root, {.time = "latest"}).mesh.coordinates == file.mesh.coordinates);
  const io::MeshFile first = io::read_mesh(root);
  CHECK_FALSE(first.mesh.coordinates == file.mesh.coordinates);
  CHECK(any_contains(first.warnings, "--time latest, or the folder 0.5"));
}

TEST_CASE("OpenFOAM: a mesh one cell thick along x or y is one of the other plane") {
  const TemporaryFolder folder;
  for (const int across : {0, 1}) {
    CAPTURE(across);
    const fs::path root = folder / (across == 0 ? "x" : "y");
    fs::copy(fs::path(test_data("openfoam")) / "ellipse", root, fs::copy_options::recursive);
    const fs::path file = root / "constant/polyMesh/points";
    const auto points = points_in(file);
    std::ostringstream text;
    text.precision(17);
    text << points.size() << "\n(\n";
    for (const auto& [x, y, z] : points) {
      // Turned without a mirror.
      if (across == 0) text << '(' << z << ' ' << x << ' ' << y << ")\n";
      if (across == 1) text << '(' << x << ' ' << -z << ' ' << y << ")\n";
    }
    text << ")\n";
    write_text(file, text.str());
    const io::MeshFile turned = io::read_mesh(root);
    const io::MeshFile level = io::read_mesh(fs::path(test_data("openfoam")) / "ellipse");
    CHECK(turned.mesh.coordinates == level.mesh.coordinates);
    CHECK(turned.mesh.topology->reversed_elements() == 0);
    CHECK(any_contains(turned.warnings,
                       across == 0 ? "its coordinates are (y, z)" : "its coordinates are (x, z)"));
    Mesh moved = turned.mesh;
    moved.coordinates.set_xy(100, moved.coordinates.xy(100) + Vec2(0.01, 0.02));
    io::write_mesh(root / "1", moved, turned.details.get());
    const auto after = points_in(root / "1/polyMesh/points");
    const auto before = points_in(file);
    for (std::size_t i = 0; i < before.size(); ++i)
      CHECK(after[i][static_cast<std::size_t>(across)] ==
            before[i][static_cast<std::size_t>(across)]);
    CHECK(io::read_mesh(root / "1").mesh.coordinates == moved.coordinates);
  }
}

TEST_CASE("OpenFOAM: sides that are no copies of one plane, or tilted, are read as a volume") {
  const TemporaryFolder folder;
  const fs::path root = copy_of("ellipse", folder);
  const fs::path file = root / "constant/polyMesh/points";
  const std::string text = read_text(file);
  write_text(file, replaced(text, "(0.273387 0.100473 0.1)", "(0.303387 0.100473 0.1)"));
  io::MeshFile read = io::read_mesh(root);
  CHECK(read.mesh.topology->kind() == MeshKind::volume);
  CHECK(any_contains(read.warnings,
                     "front, back of type empty: they are no copies of one plane: points "));
  CHECK(any_contains(read.warnings, "read as a volume mesh"));
  std::ostringstream tilted;
  tilted.precision(17);
  const auto points = points_in(test_data("openfoam/ellipse/constant/polyMesh/points"));
  tilted << points.size() << "\n(\n";
  for (const auto& [x, y, z] : points)
    tilted << '(' << 0.8 * x - 0.6 * z << ' ' << y << ' ' << 0.6 * x + 0.8 * z << ")\n";
  tilted << ")\n";
  write_text(file, tilted.str());
  read = io::read_mesh(root);
  CHECK(read.mesh.topology->kind() == MeshKind::volume);
  CHECK(any_contains(read.warnings, "they are not all at right angles to one of the axes"));
}

TEST_CASE("OpenFOAM: a wedge is a plane mesh of the axis and the radius") {
  const TemporaryFolder folder;
  const fs::path root = write_wedge(folder / "wedge", 5, 6, 4);
  const io::MeshFile file = io::read_mesh(root);
  CHECK(any_contains(file.warnings,
                     "a wedge of 5 degrees about the x-axis: its coordinates are "
                     "(x, r), r along y"));
  const Topology& topology = *file.mesh.topology;
  REQUIRE(topology.kind() == MeshKind::plane);
  CHECK(topology.node_count() == 7 * 5);
  CHECK(topology.element_count() == 24);
  const auto axis = topology.markers().find("axis");
  REQUIRE(axis);
  CHECK(topology.markers().nodes(*axis).size() == 7);
  CHECK(topology.markers().unmarked_faces() == 0);
  REQUIRE(file.details->roles.symmetry.size() == 1);
  CHECK(file.details->roles.symmetry[0].first == "axis");
  for (Index node = 0; node < topology.node_count(); ++node) {
    const Vec2 p = file.mesh.coordinates.xy(node);
    CHECK(std::abs(p.x() - std::round(p.x())) < 1e-14);
    CHECK(std::abs(4 * p.y() - std::round(4 * p.y())) < 1e-13);
  }
  // Moved nodes are turned by half the angle both ways; those of the axis stay on it.
  Mesh moved = file.mesh;
  const Index on_axis = topology.markers().nodes(*axis)[2];
  const Index inside = topology.interior_nodes()[5];
  moved.coordinates.set_xy(on_axis, moved.coordinates.xy(on_axis) + Vec2(0.25, 1e-17));
  moved.coordinates.set_xy(inside, moved.coordinates.xy(inside) + Vec2(0.1, 0.05));
  CHECK(io::write_mesh(root / "0.5", moved, file.details.get()).empty());
  const auto before = points_in(root / "constant/polyMesh/points");
  const auto after = points_in(root / "0.5/polyMesh/points");
  REQUIRE(after.size() == before.size());
  int changed = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    changed += after[i] != before[i] ? 1 : 0;
    const auto [x, y, z] = after[i];
    if (before[i][1] == 0)
      CHECK((y == 0 && z == 0));
    else
      CHECK(std::abs(std::abs(std::atan2(z, y)) - 2.5 * std::numbers::pi / 180) < 1e-14);
  }
  CHECK(changed == 3);
  const io::MeshFile back = io::read_mesh(root / "0.5");
  CHECK((back.mesh.coordinates.xy(inside) - moved.coordinates.xy(inside)).norm() < 1e-14);
}

TEST_CASE("OpenFOAM: any plane mesh is written one cell thick, and comes back") {
  Random random(4);
  for (int k = 0; k < 5; ++k) {
    const Mesh mesh = make_mesh(shuffled_mesh(random, false));
    const TemporaryFolder folder;
    const auto warnings = io::write_mesh(folder / "polyMesh", mesh, nullptr);
    CHECK(any_contains(warnings, "one cell thick"));
    const io::MeshFile back = io::read_mesh(folder / "polyMesh");
    REQUIRE(back.mesh.topology->kind() == MeshKind::plane);
    CHECK(back.mesh.coordinates == mesh.coordinates);
    CHECK(back.mesh.topology->element_count() == mesh.topology->element_count());
    CHECK(back.mesh.topology->markers().size() == mesh.topology->markers().size());
    CHECK(check_validity(*back.mesh.topology, back.mesh.coordinates).inverted ==
          check_validity(*mesh.topology, mesh.coordinates).inverted);
  }
}

TEST_CASE("OpenFOAM: a thin mesh with other cells keeps its planes and the types of its patches") {
  const TemporaryFolder folder;
  const fs::path root = write_wedge(folder / "wedge", 4, 5, 3);
  const io::MeshFile file = io::read_mesh(root);
  // The same mesh with elements in another order does not fit the files that were read.
  MeshData data;
  data.coordinates = file.mesh.coordinates;
  for (Index e = file.mesh.topology->element_count() - 1; e >= 0; --e)
    data.add_element(file.mesh.topology->element_type(e), file.mesh.topology->element(e));
  data.markers = file.mesh.topology->markers().list();
  std::swap(data.markers[0].faces[0], data.markers[0].faces[1]);
  const auto warnings = io::write_mesh(folder / "new", make_mesh(data), file.details.get());
  CHECK(warnings.empty());
  const io::MeshFile back = io::read_mesh(folder / "new");
  CHECK(back.mesh.topology->node_count() == file.mesh.topology->node_count());
  CHECK(back.mesh.topology->element_count() == file.mesh.topology->element_count());
  CHECK(back.mesh.topology->markers().find("axis"));
  CHECK(any_contains(back.warnings, "a wedge of 4 degrees about the x-axis"));
  const std::string boundary = read_text(folder / "new/constant/polyMesh/boundary");
  for (const char* entry : {"    axis\n", "    wall\n", "type wedge;", "type empty;", "type wall;"})
    CHECK_CONTAINS(boundary, entry);
}

}  // namespace winslow::test
