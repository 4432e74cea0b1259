#include <doctest/doctest.h>

#include <fstream>

#include "gui/files/browsed_folder.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"
#include "io/format/mesh_file.h"

namespace winslow::gui::test {

namespace fs = std::filesystem;

namespace {

/// A studio whose dialog is open on a folder with meshes in it, worked by keys alone.
struct Dialog : Rig {
  Dialog() {
    write(folder, ring_mesh(), "alpha.su2");
    write(folder, two_body_mesh(), "beta.vtk");
    write(folder, two_body_mesh(), ".hidden.su2");
    std::ofstream(folder / "notes.txt") << "not a mesh\n";
    fs::create_directory(folder / "inner");
    write_inner();
  }
  void write_inner() const {
    io::write_mesh(folder / "inner" / "deep.su2", ring_mesh(12, 3), nullptr);
  }
  void show_open() {
    key(keys::o, {keys::control});
    REQUIRE(bench->dialogs().file_dialog().is_open());
    type(folder.path().string() + "/");
    REQUIRE(arrive(folder.path()));
  }
  bool arrive(const fs::path& at) {
    return wait(
        [&] {
          return !bench->dialogs().file_dialog().busy() &&
                 bench->dialogs().file_dialog().folder() == at;
        },
        20);
  }
  bool listed(const std::string& name) const { return visible("dialog/entry/" + name); }
};

}  // namespace

TEST_CASE("a mesh is opened by keys alone: a path, a folder, the first letters of a name") {
  Dialog rig;
  rig.show_open();
  rig.type("in");
  rig.key(keys::tab);  // the only name that begins so is a folder: into it
  REQUIRE(rig.arrive(rig.folder / "inner"));
  rig.frames();
  CHECK(rig.listed("deep.su2"));
  rig.key(GLFW_KEY_BACKSPACE);  // nothing is typed: up
  REQUIRE(rig.arrive(rig.folder.path()));
  rig.type("be");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  REQUIRE(rig.session().document() != nullptr);
  CHECK(rig.document().name() == "beta.vtk");
  CHECK_FALSE(rig.bench->dialogs().file_dialog().is_open());
}

TEST_CASE("arrow keys go through the list, Enter opens a folder or a file, Esc leaves") {
  Dialog rig;
  rig.show_open();
  rig.key(GLFW_KEY_DOWN);  // folders come first
  rig.key(keys::enter);
  REQUIRE(rig.arrive(rig.folder / "inner"));
  rig.frames();
  rig.key(GLFW_KEY_DOWN);
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  REQUIRE(rig.session().document() != nullptr);
  CHECK(rig.document().name() == "deep.su2");
  rig.key(keys::o, {keys::control});
  REQUIRE(rig.bench->dialogs().file_dialog().is_open());
  rig.key(keys::escape);
  CHECK_FALSE(rig.bench->dialogs().file_dialog().is_open());
  CHECK(rig.document().name() == "deep.su2");
}

TEST_CASE("the filter and the hidden files decide what is listed") {
  Dialog rig;
  rig.show_open();
  rig.frames();
  CHECK(rig.listed("alpha.su2"));
  CHECK(rig.listed("beta.vtk"));
  CHECK_FALSE(rig.listed("notes.txt"));
  CHECK_FALSE(rig.listed(".hidden.su2"));
  rig.click("dialog/filter");
  rig.click("dialog/filter/SU2 (.su2)");
  CHECK(rig.listed("alpha.su2"));
  CHECK(rig.listed("inner"));
  CHECK_FALSE(rig.listed("beta.vtk"));
  rig.click("dialog/filter");
  rig.click("dialog/filter/All files");
  CHECK(rig.listed("notes.txt"));
  rig.click("dialog/hidden");
  CHECK(rig.listed(".hidden.su2"));
}

TEST_CASE("the list is sorted by name, date or size, either way") {
  TemporaryFolder folder;
  const auto make = [&](const char* name, std::size_t size, int age) {
    std::ofstream(folder / name) << std::string(size, 'x');
    fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::hours(age));
  };
  make("b", 10, 1);
  make("A", 3000, 3);
  make("c", 2000, 2);
  fs::create_directory(folder / "z");
  FolderListing listing;
  listing.go(folder.path());
  while (listing.busy()) listing.poll();
  const auto order = [&] {
    std::string names;
    for (const FolderEntry& entry : listing.entries()) names += entry.name;
    return names;
  };
  CHECK(order() == "zAbc");
  listing.sort(SortBy::size, false);
  CHECK(order() == "zAcb");
  listing.sort(SortBy::date, false);
  CHECK(order() == "zbcA");
  listing.sort(SortBy::date, true);
  CHECK(order() == "zAcb");
  CHECK(size_text(listing.entries()[1].size) == "3 kB");
  CHECK(date_text(listing.entries()[1].changed).size() == 16);
}

