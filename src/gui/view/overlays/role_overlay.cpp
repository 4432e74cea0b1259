#include "gui/view/overlays/role_overlay.h"

#include "gui/base/text.h"
#include "gui/render/space/space_scene.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

// In the order of the key; the most important ones are drawn last.
constexpr std::array<NodeRole, node_role_count> in_order{
    NodeRole::free,       NodeRole::fixed,    NodeRole::moves,
    NodeRole::on_surface, NodeRole::on_curve, NodeRole::periodic,
    NodeRole::regions,    NodeRole::corner,   NodeRole::held};
/// Pixels at 100 % to the nearest neighbour that an inner node of a plane mesh needs for its dot:
/// closer together they would hide the mesh.
constexpr float free_room = 9;

bool shown(const ViewOptions& options, const ViewState& state) {
  return options.roles || state.roles_previewed;
}

bool has_room(const ViewOverlay& o, Index node) {
  const Coordinates& x = o.session.coordinates();
  const Vec2 p = x.xy(node);
  const double least = static_cast<double>(o.theme.px(free_room)) * o.view.pixel_size(p);
  return std::ranges::all_of(o.session.topology()->neighbours(node),
                             [&](Index other) { return (x.xy(other) - p).norm() >= least; });
}

void draw_square(ImDrawList& list, const Theme& theme, const ScreenPoint& at) {
  const auto place = static_cast<ImVec2>(at);
  const auto around = [&](float half, ImU32 color) {
    list.AddRectFilled(ImVec2(place.x - half, place.y - half),
                       ImVec2(place.x + half, place.y + half), color);
  };
  around(theme.px(4.7f), palette().card);
  around(theme.px(3.5f), color_of(NodeRole::held));
}

void draw_ring(ImDrawList& list, const Theme& theme, const ScreenPoint& at, float radius) {
  const auto place = static_cast<ImVec2>(at);
  list.AddCircle(place, radius, palette().card, 24, theme.px(3.5f));
  list.AddCircle(place, radius, palette().text, 24, theme.px(1.5f));
}

/// overridden: the options set the role.
void draw_dot(ImDrawList& list, const Theme& theme, const ScreenPoint& at, NodeRole role,
              bool overridden = false) {
  if (overridden) draw_ring(list, theme, at, theme.px(7.5f));
  if (role == NodeRole::held) return draw_square(list, theme, at);
  const bool quiet = role == NodeRole::free || role == NodeRole::fixed;
  const float radius = theme.px(quiet ? 2.2f : role == NodeRole::corner ? 4.0f : 3.0f);
  const auto place = static_cast<ImVec2>(at);
  if (!quiet) list.AddCircleFilled(place, radius + theme.px(1.2f), palette().card, 12);
  list.AddCircleFilled(place, radius, color_of(role), 10);
}

/// Draws the roles that occur, with colours and numbers of nodes, in the top left corner.
void draw_key(ImDrawList& list, const Theme& theme, const ScreenBox& room, const NodeRoles& roles) {
  ImFont& font = *theme.small;
  struct Row {
    NodeRole role;
    std::string text;
    bool ring = false;
  };
  std::vector<Row> rows;
  float wide = 0;
  for (const NodeRole role : in_order) {
    const Index count = roles.counts[static_cast<std::size_t>(role)];
    if (count == 0) continue;
    rows.push_back({role, std::string(name_of(role)) + ": " + grouped(count)});
  }
  if (!roles.overridden.empty())
    rows.push_back({NodeRole::free,
                    "Told by hand: " + grouped(static_cast<Index>(roles.overridden.size())), true});
  for (const Row& row : rows)
    wide = std::max(wide, font.CalcTextSizeA(font.FontSize, 1e6f, 0, row.text.c_str()).x);
  const float pad = theme.px(8), line = font.FontSize + theme.px(4), dot = theme.px(14);
  const ImVec2 min(static_cast<float>(room.min.x()) + theme.px(12),
                   static_cast<float>(room.min.y()) + theme.px(12));
  const ImVec2 max(min.x + wide + dot + 2 * pad,
                   min.y + static_cast<float>(rows.size()) * line + 2 * pad - theme.px(4));
  // Without room for the key, the mesh matters more.
  if (max.x > static_cast<float>(room.max.x()) || max.y > static_cast<float>(room.max.y())) return;
  list.AddRectFilled(min, max, faded(palette().card, 0.97f), theme.px(5));
  list.AddRect(min, max, palette().border, theme.px(5));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const float y = min.y + pad + static_cast<float>(k) * line;
    const ScreenPoint centre(min.x + pad + theme.px(4), y + font.FontSize / 2);
    if (rows[k].ring)
      draw_ring(list, theme, centre, theme.px(4));
    else
      draw_dot(list, theme, centre, rows[k].role);
    list.AddText(&font, font.FontSize, ImVec2(min.x + pad + dot, y), palette().text,
                 rows[k].text.c_str());
    ui::note("roles/key/" + (rows[k].ring ? std::string("overridden")
                                          : std::to_string(static_cast<int>(rows[k].role))),
             ImVec2(min.x, y), ImVec2(max.x, y + line));
  }
  ui::note("roles/key", min, max);
}

}  // namespace

