#include "gui/render/image.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/gl.h"

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

TEST_CASE("A context without a display draws OpenGL 3.3") {
  const auto context = make_headless_context();
  CHECK_FALSE(context->description().empty());
  GLint major = 0;
  GLint minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  CHECK(10 * major + minor >= 33);
}

TEST_CASE("An inner context gives way to the outer one") {
  const auto outer = make_headless_context();
  const FrameBuffer target(8, 8, 0);
  target.clear({1, 0, 0, 1});
  {
    const auto inner = make_headless_context();
    const FrameBuffer other(8, 8, 0);
    other.clear({0, 1, 0, 1});
    CHECK(other.read().pixel(4, 4)[1] == 255);
  }
  const Image image = target.read();
  CHECK(image.pixel(4, 4)[0] == 255);
  CHECK(image.pixel(4, 4)[1] == 0);
  CHECK(glGetError() == GL_NO_ERROR);
}

TEST_CASE("A framebuffer resolves its samples and reads rows from the top") {
  const auto context = make_headless_context();
  const FrameBuffer target(20, 10, 4);
  target.clear({0, 0, 1, 1});
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 9, 20, 1);
  glClearColor(1, 1, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  const Image image = target.read();
  CHECK(image.width == 20);
  CHECK(image.height == 10);
  CHECK(image.pixel(3, 0)[0] == 255);
  CHECK(image.pixel(3, 1)[0] == 0);
  CHECK(image.pixel(3, 1)[2] == 255);
  CHECK(image.pixel(19, 9)[3] == 255);
}

TEST_CASE("A framebuffer larger than the machine can have is refused") {
  const auto context = make_headless_context();
  CHECK_THROWS_AS(FrameBuffer(0, 10, 4), UsageError);
  CHECK_THROWS_AS(FrameBuffer(10, 10000000, 4), UsageError);
}

TEST_CASE("Every shader of the program is built in, and a missing one is an error") {
  CHECK(embedded_shaders().size() >= 8);
  const auto context = make_headless_context();
  CHECK_NOTHROW(Shader({"fill.vert", "line.geom", "line.frag"}));
  CHECK_THROWS_AS(Shader({"fill.vert", "nothing.frag"}), Error);
}
