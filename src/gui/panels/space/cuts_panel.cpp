#include "gui/panels/panels.h"

#include "core/search/box_tree.h"
#include "gui/base/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr float cut_label_share = 0.26f;

Vec3 vector_of(const std::array<double, 3>& a) { return Vec3(a.data()); }

void put(std::array<double, 3>& to, const Vec3& from) {
  for (Index k = 0; k < 3; ++k) to[at(k)] = from[k];
}

/// The name of the axis that the normal points along: "+x"; empty: none.
std::string axis_of(const CutPlane& cut) {
  const Vec3 n = vector_of(cut.normal).normalized();
  for (Index k = 0; k < 3; ++k)
    if (std::abs(n[k]) > 1 - 1e-9) return std::string(n[k] > 0 ? "+" : "-") + "xyz"[k];
  return {};
}

std::string title_of(const CutPlane& cut, std::size_t k) {
  const std::string axis = axis_of(cut);
  std::string text = "Cut " + std::to_string(k + 1);
  if (axis.empty()) return text + ", aslant";
  const double place = cut.point[static_cast<std::size_t>(axis[1] - 'x')];
  return text + ", " + axis[1] + " = " + formatted(place + 0.0, "%.5g");  // no -0
}

/// The range of a box's offsets along the normal.
std::array<double, 2> span_of(const Box<3>& box, const Vec3& normal) {
  std::array<double, 2> span{std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::lowest()};
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 p = box.min;
    for (Index k = 0; k < 3; ++k)
      if ((corner >> static_cast<unsigned>(k) & 1U) != 0) p[k] = box.max[k];
    const double d = normal.dot(p);
    span = {std::min(span[0], d), std::max(span[1], d)};
  }
  return span;
}

/// The list of cutting planes of a volume mesh.
class CutsPanel {
 public:
  void draw(const PanelContext& context) {
    if (!ui::section("section/cuts", "Cuts")) return;
    measure(context.session.mesh());
    ViewOptions view = context.view;
    draw_rows(context, view);
    const auto& held = context.view_state.cut;
    if (held && *held < view.space.cuts.size()) draw_place(view, *held);
    draw_buttons(context, view);
    ui::checkbox("cuts/crinkle", "Whole elements", view.space.crinkle,
                 "Cuts leave whole elements: those of which some part lies behind every cut (K).");
    draw_peel(context, view.space.peel);
    context.edit(view);
  }

 private:
  void measure(const LiveMesh& mesh) {
    if (generation_ == mesh.generation() && shape_ == mesh.shape()) return;
    generation_ = mesh.generation();
    shape_ = mesh.shape();
    extents_ = space_bounds(*mesh.shared());
  }

