#include <doctest/doctest.h>
#include <imgui.h>

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

#include "core/types.h"
#include "gui/base/input.h"
#include "gui/base/screen.h"
#include "gui/base/text.h"
#include "gui/support/rig.h"

using namespace winslow::gui;

namespace winslow::gui::test {

namespace {

template <class A, class B>
concept Addable = requires(const A& a, const B& b) {
  a + b;
};
template <class A, class B>
concept Subtractable = requires(const A& a, const B& b) {
  a - b;
};

// Pixels and places of a mesh do not mix: there is no way from one to the other.
template <class Pixels, class Place>
constexpr bool apart =
    !std::is_convertible_v<Pixels, Place> && !std::is_convertible_v<Place, Pixels> &&
    !std::is_constructible_v<Pixels, Place> && !std::is_assignable_v<Pixels&, Place> &&
    !std::is_assignable_v<Place&, Pixels> && !Addable<Pixels, Place> && !Addable<Place, Pixels> &&
    !Subtractable<Pixels, Place> && !Subtractable<Place, Pixels>;
static_assert(apart<ScreenPoint, Vec2> && apart<ScreenPoint, Vec3>);
static_assert(apart<ScreenVector, Vec2> && apart<ScreenVector, Vec3>);

// A place is no distance; two places have no sum.
static_assert(!std::is_convertible_v<ScreenPoint, ScreenVector>);
static_assert(!std::is_constructible_v<ScreenPoint, ScreenVector>);
static_assert(!std::is_constructible_v<ScreenVector, ScreenPoint>);
static_assert(!Addable<ScreenPoint, ScreenPoint>);
static_assert(!Subtractable<ScreenVector, ScreenPoint>);
static_assert(std::same_as<decltype(ScreenPoint() - ScreenPoint()), ScreenVector>);
static_assert(std::same_as<decltype(ScreenPoint() + ScreenVector()), ScreenPoint>);

// To and from Dear ImGui's pairs where it is said.
static_assert(!std::is_convertible_v<ImVec2, ScreenPoint>);
static_assert(!std::is_convertible_v<ScreenPoint, ImVec2>);
static_assert(std::is_constructible_v<ScreenPoint, ImVec2>);

}  // namespace

TEST_CASE("Places and distances on screen") {
  const ScreenPoint a(10, 20), b(13, 24);
  CHECK((b - a).norm() == 5);
  CHECK((b - a).dot(ScreenVector(1, 0)) == 3);
  CHECK(a + 2 * (b - a) == ScreenPoint(16, 28));
  CHECK(b - (b - a) == a);
  CHECK(midpoint(a, b) == ScreenPoint(11.5, 22));
  CHECK(-(b - a) / 2 == ScreenVector(-1.5, -2));
  CHECK(a[0] == 10);
  CHECK(a[1] == 20);
}

TEST_CASE("A box on screen has its upper left rim, and not the other") {
  const ScreenBox box{{10, 20}, {30, 60}};
  CHECK(box.size() == ScreenVector(20, 40));
  CHECK(box.centre() == ScreenPoint(20, 40));
  CHECK(box.contains({10, 20}));
  CHECK_FALSE(box.contains({30, 40}));
  CHECK_FALSE(box.contains({20, 60}));
}

TEST_CASE("Places on screen are Dear ImGui's, in single precision") {
  const auto v = static_cast<ImVec2>(ScreenPoint(1.5, -2));
  CHECK(v.x == 1.5f);
  CHECK(v.y == -2.0f);
  CHECK(ScreenPoint(v) == ScreenPoint(1.5, -2));
}

TEST_CASE("numbers are written as people read them") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(1234567) == "1,234,567");
  CHECK(grouped(-1000) == "-1,000");
  CHECK(counted(1, "node") == "1 node");
  CHECK(counted(4774, "node") == "4,774 nodes");
  CHECK(table_number(0.8661) == "0.866");
  CHECK(table_number(12345.6) == "1.23e+04");
  CHECK(table_number(1.0 / 0.0) == "-");
}

TEST_CASE("a press and its release never fall into one frame") {
  InputQueue queue;
  queue.move(ScreenPoint(3, 4));
  queue.button(MouseButton::left, true);
  queue.button(MouseButton::left, false);
  const InputState down = queue.next_frame();
  CHECK(down.down(MouseButton::left));
  CHECK(down.mouse == ScreenPoint(3, 4));
  CHECK_FALSE(queue.empty());
  CHECK_FALSE(queue.next_frame().down(MouseButton::left));
  CHECK(queue.empty());
}

