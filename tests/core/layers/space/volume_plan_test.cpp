#include "core/layers/space/volume_plan.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/layers/space/wall_surface.h"
#include "support/walled_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::string refusal(const Mesh& mesh, const LayerOptions& options) {
  try {
    plan_volume_layers(mesh, options);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

/// Smallest share of a wall face's area along its normal, and of a wall edge's length along the
/// edge, that is left at the rim.
struct RimShares {
  double area = 10, length = 10;
};

RimShares rim_shares(const Mesh& mesh, const LayerStack& stack) {
  RimShares least;
  for (const ColumnFace& face : stack.faces) {
    const auto corners = face.corners();
    const std::size_t n = corners.size();
    std::vector<Vec3> wall, rim;
    for (const std::size_t c : corners) {
      const LayerColumn& column = stack.columns[c];
      wall.push_back(mesh.coordinates.xyz(column.wall_node));
      rim.push_back(wall.back() + column.thickness() * column.slant * column.direction);
    }
    const Vec3 normal = n == 3 ? Vec3((wall[1] - wall[0]).cross(wall[2] - wall[0]))
                               : Vec3((wall[2] - wall[0]).cross(wall[3] - wall[1]));
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = (k + 1) % n, last = (k + n - 1) % n;
      const double below = normal.dot((wall[next] - wall[k]).cross(wall[last] - wall[k]));
      const double above = normal.dot((rim[next] - rim[k]).cross(rim[last] - rim[k]));
      least.area = std::min(least.area, above / below);
      const Vec3 edge = wall[next] - wall[k];
      least.length = std::min(least.length, (rim[next] - rim[k]).dot(edge) / edge.squaredNorm());
    }
  }
  return least;
}

/// Smallest volume at a corner of a layer's element, as a share of that in a right prism.
double least_corner(const Mesh& mesh, const LayerStack& stack) {
  double least = 10;
  for (const ColumnFace& face : stack.faces) {
    const std::size_t n = face.corners().size();
    const auto point = [&](std::size_t k, std::size_t level) {
      const LayerColumn& c = stack.columns[face.columns[k % n]];
      const double height = sum_of(std::span(c.heights).first(level));
      return Vec3(mesh.coordinates.xyz(c.wall_node) + height * c.slant * c.direction);
    };
    for (std::size_t k = 0; k < n; ++k) {
      const std::vector<double>& heights = stack.columns[face.columns[k]].heights;
      const auto edge = [&](std::size_t other, std::size_t level) {
        return Vec3(point(other, level) - point(k, level));
      };
      const double area = edge(k + 1, 0).cross(edge(k + n - 1, 0)).norm();
      for (std::size_t layer = 0; layer < heights.size(); ++layer) {
        const Vec3 up = point(k, layer + 1) - point(k, layer);
        for (const std::size_t level : {layer, layer + 1}) {
          const double volume = edge(k + 1, level).cross(edge(k + n - 1, level)).dot(up);
          least = std::min(least, volume / (area * heights[layer]));
        }
      }
    }
  }
  return least;
}

double steepest(const Mesh& mesh, const LayerStack& stack) {
  double most = 0;
  for (const ColumnFace& face : stack.faces) {
    for (std::size_t k = 0; k < face.corners().size(); ++k) {
      const LayerColumn& a = stack.columns[face.columns[k]];
      const LayerColumn& b = stack.columns[face.columns[(k + 1) % face.corners().size()]];
      const double length =
          (mesh.coordinates.xyz(a.wall_node) - mesh.coordinates.xyz(b.wall_node)).norm();
      most = std::max(most, std::abs(a.thickness() - b.thickness()) / length);
    }
  }
  return most;
}

}  // namespace

TEST_CASE("with room for them layers in space have the heights that are asked for") {
  const LayerSpacing spacing{.count = 6, .first = 1e-3, .ratio = 1.3};
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube_with_cavity(6, volumes));
    const LayerStack stack = plan_volume_layers(mesh, layers_on("cavity", spacing));
    CHECK(stack.columns.size() == 26);
    CHECK(stack.pairs.empty());
    const std::vector<double> wanted = layer_heights(spacing);
    for (const LayerColumn& column : stack.columns) {
      REQUIRE(column.count() == 6);
      for (std::size_t k = 0; k < 6; ++k)
        CHECK(column.heights[k] == doctest::Approx(wanted[k]).epsilon(1e-12));
      CHECK(column.limit == LayerLimit::none);
      CHECK_FALSE(cut_short(column));
    }
    for (const ColumnFace& face : stack.faces) {
      Vec3 area(0, 0, 0), direction(0, 0, 0);
      const auto wall = [&](std::size_t k) {
        return mesh.coordinates.xyz(stack.columns[face.corners()[k]].wall_node);
      };
      for (std::size_t k = 1; k + 1 < face.corners().size(); ++k)
        area += (wall(k) - wall(0)).cross(wall(k + 1) - wall(0));
      for (const std::size_t c : face.corners()) direction += stack.columns[c].direction;
      CHECK(area.dot(direction) > 0);
    }
  }
}

