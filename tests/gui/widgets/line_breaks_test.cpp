#include "gui/widgets/line_breaks.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <sstream>

#include "gui/support/rig.h"

namespace winslow::gui::test {

TEST_CASE("lines are broken at spaces, never amid a number") {
  Rig rig;
  rig.frames();  // a font is chosen
  const std::string text = "64 columns, 0 cut short, up to 0.07973 thick\nat (1.25, -3.5)";
  for (const float width : {40.0f, 90.0f, 133.0f, 250.0f, 1000.0f}) {
    CAPTURE(width);
    const std::string broken = ui::with_line_breaks(text, width);
    REQUIRE(broken.size() == text.size());
    for (std::size_t k = 0; k < text.size(); ++k)
      CHECK((broken[k] == text[k] || (broken[k] == '\n' && text[k] == ' ')));
    CHECK(broken.find("0.07973") != std::string::npos);
    std::istringstream lines(broken);
    for (std::string line; std::getline(lines, line);) {
      const bool one_word = line.find(' ') == std::string::npos;
      CHECK((one_word || ImGui::CalcTextSize(line.c_str()).x <= width));
    }
  }
  const std::string wide = ui::with_line_breaks(text, 1000);
  CHECK(wide == text);
  CHECK(std::ranges::count(ui::with_line_breaks(text, 133), '\n') > 2);
}

}  // namespace winslow::gui::test
