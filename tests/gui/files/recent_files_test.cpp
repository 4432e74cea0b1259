#include "gui/files/recent_files.h"

#include <doctest/doctest.h>

#include <thread>

#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// Looks until the threads have done so.
void look(RecentFiles& recent) {
  for (int k = 0; k < 200; ++k) {
    recent.update(4);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

TEST_CASE("recent files: the last one first, none twice, not too many, missing ones known") {
  TemporaryFolder folder;
  RecentFiles recent;
  const auto there = write(folder, ring_mesh(12, 3), "there.su2");
  for (int k = 0; k < 20; ++k) recent.add(folder / ("gone" + std::to_string(k) + ".su2"));
  recent.add(there);
  recent.add(folder / "gone19.su2");
  recent.add(there);
  REQUIRE(recent.files().size() == RecentFiles::largest);
  CHECK(recent.files()[0].path == there);
  CHECK(recent.files()[1].path == folder / "gone19.su2");
  CHECK(recent.files()[2].path == folder / "gone18.su2");
  look(recent);
  CHECK_FALSE(recent.files()[0].missing);
  CHECK(recent.files()[1].missing);
  CHECK(recent.folders() == std::vector{folder.path()});
}

TEST_CASE("recent files outlive the studio and open from the menu and the palette") {
  Rig rig;
  const auto first = write(rig.folder, ring_mesh(), "first.su2");
  const auto second = write(rig.folder, two_body_mesh(), "second.su2");
  const WorkbenchOptions options{1, rig.folder / "profile"};
  for (const auto& path : {first, second}) {
    rig.bench = std::make_unique<Workbench>(options);
    rig.bench->apply(action::OpenMesh{path});
    REQUIRE(rig.settle());
    rig.bench->apply(action::Quit{});
    rig.bench.reset();  // writes the settings
  }
  rig.bench = std::make_unique<Workbench>(options);
  rig.frames();
  REQUIRE(rig.bench->recent().files().size() == 2);
  CHECK(rig.bench->recent().files()[0].path == second);
  rig.click("menu/File");
  rig.click("menu/open_recent");
  rig.frames();
  rig.click("menu/recent/" + first.string());
  REQUIRE(rig.settle());
  CHECK(rig.document().name() == "first.su2");
  rig.key(keys::p, {keys::control});
  rig.type("second");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  CHECK(rig.document().name() == "second.su2");
}

TEST_CASE("of several files dropped the first is opened, and the others are mentioned") {
  Rig rig;
  const auto first = write(rig.folder, ring_mesh(), "first.su2");
  const auto second = write(rig.folder, two_body_mesh(), "second.su2");
  rig.input.drop({first, second});
  rig.frames();
  REQUIRE(rig.settle());
  CHECK(rig.document().name() == "first.su2");
  REQUIRE(rig.session().messages().notice().has_value());
  CHECK(rig.session().messages().notice()->text.find("2 files") != std::string::npos);
}

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
