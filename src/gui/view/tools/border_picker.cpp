#include "gui/view/tools/border_picker.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/mesh/surface_faces.h"

namespace winslow::gui {

namespace {

struct OnBorder {
  double distance = std::numeric_limits<double>::infinity();  // pixels
  Index marker = -1;
  std::array<Index, 2> edge{};
  Vec3 point{0, 0, 0};
};

/// The nearest place of an edge, if it is nearer than what was found.
void take_nearer(OnBorder& best, const ScreenPoint& at, Index marker,
                 const std::array<Index, 2>& edge, const SpacePoints& x, const SpaceView& view) {
  const Vec3 a = x[edge[0]], b = x[edge[1]];
  const ScreenPoint from = view.project(a).at;
  const ScreenVector along = view.project(b).at - from, way = at - from;
  const double squared = along.x() * along.x() + along.y() * along.y();
  const double share =
      squared > 0 ? std::clamp((way.x() * along.x() + way.y() * along.y()) / squared, 0.0, 1.0) : 0;
  const double distance = (from + along * share - at).norm();
  if (distance < best.distance) best = {distance, marker, edge, a + share * (b - a)};
}

/// No surface lies before it.
bool is_seen(const Vec3& point, const VolumeView& picture, const SpaceView& view) {
  constexpr double slack = 6;  // pixels: the surface is nowhere nearer to its border
  const View::Projection there = view.project(point);
  const auto hit = picture.pick(view, there.at);
  return !hit || view.project(hit->point).depth > there.depth - slack * view.pixel_size(point);
}

Index element_at(const Topology& topology, const std::array<Index, 2>& edge) {
  for (const Index e : topology.star(edge[0]))
    if (std::ranges::find(topology.element(e), edge[1]) != topology.element(e).end()) return e;
  return -1;
}

}  // namespace

std::optional<SeenPlace> seen_border(const ScreenPoint& at, double reach, const VolumeView& picture,
                                     const SpaceView& view, const MarkerLooks& looks) {
  const Mesh* mesh = picture.mesh();
  if (!mesh || !is_surface(*mesh->topology)) return std::nullopt;
  const Topology& topology = *mesh->topology;
  const SpacePoints x(mesh->coordinates);
  OnBorder best;
  for (std::size_t m = 0; m < topology.markers().size(); ++m) {
    const Marker& marker = topology.markers()[m];
    if (looks.of(marker.name).hidden) continue;
    for (const Face& face : marker.faces)
      take_nearer(best, at, static_cast<Index>(m), face.edge(), x, view);
  }
  if (best.marker < 0 || best.distance > reach || !is_seen(best.point, picture, view))
    return std::nullopt;
  const Index element = element_at(topology, best.edge);
  if (element < 0) return std::nullopt;
  Vec3 normal = area_vector(x, Face(topology.element(element))).normalized();
  if (normal.dot(view.unproject(at).direction) > 0) normal = -normal;
  return SeenPlace{best.point, normal, element, best.marker, {}};
}

}  // namespace winslow::gui
