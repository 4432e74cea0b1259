#include "gui/document/selection/shape_edit.h"

#include <doctest/doctest.h>

namespace winslow::gui {

TEST_CASE("an arc grows the shorter way round, over the end of the list too") {
  const BoundaryArc one{0, 2, 2};
  CHECK(extended(one, 5, 20) == BoundaryArc{0, 2, 5});
  CHECK(extended(one, 18, 20) == BoundaryArc{0, 18, 2});
  const BoundaryArc over = extended(one, 18, 20);
  for (const std::size_t inside : {18u, 19u, 0u, 1u, 2u}) CHECK(over.contains(inside));
  for (const std::size_t outside : {3u, 10u, 17u}) CHECK_FALSE(over.contains(outside));
  CHECK(extended(over, 19, 20) == over);
  CHECK(extended(over, 16, 20) == BoundaryArc{0, 16, 2});
  CHECK(extended(over, 4, 20) == BoundaryArc{0, 18, 4});
}

}  // namespace winslow::gui
