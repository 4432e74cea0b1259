#include "gui/files/browsed_folder.h"

#include <doctest/doctest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "gui/support/meshes.h"

namespace winslow::gui::test {

namespace {

/// A folder with two meshes, a text, a hidden mesh and a folder, as read.
struct Browsed {
  Browsed() {
    for (const char* name : {"alpha.su2", "alpine.su2", "notes.txt", ".hidden.su2"})
      std::ofstream(folder / name) << name;
    std::filesystem::create_directory(folder / "Meshes");
    browsed.set_filter({"SU2", {".su2"}});
    go(folder.path());
  }
  std::string go(const std::filesystem::path& to) {
    browsed.go(to);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    std::string problem;
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (std::string now = browsed.poll(); !now.empty()) problem = now;
      REQUIRE(std::chrono::steady_clock::now() < end);
    } while (browsed.listing().busy());
    return problem;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const FolderEntry* entry : browsed.shown()) all.push_back(entry->name);
    return all;
  }

  TemporaryFolder folder;
  BrowsedFolder browsed;
};

}  // namespace

TEST_CASE("Folders and files of one kind are listed, hidden ones if asked for") {
  Browsed b;
  CHECK(b.names() == std::vector<std::string>{"Meshes", "alpha.su2", "alpine.su2"});
  b.browsed.show_hidden(true);
  CHECK(b.names().size() == 4);
}

TEST_CASE("A row is found by the letters that it begins with, and stepped from") {
  Browsed b;
  b.browsed.find("ALPI");
  CHECK(b.browsed.chosen() == "alpine.su2");
  CHECK(b.browsed.take_reveal());
  CHECK_FALSE(b.browsed.take_reveal());
  b.browsed.step(1);  // the last row
  CHECK(b.browsed.chosen() == "alpine.su2");
  b.browsed.step(-1);
  CHECK(b.browsed.chosen() == "alpha.su2");
  b.browsed.find("");
  CHECK_FALSE(b.browsed.chosen());
  b.browsed.step(-1);
  CHECK(b.browsed.chosen() == "alpine.su2");
}

TEST_CASE("A text is completed as far as all names go on alike") {
  Browsed b;
  REQUIRE(b.browsed.complete("a"));
  CHECK(b.browsed.complete("a")->text == "alp");
  CHECK_FALSE(b.browsed.complete("a")->single);
  CHECK(b.browsed.complete("mes")->text == "Meshes");
  CHECK(b.browsed.complete("mes")->single);
  CHECK_FALSE(b.browsed.complete("b"));
}

TEST_CASE("A typed text that ends in a slash names a folder; one that cannot be read says why") {
  Browsed b;
  CHECK(b.browsed.typed_folder("Meshes/") == b.folder / "Meshes/");
  CHECK_FALSE(b.browsed.typed_folder("Meshes"));
  CHECK_FALSE(b.browsed.typed_folder("none/"));
  CHECK_FALSE(b.go(b.folder / "none").empty());
  CHECK(b.browsed.wanted() == b.folder.path());  // where it was
}

}  // namespace winslow::gui::test
