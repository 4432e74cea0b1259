#include "core/problem/tied_nodes.h"

#include <doctest/doctest.h>

#include <memory>

#include "core/error.h"
#include "core/problem/sliding_nodes.h"

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
