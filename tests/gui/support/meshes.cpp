#include "gui/support/meshes.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <utility>

#include "io/format/mesh_file.h"

namespace winslow::gui::test {

Mesh ring_mesh(Index around, Index layers) {
  MeshData data;
  for (Index j = 0; j <= layers; ++j)
    for (Index i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      const double t = static_cast<double>(j) / layers;
      const Vec2 circle(std::cos(angle), std::sin(angle));
      const Vec2 body(0.5 * circle.x(), 0.15 * circle.y());
      data.coordinates.push_xy((1 - t) * body + t * 3 * circle);
    }
  const auto node = [around](Index i, Index j) { return j * around + i % around; };
  for (Index j = 0; j < layers; ++j)
    for (Index i = 0; i < around; ++i) {
      const std::array<Index, 3> lower{node(i, j), node(i + 1, j + 1), node(i + 1, j)};
      const std::array<Index, 3> upper{node(i, j), node(i, j + 1), node(i + 1, j + 1)};
      data.add_element(ElementType::triangle, lower);
      data.add_element(ElementType::triangle, upper);
    }
  Marker flap{"flap", 1, {}};
  Marker farfield{"farfield", 2, {}};
  for (Index i = 0; i < around; ++i) {
    flap.faces.emplace_back(node(i, 0), node(i + 1, 0));
    farfield.faces.emplace_back(node(i, layers), node(i + 1, layers));
  }
  data.markers = {flap, farfield};
  return make_mesh(data);
}

Mesh two_body_mesh(Index fine) {
  const Index columns = 16 * fine;
  const Index rows = 8 * fine;
  const double side = 0.5 / fine;
  const auto hole = [fine](Index column, Index row) -> int {
    const Index i = column / fine;
    const Index j = row / fine;
    if (j != 3 && j != 4) return 0;
    if (i == 3 || i == 4) return 1;
    return i == 11 || i == 12 ? 2 : 0;
  };
  MeshData data;
  std::map<std::pair<Index, Index>, Index> ids;
  const auto node = [&](Index i, Index j) {
    const auto [it, added] = ids.try_emplace({i, j}, data.node_count());
    if (added) data.coordinates.push_xy(Vec2(side * i - 4, side * j - 2));
    return it->second;
  };
  std::array<Marker, 3> markers{Marker{"outer", 1, {}}, Marker{"left", 2, {}},
                                Marker{"right", 3, {}}};
  const auto inside = [&](Index i, Index j) { return i >= 0 && j >= 0 && i < columns && j < rows; };
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      if (hole(i, j)) continue;
      const std::array<Index, 4> corners{node(i, j), node(i + 1, j), node(i + 1, j + 1),
                                         node(i, j + 1)};
      data.add_element(ElementType::quadrilateral, corners);
      const std::array<std::pair<Index, Index>, 4> beside{
          {{i, j - 1}, {i + 1, j}, {i, j + 1}, {i - 1, j}}};
      for (std::size_t k = 0; k < 4; ++k) {
        const auto [p, q] = beside[k];
        const int which = inside(p, q) ? hole(p, q) : 0;
        if (inside(p, q) && which == 0) continue;
        markers[static_cast<std::size_t>(which)].faces.push_back(
            {corners[k], corners[(k + 1) % 4]});
      }
    }
  data.markers.assign(markers.begin(), markers.end());
  return make_mesh(data);
}

Mesh tangled_mesh() {
  Mesh mesh = ring_mesh();
  const Index node = mesh.topology->interior_nodes()[30];
  mesh.coordinates.set_xy(node, -mesh.coordinates.xy(node));
  return mesh;
}

TemporaryFolder::TemporaryFolder() {
  static std::atomic<int> count{0};
  path_ = std::filesystem::temp_directory_path() /
          ("winslow-studio-" + std::to_string(getpid()) + "-" + std::to_string(++count));
  std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path write(const TemporaryFolder& folder, const Mesh& mesh,
                            const std::string& name) {
  const auto path = folder / name;
  io::write_mesh(path, mesh, nullptr);
  return path;
}

}  // namespace winslow::gui::test
