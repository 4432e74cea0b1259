#include "core/problem/node_classes.h"

#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <vector>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/problem/node_unknowns.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::shared_ptr<const Topology> plane() { return Topology::build(square(4, Cells::mixed)); }
std::shared_ptr<const Topology> volume() { return Topology::build(cube(3, Volumes::tetrahedra)); }

/// A mesh in which nodes of every class take turns.
NodeClasses all_classes(const std::shared_ptr<const Topology>& topology, Random& random) {
  NodeClasses classes(topology);
  const bool space = topology->space_dimension() == 3;
  for (Index node = 0; node < topology->node_count(); ++node) {
    if (!topology->used(node)) continue;
    const Vec3 direction(random.uniform(0.1, 1), random.uniform(-1, 1),
                         space ? random.uniform(-1, 1) : 0);
    const std::array<Index, 1> one{node};
    switch (node % 5) {
      case 0:
        classes.set_fixed(one);
        break;
      case 1:
        classes.set_prescribed(one);
        break;
      case 2:
        classes.set_on_curve(node, direction);
        break;
      case 3:
        if (space) classes.set_on_surface(node, direction);
        break;
      default:
        classes.set_free(one);
    }
  }
  return classes;
}

Coordinates random_coordinates(const Topology& topology, Random& random) {
  Coordinates x(topology.space_dimension(), topology.node_count());
  for (double& value : x.values()) value = random.uniform(-2, 2);
  return x;
}

double distance(const Coordinates& a, const Coordinates& b, Index node) {
  return a.dimension() == 2 ? (a.xy(node) - b.xy(node)).norm() : (a.xyz(node) - b.xyz(node)).norm();
}

}  // namespace

TEST_CASE("interior nodes are free and all others fixed until it is said otherwise") {
  for (const auto& topology : {plane(), volume()}) {
    const NodeClasses classes(topology);
    for (Index node = 0; node < topology->node_count(); ++node) {
      const bool inside = topology->used(node) && !topology->on_boundary(node);
      CHECK(classes[node] == (inside ? NodeClass::free : NodeClass::fixed));
      CHECK(classes.unknowns(node) == (inside ? topology->space_dimension() : 0));
    }
  }
}

TEST_CASE("a frame has as many orthonormal directions as its node has unknowns") {
  Random random(3);
  for (const auto& topology : {plane(), volume()}) {
    const NodeClasses classes = all_classes(topology, random);
    std::array<int, 4> met{};
    for (Index node = 0; node < topology->node_count(); ++node) {
      const TangentFrame frame = classes.frame(node);
      const int count = classes.unknowns(node);
      REQUIRE(frame.count() == count);
      ++met[static_cast<std::size_t>(count)];
      for (const Vec3& a : frame) {
        for (const Vec3& b : frame) CHECK(std::abs(a.dot(b) - (&a == &b ? 1 : 0)) < 1e-15);
        if (topology->space_dimension() == 2) CHECK(a.z() == 0);
      }
    }
    CHECK(met[0] > 0);
    CHECK(met[1] > 0);
    CHECK(met[2] > 0);
    CHECK((met[3] > 0) == (topology->space_dimension() == 3));
  }
}

TEST_CASE("directions of a curve and a surface are those given") {
  const auto topology = volume();
  NodeClasses classes(topology);
  classes.set_on_curve(0, {0, -3, 0});
  CHECK(*classes.frame(0).begin() == Vec3(0, -1, 0));
  classes.set_on_surface(1, {1, 2, -2});
  REQUIRE(classes.frame(1).count() == 2);
  for (const Vec3& tangent : classes.frame(1)) CHECK(std::abs(tangent.dot(Vec3(1, 2, -2))) < 1e-15);
  // Held again: nothing of the frame is left.
  classes.set_fixed(std::array<Index, 2>{0, 1});
  CHECK(classes.frame(1).count() == 0);
  CHECK(classes.same_unknowns(NodeClasses(topology)));
}

TEST_CASE("fixed and prescribed nodes make no difference to the unknowns, sliding ones do") {
  const auto topology = volume();
  const NodeClasses plain(topology);
  NodeClasses other(topology);
  other.set_prescribed(std::array<Index, 1>{0});
  CHECK(plain.same_unknowns(other));
  other.set_on_surface(0, {0, 0, 1});
  CHECK_FALSE(plain.same_unknowns(other));
  NodeClasses third(topology);
  third.set_on_surface(0, {0, 1, 1});
  CHECK_FALSE(other.same_unknowns(third));
  CHECK_FALSE(plain.same_unknowns(NodeClasses(volume())));
}

