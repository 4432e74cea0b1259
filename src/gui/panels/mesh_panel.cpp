#include "gui/panels/mesh_panel.h"

#include <cstdio>

#include "gui/base/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

std::string extent_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

/// A name at the left, what belongs to it at the right.
void line(const std::string& name, const std::string& value, const char* tip) {
  ui::text_dim(name);
  ui::tooltip(tip);
  ImGui::SameLine();
  const float room = ImGui::GetContentRegionAvail().x;
  ui::text_right(ui::elided(value, room), palette().text);
  ui::tooltip(tip);
}

/// "triangles", "tetrahedra"
std::string plural_of(ElementType type) {
  std::string name(shape_of(type).name);
  constexpr std::string_view greek = "hedron";
  if (name.ends_with(greek)) return name.substr(0, name.size() - 2) + "a";
  return name + "s";
}

}  // namespace

void ZonePanel::draw(const PanelContext& context) {
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
  constexpr const char* tip =
      "The file holds several meshes, zones: choose which one is open. Saving into a file of the "
      "same format keeps the others as they are.";
  ui::row("Zone", tip);
  if (ui::combo("mesh/zone", names, chosen, tip))
    context.emit(
        action::OpenMesh{zone_file(document.source(), document.saved()), false, zones[chosen]});
}

void MeshPanel::count(const std::shared_ptr<const Topology>& topology) {
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

void MeshPanel::measure(const LiveMesh& live) {
  if (generation_ == live.generation() && shape_ == live.shape()) return;
  generation_ = live.generation();
  shape_ = live.shape();
  const auto shared = live.shared();
  const Mesh& mesh = *shared;
  if (in_space(live)) {
    extents_ = space_bounds(mesh);
    return;
  }
  const Bounds box = bounds(mesh);
  extents_ = {{box.min.x(), box.min.y(), 0}, {box.max.x(), box.max.y(), 0}};
}

void MeshPanel::draw(const PanelContext& context) {
  if (!ui::section("section/mesh", "Mesh")) return;
  if (!context.session.document()) {
    ui::text_dim("No mesh is open.");
    return;
  }
  count(context.session.topology());
  measure(context.session.mesh());
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(context.theme.px(8), context.theme.px(4)));
  draw_sizes(context);
  draw_markers(context);
  ImGui::PopStyleVar();
}

void MeshPanel::draw_sizes(const PanelContext& context) const {
  const Vec3 size = extents_.size();
  const bool in_space = context.session.in_space();
  ImGui::BeginGroup();
  line("x", extent_text(extents_.min.x()) + " to " + extent_text(extents_.max.x()),
       "Extent of the mesh, in its own units.");
  line("y", extent_text(extents_.min.y()) + " to " + extent_text(extents_.max.y()),
       "Extent of the mesh, in its own units.");
  if (in_space)
    line("z", extent_text(extents_.min.z()) + " to " + extent_text(extents_.max.z()),
         "Extent of the mesh, in its own units.");
  std::string sizes = extent_text(size.x()) + " by " + extent_text(size.y());
  if (in_space) sizes += " by " + extent_text(size.z());
  line("Size", sizes, "Extents along the axes.");
  ImGui::EndGroup();
  ui::note("mesh/extents");
  ImGui::BeginGroup();
  const Topology& topology = *context.topology();
  line("Nodes", grouped(topology.node_count()), "All nodes of the mesh.");
  line("  on the boundary", grouped(counts_.boundary_nodes),
       context.session.kind() == MeshKind::volume ? "Nodes of boundary faces."
                                                  : "Nodes of boundary edges.");
  if (counts_.unused_nodes > 0)
    line("  unused", grouped(counts_.unused_nodes), "Nodes that no element has.");
  line("Elements", grouped(topology.element_count()), "All elements of the mesh.");
  for (const ElementType type : all_element_types) {
    const Index count = counts_.of_type[static_cast<std::size_t>(type)];
    if (count == 0) continue;
    line("  " + plural_of(type), grouped(count), "Elements of this kind.");
  }
  ImGui::EndGroup();
  ui::note("mesh/counts");
}

void MeshPanel::draw_markers(const PanelContext& context) {
  const Topology& topology = *context.topology();
  const auto& markers = topology.markers();
  if (markers.empty()) return;
  const bool faces = context.session.kind() == MeshKind::volume;
  std::size_t edges = 0;
  ImGui::BeginGroup();
  for (std::size_t m = 0; m < markers.size(); ++m) edges += markers[m].faces.size();
  line(faces ? "Faces of markers" : "Edges of markers", grouped(static_cast<long long>(edges)),
       faces ? "Boundary faces that a marker names, in all."
             : "Boundary edges that a marker names, in all.");
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const std::string count = grouped(static_cast<long long>(markers[m].faces.size()));
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(count.c_str()).x -
                       2 * ImGui::GetFontSize();
    line("  " + ui::elided(markers[m].name, room), count,
         faces ? "Faces of this marker." : "Edges of this marker.");
  }
  ImGui::EndGroup();
  ui::note("mesh/markers");
}

}  // namespace winslow::gui
