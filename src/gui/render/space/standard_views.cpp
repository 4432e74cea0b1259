#include "gui/render/space/standard_views.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace winslow::gui {

namespace {

/// Three quarters from ahead: x to the right.
ViewDirection three_quarters(int up) { return {up == 1 ? 24.0 : -66.0, 22, up}; }

/// To a power of ten that is at most `most`: a number to be read.
double rounded(double value, double most) {
  if (!(most > 0)) return value;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return power * std::round(value / power);
}

constexpr double aside = 24;  // degrees by which one looks past a cut's normal

}  // namespace

const std::vector<std::string>& view_names() {
  static const std::vector<std::string> names{"iso", "+x", "-x", "+y", "-y", "+z", "-z"};
  return names;
}

ViewDirection named_view(const std::string& name, int up) {
  if (name == "iso") return {up == 1 ? 45.0 : -45.0, degrees(std::atan(std::sqrt(0.5))), up};
  const auto found = std::ranges::find(view_names(), name);
  if (found == view_names().end()) {
    std::string list;
    for (const std::string& known : view_names()) list += (list.empty() ? "" : ", ") + known;
    throw UsageError("found \"" + name + "\", expected one of " + list);
  }
  return direction_towards((name[0] == '-' ? -1 : 1) * Vec3::Unit(name[1] - 'x'), up);
}

ViewDirection automatic_view(const std::vector<Plane>& cuts, int up) {
  if (cuts.empty()) return three_quarters(up);
  Vec3 normal = Vec3::Zero();
  for (const Plane& cut : cuts) normal += cut.normal();
  if (normal.norm() < 1e-6) normal = cuts.front().normal();
  ViewDirection view = direction_towards(normal, up);
  // Several cuts are seen best from between their normals.
  if (cuts.size() > 1) return {view.azimuth, std::clamp(view.elevation, -80.0, 80.0), up};
  constexpr double steep = 40;  // from there on towards the horizon, not away from it
  view.azimuth += aside;
  if (std::abs(view.elevation) > steep)
    view.elevation -= std::copysign(35.0, view.elevation);
  else
    view.elevation += three_quarters(up).elevation;
  return view;
}

std::vector<Plane> automatic_cuts(const Mesh& mesh, const VolumeBoundary& boundary,
                                  const ViewDirection& view) {
  if (!boundary.encloses) return {};
  const SpacePoints x(mesh.coordinates);
  Box<3> bodies = Box<3>::empty();
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    if (boundary.enclosing[f] != 0) continue;
    for (const Index node : boundary.faces[f].nodes) bodies.add(x[node]);
  }
  const Vec3 to = to_viewer(view);
  Index axis = 0;
  to.cwiseAbs().maxCoeff(&axis);
  Vec3 normal = Vec3::Zero();
  normal[axis] = to[axis] < 0 ? -1 : 1;
  Vec3 middle = bodies.centre();
  middle[axis] = rounded(middle[axis], 0.02 * bodies.size()[axis]);
  return {Plane(middle, normal)};
}

}  // namespace winslow::gui
