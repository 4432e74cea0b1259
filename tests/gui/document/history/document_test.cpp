#include "gui/document/history/document.h"

#include <doctest/doctest.h>

#include <filesystem>

namespace winslow::gui::test {

TEST_CASE("revisions that were saved or only shown need no saving") {
  SavedFile saved("mesh.su2");
  CHECK_FALSE(saved.lacks(0));  // as it was opened
  CHECK(saved.lacks(1));
  saved.mark_shown_only(1);
  CHECK_FALSE(saved.lacks(1));
  CHECK(saved.lacks(2));
  saved.mark_saved("other.su2", 2);
  CHECK(saved.path() == "other.su2");
  CHECK_FALSE(saved.lacks(2));
  CHECK_FALSE(saved.lacks(1));
  CHECK(saved.lacks(0));  // the mesh as opened is not what is in the file
}

TEST_CASE("only files that were written may be replaced without asking") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  SavedFile saved(folder / "mesh.su2");
  CHECK_FALSE(saved.wrote(folder / "mesh.su2"));
  saved.set_path(folder / "elsewhere.su2");
  CHECK_FALSE(saved.wrote(folder / "elsewhere.su2"));
  saved.mark_saved(folder / "mesh.su2", 1);
  CHECK(saved.wrote(folder / "mesh.su2"));
  CHECK(saved.wrote(folder / "." / "mesh.su2"));  // the same, said otherwise
  CHECK_FALSE(saved.wrote(folder / "elsewhere.su2"));
}

TEST_CASE("a file that is one mesh has no zones") {
  const SourceFile source{"mesh.su2", {}, nullptr, {}};
  CHECK(source.zones().empty());
  CHECK(source.zone() == 0);
  CHECK(source.zone_text().empty());
  CHECK(zone_file(source, SavedFile("other.su2")) == "mesh.su2");
}

}  // namespace winslow::gui::test
