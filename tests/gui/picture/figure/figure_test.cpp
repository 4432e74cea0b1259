#include <doctest/doctest.h>

#include <fstream>
#include <pugixml.hpp>
#include <sstream>

#include "core/command/command.h"
#include "core/error.h"
#include "gui/picture/figure/page.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/support/rig.h"
#include "gui/view/overlays/vcv_overlay.h"

namespace winslow::gui::test {

namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

/// A ring seen whole, one point a unit of 1/50.
VectorFigure ring_figure() {
  VectorFigure figure;
  figure.mesh = ring_mesh();
  figure.camera.set_viewport(0, 0, 400, 300);
  figure.camera.fit(bounds(figure.mesh));
  figure.title = "Ring";
  for (Index m = 0; m < 2; ++m) figure.marker_colors.emplace_back(marker_color(m));
  return figure;
}

/// Lines stroked in a colour, over all paths.
std::size_t lines_of_color(const pugi::xml_document& svg, const Rgb& color) {
  std::size_t lines = 0;
  for (const auto& path : svg.select_nodes("//*[local-name()='path']")) {
    const std::string style = path.node().attribute("style").value();
    const std::size_t at = style.find("stroke:rgb(");
    if (at == std::string::npos) continue;
    std::array<float, 3> percent{};
    std::sscanf(style.c_str() + at, "stroke:rgb(%f%%,%f%%,%f%%)", &percent[0], &percent[1],
                &percent[2]);
    bool same = true;
    for (std::size_t c = 0; c < 3; ++c) same &= std::abs(percent[c] - 100 * color[c]) < 0.5f;
    if (same) lines += count(path.node().attribute("d").value(), "L ");
  }
  return lines;
}

std::vector<double> coordinates_of(const pugi::xml_document& svg) {
  std::vector<double> found;
  for (const auto& path : svg.select_nodes("//*[local-name()='path']")) {
    std::istringstream words(path.node().attribute("d").value());
    for (std::string word; words >> word;)
      if (std::isdigit(word[0]) || word[0] == '-') found.push_back(std::stod(word));
  }
  REQUIRE_FALSE(found.empty());
  return found;
}

}  // namespace

TEST_CASE("an SVG figure is XML and holds each visible edge of the boundary once") {
  TemporaryFolder folder;
  const auto path = folder / "ring.svg";
  VectorFigure figure = ring_figure();
  write_figure(path, figure);
  pugi::xml_document svg;
  REQUIRE(svg.load_file(path.c_str()));
  CHECK(std::string(svg.document_element().name()) == "svg");
  CHECK(lines_of_color(svg, marker_color(0)) == 24);
  CHECK(lines_of_color(svg, marker_color(1)) == 24);

  // Nothing of the far field is in a view of the body.
  figure.camera.fit({{-0.6, -0.3}, {0.6, 0.3}});
  write_figure(path, figure);
  REQUIRE(svg.load_file(path.c_str()));
  CHECK(lines_of_color(svg, marker_color(0)) == 24);
  CHECK(lines_of_color(svg, marker_color(1)) == 0);
}

TEST_CASE("a PDF figure is one page of the size of the view and its margins") {
  TemporaryFolder folder;
  const auto path = folder / "ring.pdf";
  const VectorFigure figure = ring_figure();
  write_figure(path, figure);
  const std::string pdf = content(path);
  CHECK(pdf.starts_with("%PDF-1."));
  CHECK(pdf.find("%%EOF") != std::string::npos);
  CHECK(count(pdf, "/Type /Page %") == 1);
  const FigureMargins m = figure_margins(figure);
  const std::size_t box = pdf.find("/MediaBox [ 0 0 ");
  REQUIRE(box != std::string::npos);
  double width = 0;
  double height = 0;
  std::sscanf(pdf.c_str() + box, "/MediaBox [ 0 0 %lf %lf", &width, &height);
  CHECK(width == doctest::Approx(400 + m.left + m.right).epsilon(1e-4));
  CHECK(height == doctest::Approx(300 + m.top + m.bottom).epsilon(1e-4));
}

