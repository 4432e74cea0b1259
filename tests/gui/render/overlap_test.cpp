#include "gui/render/overlap.h"

#include <doctest/doctest.h>

#include <random>

#include "gui/render/draw_list.h"
#include "gui/support/scene.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::gui;
using winslow::test::Cells;

namespace {

/// Interior nodes anywhere in the unit square.
Mesh scrambled(Index cells, Cells kind) {
  Mesh mesh = make_mesh(winslow::test::square(cells, kind));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (const Index node : mesh.topology->interior_nodes()) {
    const double x = anywhere(random);
    mesh.coordinates.set_xy(node, {x, anywhere(random)});
  }
  return mesh;
}

Vec2 corner(const DrawList& list, std::uint32_t vertex) {
  const std::size_t at = 2 * static_cast<std::size_t>(vertex);
  return Vec2(list.positions[at], list.positions[at + 1]) + list.origin.head<2>();
}

/// Some of the triangles [first, first + count) holds a point, their edges moved out by `rim`.
bool holds(const DrawList& list, const std::vector<std::uint32_t>& triangles, std::size_t first,
           std::size_t count, const Vec2& p, double rim) {
  for (std::size_t t = first; t < first + count; ++t) {
    std::array<Vec2, 3> c{corner(list, triangles[3 * t]), corner(list, triangles[3 * t + 1]),
                          corner(list, triangles[3 * t + 2])};
    if (twice_area(c[0], c[1], c[2]) < 0) std::swap(c[1], c[2]);
    // Of a sliver the edges alone would hold all of a line.
    const Vec2 low = c[0].cwiseMin(c[1]).cwiseMin(c[2]), high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    bool inside = (p - low).minCoeff() >= -std::abs(rim) && (high - p).minCoeff() >= -std::abs(rim);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2& a = c[k];
      const Vec2& b = c[(k + 1) % 3];
      inside = inside && twice_area(a, b, p) >= -rim * (b - a).norm();
    }
    if (inside) return true;
  }
  return false;
}

double drawn_area(const DrawList& list, const std::vector<std::uint32_t>& triangles,
                  const DrawList::Range& range) {
  double area = 0;
  for (std::size_t t = range.first; t < range.first + range.count; ++t)
    area += 0.5 *
            std::abs(twice_area(corner(list, triangles[3 * t]), corner(list, triangles[3 * t + 1]),
                                corner(list, triangles[3 * t + 2])));
  return area;
}

DrawList list_of(const Mesh& mesh) {
  return whole_draw_list(*mesh.topology, group_edges(*mesh.topology), mesh.coordinates, {0.5, 0.5});
}

}  // namespace

TEST_CASE("Of a mesh that lies beside itself nothing is left out") {
  for (const Cells kind : {Cells::triangles, Cells::quads, Cells::mixed}) {
    const Mesh mesh = make_mesh(winslow::test::square_with_hole(12, kind));
    CHECK_FALSE(list_of(mesh).seen.has_value());
  }
  // Nor of one with some inverted elements.
  Mesh mesh = make_mesh(winslow::test::regular_star(6));
  mesh.coordinates.set_xy(0, {1.2, 0.7});
  const DrawList list = list_of(mesh);
  CHECK_FALSE(list.seen.has_value());
  CHECK(list.inverted_triangles.size() == 3);
}

TEST_CASE("A scrambled mesh covers what it did, once instead of a thousand times") {
  for (const Cells kind : {Cells::triangles, Cells::quads}) {
    CAPTURE(winslow::test::name_of(kind));
    const Mesh mesh = scrambled(60, kind);
    const DrawList list = list_of(mesh);
    REQUIRE(list.seen.has_value());
    const DrawList::Range inverted{0, list.inverted_triangles.size() / 3};
    CHECK(drawn_area(list, list.inverted_triangles, inverted) < 2);
    CHECK(drawn_area(list, list.triangles, list.seen->beside_inverted) < 1);
    CHECK(drawn_area(list, list.triangles, list.seen->alone) < 2);
    CHECK(drawn_area(list, list.triangles, list.seen->whole) > 100);

    DrawList all;  // inverted elements as they are
    all.origin = list.origin;
    all.positions = list.positions;
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      const auto corners = mesh.topology->element(e);
      if (!is_inverted(mesh.coordinates, corners)) continue;
      std::array<int, 6> cut{0, 1, 2, 0, 0, 0};
      if (corners.size() == 4) cut = cut_quadrilateral(mesh.coordinates, corners);
      for (std::size_t k = 0; k < (corners.size() == 4 ? 6U : 3U); ++k)
        all.triangles.push_back(
            static_cast<std::uint32_t>(corners[static_cast<std::size_t>(cut[k])]));
    }
    const std::size_t count = all.triangles.size() / 3;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-0.02, 1.02);
    const double rim = 1e-5;
    for (int k = 0; k < 400; ++k) {
      const double x = anywhere(random);
      // Where little lies, above all.
      const Vec2 p(x, k % 2 == 0 ? anywhere(random) : 0.02 * anywhere(random));
      CAPTURE(p);
      const bool shown =
          holds(list, list.inverted_triangles, inverted.first, inverted.count, p, rim);
      const bool is = holds(all, all.triangles, 0, count, p, -rim);
      const bool may_be = holds(all, all.triangles, 0, count, p, 2 * rim);
      CHECK((!is || shown));
      CHECK((!shown || may_be));
    }
  }
}

