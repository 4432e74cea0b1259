#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

namespace fs = std::filesystem;

/// Mean colour of a block of pixels.
std::array<double, 3> mean(const Image& image, int x, int y, int side) {
  std::array<double, 3> sum{};
  for (int dy = 0; dy < side; ++dy)
    for (int dx = 0; dx < side; ++dx)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += image.pixel(x + dx, y + dy)[c];
  for (double& s : sum) s /= side * side;
  return sum;
}

/// Largest difference between blocks of two pictures of the same, one `ratio` times as large.
double difference(const Image& small, const Image& large, int ratio, int block) {
  double largest = 0;
  for (int y = 0; y + block <= small.height; y += block)
    for (int x = 0; x + block <= small.width; x += block) {
      const auto a = mean(small, x, y, block);
      const auto b = mean(large, ratio * x, ratio * y, ratio * block);
      for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
    }
  return largest;
}

}  // namespace

TEST_CASE("a picture at three times the size shows the same") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  const Image window = rig.bench->pictures().picture();
  const Image large = rig.bench->pictures().picture({.scale = 3, .size = {}});
  REQUIRE(large.width == 2700);
  REQUIRE(large.height == 1800);
  CHECK(difference(window, large, 3, 60) < 12);
  // Were it another part of the mesh, or the lines three times as thin, this would not hold.
  const Image alone = rig.bench->pictures().picture({.size = {}, .panels = false});
  const Image alone3 = rig.bench->pictures().picture({.scale = 3, .size = {}, .panels = false});
  REQUIRE(alone3.width == 3 * alone.width);
  CHECK(difference(alone, alone3, 3, 30) < 20);
}

TEST_CASE("a picture leaves the window as it was") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  rig.click("section/solver");
  rig.move({1, 1});
  rig.frames(3);
  const Image before = rig.bench->pictures().picture();
  const ScreenPoint centre = rig.pixel({0.5, 0.5});
  rig.bench->pictures().picture({.scale = 2, .size = {}, .panels = false});
  CHECK(rig.pixel({0.5, 0.5}) == centre);
  rig.frames(3);
  CHECK(rig.bench->pictures().picture().rgba == before.rgba);
}

TEST_CASE("without panels a picture shows the mesh alone") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  const Layout& layout = rig.bench->layout();
  const Image alone = rig.bench->pictures().picture({.size = {}, .panels = false, .legend = false});
  CHECK(alone.width == static_cast<int>(std::lround(layout.viewport.width)));
  CHECK(alone.height == static_cast<int>(std::lround(layout.viewport.height)));
  const Image window = rig.bench->pictures().picture();
  // The middle of the viewport is the same in both; the corner is paper, without a toolbar.
  const auto x = static_cast<int>(layout.viewport.x + 0.3f * layout.viewport.width);
  const auto y = static_cast<int>(layout.viewport.y + 0.5f * layout.viewport.height);
  const auto there = mean(window, x, y, 20);
  const auto here = mean(alone, x - static_cast<int>(layout.viewport.x),
                         y - static_cast<int>(layout.viewport.y), 20);
  for (std::size_t c = 0; c < 3; ++c) CHECK(here[c] == doctest::Approx(there[c]).epsilon(0.02));
  CHECK(mean(alone, 0, 0, 4) == std::array<double, 3>{255, 255, 255});
}

TEST_CASE("a transparent picture has no paper, and undivided colours") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  const Image image = rig.bench->pictures().picture(
      {.size = {}, .panels = false, .transparent = true, .legend = false});
  CHECK(image.pixel(0, 0)[3] == 0);
  CHECK(image.pixel(image.width / 2, image.height / 2)[3] == 0);  // inside the body
  const auto opaque = [&](int x) { return image.pixel(x, image.height / 2)[3] == 255; };
  int count = 0;
  for (int x = 0; x < image.width; ++x) count += opaque(x);
  CHECK(count > image.width / 3);
  const Image paper = rig.bench->pictures().picture({.size = {}, .panels = false, .legend = false});
  for (int x = 0; x < image.width; ++x)
    if (opaque(x))
      CHECK(image.pixel(x, image.height / 2)[1] == paper.pixel(x, image.height / 2)[1]);
}

TEST_CASE("a picture larger than a tile has no seams") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  // 2048 pixels are drawn at once: the same picture, in one piece and in several.
  const Image whole = rig.bench->pictures().picture(
      {.size = std::array{1500, 900}, .panels = false, .legend = false});
  const Image pieces = rig.bench->pictures().picture(
      {.size = std::array{3000, 1800}, .panels = false, .legend = false});
  CHECK(difference(whole, pieces, 2, 20) < 20);
}

TEST_CASE("a background of two colours runs over the whole of a picture, not of its pieces") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  set_view(rig, [](ViewOptions& view) {
    view.backdrop = Backdrop::gradient;
    view.fill = view.wireframe = false;
  });
  const Image image = rig.bench->pictures().picture(
      {.size = std::array{2400, 3000}, .panels = false, .legend = false});
  double before = mean(image, 10, 0, 4)[0];
  const double first = before;
  for (int y = 4; y + 4 <= image.height; y += 4) {
    const double now = mean(image, 10, y, 4)[0];
    CHECK(std::abs(now - before) < 6);
    before = now;
  }
  CHECK(std::abs(before - first) > 20);
}

TEST_CASE("the dialog chooses size and content, the file dialog the file") {
  Rig rig(1280, 720);
  rig.open(ring_mesh());
  rig.key(keys::f12, {keys::shift});
  REQUIRE(rig.visible("picture/accept"));
  rig.click("picture/size");
  rig.click("picture/size/Twice as large");
  rig.click("picture/mesh_alone");
  rig.click("picture/transparent");
  rig.click("picture/accept");
  REQUIRE(rig.visible("dialog/accept"));
  const auto path = rig.folder / "figure.png";
  rig.fill("dialog/name", path.string());
  rig.click("dialog/accept");
  REQUIRE(rig.settle());
  CHECK(fs::file_size(path) > 1000);
  CHECK(rig.bench->capture().picture().scale == 2);
  CHECK(rig.bench->capture().picture().transparent);
  CHECK(rig.session().messages().notice()->text.find("figure.png") != std::string::npos);
}

TEST_CASE("a typed size is used, and one that cannot be is refused before a file is chosen") {
  Rig rig(1280, 720);
  rig.open(ring_mesh());
  rig.bench->apply(action::ShowPictureDialog{});
  rig.frames(3);
  rig.click("picture/size");
  rig.click("picture/size/Other");
  rig.fill("picture/width", "5");
  CHECK_FALSE(rig.bench->widgets().find("picture/accept")->enabled);
  rig.fill("picture/width", "1200");
  rig.fill("picture/height", "300");
  rig.click("picture/accept");
  CHECK(rig.bench->capture().picture().size == std::array{1200, 300});
  CHECK(rig.bench->dialogs().file_dialog().is_open());
}

TEST_CASE("a picture that cannot be written says so") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  rig.bench->apply(action::SavePicture{rig.folder / "no" / "such" / "folder.png"});
  REQUIRE(rig.wait([&] { return rig.session().messages().prompt() != nullptr; }));
  CHECK(rig.session().messages().prompt()->kind == Prompt::Kind::error);
  CHECK(rig.session().messages().prompt()->text.find("folder.png") != std::string::npos);
}

}  // namespace winslow::gui::test
