#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "gui/document/session/session.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

TEST_CASE("the progress of a motion is told as its share") {
  Rig rig;
  rig.open(ring_mesh(120, 30));
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{150, Vec2(0, 0), Vec2(0.3, 0)}});
  std::set<std::string> told;
  REQUIRE(rig.wait([&] {
    if (!rig.session().job().active()) return true;
    const std::string text = activity_of(rig.session()).text;
    const auto history = rig.session().mesh().convergence();
    const long percent = std::lround(history.empty() ? 0 : 100 * history.back().fraction);
    CHECK(text.find(": " + std::to_string(percent) + " % of the motion") != text.npos);
    told.insert(text);
    return false;
  }));
  CHECK(told.size() > 2);
  rig.bench->apply(action::Scramble{1});
  rig.bench->apply(action::RunSmooth{});
  rig.wait([&] {
    if (!rig.session().job().active()) return true;
    CHECK(activity_of(rig.session()).text.find("of the motion") == std::string::npos);
    return false;
  });
}

}  // namespace winslow::gui::test
