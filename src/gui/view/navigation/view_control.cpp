#include "gui/view/navigation/view_control.h"

#include "gui/view/mesh/mesh_colors.h"
#include "gui/view/mesh/volume_layer.h"
#include "gui/view/navigation/go_to.h"

namespace winslow::gui {

namespace {

/// Replaces a field by the same metric for meshes of a kind, or by the one that all kinds have.
void suit_field(std::optional<ElementField>& field, MeshKind kind) {
  const std::vector<ElementField>& all = all_element_fields(kind);
  if (!field || std::ranges::find(all, *field) != all.end()) return;
  const auto same = std::ranges::find_if(
      all, [&](const ElementField& f) { return field_info(f).name == field_info(*field).name; });
  field = same != all.end() ? *same
                            : ElementField(Metric::normalized_jacobian, cell_dimension_of(kind));
}

void suit_fields(ViewOptions& options, MeshKind kind) {
  const std::optional<ElementField> before = options.color;
  suit_field(options.color, kind);
  suit_field(options.worst_by, kind);
  if (!options.color || options.color == before) return;
  // These were chosen for the values of the previous field.
  options.range.reset();
  options.isolation = isolation_for(*options.color);
}

}  // namespace

bool ViewControl::begin_frame(double x, double y, double width, double height) {
  navigator_.set_viewport({{x, y}, {x + width, y + height}});
  const bool another = look_at_another();
  navigator_.camera_control().update(options_);
  if (session_.kind() == MeshKind::volume) suit_peel();
  state_.can_go_back = navigator_.can_go_back();
  state_.can_go_forward = navigator_.can_go_forward();
  return another;
}

bool ViewControl::look_at_another() {
  if (generation_ == session_.generation()) return false;
  generation_ = session_.generation();
  navigator_.leave_mesh();
  const ColumnState columns = state_.columns;
  state_ = ViewState();
  state_.columns = columns;
  options_.magnifier.pin.reset();
  // Markers hidden in one mesh must not be missing in another that has markers of the same names.
  if (const Document* document = session_.document()) {
    const std::string file = document->source().path.string();
    if (options_.markers.mesh != file) options_.markers = {file, {}};
    suit_fields(options_, session_.kind());
  }
  navigator_.begin_mesh();
  return true;
}

/// Makes the peeled marker one that exists; at first that of a body.
void ViewControl::suit_peel() {
  const Topology& topology = *session_.topology();
  std::string& marker = options_.space.peel.marker;
  if (topology.markers().empty() || topology.markers().find(marker)) return;
  const VolumeBoundary& boundary = *session_.document()->boundary();
  std::size_t chosen = 0;
  for (std::size_t f = boundary.faces.size(); f-- > 0;)
    if (boundary.enclosing[f] == 0 && boundary.faces[f].marker >= 0)
      chosen = at(boundary.faces[f].marker);
  marker = topology.markers()[chosen].name;
}

void ViewControl::set_mouse(const std::optional<ScreenPoint>& mouse,
                            const std::optional<SeenPlace>& seen) {
  mouse_ = mouse;
  const LookedAt now = navigator_.looked_at();
  state_.pixel = now.units_per_pixel;
  state_.seen = seen;
  state_.looks_from = now.direction;
  // In space, a place on screen has no unique point; the visible item there has one.
  state_.cursor = mouse && !now.direction ? std::optional(camera().to_world(*mouse)) : std::nullopt;
}

void ViewControl::move_divider(double by) {
  options_.divider = std::clamp(options_.divider + by, 0.02, 0.98);
}

void ViewControl::release_magnifier() {
  if (!options_.magnifier.pin) options_.magnifier.on = false;
}

void ViewControl::on(const action::EditView& a) {
  const double before = options_.scale;
  a.edit.apply_to(options_);
  const bool scaled = options_.scale != before && options_.scale > 0;
  const float fits = scale_.of(options_.scale);
  if (!scaled || static_cast<double>(fits) >= options_.scale - 1e-3) return;
  session_.messages().tell(
      Notice::Kind::information,
      "This window has room for " + std::to_string(std::lround(100 * fits)) + " % only");
}

void ViewControl::on(const action::StepScale& a) {
  if (a.by == 0) {
    options_.scale = 0;
    return;
  }
  const auto tell = [&](const char* text) {
    session_.messages().tell(Notice::Kind::information, text);
  };
  const auto now = static_cast<double>(scale_.of(options_.scale));
  const auto up = std::ranges::find_if(scales, [&](double s) { return s > now + 1e-3; });
  const auto here = std::ranges::find_if(scales, [&](double s) { return s > now - 1e-3; });
  if (a.by < 0) {
    if (here == scales.begin()) return tell("The interface is as small as it gets");
    options_.scale = *(here - 1);
    return;
  }
  if (up == scales.end()) return tell("The interface is as large as it gets");
  if (static_cast<double>(scale_.fitting(*up)) < *up - 1e-3)
    return tell("This window has no room for a larger interface");
  options_.scale = *up;
}

void ViewControl::on(const action::InspectNode& a) {
  session_.apply(action::SelectNode{a.node});
  if (!a.node) return;
  options_.side_tab = SideTab::vcv;
  open_right(options_, state_.columns);
  // A typed number may belong to a node that is out of view.
  if (session_.nodes().inspected() != a.node) return;
  const bool seen = navigator_.camera_control().sees(*a.node);
  on(action::GoTo{MeshItem{MeshItem::Kind::node, *a.node}, !seen});
}

void ViewControl::on(const action::AddCut& a) {
  if (session_.kind() != MeshKind::volume || options_.space.cuts.size() >= most_cuts) return;
  state_.cut = options_.space.cuts.size();
  options_.space.cuts.push_back(cut_through(a.point, a.normal));
}

void ViewControl::on(const action::AddCutAcrossView&) {
  if (session_.kind() != MeshKind::volume) return;
  const SpaceCamera& camera = space().view();
  Index axis = 0;
  camera.back().cwiseAbs().maxCoeff(&axis);
  const Vec3 normal = (camera.back()[axis] < 0 ? -1 : 1) * Vec3::Unit(axis);
  const Box<3> mesh = space_bounds(Mesh{session_.topology(), session_.coordinates()});
  const Vec3 middle = camera.centre().cwiseMax(mesh.min).cwiseMin(mesh.max);
  on(action::AddCut{middle, normal});
}

void ViewControl::on(const action::ShowLook& a) {
  if (!view().turns()) return;
  options_.space.cuts = a.look.cuts;
  options_.space.peel.on = false;
  options_.space.up = a.look.up;
  state_.cut.reset();
  navigator_.show(a.look);
}

void ViewControl::on(const action::BoxZoom&) {
  state_.box_zoom_armed = session_.document() && !state_.box_zoom_armed;
}

void ViewControl::on(const action::GoTo& a) {
  if (a.item && !exists(*a.item, session_)) return;
  state_.focus = a.item;
  if (a.item && a.centre) navigator_.go_to(*a.item);
}

void ViewControl::on(const action::AskGoTo&) {
  if (!session_.document()) return;
  open_right(options_, state_.columns);
  options_.side_tab = SideTab::quality;
  state_.go_to_wanted = true;
}

void ViewControl::on(const action::PinMagnifier&) {
  if (!session_.document() || view().turns()) return;
  if (options_.magnifier.on && options_.magnifier.pin) {
    options_.magnifier.pin.reset();
    options_.magnifier.on = false;
    return;
  }
  const Vec2 place = mouse_ ? camera().to_world(*mouse_) : camera().centre();
  options_.magnifier.on = true;
  options_.magnifier.pin = {{place.x(), place.y()}};
}

}  // namespace winslow::gui
