#include "gui/base/screen.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <concepts>
#include <type_traits>

#include "core/types.h"

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

}  // namespace winslow::gui::test
