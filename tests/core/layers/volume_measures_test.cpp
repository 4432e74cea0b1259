#include "core/layers/volume_measures.h"

#include <doctest/doctest.h>

#include "support/volume_layers.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// Layers of heights .01, .02 on the floor of the unit cube, at their wanted places.
VolumeLayerInsertion on_floor(Volumes volumes) {
  return extruded(make_mesh(cube(4, volumes)), {{"floor"}, {0.01, 0.02}, {"walls"}, 1});
}

const LayerColumn& column_inside(const LayerStack& stack) {
  return *std::ranges::find(stack.columns, false, &LayerColumn::along_boundary);
}

std::size_t index_of(const LayerStack& stack, const LayerColumn& column) {
  return static_cast<std::size_t>(&column - stack.columns.data());
}

}  // namespace

TEST_CASE("Straight columns on a flat wall have their wanted heights and no tilt") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    const auto layers = on_floor(volumes);
    const LayerMeasures m = measure_layers(layers.stack, layers.ideal);
    CHECK(m.columns.size() == 25);
    CHECK(m.first_height.min == doctest::Approx(0.01));
    CHECK(m.first_height.max == doctest::Approx(0.01));
    CHECK(m.thickness.avg == doctest::Approx(0.03));
    CHECK(m.spacing_error.max < 1e-12);
    CHECK(m.orthogonality.max < 1e-6);
    CHECK(m.cut_short == 0);
  }
}

TEST_CASE("Heights are normal to the wall: nodes that move along it tilt their column") {
  const auto layers = on_floor(Volumes::tetrahedra);
  const LayerColumn& column = column_inside(layers.stack);
  const std::size_t c = index_of(layers.stack, column);
  Coordinates x = layers.ideal;
  const double sideways = 0.01 * std::tan(radians(30));
  x.set_xyz(column.nodes[1], x.xyz(column.nodes[1]) + Vec3(sideways, 0, 0));
  const LayerMeasures tilted = measure_layers(layers.stack, x);
  CHECK(tilted.columns[c].tilt == doctest::Approx(30));
  CHECK(tilted.columns[c].spacing_error < 1e-12);
  x.set_xyz(column.nodes[1], x.xyz(column.wall_node) + Vec3(0, 0, 0.011));
  const LayerMeasures higher = measure_layers(layers.stack, x);
  CHECK(higher.columns[c].first_error == doctest::Approx(0.1));
  CHECK(higher.columns[c].first_height == doctest::Approx(0.011));
  CHECK(higher.columns[c].thickness == doctest::Approx(0.03));
  CHECK(higher.columns[c].tilt < 1e-6);
}

TEST_CASE("Columns along a boundary have heights but no tilt") {
  const auto layers = on_floor(Volumes::hexahedra);
  const LayerMeasures m = measure_layers(layers.stack, layers.ideal);
  std::size_t along = 0;
  for (std::size_t c = 0; c < m.columns.size(); ++c) {
    if (!layers.stack.columns[c].along_boundary) continue;
    ++along;
    CHECK(m.columns[c].tilt == -1);
    CHECK(m.columns[c].first_height == doctest::Approx(0.01));
  }
  CHECK(along == 16);
}

TEST_CASE("A mitred column at a corner of a cube has its heights over all faces there") {
  const Mesh mesh = make_mesh(cube_with_cavity(6, Volumes::tetrahedra));
  const auto layers = extruded(mesh, {{"cavity"}, {0.01, 0.02}, {}, 1});
  const LayerMeasures m = measure_layers(layers.stack, layers.ideal);
  CHECK(m.spacing_error.max < 1e-9);
  // The corner's column, one of eight, goes off at 54.7 degrees from three faces.
  CHECK(std::ranges::count_if(layers.stack.columns, [](const LayerColumn& column) {
          return std::abs(column.slant - std::sqrt(3.0)) < 1e-2;
        }) == 8);
  CHECK(m.orthogonality.max < 0.5);
}

TEST_CASE("Corrections are the wanted over the present heights, at most a factor of two") {
  const auto layers = on_floor(Volumes::tetrahedra);
  LayerStack stack = layers.stack;
  const LayerColumn& column = column_inside(layers.stack);
  const std::size_t c = index_of(layers.stack, column);
  Coordinates x = layers.ideal;
  const Vec3 foot = x.xyz(column.wall_node);
  x.set_xyz(column.nodes[1], foot + Vec3(0, 0, 0.008));
  x.set_xyz(column.nodes[2], foot + Vec3(0, 0, 0.010));
  correct_volume_layers(stack, x);
  CHECK(stack.columns[c].corrections[0] == doctest::Approx(1.25));
  CHECK(stack.columns[c].corrections[1] == doctest::Approx(2));
  correct_volume_layers(stack, x);
  CHECK(stack.columns[c].corrections[0] == doctest::Approx(1.25 * 1.25));
  CHECK(stack.columns[(c + 1) % stack.columns.size()].corrections[0] == doctest::Approx(1));
}

TEST_CASE("columns turn with their walls, so that heights are measured where the walls went") {
  const Mesh mesh = box_with_ball(5, Volumes::tetrahedra);
  const auto layers = extruded(mesh, {{"cavity"}, growing_heights(4, 0.01, 1.2), {}});
  const Coordinates& x = layers.ideal;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  Coordinates turned = x;
  for (Index node = 0; node < x.size(); ++node) turned.set_xyz(node, turn * x.xyz(node));
  const LayerStack carried = carried_by_walls(layers.stack, x, turned);
  for (std::size_t c = 0; c < carried.columns.size(); ++c)
    CHECK((carried.columns[c].direction - turn * layers.stack.columns[c].direction).norm() < 1e-9);
  CHECK(measure_layers(carried, turned).spacing_error.max < 1e-9);
  CHECK(measure_layers(layers.stack, turned).spacing_error.max > 0.1);
}