namespace {

/// In the order of NodeRole. A colour of 0 stands for that of the text.
struct RoleLook {
  const char* name;
  ImU32 on_light = 0, on_dark = 0;
};
constexpr std::array<RoleLook, node_role_count> looks{
    {{"Free, inside"},
     {"Fixed"},
     {"Corner or edge, stays", IM_COL32(210, 40, 30, 255), IM_COL32(255, 110, 90, 255)},
     {"Slides on a curve", IM_COL32(196, 140, 0, 255), IM_COL32(240, 190, 40, 255)},
     {"Slides on a surface", IM_COL32(22, 140, 70, 255), IM_COL32(70, 200, 120, 255)},
     {"Periodic", IM_COL32(140, 50, 190, 255), IM_COL32(210, 130, 250, 255)},
     {"Moved, selected"},
     {"Held", IM_COL32(0, 95, 185, 255), IM_COL32(110, 190, 255, 255)},
     {"Regions meet, stays", IM_COL32(150, 85, 20, 255), IM_COL32(220, 165, 105, 255)}}};

}  // namespace

ImU32 color_of(NodeRole role) {
  const Palette& p = palette();
  if (role == NodeRole::free) return p.text_dim;
  if (role == NodeRole::moves) return p.accent;
  const RoleLook& look = looks[static_cast<std::size_t>(role)];
  return look.on_light == 0 ? p.text : p.dark ? look.on_dark : look.on_light;
}

const char* name_of(NodeRole role) { return looks[static_cast<std::size_t>(role)].name; }

void RoleOverlay::find_in_plane(const ViewOverlay& o, const NodeRoles& roles) {
  const Coordinates& x = o.session.coordinates();
  const Bounds seen = o.view.visible();
  for (Index i = 0; i < x.size(); ++i) {
    const Vec2 p = x.xy(i);
    if ((p.array() < seen.min.array()).any() || (p.array() > seen.max.array()).any()) continue;
    const NodeRole role = roles.roles[at(i)];
    const bool told = std::ranges::binary_search(roles.overridden, i);
    if (role == NodeRole::free && !told && !has_room(o, i)) continue;
    dots_.push_back({o.view.to_screen(p), role, told});
  }
}

/// Finds the nodes of bodies and of moving parts. Leaves out an enclosure that stays, and what a
/// cut removes.
void RoleOverlay::find_in_picture(const ViewOverlay& o, const VolumeScenes& scenes,
                                  const NodeRoles& roles) {
  const VolumeBoundary& boundary = *o.session.document()->boundary();
  const Topology& topology = *o.session.topology();
  const Coordinates& x = o.session.coordinates();
  std::vector<unsigned char> taken(at(x.size()), 0);
  std::vector<Index> nodes;
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    const SurfaceFace& face = boundary.faces[f];
    const bool marked = face.marker >= 0;
    if (marked && o.options.markers.of(topology.markers()[at(face.marker)].name).hidden) continue;
    for (const Index node : face.nodes) {
      const NodeRole role = roles.roles[at(node)];
      const bool quiet = role == NodeRole::fixed || role == NodeRole::moves;
      if (taken[at(node)] != 0 || (quiet && boundary.enclosing[f] != 0)) continue;
      if (boundary.enclosing[f] != 0 && cut_away(x.xyz(node), ~0U, scenes.planes)) continue;
      taken[at(node)] = 1;
      nodes.push_back(node);
    }
  }
  std::vector<DeepPlace> places;
  for (const Index node : nodes) {
    const auto [at, depth] = o.view.project(x.xyz(node));
    places.push_back({at, depth, !o.view.viewport().contains(at)});
  }
  hide_behind(o.view, scenes.parts, scenes.planes, places);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (!places[k].hidden)
      dots_.push_back({places[k].at, roles.roles[at(nodes[k])],
                       std::ranges::binary_search(roles.overridden, nodes[k])});
}

void RoleOverlay::draw(ImDrawList& list, const ViewOverlay& o, const VolumeView& picture,
                       const ScreenBox& room) {
  const bool in_space = o.session.in_space();
  const VolumeScenes* scenes = picture.scenes();
  if (!shown(o.options, o.state) || (in_space && !scenes)) {
    key_ = Key();
    return;
  }
  const auto roles = o.session.inspection().roles.find();
  const Coordinates& x = o.session.coordinates();
  if (!roles || roles->roles.size() != at(x.size())) return;
  const Key now{ViewKey(o.view), picture.revision(), o.session.shape(), roles};
  if (key_ != now) {
    key_ = now;
    dots_.clear();
    in_space ? find_in_picture(o, *scenes, *roles) : find_in_plane(o, *roles);
  }
  for (const auto& [a, b] : roles->features)
    list.AddLine(static_cast<ImVec2>(o.view.project(place_of(x, a)).at),
                 static_cast<ImVec2>(o.view.project(place_of(x, b)).at),
                 faded(color_of(NodeRole::corner), 0.7f), o.theme.px(1.6f));
  for (const NodeRole role : in_order)
    for (const Dot& dot : dots_)
      if (dot.role == role) draw_dot(list, o.theme, dot.at, role, dot.overridden);
  draw_key(list, o.theme, room, *roles);
}

}  // namespace winslow::gui