  void draw_rows(const PanelContext& context, ViewOptions& view) {
    auto& cuts = view.space.cuts;
    const float side = ImGui::GetFrameHeight();
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    std::optional<std::size_t> gone;
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const std::string id = "cuts/" + std::to_string(k);
      ui::checkbox(id + "/on", "", cuts[k].on, "The cut is there, or kept for later.");
      ImGui::SameLine(0, gap);
      const bool held = context.view_state.cut == k;
      const float width = ImGui::GetContentRegionAvail().x - side - gap;
      const bool pressed =
          ui::button(id + "/hold", title_of(cuts[k], k),
                     {"Show its numbers, and its handle in the picture: drag the arrow to move the "
                      "cut, its ball to turn it.",
                      held ? ui::ButtonStyle::primary : ui::ButtonStyle::normal, true, width});
      if (pressed)
        context.emit(action::HoldCut{held ? std::nullopt : std::optional<std::size_t>(k)});
      ImGui::SameLine(0, gap);
      if (ui::button(id + "/remove", "x",
                     {"Take this cut away.", ui::ButtonStyle::normal, true, side}))
        gone = k;
    }
    if (!gone) return;
    cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(*gone));
    context.emit(action::HoldCut{});
  }

  void draw_place(ViewOptions& view, std::size_t k) const {
    CutPlane& cut = view.space.cuts[k];
    std::vector<std::string> names{"+x", "-x", "+y", "-y", "+z", "-z"};
    const auto now = std::ranges::find(names, axis_of(cut));
    auto chosen = static_cast<std::size_t>(now - names.begin());
    if (now == names.end()) names.emplace_back("As typed or turned");
    if (ui::choice("cuts/axis", "Normal", names, chosen, "What the normal points to is taken away.",
                   cut_label_share) &&
        chosen < 6)
      put(cut.normal, (chosen % 2 == 0 ? 1 : -1) * Vec3::Unit(static_cast<Index>(chosen / 2)));
    Vec3 normal = vector_of(cut.normal);
    if (ui::space_vector_field({"cuts/normal", "normal of the plane, of any length but 0."},
                               normal) &&
        normal.allFinite() && normal.norm() > 0)
      put(cut.normal, normal);
    Vec3 point = vector_of(cut.point);
    ui::text_dim("Point");
    ui::tooltip("A point of the plane.");
    if (ui::space_vector_field({"cuts/point", "of a point of the plane."}, point) &&
        point.allFinite())
      put(cut.point, point);
    const Vec3 unit = vector_of(cut.normal).normalized();
    const auto [low, high] = span_of(extents_, unit);
    const double offset = unit.dot(vector_of(cut.point));
    auto share = static_cast<float>(100 * (offset - low) / (high - low));
    ui::row("Position", "From one end of the mesh to the other, along the normal.",
            cut_label_share);
    if (ImGui::SliderFloat("##cuts/position", &share, 0, 100, ""))
      put(cut.point, vector_of(cut.point) +
                         (low + 0.01 * static_cast<double>(share) * (high - low) - offset) * unit);
    ui::note("cuts/position");
  }

  static void draw_peel(const PanelContext& context, Peel& peel) {
    const auto& markers = context.topology()->markers();
    if (markers.empty()) return;
    ui::checkbox(
        "peel/on", "Layers at a marker", peel.on,
        "Show only the elements that lie so many layers deep below a marker: layer 1 has a node of "
        "it, layer 2 lies beside layer 1, and so on. Cuts then leave whole elements.");
    if (!peel.on) return;
    std::vector<std::string> names;
    std::size_t chosen = 0;
    for (const Marker& marker : markers) {
      if (marker.name == peel.marker) chosen = names.size();
      names.push_back(marker.name);
    }
    if (ui::choice("peel/marker", "Marker", names, chosen, "From where the layers are counted.",
                   cut_label_share))
      peel.marker = names[chosen];
    constexpr const char* layers_tip =
        "The first layer that is shown, and the last. 1 to 3: the three at the marker; 4 to 6: "
        "without the first three.";
    ui::row("Layers", layers_tip, cut_label_share);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    ImGui::SetNextItemWidth(width);
    if (ui::number("peel/from", peel.from, layers_tip)) peel.to = std::max(peel.to, peel.from);
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(width);
    if (ui::number("peel/to", peel.to, layers_tip)) peel.from = std::min(peel.from, peel.to);
    peel.from = std::max(peel.from, 1);
    peel.to = std::max(peel.to, 1);
  }

  void draw_buttons(const PanelContext& context, ViewOptions& view) const {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    const bool room = view.space.cuts.size() < most_cuts;
    if (ui::button("cuts/add", "Add a cut",
                   {room ? "Through the middle of the mesh, across z. A right click on a face cuts "
                           "along it."
                         : "There are six cuts: take one away first.",
                    ui::ButtonStyle::normal, room, width}))
      context.emit(action::AddCut{extents_.centre(), Vec3(0, 0, 1)});
    ImGui::SameLine(0, gap);
    const auto& held = context.view_state.cut;
    const bool can = held && *held < view.space.cuts.size();
    if (ui::button("cuts/flip", "Flip",
                   {"Take away the other side of the cut that is chosen.", ui::ButtonStyle::normal,
                    can, -1}))
      put(view.space.cuts[*held].normal, -vector_of(view.space.cuts[*held].normal));
  }

  Box<3> extents_;                            // of the mesh
  std::uint64_t generation_ = 0, shape_ = 0;  // for which they are valid
};

}  // namespace

DrawPanel cuts_panel() { return panel_of<CutsPanel>(); }

}  // namespace winslow::gui