TEST_CASE("what a node cannot be is refused") {
  const auto flat = plane();
  NodeClasses classes(flat);
  const Index beyond = flat->node_count();
  CHECK_THROWS_AS(classes.set_fixed(std::array<Index, 1>{beyond}), UsageError);
  CHECK_THROWS_AS(classes.set_prescribed(std::array<Index, 1>{-1}), UsageError);
  CHECK_THROWS_AS(classes.set_on_curve(beyond, {1, 0, 0}), UsageError);
  CHECK_THROWS_AS(classes.set_on_curve(0, {0, 0, 0}), UsageError);
  CHECK_THROWS_AS(classes.set_on_curve(0, {1, 0, 1}), UsageError);
  CHECK_THROWS_AS(classes.set_on_surface(0, {0, 0, 1}), UsageError);
  MeshData data = square(2, Cells::triangles);
  data.coordinates.push_xy({5, 5});  // no element uses it
  const auto loose = Topology::build(data);
  CHECK_THROWS_AS(NodeClasses(loose).set_free(std::array<Index, 1>{loose->node_count() - 1}),
                  UsageError);
}

TEST_CASE("unknowns move nodes along their frames and nothing else") {
  Random random(7);
  for (const auto& topology : {plane(), volume()}) {
    const auto classes = std::make_shared<const NodeClasses>(all_classes(topology, random));
    const NodeUnknowns nodes(classes, 1);
    const Coordinates x = random_coordinates(*topology, random);
    std::size_t expected = 0;
    for (Index node = 0; node < topology->node_count(); ++node) {
      expected += static_cast<std::size_t>(classes->unknowns(node));
    }
    REQUIRE(nodes.unknowns() == expected);
    std::vector<double> direction(expected), before(expected), after(expected);
    for (double& d : direction) d = random.uniform(-1, 1);
    constexpr double step = 0.25;
    Coordinates y = x;
    const double longest = nodes.advance(direction, step, y);
    nodes.values(x, before);
    nodes.values(y, after);
    for (std::size_t i = 0; i < expected; ++i) {
      CHECK(after[i] - before[i] == doctest::Approx(step * direction[i]).epsilon(1e-12));
    }
    double largest = 0;
    for (std::size_t i = 0, next = 0; i < nodes.nodes().size(); ++i) {
      const Index node = nodes.nodes()[i];
      CHECK(nodes.first(i) == next);
      CHECK(nodes.count(i) == static_cast<std::size_t>(classes->unknowns(node)));
      double squares = 0;
      for (std::size_t k = 0; k < nodes.count(i); ++k) {
        squares += direction[next + k] * direction[next + k];
      }
      // Orthonormal directions: a node moves as far as its unknowns do.
      CHECK(distance(x, y, node) == doctest::Approx(step * std::sqrt(squares)).epsilon(1e-12));
      largest = std::max(largest, distance(x, y, node));
      next += nodes.count(i);
    }
    CHECK(longest == doctest::Approx(largest));
    for (Index node = 0; node < topology->node_count(); ++node) {
      if (classes->unknowns(node) == 0) CHECK(distance(x, y, node) == 0);
    }
    // Velocities are the derivative of advance(); those of other nodes stay.
    Coordinates rates = x;
    nodes.velocities(x, direction, rates);
    for (Index node = 0; node < topology->node_count(); ++node) {
      Coordinates expected_rate = x;
      if (classes->unknowns(node) == 0) {
        CHECK(distance(rates, x, node) == 0);
        continue;
      }
      for (int c = 0; c < x.dimension(); ++c) {
        const std::size_t place = static_cast<std::size_t>(node * x.dimension() + c);
        expected_rate.values()[place] = (y.values()[place] - x.values()[place]) / step;
      }
      CHECK(distance(rates, expected_rate, node) < 1e-13);
    }
  }
}

