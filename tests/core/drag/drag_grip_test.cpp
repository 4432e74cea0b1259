#include "core/drag/drag_grip.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace winslow {

namespace {

enum class Faces { triangles, squares, bricks };

/// A strip of n by m squares of edge 1/n, each cut in two or whole, or two of them a brick with six
/// nodes, rolled up about the y axis.
struct Strip {
  Coordinates x = Coordinates(3, 0);
  std::vector<Face> faces;
  Index n, m;

  Strip(Index squares, Index rows, Faces kind, double radius = 0) : n(squares), m(rows) {
    for (Index j = 0; j <= m; ++j)
      for (Index i = 0; i <= n; ++i) {
        const double s = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
        x.push_xyz(radius > 0
                       ? Vec3(radius * std::cos(s / radius), y, radius * std::sin(s / radius))
                       : Vec3(s, y, 0));
      }
    for (Index j = 0; j < m; ++j)
      for (Index i = 0; i < n; ++i) {
        const Index a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
        if (kind == Faces::triangles) {
          faces.emplace_back(a, b, c);
          faces.emplace_back(a, c, d);
        } else if (kind == Faces::bricks && (i + j) % 2 == 0 && i + 1 < n) {
          faces.emplace_back(std::array{a, b, id(i + 2, j), id(i + 2, j + 1), c, d});
        } else if (kind == Faces::squares || i == 0 || (i + j) % 2 == 0) {
          faces.emplace_back(a, b, c, d);
        }
      }
  }
  Index id(Index i, Index j) const { return j * (n + 1) + i; }
};

}  // namespace

TEST_CASE("shares on a flat surface are those of the straight distance, whatever its faces") {
  for (const Faces kind : {Faces::triangles, Faces::squares, Faces::bricks}) {
    CAPTURE(static_cast<int>(kind));
    const Strip strip(24, 24, kind);
    const std::vector<Index> held{strip.id(12, 12)};
    const double radius = 0.4;
    const FadedPatch patch = faded_patch(strip.faces, strip.x, held, radius);
    CHECK(std::ranges::is_sorted(patch.nodes));
    std::size_t within = 0;
    for (Index node = 0; node < strip.x.size(); ++node) {
      const double distance = (strip.x.xyz(node) - strip.x.xyz(held[0])).norm();
      if (distance < 0.93 * radius) ++within;
      const auto it = std::ranges::lower_bound(patch.nodes, node);
      const bool has = it != patch.nodes.end() && *it == node;
      const double share =
          has ? patch.shares[static_cast<std::size_t>(it - patch.nodes.begin())] : 0;
      CHECK(std::abs(share - faded_share(distance, radius)) < 0.07);
    }
    CHECK(patch.nodes.size() >= within);
  }
}

TEST_CASE("distances run along the surface: around a cylinder, not through it") {
  // Nearly closed: its ends are .02 apart, and 1 along the surface.
  const Strip strip(60, 4, Faces::triangles, 0.98 / (2 * pi) * 1.04);
  const FadedPatch patch =
      faded_patch(strip.faces, strip.x, std::vector<Index>{strip.id(0, 2)}, 0.3);
  for (const Index node : patch.nodes) CHECK(node % 61 <= 19);
  CHECK(patch.nodes.size() > 60);
}

TEST_CASE("what is held moves with all of itself, with a radius of nothing alone") {
  const Strip strip(10, 10, Faces::triangles);
  const std::vector<Index> held{strip.id(4, 4), strip.id(5, 4), strip.id(5, 5), 100000};
  const FadedPatch alone = faded_patch(strip.faces, strip.x, held, 0);
  CHECK(alone.nodes == std::vector<Index>{held[0], held[1], held[2]});
  CHECK(alone.shares == std::vector<double>{1, 1, 1});
  const FadedPatch faded = faded_patch(strip.faces, strip.x, held, 0.25);
  CHECK(faded.nodes.size() > 9);
  for (std::size_t k = 0; k < faded.nodes.size(); ++k) {
    const bool is_held = std::ranges::find(held, faded.nodes[k]) != held.end();
    CHECK((faded.shares[k] == 1) == is_held);
  }
}

}  // namespace winslow