TEST_CASE("a motion after a press waits for the next frame") {
  InputQueue queue;
  queue.button(MouseButton::left, true);
  queue.move(ScreenPoint(9, 9));
  queue.wheel(Vec2(0, 1));
  CHECK(queue.next_frame().mouse != ScreenPoint(9, 9));
  const InputState next = queue.next_frame();
  CHECK(next.mouse == ScreenPoint(9, 9));
  CHECK(next.wheel.y() == 1);
  CHECK(queue.next_frame().wheel.y() == 0);
}

TEST_CASE(
    "characters come together, unless a key leads elsewhere between them, or one comes twice") {
  InputQueue queue;
  for (const char32_t c : {U'1', U'2', U'1'}) queue.text(c);
  CHECK(queue.next_frame().text == U"12");
  CHECK(queue.next_frame().text == U"1");
  queue.text(U'5');
  queue.key(GLFW_KEY_TAB, true);
  queue.text(U'6');
  const InputState before = queue.next_frame();
  CHECK(before.text == U"5");
  CHECK(before.keys[GLFW_KEY_TAB]);
  // Tab leads to another field within the frames that come before it.
  CHECK(queue.next_frame().text.empty());
  CHECK(queue.next_frame().text.empty());
  CHECK(queue.next_frame().text == U"6");
  // A key that types its own character comes with it.
  queue.key(GLFW_KEY_X, true);
  queue.text(U'x');
  CHECK(queue.next_frame().text == U"x");
  CHECK(queue.empty());
}

TEST_CASE("keys and text are counted once") {
  InputQueue queue;
  queue.key(keys::control, true);
  queue.key(keys::z, true);
  queue.text(U'x');
  queue.key(keys::z, false);
  const InputState first = queue.next_frame();
  CHECK(first.control());
  CHECK(first.keys[keys::z]);
  CHECK(first.text == U"x");
  const InputState second = queue.next_frame();
  CHECK_FALSE(second.keys[keys::z]);
  CHECK(second.text.empty());
  queue.key(-1, true);  // a key that GLFW does not know
  CHECK(queue.empty());
}

TEST_CASE("Control that goes up before its key still counts") {
  InputQueue queue;
  queue.key(keys::control, true);
  CHECK(queue.next_frame().control());
  // Both in one frame: a fast hand, or a program that types.
  queue.key(keys::q, true);
  queue.key(keys::control, false);
  queue.key(keys::q, false);
  const InputState pressed = queue.next_frame();
  CHECK(pressed.keys[keys::q]);
  CHECK(pressed.control());
  CHECK_FALSE(queue.next_frame().control());
  // Nor does Control that comes after a key or a button belong to it.
  queue.key(keys::w, true);
  queue.key(keys::control, true);
  CHECK_FALSE(queue.next_frame().control());
  queue.button(MouseButton::left, true);
  queue.key(keys::control, false);
  CHECK(queue.next_frame().control());
}

TEST_CASE("keys that are held back stay in their order, and what is down can go up") {
  InputQueue queue;
  queue.key(keys::q, true);
  CHECK(queue.next_frame().keys[keys::q]);
  queue.key(keys::q, false);
  queue.key(keys::z, true);
  queue.text(U'z');
  queue.key(keys::z, false);
  const InputState held = queue.next_frame(InputQueue::Keys::hold);
  CHECK_FALSE(held.keys[keys::q]);
  CHECK_FALSE(held.keys[keys::z]);
  CHECK(held.text.empty());
  CHECK_FALSE(queue.empty());
  const InputState taken = queue.next_frame();
  CHECK(taken.keys[keys::z]);
  CHECK(taken.text == U"z");
}

