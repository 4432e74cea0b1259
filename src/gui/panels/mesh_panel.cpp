#include "gui/panels/panels.h"

#include <cstdio>

#include "core/mesh/element_type.h"
#include "gui/base/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// "triangles", "tetrahedra"
std::string plural_of(ElementType type) {
  std::string name(shape_of(type).name);
  constexpr std::string_view greek = "hedron";
  if (name.ends_with(greek)) return name.substr(0, name.size() - 2) + "a";
  return name + "s";
}

/// Properties of the open mesh: extents, numbers of nodes and of elements by type, edges by marker.
class MeshPanel {
 public:
  void draw(const PanelContext& context) {
    if (!ui::section("section/mesh", "Mesh")) return;
    if (!context.session.document()) return ui::text_dim("No mesh is open.");
    count(context.session.topology());
    measure(context.session.mesh());
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                        ImVec2(context.theme.px(8), context.theme.px(4)));
    draw_sizes(context);
    draw_markers(context);
    ImGui::PopStyleVar();
  }

 private:
  void count(const std::shared_ptr<const Topology>& topology) {
    if (counts_.topology == topology) return;
    counts_ = {.topology = topology};
    for (Index e = 0; e < topology->element_count(); ++e)
      ++counts_.of_type[static_cast<std::size_t>(topology->element_type(e))];
    for (Index i = 0; i < topology->node_count(); ++i) {
      if (!topology->used(i))
        ++counts_.unused_nodes;
      else if (topology->on_boundary(i))
        ++counts_.boundary_nodes;
    }
  }

  void measure(const LiveMesh& live) {
    if (generation_ == live.generation() && shape_ == live.shape()) return;
    generation_ = live.generation();
    shape_ = live.shape();
    const Topology& topology = *live.topology();
    extents_ = Box<3>::empty();
    for (Index i = 0; i < topology.node_count(); ++i)
      if (topology.used(i)) extents_.add(place_of(live.coordinates(), i));
  }

  void draw_sizes(const PanelContext& context) const {
    const Vec3 size = extents_.size();
    std::string sizes;
    ImGui::BeginGroup();
    for (Index k = 0; k < context.session.coordinates().dimension(); ++k) {
      ui::figure(std::string(1, "xyz"[k]),
                 formatted(extents_.min[k], "%.6g") + " to " + formatted(extents_.max[k], "%.6g"),
                 "Extent of the mesh, in its own units.");
      sizes += (k > 0 ? " by " : "") + formatted(size[k], "%.6g");
    }
    ui::figure("Size", sizes, "Extents along the axes.");
    ImGui::EndGroup();
    ui::note("mesh/extents");
    ImGui::BeginGroup();
    const Topology& topology = *context.topology();
    ui::figure("Nodes", grouped(topology.node_count()), "All nodes of the mesh.");
    ui::figure("  on the boundary", grouped(counts_.boundary_nodes),
               context.session.kind() == MeshKind::volume ? "Nodes of boundary faces."
                                                          : "Nodes of boundary edges.");
    if (counts_.unused_nodes > 0)
      ui::figure("  unused", grouped(counts_.unused_nodes), "Nodes that no element has.");
    ui::figure("Elements", grouped(topology.element_count()), "All elements of the mesh.");
    for (std::size_t type = 0; type < element_type_count; ++type) {
      const Index count = counts_.of_type[type];
      if (count == 0) continue;
      ui::figure("  " + plural_of(static_cast<ElementType>(type)), grouped(count),
                 "Elements of this kind.");
    }
    ImGui::EndGroup();
    ui::note("mesh/counts");
  }

  static void draw_markers(const PanelContext& context) {
    const Topology& topology = *context.topology();
    const auto& markers = topology.markers();
    if (markers.empty()) return;
    const bool faces = context.session.kind() == MeshKind::volume;
    std::size_t edges = 0;
    ImGui::BeginGroup();
    for (std::size_t m = 0; m < markers.size(); ++m) edges += markers[m].faces.size();
    ui::figure(faces ? "Faces of markers" : "Edges of markers",
               grouped(static_cast<long long>(edges)),
               faces ? "Boundary faces that a marker names, in all."
                     : "Boundary edges that a marker names, in all.");
    for (std::size_t m = 0; m < markers.size(); ++m) {
      const std::string count = grouped(static_cast<long long>(markers[m].faces.size()));
      const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(count.c_str()).x -
                         2 * ImGui::GetFontSize();
      ui::figure("  " + ui::elided(markers[m].name, room), count,
                 faces ? "Faces of this marker." : "Edges of this marker.");
    }
    ImGui::EndGroup();
    ui::note("mesh/markers");
  }

  /// Counts for one connectivity.
  struct Counts {
    std::shared_ptr<const Topology> topology;
    std::array<Index, element_type_count> of_type{};
    Index boundary_nodes = 0, unused_nodes = 0;
  };
  Counts counts_;
  Box<3> extents_;           // z = 0 in the plane
  std::uint64_t shape_ = 0;  // shape of the extents
  std::uint64_t generation_ = 0;
};

}  // namespace

/// Draws the choice of a zone, for files with several zones only.
void draw_zone(const PanelContext& context) {
  if (!context.session.document()) return;
  const Document& document = *context.session.document();
  const auto zones = document.source().zones();
  if (zones.size() < 2) return;
  std::vector<std::string> names;
  std::size_t chosen = 0;
  for (const int zone : zones) {
    if (zone == document.source().zone()) chosen = names.size();
    names.push_back(std::to_string(zone) + " of " + std::to_string(zones.size()));
  }
  if (ui::choice("mesh/zone", "Zone", names, chosen,
                 "The file holds several meshes, zones: choose which one is open. Saving into a "
                 "file of the same format keeps the others as they are.")) {
    io::ReadOptions reading = document.source().reading;
    reading.zone = zones[chosen];
    context.emit(action::OpenMesh{zone_file(document.source(), document.saved()), false, reading});
  }
}

DrawPanel mesh_panel() { return panel_of<MeshPanel>(); }

}  // namespace winslow::gui