TEST_CASE("every unknown of a node compares with the mean length of the node's edges") {
  Random random(9);
  for (const auto& topology : {plane(), volume()}) {
    const auto classes = std::make_shared<const NodeClasses>(all_classes(topology, random));
    const NodeUnknowns nodes(classes, 1);
    const Coordinates x = random_coordinates(*topology, random);
    std::vector<double> lengths(nodes.unknowns());
    nodes.lengths(x, lengths);
    for (std::size_t i = 0; i < nodes.nodes().size(); ++i) {
      const Index node = nodes.nodes()[i];
      double sum = 0;
      for (const Index k : topology->neighbours(node)) {
        double squares = 0;
        for (int c = 0; c < x.dimension(); ++c) {
          const double d = x.values()[static_cast<std::size_t>(k * x.dimension() + c)] -
                           x.values()[static_cast<std::size_t>(node * x.dimension() + c)];
          squares += d * d;
        }
        sum += std::sqrt(squares);
      }
      const double mean = sum / static_cast<double>(topology->neighbours(node).size());
      for (std::size_t k = 0; k < nodes.count(i); ++k) {
        CHECK(lengths[nodes.first(i) + k] == doctest::Approx(mean));
      }
      CHECK(nodes.mean_edge(x, node) == doctest::Approx(mean));
    }
  }
}

namespace winslow::test {

namespace {

std::shared_ptr<const RigidImage> shift(double by) {
  RigidImage image;
  image.offset = Vec3(by, 0, 0);
  return std::make_shared<const RigidImage>(image);
}

/// All nodes on the x axis.
class Axis final : public SlidingGeometry {
 public:
  Foot foot(Index, const Vec3& point) const override {
    Foot foot;
    foot.point = Vec3(point.x(), 0, 0);
    foot.frame.add(Vec3::UnitX());
    return foot;
  }
};

}  // namespace

TEST_CASE("periodic pairs are found from either side, and end for both nodes at once") {
  TiedNodes tied;
  tied.add(NodeImage{7, 2, shift(1)});
  tied.add(NodeImage{5, 3, shift(1)});
  CHECK(tied.partner(7) == 2);
  CHECK(tied.partner(2) == 7);
  CHECK_FALSE(tied.partner(4));
  CHECK(tied.has_image(2));
  CHECK_FALSE(tied.has_image(7));
  REQUIRE(tied.images().size() == 2);
  CHECK(tied.images().front().image == 5);
  CHECK_THROWS_AS(tied.add(NodeImage{2, 9, shift(1)}), UsageError);
  CHECK_THROWS_AS(tied.add(NodeImage{9, 5, shift(1)}), UsageError);
  CHECK(tied.separate(7) == 2);
  CHECK_FALSE(tied.partner(2));
  CHECK_FALSE(tied.separate(7));
  CHECK(tied.separate(3) == 5);
  CHECK(tied == TiedNodes());
}

TEST_CASE("ties are equal if the images go to the same places") {
  TiedNodes a, b, c;
  a.add(NodeImage{7, 2, shift(1)});
  b.add(NodeImage{7, 2, shift(1)});
  c.add(NodeImage{7, 2, shift(2)});
  CHECK(a == b);
  CHECK(!(a == c));
}

TEST_CASE("a node slides on a line of its own, or on geometry, until it is taken out") {
  SlidingNodes sliding;
  TangentFrame line;
  line.add(Vec3::UnitY());
  sliding.set(1, line);
  REQUIRE(sliding.frame(1));
  CHECK(sliding.frame(1)->count() == 1);
  CHECK(sliding.geometry(1) == nullptr);
  CHECK(sliding.frame(2) == nullptr);
  const auto axis = std::make_shared<const Axis>();
  Coordinates x(3, 4);
  x.set_xyz(2, Vec3(5, 0, 0));
  const std::vector<Index> nodes{2, 3};
  const auto frames = sliding.set(nodes, axis, x);
  REQUIRE(frames.size() == 2);
  CHECK(frames[0][0] == Vec3::UnitX());
  CHECK(sliding.geometry(2) == axis.get());
  const SlidingNodes before = sliding;
  CHECK(before.same_ways(sliding));
  sliding.erase(2);
  CHECK(sliding.geometry(2) == nullptr);
  CHECK(sliding.frame(2) == nullptr);
  CHECK(sliding.geometry(3) == axis.get());
  CHECK_FALSE(before.same_ways(sliding));
}

}  // namespace winslow::test