TEST_CASE("a figure of a deep zoom has no coordinates off the page") {
  TemporaryFolder folder;
  VectorFigure figure = ring_figure();
  figure.camera.look_at({0.5, 0}, 1e-12);
  write_figure(folder / "deep.svg", figure);
  pugi::xml_document svg;
  REQUIRE(svg.load_file((folder / "deep.svg").c_str()));
  for (const double c : coordinates_of(svg)) CHECK(std::abs(c) < 2000);
}

TEST_CASE("an inset of a figure shows its place again, larger, and only there") {
  TemporaryFolder folder;
  VectorFigure figure = ring_figure();
  write_figure(folder / "plain.svg", figure);
  FigureInset inset;
  inset.camera.set_viewport(10, 180, 110, 110);
  inset.camera.look_at({0, 0}, figure.camera.units_per_pixel() / 2);
  inset.source = {{172.5, 122.5}, {227.5, 177.5}};
  figure.inset = inset;
  write_figure(folder / "inset.svg", figure);
  pugi::xml_document plain, with;
  REQUIRE(plain.load_file((folder / "plain.svg").c_str()));
  REQUIRE(with.load_file((folder / "inset.svg").c_str()));
  const Rgb& body = marker_color(0);
  const Rgb& far_field = marker_color(1);
  CHECK(lines_of_color(plain, body) == 24);
  CHECK(lines_of_color(with, body) == 48);
  CHECK(lines_of_color(with, far_field) == lines_of_color(plain, far_field));
  CHECK(fs::file_size(folder / "inset.svg") > fs::file_size(folder / "plain.svg"));
}

TEST_CASE("VCVs of a figure are vectors: outline and edges in their colour, negative ones red") {
  TemporaryFolder folder;
  const auto path = folder / "vcv.svg";
  VectorFigure figure = ring_figure();
  const MeshState state = make_state(figure.mesh);
  const Topology& topology = *figure.mesh.topology;
  for (const Index node : topology.interior_nodes())
    if (topology.neighbours(node).size() == 6 && figure.vcvs.size() < 2)
      figure.vcvs.push_back(inspect_node(*state.vcvs.plane(), figure.mesh.coordinates, node));
  REQUIRE(figure.vcvs.size() == 2);
  figure.vcvs[0].weights.assign(6, 1);
  figure.vcvs[1].weights = {1, 1, -1, 1, 1, 1};
  write_figure(path, figure);
  pugi::xml_document svg;
  REQUIRE(svg.load_file(path.c_str()));
  CHECK(lines_of_color(svg, VcvColors().line) == (6 + 6) + (6 + 5));
  CHECK(lines_of_color(svg, VcvColors().negative) == 1);
  CHECK(svg.select_nodes("//*[local-name()='image']").empty());
  write_figure(folder / "vcv.pdf", figure);
  const auto with = fs::file_size(folder / "vcv.pdf");

  // Where they are not in sight nothing is drawn of them.
  figure.camera.fit({{1.9, 1.9}, {1.95, 1.95}});
  write_figure(path, figure);
  REQUIRE(svg.load_file(path.c_str()));
  CHECK(lines_of_color(svg, VcvColors().line) == 0);
  figure = ring_figure();
  write_figure(folder / "vcv.pdf", figure);
  CHECK(fs::file_size(folder / "vcv.pdf") < with);
}

TEST_CASE("a VCV larger than the page is cut off at it") {
  TemporaryFolder folder;
  VectorFigure figure = ring_figure();
  const MeshState state = make_state(figure.mesh);
  const Index node = figure.mesh.topology->interior_nodes()[0];
  figure.vcvs.push_back(inspect_node(*state.vcvs.plane(), figure.mesh.coordinates, node));
  figure.camera.look_at(figure.vcvs[0].position, 1e-9);
  write_figure(folder / "deep.svg", figure);
  pugi::xml_document svg;
  REQUIRE(svg.load_file((folder / "deep.svg").c_str()));
  CHECK(lines_of_color(svg, VcvColors().line) > 0);
  for (const double c : coordinates_of(svg)) CHECK(std::abs(c) < 2000);
}

