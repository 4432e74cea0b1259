#include <doctest/doctest.h>

#include "core/error.h"
#include "gui/settings/picture_spec.h"

namespace winslow::gui::test {

TEST_CASE("the size of a picture is that of the window times a scale, or as typed") {
  CHECK(picture_size({}, 640, 480) == std::array{640, 480});
  CHECK(picture_size({.scale = 3, .size = {}}, 640, 480) == std::array{1920, 1440});
  CHECK(picture_size({.size = std::array{1000, 100}}, 640, 480) == std::array{1000, 100});
}

TEST_CASE("a picture too small or too large to draw is refused") {
  CHECK_THROWS_AS(picture_size({.size = std::array{8, 100}}, 640, 480), UsageError);
  CHECK_THROWS_AS(picture_size({.size = std::array{40000, 100}}, 640, 480), UsageError);
  CHECK_THROWS_AS(picture_size({.size = std::array{30000, 30000}}, 640, 480), UsageError);
  CHECK_THROWS_AS(picture_size({.scale = 1e12, .size = {}}, 640, 480), UsageError);
  CHECK_THROWS_AS(picture_size({.size = std::array{-5, 100}}, 640, 480), UsageError);
}

}  // namespace winslow::gui::test
