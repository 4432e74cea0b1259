#include "gui/widgets/legend.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <set>

using namespace winslow;
using namespace winslow::gui;

namespace {

/// An ImGui frame without OpenGL: what is drawn can be read from its vertices.
class Frame {
 public:
  Frame() : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {800, 600};
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    ImGui::NewFrame();
  }
  ~Frame() {
    ImGui::SetCurrentContext(context_);
    ImGui::EndFrame();
    ImGui::DestroyContext(context_);
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  ImDrawList& list() {
    ImGui::SetCurrentContext(context_);
    return *ImGui::GetBackgroundDrawList();
  }

 private:
  ImGuiContext* context_;
};

Legend make_legend() {
  Legend legend;
  legend.title = "Aspect ratio";
  legend.scale = {"viridis", 1, 3, true, 0};
  legend.histogram = Histogram{1, 3, {50, 20, 0, 1}};
  return legend;
}

std::set<ImU32> colors_of(const ImDrawList& list) {
  std::set<ImU32> colors;
  for (const ImDrawVert& v : list.VtxBuffer) colors.insert(v.col);
  return colors;
}

ImU32 packed(const Rgb& c) { return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], 1)); }

}  // namespace

TEST_CASE("A legend stays within the rectangle that it asks for") {
  Frame frame;
  const Legend legend = make_legend();
  for (const float font_size : {10.0f, 14.0f, 28.0f}) {
    CAPTURE(font_size);
    LegendStyle style;
    style.font_size = font_size;
    const float width = legend_width(legend, style);
    const int before = frame.list().VtxBuffer.Size;
    draw_legend(frame.list(), 100, 50, 300, legend, style);
    REQUIRE(frame.list().VtxBuffer.Size > before + 100);
    for (int k = before; k < frame.list().VtxBuffer.Size; ++k) {
      const ImVec2 p = frame.list().VtxBuffer[k].pos;
      CHECK(p.x >= 98.0f);
      CHECK(p.x <= 100 + width + 2);
      CHECK(p.y >= 48.0f);
      CHECK(p.y <= 350 + 0.3f * font_size);
    }
  }
}

TEST_CASE("A legend shows the scale's colours, or one rectangle a band") {
  Frame frame;
  Legend legend = make_legend();
  legend.histogram.reset();
  draw_legend(frame.list(), 0, 0, 300, legend, {});
  const auto smooth = colors_of(frame.list());
  CHECK(smooth.size() > 150);

  Frame other;
  legend.scale.bands = 5;
  draw_legend(other.list(), 0, 0, 300, legend, {});
  const auto banded = colors_of(other.list());
  CHECK(banded.size() < 10);
  for (int k = 0; k < 5; ++k) {
    CHECK(banded.contains(packed(legend.scale.color(1.2 + 0.4 * k))));
  }
}

TEST_CASE("The histogram has a bar for each bin that is not empty, longest where most are") {
  Frame frame;
  Legend legend = make_legend();
  LegendStyle style;
  draw_legend(frame.list(), 0, 0, 300, legend, style);
  const auto right_end = [&](const ImDrawList& list, double value) {
    float right = 0;
    for (const ImDrawVert& v : list.VtxBuffer) {
      if (v.col == packed(legend.scale.color(value))) right = std::max(right, v.pos.x);
    }
    return right;
  };
  const float most = right_end(frame.list(), 1.25);
  const float fewer = right_end(frame.list(), 1.75);
  const float one = right_end(frame.list(), 2.75);
  CHECK(most > fewer);
  CHECK(fewer > one);
  CHECK(one > style.bar_width + 1);
  CHECK(right_end(frame.list(), 2.25) <= style.bar_width);
}

TEST_CASE("Values beyond the range widen the labels of the ends") {
  Frame frame;
  Legend legend = make_legend();
  legend.title.clear();
  const float plain = legend_width(legend, {});
  legend.more_above = true;
  CHECK(legend_width(legend, {}) > plain);
}

TEST_CASE("A legend without room or range draws no nonsense") {
  Frame frame;
  Legend legend = make_legend();
  draw_legend(frame.list(), 0, 0, 5, legend, {});
  legend.scale.low = legend.scale.high = 2;
  draw_legend(frame.list(), 0, 0, 300, legend, {});
  for (const ImDrawVert& v : frame.list().VtxBuffer) {
    CHECK(std::isfinite(v.pos.x));
    CHECK(std::isfinite(v.pos.y));
  }
}

TEST_CASE("A logarithmic legend has its decades evenly apart") {
  Legend legend;
  legend.scale = {"viridis", 1, 1000, true, 0};
  legend.scale.logarithmic = true;
  const auto ticks = legend_ticks(legend, 4);
  REQUIRE(ticks.size() == 4);
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(legend.scale.share(ticks[k].value) == doctest::Approx(static_cast<double>(k) / 3));
  CHECK(ticks[2].text == "100");
  legend.more_above = true;
  CHECK(legend_ticks(legend, 4).back().text == "\u2265 1000");
}

TEST_CASE("A legend names the colour of inverted elements, below its bar") {
  Frame frame;
  Legend legend = make_legend();
  legend.inverted = Rgb{0.9f, 0.1f, 0.12f};
  const LegendStyle style;
  const LegendBars bars = legend_bars(0, 0, 300, legend, style);
  CHECK(bars.bottom < 300 - 1.5f * style.font_size);
  draw_legend(frame.list(), 0, 0, 300, legend, style);
  float top = 1e9f, bottom = 0;
  for (const ImDrawVert& v : frame.list().VtxBuffer) {
    if (v.col != packed(*legend.inverted)) continue;
    top = std::min(top, v.pos.y);
    bottom = std::max(bottom, v.pos.y);
  }
  CHECK(top > bars.bottom);
  CHECK(bottom <= 301);
  CHECK(bottom - top > 8);
}
