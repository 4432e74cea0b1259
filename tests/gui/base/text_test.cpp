#include <doctest/doctest.h>

#include "gui/base/text.h"

namespace winslow::gui::test {

TEST_CASE("numbers are written as people read them") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(1234567) == "1,234,567");
  CHECK(grouped(-1000) == "-1,000");
  CHECK(counted(1, "node") == "1 node");
  CHECK(counted(4774, "node") == "4,774 nodes");
  CHECK(table_number(0.8661) == "0.866");
  CHECK(table_number(12345.6) == "1.23e+04");
  CHECK(table_number(1.0 / 0.0) == "-");
}

}  // namespace winslow::gui::test