TEST_CASE("lines and polygons are cut at a box") {
  const ScreenBox box{{0, 0}, {2, 1}};
  const auto line = clip_line({-1, 0.5}, {3, 0.5}, box);
  REQUIRE(line);
  CHECK(((*line)[0] - ScreenPoint(0, 0.5)).norm() < 1e-12);
  CHECK(((*line)[1] - ScreenPoint(2, 0.5)).norm() < 1e-12);
  CHECK_FALSE(clip_line({-1, 2}, {3, 2}, box));
  CHECK_FALSE(clip_line({-1, 0.5}, {-0.5, 3}, box));
  const auto polygon = clip_polygon({{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}, box);
  REQUIRE(polygon.size() == 4);
  CHECK(clip_polygon({{3, 0}, {4, 0}, {4, 1}}, box).size() < 3);
}

TEST_CASE("the studio saves its view as vector graphics, colours and legend included") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  const auto path = rig.folder / "view.svg";
  rig.bench->apply(action::SavePicture{path});
  REQUIRE(rig.settle());
  const std::string colored = content(path);
  pugi::xml_document svg;
  REQUIRE(svg.load_string(colored.c_str()));
  CHECK(lines_of_color(svg, marker_color(0)) == 24 + 1);  // and its line in the key
  // Without colours there is neither legend nor a path for each of them.
  ViewOptions plain = rig.bench->view_control().options();
  plain.color.reset();
  rig.bench->apply(action::EditView{whole(plain)});
  rig.bench->apply(action::SavePicture{path, true});
  REQUIRE(rig.settle());
  CHECK(static_cast<double>(content(path).size()) < 0.6 * static_cast<double>(colored.size()));
}

TEST_CASE("pinned VCVs are in the studio's vector graphics") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  const Topology& topology = *rig.mesh().topology;
  Index node = -1;
  for (const Index k : topology.interior_nodes())
    if (topology.neighbours(k).size() == 6) node = k;
  REQUIRE(node >= 0);
  const auto lines_when_pinned = [&](const std::string& name) {
    rig.bench->apply(action::SavePicture{rig.folder / name});
    REQUIRE(rig.settle());
    pugi::xml_document svg;
    REQUIRE(svg.load_file((rig.folder / name).c_str()));
    return lines_of_color(svg, VcvColors().line) + lines_of_color(svg, VcvColors().negative);
  };
  CHECK(lines_when_pinned("none.svg") == 0);
  rig.bench->apply(action::PinNodes{{node}});
  CHECK(lines_when_pinned("one.svg") == 12);
}

TEST_CASE("a figure that cannot be written leaves nothing behind") {
  TemporaryFolder folder;
  CHECK_THROWS_AS(write_figure(folder / "no" / "a.svg", ring_figure()), OutputError);
  CHECK_THROWS_AS(write_figure(folder / "a.eps", ring_figure()), UsageError);
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("the words of an SVG are text: title, key and ticks can be searched and edited") {
  TemporaryFolder folder;
  const auto path = folder / "ring.svg";
  VectorFigure figure = ring_figure();
  figure.title = "Ring <1> & more";
  figure.key.emplace_back("flap", marker_color(0));
  write_figure(path, figure);
  pugi::xml_document svg;
  REQUIRE(svg.load_file(path.c_str()));
  std::vector<std::string> words;
  for (const auto& text : svg.select_nodes("//*[local-name()='text']")) {
    words.emplace_back(text.node().text().get());
    CHECK(std::string(text.node().attribute("font-family").value()).ends_with("sans-serif"));
    CHECK(text.node().attribute("font-size").as_double() > 0);
  }
  CHECK(words == std::vector<std::string>{"Ring <1> & more", "flap"});
  // No outlines of letters beside them.
  CHECK(svg.select_nodes("//*[local-name()='symbol']").empty());
}

}  // namespace winslow::gui::test