TEST_CASE("in a gap the first height stays and ratios give way") {
  const Mesh mesh = box_with_slab(8, 2, 3, Volumes::tetrahedra);  // .25 above the floor
  const LayerSpacing spacing{.count = 8, .first = 2e-3, .ratio = 1.6};
  LayerOptions options = layers_on("body", spacing);
  const LayerStack stack = plan_volume_layers(mesh, options);
  int limited = 0;
  for (const LayerColumn& column : stack.columns) {
    CHECK(column.count() == 8);
    CHECK(column.heights[0] == doctest::Approx(2e-3));
    const Vec3 p = mesh.coordinates.xyz(column.wall_node);
    if (p.z() > 0.3 || column.slant > 1.01) continue;
    CHECK(column.thickness() <= 0.35 * 0.25 * 1.01);
    CHECK((column.limit == LayerLimit::clearance || column.limit == LayerLimit::neighbour ||
           column.limit == LayerLimit::crossing));
    CHECK(cut_short(column));
    ++limited;
  }
  CHECK(limited >= 9);
  CHECK(steepest(mesh, stack) < 0.5 + 1e-6);
  options.scale_all = true;
  for (const LayerColumn& column : plan_volume_layers(mesh, options).columns)
    CHECK(column.heights[1] / column.heights[0] == doctest::Approx(1.6));
}

TEST_CASE("in concave corners faces and edges keep their share at the rim") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra, Volumes::mixed}) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube_with_cavity(6, volumes));
    const LayerStack stack =
        plan_volume_layers(mesh, layers_on("outer", {.count = 5, .first = 4e-3, .ratio = 2}));
    const RimShares shares = rim_shares(mesh, stack);
    CHECK(shares.length >= 0.65 - 1e-6);
    CHECK(shares.area >= 0.45 - 1e-6);
    CHECK(steepest(mesh, stack) <= 0.5 + 1e-6);
    double thickest = 0, thinnest = 1;
    for (const LayerColumn& column : stack.columns) {
      thickest = std::max(thickest, column.thickness());
      thinnest = std::min(thinnest, column.thickness());
      CHECK(column.heights[0] <= 4e-3 * (1 + 1e-9));
    }
    CHECK(thinnest < 0.7 * thickest);
    CHECK(shares.length < 0.66);  // and no more than that is given up
  }
}

TEST_CASE("corners of layers keep a part of their volume where thin faces meet sharp ridges") {
  Random random(17);
  for (int trial = 0; trial < 6; ++trial) {
    CAPTURE(trial);
    Mesh mesh = box_with_spike(0.34);
    for (Index node = 0; node < mesh.coordinates.size(); ++node) {
      Vec3 p = mesh.coordinates.xyz(node);
      if (mesh.topology->on_boundary(node) && std::abs(p.x() - 0.5) < 0.3 &&
          std::abs(p.y() - 0.5) < 0.3 && p.z() < 0.4)
        mesh.coordinates.set_xyz(node, p + 0.02 * random_vector(random));
    }
    LayerStack stack;
    try {
      stack = plan_volume_layers(
          mesh, layers_on("body", {.count = 6, .first = 2e-3, .ratio = 1.9, .growth = 1}));
    } catch (const UsageError& error) {
      CHECK(std::string(error.what()).find("turns too sharply") != std::string::npos);
      continue;
    }
    CHECK(least_corner(mesh, stack) >= 0.2 - 1e-9);
  }
}