TEST_CASE("a folder that cannot be read is said, and the one before stays") {
  Dialog rig;
  rig.show_open();
  rig.fill("dialog/folder", (rig.folder / "none").string());
  rig.click("dialog/folder");
  rig.key(keys::enter);
  rig.frames();
  CHECK(rig.visible("dialog/error"));
  CHECK(rig.bench->dialogs().file_dialog().folder() == rig.folder.path());
  CHECK(rig.listed("alpha.su2"));
}

TEST_CASE("a mesh is saved by keys alone, in a new folder, in the format of the filter") {
  Dialog rig;
  rig.open(ring_mesh());
  rig.key(keys::s, {keys::control, keys::shift});
  REQUIRE(rig.arrive(rig.folder.path()));
  rig.click("dialog/new_folder");
  rig.frames();
  rig.type("made");
  rig.key(keys::enter);
  REQUIRE(rig.arrive(rig.folder / "made"));
  rig.click("dialog/filter");
  rig.click("dialog/filter/VTK XML (.vtu)");
  rig.frames();
  rig.key(keys::a, {keys::control});
  rig.type("result");  // the filter says the rest
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  CHECK(io::read_mesh(rig.folder / "made" / "result.vtu").mesh.coordinates ==
        rig.mesh().coordinates);
  CHECK(rig.document().name() == "result.vtu");
}

TEST_CASE("the places lead to the home folder and to the bundled meshes") {
  Dialog rig;
  rig.show_open();
  rig.click("dialog/place/Bundled meshes");
  REQUIRE(rig.wait([&] { return rig.listed("naca0012.su2"); }));
  rig.click("dialog/place/System");
  CHECK(rig.arrive("/"));
  rig.click("dialog/cancel");
  CHECK_FALSE(rig.bench->dialogs().file_dialog().is_open());
}

TEST_CASE("names keep their room: dates are cut for them, then sizes") {
  Dialog rig;
  rig.show_open();
  rig.frames();
  CHECK(rig.visible("dialog/date/alpha.su2"));
  CHECK(rig.visible("dialog/sort/date"));
  const std::string longer = "a_wing_with_flap_deployed_at_forty_degrees_and_layers_12.su2";
  write(rig.folder, ring_mesh(), longer);
  rig.resize(760, 480);
  rig.key(keys::escape);
  rig.show_open();
  rig.frames(4);
  REQUIRE(rig.listed(longer));
  CHECK_FALSE(rig.visible("dialog/cut/" + longer));
  CHECK_FALSE(rig.visible("dialog/date/" + longer));
}

TEST_CASE("an arrow says by what the list is sorted, and which way") {
  Dialog rig;
  rig.show_open();
  rig.frames();
  const auto over = [&](const char* arrow, const char* header) {
    const auto a = rig.bench->widgets().find(arrow);
    const auto h = rig.bench->widgets().find(header);
    return a && h && a->centre().x() > h->min.x() && a->centre().x() < h->max.x();
  };
  CHECK(over("dialog/sorted/up", "dialog/sort/name"));
  rig.click("dialog/sort/name");
  rig.frames();
  CHECK(over("dialog/sorted/down", "dialog/sort/name"));
  rig.click("dialog/sort/size");
  rig.frames();
  CHECK(over("dialog/sorted/down", "dialog/sort/size"));
}

}  // namespace winslow::gui::test