TEST_CASE("Every piece has the colour of its element") {
  const Mesh mesh = scrambled(40, Cells::triangles);
  const DrawList list = list_of(mesh);
  REQUIRE(list.seen.has_value());
  REQUIRE(list.triangle_element.size() == list.triangles.size() / 3);
  for (const DrawList::Range& range : {list.seen->beside_inverted, list.seen->alone})
    for (std::size_t t = range.first; t < range.first + range.count; t += 7) {
      const auto nodes = mesh.topology->element(list.triangle_element[t]);
      DrawList one;
      one.positions.reserve(6);
      for (const Index node : nodes) {
        one.positions.push_back(static_cast<float>(mesh.coordinates.xy(node).x()));
        one.positions.push_back(static_cast<float>(mesh.coordinates.xy(node).y()));
      }
      Vec2 centre(0, 0);
      for (std::size_t k = 0; k < 3; ++k) centre += corner(list, list.triangles[3 * t + k]) / 3;
      CHECK(holds(one, {0, 1, 2}, 0, 1, centre, 1e-5));
    }
}

TEST_CASE("Through faint elements of a pile the others are seen, each place once") {
  const Mesh mesh = scrambled(60, Cells::triangles);
  DrawList list = list_of(mesh);
  REQUIRE(list.seen.has_value());
  const DrawList plain = list;
  const auto count = static_cast<std::size_t>(mesh.topology->element_count());
  // One in fifty is opaque, the others faint; of these some are not drawn at all.
  std::vector<std::uint32_t> rgba(count, 0x26FFFFFFU);
  for (std::size_t e = 0; e < count; e += 50) rgba[e] = 0xFFFFFFFFU;
  for (std::size_t e = 1; e < count; e += 3)
    if (rgba[e] != 0xFFFFFFFFU) rgba[e] = 0x00FFFFFFU;
  REQUIRE(seen_through(list, rgba));
  const DrawList::Range& through = list.seen->through;
  CHECK(through.first == plain.triangle_element.size());
  CHECK(through.first + through.count == list.triangle_element.size());
  CHECK(drawn_area(list, list.triangles, through) < 3);
  CHECK(drawn_area(list, list.triangles, list.seen->whole) > 100);
  DrawList opaque;  // as they are, and as they are drawn
  opaque.origin = list.origin;
  opaque.positions = list.positions;
  std::vector<std::uint32_t> drawn;
  for (std::size_t t = list.seen->whole.first; t < through.first; ++t)
    if (static_cast<std::size_t>(list.triangle_element[t]) % 50 == 0)
      for (std::size_t k = 0; k < 3; ++k) opaque.triangles.push_back(list.triangles[3 * t + k]);
  for (std::size_t t = through.first; t < through.first + through.count; ++t) {
    const std::uint32_t alpha = rgba[static_cast<std::size_t>(list.triangle_element[t])] >> 24U;
    CHECK(alpha > 0);
    if (alpha == 255)
      for (std::size_t k = 0; k < 3; ++k) drawn.push_back(list.triangles[3 * t + k]);
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (int k = 0; k < 300; ++k) {
    const double x = anywhere(random);
    const Vec2 p(x, anywhere(random));
    CAPTURE(p);
    if (holds(opaque, opaque.triangles, 0, opaque.triangles.size() / 3, p, -1e-5))
      CHECK(holds(list, drawn, 0, drawn.size() / 3, p, 1e-5));
  }
  // Other colours replace what was added; a list that does not lie over itself has none.
  REQUIRE(seen_through(list, std::vector<std::uint32_t>(count, 0x26FFFFFFU)));
  CHECK(drawn_area(list, list.triangles, list.seen->through) < 2);
  REQUIRE(seen_through(list, std::vector<std::uint32_t>(count, 0x00FFFFFFU)));
  CHECK(list.triangles == plain.triangles);
  CHECK(list.positions == plain.positions);
  DrawList valid = list_of(make_mesh(winslow::test::square(20, Cells::triangles)));
  CHECK_FALSE(seen_through(valid, std::vector<std::uint32_t>(800, 0x26FFFFFFU)));
}

TEST_CASE("Lines of a pile of elements fade, those beside it stay") {
  const Mesh mesh = scrambled(60, Cells::triangles);
  const DrawList list = list_of(mesh);
  const Mesh valid = make_mesh(winslow::test::square(60, Cells::triangles));
  // Of 7200 triangles that each cover a tenth of the square.
  CHECK(lines_spaced(list, 0.01f) < list.interior.count / 20);
  CHECK(lines_spaced(list_of(valid), 0.01f) == list_of(valid).interior.count);
}

TEST_CASE("A scrambled mesh looks the same whether what is hidden is left out or not") {
  gui::test::Scene scene;
  const Mesh mesh = scrambled(30, Cells::triangles);
  MeshStyle style;
  style.wireframe = false;
  style.boundary_width = 0;
  scene.show(mesh);
  scene.renderer.set_marker_styles(std::vector<MeshRenderer::MarkerStyle>(4, {{0, 0, 0, 0}, 0}));
  const Image image = scene.draw(style);
  PreparedMesh plain = prepare_mesh(mesh.topology, mesh.coordinates);
  plain.whole.inverted_triangles.clear();
  plain.whole.seen.reset();
  for (Index e = 0; e < mesh.topology->element_count(); ++e)
    if (is_inverted(mesh.coordinates, mesh.topology->element(e)))
      for (const Index node : mesh.topology->element(e))
        plain.whole.inverted_triangles.push_back(static_cast<std::uint32_t>(node));
  scene.renderer.set_mesh(std::move(plain));
  const Image whole = scene.draw(style);
  const auto red = [](const Image& of, int x, int y) {
    const auto* p = of.pixel(x, y);
    return p[0] > 120 && p[1] < 80;
  };
  int different = 0, inverted = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      inverted += red(whole, x, y);
      different += red(whole, x, y) != red(image, x, y);
    }
  CHECK(inverted > 20000);
  CHECK(different < 40);
}