TEST_CASE("where constant heights are too thick all of them are scaled, and the reason is said") {
  const Mesh mesh = box_with_slab(8, 2, 3, Volumes::hexahedra);
  const LayerStack stack =
      plan_volume_layers(mesh, layers_on("body", {.count = 8, .first = 0.02, .ratio = 1.2}));
  int scaled = 0;
  for (const LayerColumn& column : stack.columns) {
    REQUIRE(column.count() == 8);
    if (column.heights[0] > 0.02 * (1 - 1e-9)) continue;
    ++scaled;
    CHECK(column.limit != LayerLimit::none);
    CHECK(column.heights[7] == doctest::Approx(column.heights[0]));
  }
  CHECK(scaled > 0);
  const std::string why =
      refusal(mesh, layers_on("body", {.count = 100, .first = 0.02, .ratio = 1.2}));
  CHECK(why.starts_with("there is no room for 100 layers above node"));
  CHECK(why.find("is left there (clearance)") != std::string::npos);
}

TEST_CASE("walls with heights of their own go over into one another") {
  const Mesh mesh = make_mesh(cube(12, Volumes::tetrahedra));
  LayerOptions options;
  options.walls = {{{"floor"}, {.count = 4, .first = 1e-3, .ratio = 1.2}},
                   {{"walls"}, {.count = 4, .first = 4e-3, .ratio = 1.2}}};
  const LayerStack stack = plan_volume_layers(mesh, options);
  double far_floor = 1, far_wall = 0;
  for (const LayerColumn& column : stack.columns) {
    const Vec3 p = mesh.coordinates.xyz(column.wall_node);
    CHECK(column.first >= 1e-3 * (1 - 1e-9));
    CHECK(column.first <= 4e-3 * (1 + 1e-9));
    if ((p - Vec3(0.5, 0.5, 0)).norm() < 1e-9) far_floor = column.first;
    if (p.z() == 1) far_wall = std::max(far_wall, column.first);
  }
  CHECK(far_floor < 1.2e-3);
  CHECK(far_wall > 3.9e-3);

  options.walls[1].spacing.count = 7;
  CHECK(refusal(mesh, options) ==
        "walls that meet need the same number of layers, but of marker 'floor' 4 and of marker "
        "'walls' 7 are asked for: give both the same number");
  options.walls[0].spacing.match_outside = true;
  options.walls[0].spacing.ratio = 2;
  for (const LayerColumn& column : plan_volume_layers(mesh, options).columns)
    CHECK(column.count() == 7);
}

TEST_CASE("matching the elements outside ends with the height of regular tetrahedra") {
  const Mesh mesh = make_mesh(cube(8, Volumes::hexahedra));
  LayerOptions options = layers_on("floor", {.count = 4, .first = 1e-2, .ratio = 1.3});
  options.walls[0].spacing.match_outside = true;
  const LayerStack stack = plan_volume_layers(mesh, options);
  const auto count = with_counts(options, mesh).walls[0].spacing.count;
  const double last = std::sqrt(2.0 / 3) / 8;
  CHECK(0.01 * std::pow(1.3, count - 1) * std::pow(1.01, (count - 1) * (count - 2) / 2.0) >= last);
  for (const LayerColumn& column : stack.columns) {
    REQUIRE(column.count() == static_cast<std::size_t>(count));
    if (column.limit == LayerLimit::none)
      CHECK(column.heights.back() == doctest::Approx(last).epsilon(1e-6));
  }
}

TEST_CASE("single columns may have a thickness of their own, but neither fans nor no layers") {
  const Mesh mesh = make_mesh(cube(8, Volumes::hexahedra));
  LayerOptions options = layers_on("floor", {.count = 4, .first = 5e-3, .ratio = 1.5});
  const auto stack = plan_volume_layers(mesh, options);
  Index middle = -1;
  for (const LayerColumn& column : stack.columns)
    if ((mesh.coordinates.xyz(column.wall_node) - Vec3(0.5, 0.5, 0)).norm() < 1e-9)
      middle = column.wall_node;
  options.overrides = {{middle, {}, 0.022}};
  for (const LayerColumn& column : plan_volume_layers(mesh, options).columns) {
    if (column.wall_node == middle) CHECK(column.thickness() == doctest::Approx(0.022));
  }
  options.overrides = {{middle, {}, 0.0}};
  CHECK(refusal(mesh, options).find("cannot be without layers") != std::string::npos);
  options.overrides = {{middle, 3, {}}};
  CHECK(refusal(mesh, options).find("volume meshes have no fans yet") != std::string::npos);
  options.overrides = {{mesh.topology->interior_nodes()[0], 1, {}}};
  CHECK(refusal(mesh, options).find("is on none of the walls") != std::string::npos);
}