TEST_CASE("what is typed after a command with Ctrl waits for its field, another command does not") {
  InputQueue queue;
  queue.key(keys::control, true);
  queue.key(GLFW_KEY_G, true);
  queue.key(GLFW_KEY_G, false);
  queue.key(keys::control, false);
  queue.key(keys::e, true);
  queue.text(U'e');
  queue.key(keys::e, false);
  InputState state = queue.next_frame();
  REQUIRE(state.keys[GLFW_KEY_G]);
  int waited = 0;
  for (; waited < 20 && !state.keys[keys::e]; ++waited) {
    CHECK(state.text.empty());
    state = queue.next_frame();
  }
  CHECK(waited > 3);
  CHECK(waited < 8);
  CHECK(state.text == U"e");
  // Undo, three times in a row.
  queue = {};
  queue.key(keys::control, true);
  for (int k = 0; k < 3; ++k) {
    queue.key(keys::z, true);
    queue.key(keys::z, false);
  }
  int frames = 0;
  for (; !queue.empty(); ++frames) queue.next_frame();
  CHECK(frames <= 6);
}

}  // namespace winslow::gui::test

TEST_CASE("Ticks are round, evenly spaced and inside the range") {
  const auto ticks = nice_ticks(0, 1, 5);
  REQUIRE(ticks.size() == 6);
  for (std::size_t k = 0; k < 6; ++k) CHECK(ticks[k] == doctest::Approx(0.2 * double(k)));

  for (const auto& range : {std::pair{-3.7, 12.1}, {1e-9, 7e-9}, {1e6, 1.00003e6}}) {
    const double low = range.first, high = range.second;
    CAPTURE(low);
    const auto some = nice_ticks(low, high, 6);
    REQUIRE(some.size() >= 3);
    CHECK(some.size() <= 8);
    CHECK(some.front() >= low - 1e-9 * (high - low));
    CHECK(some.back() <= high + 1e-9 * (high - low));
    const double step = some[1] - some[0];
    const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    const bool round = std::abs(mantissa - 1) < 1e-3 || std::abs(mantissa - 2) < 1e-3 ||
                       std::abs(mantissa - 2.5) < 1e-3 || std::abs(mantissa - 5) < 1e-3;
    CHECK(round);
  }
}

TEST_CASE("A range without extent has no ticks") {
  CHECK(nice_ticks(1, 1, 5).empty());
  CHECK(nice_ticks(2, 1, 5).empty());
  CHECK(nice_ticks(0, std::numeric_limits<double>::infinity(), 5).empty());
  CHECK(nice_ticks(std::nan(""), 1, 5).empty());
}

TEST_CASE("Rounding up gives the next round number and keeps a round one") {
  CHECK(round_up_nicely(1.3) == doctest::Approx(1.5));
  CHECK(round_up_nicely(17) == doctest::Approx(20));
  CHECK(round_up_nicely(0.0071) == doctest::Approx(0.008));
  CHECK(round_up_nicely(9.5) == doctest::Approx(10));
  CHECK(round_up_nicely(2.5) == doctest::Approx(2.5));
}

TEST_CASE("Labels are as short as their neighbours allow") {
  CHECK(format_tick(0.2, 0.2) == "0.2");
  CHECK(format_tick(0.25, 0.25) == "0.25");
  CHECK(format_tick(1, 0.2) == "1.0");
  CHECK(format_tick(-1e-17, 0.2) == "0");
  CHECK(format_tick(100, 50) == "100");
  CHECK(format_tick(2e-7, 1e-7) == "2e-07");
  CHECK(format_tick(3e9, 1e9) == "3e+09");
}

TEST_CASE("Ticks of a logarithmic axis are powers of ten, or 1, 2 and 5 times those") {
  CHECK(log_ticks(1, 1e4, 8) == std::vector<double>{1, 10, 100, 1000, 1e4});
  const auto fine = log_ticks(1, 60, 8);
  REQUIRE(fine.size() == 6);
  CHECK(fine[1] == doctest::Approx(2));
  CHECK(fine[5] == doctest::Approx(50));
  // Of many decades every so many, and all inside.
  for (const int wanted : {2, 3, 5, 8}) {
    const auto many = log_ticks(3e-9, 2e7, wanted);
    CAPTURE(wanted);
    CHECK(many.size() >= 2);
    CHECK(many.size() <= static_cast<std::size_t>(wanted) + 1);
    CHECK(many.front() >= 3e-9);
    CHECK(many.back() <= 2e7);
  }
  CHECK(log_ticks(0, 1, 5).empty());
  CHECK(log_ticks(2, 3, 5) == nice_ticks(2, 3, 5));
  CHECK(format_power(1e-6) == "1e-06");
  CHECK(format_power(20) == "20");
}
