#include "io/file/scratch_file.h"

#include "io/support/files.h"

namespace winslow::test {

TEST_CASE("a scratch file can be opened by its name, and is gone with its object") {
  std::filesystem::path path;
  {
    const std::string bytes(100000, 'x');
    const io::ScratchFile file(bytes);
    path = file.path();
    CHECK(read_text(path) == bytes);
    CHECK(read_text(path) == bytes);  // each opening begins at the start
  }
  CHECK_FALSE(std::filesystem::exists(path));
}

}  // namespace winslow::test
