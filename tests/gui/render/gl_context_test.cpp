#include "gui/render/gl_context.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/gl.h"
#include "gui/render/shader.h"

using namespace winslow;
using namespace winslow::gui;

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
