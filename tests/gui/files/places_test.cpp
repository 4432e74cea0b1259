#include "gui/files/places.h"

#include <doctest/doctest.h>

namespace winslow::gui::test {

namespace {

std::vector<std::string> recent_names(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> names;
  for (const Place& place : places(folders))
    if (place.group == "Recent folders") names.push_back(place.label);
  return names;
}

}  // namespace

TEST_CASE("recent folders of one name are told apart by what is above them") {
  CHECK(recent_names({"/a/wing/mesh", "/b/tail/mesh", "/b/cases"}) ==
        std::vector<std::string>{"wing/mesh", "tail/mesh", "cases"});
  CHECK(recent_names({"/x/run/1/mesh", "/y/run/1/mesh"}) ==
        std::vector<std::string>{"x/run/1/mesh", "y/run/1/mesh"});
  CHECK(recent_names({"/"}) == std::vector<std::string>{"/"});
}

}  // namespace winslow::gui::test
