#include "gui/support/rig.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

namespace winslow::gui::test {

Rig::Rig(int width, int height, const std::filesystem::path& profile)
    : context(make_headless_context()),
      bench(std::make_unique<Workbench>(WorkbenchOptions{1, profile})),
      width_(width),
      height_(height) {
  frames();
}

void Rig::frame() { bench->update(input, width_, height_, 1.0 / 30); }

void Rig::frames(int more) {
  while (!input.empty()) frame();
  for (int i = 0; i < more; ++i) frame();
}

bool Rig::wait(const std::function<bool()>& done, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  frames(1);
  while (!done()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    frames(1);
  }
  frames(1);
  return true;
}

bool Rig::settle() {
  return wait([this] { return bench->settled() && !session().job().active(); });
}

void Rig::open(const Mesh& mesh, const std::string& name) {
  bench->apply(action::OpenMesh{write(folder, mesh, name)});
  REQUIRE(settle());
  REQUIRE(session().document() != nullptr);
}

void Rig::move(const ScreenPoint& to) {
  input.move(to);
  frames(1);
}

void Rig::press(MouseButton button) {
  input.button(button, true);
  frames(1);
}

void Rig::release(MouseButton button) {
  input.button(button, false);
  frames();
}

void Rig::click(const ScreenPoint& at) {
  move(at);
  frames(1);
  press();
  release();
}

void Rig::click(const std::string& widget) {
  const auto rect = bench->widgets().find(widget);
  INFO("widget ", widget);
  REQUIRE(rect.has_value());
  click(rect->centre());
}

void Rig::drag(const ScreenPoint& from, const ScreenPoint& to, int steps, MouseButton button) {
  move(from);
  frames(1);
  press(button);
  for (int i = 1; i <= steps; ++i) move(from + (to - from) * (static_cast<double>(i) / steps));
}

void Rig::wheel(const ScreenPoint& at, double notches) {
  move(at);
  frames(1);
  input.wheel(Vec2(0, notches));
  frames(1);
}

void Rig::key(int glfw_key, std::vector<int> modifiers) {
  for (int m : modifiers) input.key(m, true);
  input.key(glfw_key, true);
  input.key(glfw_key, false);
  for (int m : modifiers) input.key(m, false);
  frames();
}

void Rig::type(const std::string& text) {
  for (char c : text) {
    input.text(static_cast<char32_t>(c));
    frames(1);
  }
}

void Rig::fill(const std::string& widget, const std::string& text) {
  click(widget);
  key(keys::a, {keys::control});
  type(text);
  key(keys::tab);
}

void turn_flap(Rig& rig, double degrees, const Vec2& by) {
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{degrees, Vec2(0, 0), by}});
  REQUIRE(rig.settle());
}

void set_view(Rig& rig, const std::function<void(ViewOptions&)>& change) {
  ViewOptions view = rig.bench->view_control().options();
  change(view);
  rig.bench->apply(action::EditView{whole(view)});
  REQUIRE(rig.settle());
  rig.frames();
}

}  // namespace winslow::gui::test
