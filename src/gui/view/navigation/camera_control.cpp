#include "gui/view/navigation/camera_control.h"

#include <algorithm>
#include <vector>

#include "gui/render/space/space_view.h"
#include "gui/view/navigation/go_to.h"

namespace winslow::gui {

void PlaneControl::begin(ViewOptions& /*options*/) {
  const Mesh& mesh = session_.document()->state().mesh;
  const Bounds all = bounds(mesh);
  if (const std::vector<Index> holes = body_nodes(); !holes.empty()) {
    const Bounds bodies = bounds(mesh.coordinates, holes);
    // With a far field of a hundred chords the bodies would be a dot.
    if (bodies.size().maxCoeff() < 0.15 * all.size().maxCoeff()) {
      const Vec2 room = Vec2::Constant(0.6 * bodies.size().maxCoeff());
      return view_.camera().fit({bodies.min - room, bodies.max + room});
    }
  }
  view_.camera().fit(all);
}

void PlaneControl::fit_all() {
  view_.camera().fit(bounds(Mesh{session_.topology(), session_.coordinates()}));
}

void PlaneControl::fit_bodies() {
  const std::vector<Index> nodes = body_nodes();
  if (!nodes.empty()) view_.camera().fit(bounds(session_.coordinates(), nodes), 0.1);
}

void PlaneControl::fit_markers(std::span<const Index> markers) {
  std::vector<Index> nodes;
  for (const Index m : markers) {
    if (m < 0 || static_cast<std::size_t>(m) >= session_.topology()->markers().size()) continue;
    const auto of_marker = session_.topology()->markers().nodes(m);
    nodes.insert(nodes.end(), of_marker.begin(), of_marker.end());
  }
  if (!nodes.empty()) view_.camera().fit(bounds(session_.coordinates(), nodes), 0.2);
}

void PlaneControl::go_to(const MeshItem& item, const std::optional<ScreenBox>& card) {
  const Bounds box = surroundings(item, session_);
  look_around(box.centre(), 4 * box.size().norm(), card);
}

bool PlaneControl::sees(Index node) const {
  const ScreenVector pixel =
      camera().to_screen(session_.coordinates().xy(node)) - camera().viewport_origin();
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera().viewport_width() &&
         pixel.y() <= camera().viewport_height();
}

void PlaneControl::look_around(const Vec2& point, double radius,
                               const std::optional<ScreenBox>& card) {
  const Vec2 half = Vec2::Constant(radius);
  view_.camera().fit({point - half, point + half});
  if (card) look_above(view_.camera(), *card);
}

/// Of all holes.
std::vector<Index> PlaneControl::body_nodes() const {
  std::vector<Index> nodes;
  if (!session_.mesh().boundary()) return nodes;
  for (const auto& body : session_.mesh().boundary()->bodies())
    if (body.hole) nodes.insert(nodes.end(), body.nodes.begin(), body.nodes.end());
  return nodes;
}

void look_above(Camera& camera, const ScreenBox& card) {
  const ScreenPoint origin = camera.viewport_origin();
  const double width = camera.viewport_width(), height = camera.viewport_height();
  const double free = card.min.y() - origin.y();
  if (card.max.x() < origin.x() + width / 2 || free < height / 4) return;
  const double unit = camera.units_per_pixel() * std::min(width, height) / std::min(width, free);
  camera.look_at(camera.centre() - Vec2(0, (height - free) / 2 * unit), unit);
}

void look_above(SpaceCamera& camera, const ScreenBox& card) {
  const ScreenBox view = camera.viewport();
  const ScreenVector size = view.size();
  const double free = card.min.y() - view.min.y();
  if (card.max.x() < view.min.x() + size.x() / 2 || free < size.y() / 4) return;
  const double unit =
      camera.units_per_pixel() * std::min(size.x(), size.y()) / std::min(size.x(), free);
  camera.look_at(camera.centre() - (size.y() - free) / 2 * unit * camera.up(), unit);
}

}  // namespace winslow::gui
