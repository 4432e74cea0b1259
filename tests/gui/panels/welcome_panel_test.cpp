#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

#include "gui/demos/demo.h"
#include "gui/files/assets.h"
#include "gui/panels/dialogs.h"
#include "gui/shell/headless/headless_studio.h"
#include "gui/support/rig.h"
#include "support/paths.h"

namespace winslow::gui::test {

namespace fs = std::filesystem;

TEST_CASE("the cards of the welcome page open the bundled meshes") {
  for (const BundledMesh& mesh : bundled_meshes()) {
    Rig rig(1400, 900);
    INFO("mesh ", mesh.id);
    CHECK(fs::is_regular_file(bundled_path(assets_folder(), mesh.file)));
    rig.click("welcome/" + mesh.id);
    REQUIRE(rig.wait([&] { return rig.session().document() != nullptr; }));
    CHECK(rig.document().name() == mesh.file);
    CHECK_FALSE(rig.visible("welcome/open"));
  }
}

TEST_CASE("pictures of the bundled meshes come after the first frames and not before") {
  Rig rig(1400, 860);
  CHECK(rig.bench->regions().welcome().thumbnails().find("quads") == nullptr);
  const Image before = rig.bench->pictures().picture();
  const auto drawn = [&] {
    for (const BundledMesh& mesh : bundled_meshes())
      if (!rig.bench->regions().welcome().thumbnails().find(mesh.id)) return false;
    return true;
  };
  REQUIRE(rig.wait(drawn));
  rig.frames();
  const Image after = rig.bench->pictures().picture();
  for (const BundledMesh& mesh : bundled_meshes()) {
    const auto card = *rig.bench->widgets().find("welcome/" + mesh.id);
    const ScreenVector size = card.max - card.min;
    int changed = 0;
    for (int k = 1; k < 60; ++k) {
      const auto x = static_cast<int>(card.min.x() + size.x() * k / 60);
      const auto y = static_cast<int>(card.min.y() + 0.4 * size.y());
      changed += before.pixel(x, y)[0] != after.pixel(x, y)[0];
    }
    CHECK(changed > 20);
  }
}

TEST_CASE("the welcome page lists recent files and can be shown over a mesh") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::ShowWelcome{});
  rig.frames();
  REQUIRE(rig.visible("welcome/back"));
  rig.click("welcome/back");
  CHECK_FALSE(rig.visible("welcome/open"));
  rig.bench->apply(action::CloseMesh{});
  rig.frames();
  REQUIRE(rig.visible("welcome/recent/mesh.su2"));
  rig.click("welcome/recent/mesh.su2");
  REQUIRE(rig.settle());
  CHECK(rig.document().name() == "mesh.su2");
}

TEST_CASE("meshes and demos of the welcome page are all on screen at 1100 by 720") {
  Rig rig;
  for (int k = 0; k < 6; ++k) rig.open(ring_mesh(), "mesh" + std::to_string(k) + ".su2");
  CHECK(rig.visible("tab/quality"));
  rig.bench->apply(action::CloseMesh{});
  rig.frames();
  CHECK_FALSE(rig.visible("tab/quality"));
  std::vector<std::string> wanted;
  for (const BundledMesh& mesh : bundled_meshes()) wanted.push_back(mesh.id);
  for (const Demo& demo : demos()) wanted.push_back("demo/" + demo.id);
  for (int k = 0; k < 6; ++k) wanted.push_back("recent/mesh" + std::to_string(k) + ".su2");
  const Area& page = rig.bench->layout().viewport;
  std::vector<WidgetMap::Rect> seen;
  for (const std::string& id : wanted) {
    INFO(id);
    const auto rect = rig.bench->widgets().find("welcome/" + id);
    REQUIRE(rect.has_value());
    CHECK(rect->min.x() >= page.x);
    CHECK(rect->min.y() >= page.y);
    CHECK(rect->max.x() <= page.x + page.width);
    CHECK(rect->max.y() <= page.y + page.height);
    for (const WidgetMap::Rect& other : seen) CHECK(apart(*rect, other));
    seen.push_back(*rect);
  }
}

TEST_CASE("the welcome page stands in the middle of a large window") {
  Rig rig(2560, 1440);
  const auto first = rig.bench->widgets().find("welcome/" + bundled_meshes().front().id);
  const auto last = rig.bench->widgets().find("welcome/" + bundled_meshes().back().id);
  REQUIRE(first.has_value());
  REQUIRE(last.has_value());
  CHECK(first->min.x() + last->max.x() == doctest::Approx(2560).epsilon(0.005));
  CHECK(rig.bench->widgets().find("welcome/open")->min.y() > 200);
}

TEST_CASE("a script's wait waits for the pictures on the cards, over a mesh as well") {
  HeadlessStudio studio(1100, 720);
  const auto pictured = [&] {
    return std::ranges::all_of(bundled_meshes(), [&](const BundledMesh& mesh) {
      return studio.bench().regions().welcome().thumbnails().find(mesh.id) != nullptr;
    });
  };
  const TemporaryFolder folder;
  studio.open(write(folder, ring_mesh(), "mesh.su2"));
  studio.bench().apply(action::ShowWelcome{});
  studio.frames();
  CHECK_FALSE(pictured());
  studio.settle();
  CHECK(pictured());
}

TEST_CASE("a demo starts with one click on the welcome page") {
  Rig rig(1400, 900);
  rig.frames();
  rig.click("welcome/demo/E");
  REQUIRE(rig.wait([&] { return rig.bench->demo().ready(rig.session()); }));
  CHECK(rig.bench->demo().demo()->id == "E");
  REQUIRE(rig.settle());
}

TEST_CASE("About names versions and graphics, and copies them") {
  Rig rig;
  rig.bench->apply(action::ShowAbout{});
  rig.frames(3);
  for (const char* part : {"winslow", "OpenGL", "Renderer", "Dear ImGui", "GLFW", "Eigen"})
    CHECK(rig.visible(std::string("about/") + part));
  rig.click("about/copy");
  const std::string copied = ImGui::GetClipboardText();
  CHECK(copied.find(std::string("Dear ImGui: ") + ImGui::GetVersion()) != std::string::npos);
  for (const auto& fact : AboutPanel::facts()) {
    INFO(fact.first);
    CHECK_FALSE(fact.second.empty());
    CHECK(copied.find(fact.second) != std::string::npos);
  }
  rig.key(keys::escape);
  CHECK_FALSE(rig.visible("about/copy"));
}

TEST_CASE("assets are found beside an installed program, else in the source tree") {
  TemporaryFolder folder;
  fs::create_directories(folder / "share" / "winslow");
  CHECK(assets_folder(folder / "bin" / "winslow") == fs::path(winslow::test::assets()));
  std::ofstream(folder / "share" / "winslow" / "naca0012.su2") << "\n";
  CHECK(assets_folder(folder / "bin" / "winslow") == folder / "share" / "winslow");
}

}  // namespace winslow::gui::test
