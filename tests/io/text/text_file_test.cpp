#include "io/text/text_file.h"

#include "io/support/files.h"

namespace winslow::test {

TEST_CASE("a text file is read whole; folders, devices and files without end are refused") {
  const TemporaryFolder folder;
  const std::string text("line\n\0 and more", 15);
  write_text(folder / "a", text);
  CHECK(io::read_text_file(folder / "a") == text);
  CHECK_THROWS_WITH_AS(io::read_text_file(folder.path()),
                       doctest::Contains("found a folder, expected a file"), InputError);
  CHECK_THROWS_WITH_AS(io::read_text_file("/dev/zero"),
                       doctest::Contains("/dev/zero: cannot be read: it is neither a file nor"),
                       InputError);
  CHECK_THROWS_WITH_AS(io::read_text_file(folder / "none"),
                       doctest::Contains("No such file or directory"), InputError);
  CHECK_THROWS_WITH_AS(io::read_text_file(folder / "a", 3),
                       doctest::Contains("it has more than 3 bytes"), InputError);
}

TEST_CASE("the depth of JSON counts brackets outside of texts") {
  CHECK_FALSE(io::nested_deeper("[[{}]]", 3));
  CHECK(io::nested_deeper("[[{}]]", 2));
  CHECK_FALSE(io::nested_deeper("[\"[[[[\\\"[[[\", [], [], []]", 2));
  CHECK(io::nested_deeper(std::string(1000000, '['), 100));
}

}  // namespace winslow::test
