#include "gui/render/image.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"

using namespace winslow;
using namespace winslow::gui;

namespace {

std::filesystem::path temporary(const std::string& name) {
  return std::filesystem::temp_directory_path() /
         ("winslow_" + std::to_string(::getpid()) + "_" + name);
}

Image pattern(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int v : {7 * x, 11 * y, x + y, 255 - x}) {
        image.rgba.push_back(static_cast<std::uint8_t>(v % 256));
      }
    }
  }
  return image;
}

}  // namespace

TEST_CASE("A picture comes back from its PNG file bit for bit") {
  const auto path = temporary("pattern.png");
  const Image image = pattern(37, 23);
  write_png(path, image);
  const Image back = read_png(path);
  std::filesystem::remove(path);
  CHECK(back.width == 37);
  CHECK(back.height == 23);
  CHECK(back.rgba == image.rgba);
}

TEST_CASE("what is no PNG is refused") {
  const auto path = temporary("none.png");
  std::ofstream(path) << "not a picture";
  CHECK_THROWS_AS(read_png(path), InputError);
  std::filesystem::remove(path);
  CHECK_THROWS_AS(read_png(path), InputError);
}

TEST_CASE("A picture that cannot be written leaves what was there") {
  const auto path = temporary("kept.png");
  write_png(path, pattern(5, 4));
  CHECK_THROWS_AS(write_png(path, Image{}), OutputError);
  CHECK_THROWS_AS(write_png(path, Image{10, 10, {1, 2, 3}}), OutputError);
  CHECK(read_png(path).width == 5);
  std::filesystem::remove(path);
  CHECK_THROWS_AS(write_png(temporary("no_folder") / "x.png", pattern(2, 2)), OutputError);
}
