#include "gui/panels/panels.h"

#include "core/inspect/space/surface_measures.h"
#include "gui/base/text.h"
#include "gui/menu/bodies.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

std::string number_text(double value) { return formatted(value == 0 ? 0.0 : value, "%.6g"); }

std::string vector_text(const Vec3& v, double unit) {
  std::string text;
  for (Index k = 0; k < 3; ++k)
    text += (k > 0 ? ", " : "") + number_text(std::abs(v[k]) < 1e-9 * unit ? 0.0 : v[k]);
  return text;
}

/// Areas and volumes of the open mesh in space: total, of markers, of the selected surface, and of
/// isolated elements.
class MeasuresPanel {
 public:
  void draw(const PanelContext& context) {
    if (!ui::section("section/measures", "Areas and volumes")) return;
    measure(context.session);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                        ImVec2(context.theme.px(8), context.theme.px(4)));
    const bool surface = context.session.kind() == MeshKind::surface;
    if (surface) {
      draw_surface();
    } else {
      ui::figure("Volume of the mesh", number_text(volume_),
                 "Of all elements, in cubed units of the mesh.");
      ui::note("measures/volume");
    }
    if (context.shown && context.shown->alone) {
      const ShownAlone& alone = *context.shown->alone;
      ui::figure("Shown alone", counted(alone.count, "element"),
                 "Elements that are isolated, or of the layers at a marker that are shown.");
      ui::figure(surface ? "  their area" : "  their volume", number_text(alone.size),
                 surface ? "In squared units of the mesh." : "In cubed units of the mesh.");
      ui::note("measures/alone");
    }
    if (!surface) {
      draw_selection(context);
      draw_markers(context);
    }
    ImGui::PopStyleVar();
  }

 private:
  void measure(const Session& session) {
    const std::vector<Index>& selected = session.selection().markers();
    const bool same = known_ && generation_ == session.generation() && shape_ == session.shape();
    if (same && selected_ == selected) return;
    const VolumeBoundary& boundary = *session.document()->boundary();
    const SpacePoints x(session.coordinates());
    if (!same && session.kind() == MeshKind::surface) {
      const SurfaceMeasures whole = measure_surface(x, boundary.faces);
      area_ = whole.area;
      encloses_ = whole.volume;
    } else if (!same) {
      volume_ = mesh_volume(x, boundary.faces);
      areas_.assign(session.topology()->markers().size(), 0);
      for (const SurfaceFace& face : boundary.faces)
        if (face.marker >= 0) areas_[at(face.marker)] += face_area(x, face.nodes);
    }
    selection_ = measure_surface(x, faces_of_markers(boundary.faces, selected));
    known_ = true;
    generation_ = session.generation();
    shape_ = session.shape();
    selected_ = selected;
  }

  void draw_surface() const {
    ui::figure("Area", number_text(area_), "Of all elements, in squared units of the mesh.");
    ui::note("measures/area");
    if (!encloses_) return ui::text_dim("The surface is open: it encloses no volume.");
    ui::figure("Encloses", number_text(*encloses_),
               "Volume inside the surface, in cubed units of the mesh; negative where its "
               "elements face inwards.");
    ui::note("measures/encloses");
  }

  void draw_selection(const PanelContext& context) const {
    if (selected_.empty()) return ui::text_dim("Select markers to measure their surface.");
    ImGui::BeginGroup();
    ui::figure("Selected", names_of(context, selected_),
               "The markers that are selected, taken together.");
    ui::figure("  area", number_text(selection_.area), "In squared units of the mesh.");
    const double size = selection_.centroid.norm() + std::sqrt(selection_.area);
    ui::figure("  centroid", vector_text(selection_.centroid, size), "Of the area.");
    if (selection_.volume) {
      ui::figure("  encloses", number_text(*selection_.volume),
                 "Volume inside the surface, in cubed units of the mesh. It is closed.");
    } else {
      ui::figure(
          "  area vector", vector_text(selection_.area_vector, selection_.area),
          "Sum of the faces' area vectors, out of the mesh: its components are the areas of the "
          "surface's projections along the axes. It would be 0 if the surface were closed.");
    }
    ImGui::EndGroup();
    ui::note("measures/selection");
  }

  void draw_markers(const PanelContext& context) const {
    const auto& markers = context.topology()->markers();
    if (areas_.size() != markers.size()) return;
    ImGui::BeginGroup();
    double sum = 0;
    for (const double area : areas_) sum += area;
    ui::figure("Area of markers", number_text(sum), "In squared units of the mesh.");
    for (std::size_t m = 0; m < markers.size(); ++m) {
      const std::string area = number_text(areas_[m]);
      const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(area.c_str()).x -
                         2 * ImGui::GetFontSize();
      ui::figure("  " + ui::elided(markers[m].name, room), area, "Area of this marker.");
    }
    ImGui::EndGroup();
    ui::note("measures/markers");
  }

  // State for which the numbers are valid.
  std::uint64_t generation_ = 0, shape_ = 0;
  std::vector<Index> selected_;
  bool known_ = false;
  double area_ = 0;  // of a surface mesh
  std::optional<double> encloses_;
  double volume_ = 0;
  std::vector<double> areas_;  // of markers
  SurfaceMeasures selection_;
};

}  // namespace

DrawPanel measures_panel() { return panel_of<MeasuresPanel>(); }

}  // namespace winslow::gui
