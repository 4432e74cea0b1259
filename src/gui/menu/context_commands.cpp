#include "gui/menu/context_commands.h"

#include <cstdio>

#include "core/inspect/space/surface_measures.h"
#include "core/quality/metric.h"
#include "gui/base/text.h"
#include "gui/document/jobs/run_settings.h"
#include "gui/menu/bodies.h"
#include "gui/menu/motion_commands.h"
#include "gui/menu/solver_commands.h"

namespace winslow::gui {

namespace {

/// As many digits as tell places apart on a mesh far from the origin.
std::string coordinates_text(const Vec2& point, const char* between) {
  std::array<char, 80> text{};
  const int used = std::snprintf(text.data(), text.size(), "%.10g%s", point.x(), between);
  std::snprintf(text.data() + used, text.size() - static_cast<std::size_t>(used), "%.10g",
                point.y());
  return text.data();
}

std::string coordinates_text(const Vec3& point) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%.10g, %.10g, %.10g", point.x(), point.y(), point.z());
  return text.data();
}

std::string node_place(const PanelContext& context, Index node) {
  const Coordinates& x = context.session.coordinates();
  return x.dimension() == 3 ? coordinates_text(x.xyz(node)) : coordinates_text(x.xy(node), ", ");
}

UserCommand copying(std::string id, std::string label, const std::string& text) {
  return {.id = std::move(id),
          .label = std::move(label),
          .tooltip = "To paste it elsewhere: " + text,
          .run = [text](const PanelContext& c) { c.emit(action::CopyText{text}); }};
}

/// Says what is known of an item, in the column on the right; the view stays.
UserCommand describing(std::string id, const MeshItem& item) {
  return {.id = std::move(id),
          .label = "Say what is known of it",
          .tooltip = "Coordinates, neighbours and quality, in the panel \"Go to\".",
          .run = [item](const PanelContext& c) {
            c.emit(action::AskGoTo{});
            c.emit(action::GoTo{item, false});
          }};
}

/// Selects a body, then edits a field of a panel.
std::function<void(const PanelContext&)> select_and_edit(std::vector<Index> markers,
                                                         const char* field) {
  return [markers = std::move(markers), field](const PanelContext& c) {
    c.emit(action::SelectMarkers{markers, false});
    c.emit(action::EditField{field});
  };
}

UserCommand::Text blocked_by_lock(std::vector<Index> markers) {
  return [markers = std::move(markers)](const PanelContext& c) -> std::string {
    if (std::string busy = while_busy(c); !busy.empty()) return busy;
    const std::string locked = locked_marker(c, markers);
    return locked.empty() ? "" : locked + " is locked.";
  };
}

/// Changes the looks of markers.
template <class Change>
std::function<void(const PanelContext&)> change_looks(std::vector<Index> markers, Change change) {
  return [markers = std::move(markers), change](const PanelContext& c) {
    c.edit_view([&](ViewOptions& view) {
      for (const Index m : markers) {
        const std::string name = names_of(c, {m});
        MarkerLook look = view.markers.of(name);
        change(look);
        view.markers.set(name, look);
      }
    });
    // What is out of sight or locked is not to be moved with the rest.
    const auto& selected = c.session.selection().markers();
    const bool taken = std::ranges::any_of(
        markers, [&](Index m) { return std::ranges::binary_search(selected, m); });
    if (!taken) return;
    std::vector<Index> kept;
    std::ranges::set_difference(selected, markers, std::back_inserter(kept));
    c.emit(action::SelectMarkers{kept, false});
  };
}

/// Asks first whether the mesh is of such a kind.
UserCommand::Text for_meshes(MeshKinds kinds, UserCommand::Text blocked) {
  return [kinds, blocked = std::move(blocked)](const PanelContext& c) -> std::string {
    std::string reason = why_not_served(kinds, c);
    return reason.empty() ? blocked(c) : reason;
  };
}

std::vector<UserCommand> moving(const std::vector<Index>& markers) {
  const auto blocked = blocked_by_lock(markers);
  const auto moves = for_meshes(movable_meshes, blocked);
  return {
      {.id = "body/select",
       .label = "Select",
       .tooltip = "What is selected moves, the rest stays.",
       .blocked = blocked,
       .run =
           [markers](const PanelContext& c) {
             c.emit(action::SelectMarkers{markers, false});
           }},
      {.id = "body/move",
       .label = "Move...",
       .tooltip = "Type how far it moves, and press Enter.",
       .blocked = moves,
       .run =
           [markers](const PanelContext& c) {
             c.emit(action::SelectMarkers{markers, false});
             c.emit(action::EditField{translation_field(c)});
           }},
      {.id = "body/rotate",
       .label = "Rotate...",
       .tooltip = "Type by how many degrees it turns, and press Enter.",
       .blocked = moves,
       .run = select_and_edit(markers, "motion/rotate")},
      {.id = "body/deform",
       .label = "Deform by a sine...",
       .tooltip = "Type a sine that bends it.",
       .blocked = moves,
       .run = select_and_edit(markers, "shape/amplitude")},
      {.id = "body/layers",
       .label = "Insert layers...",
       .tooltip = "Say how many layers it gets, and how high they are.",
       .blocked = for_meshes(plane_meshes, while_busy),
       .run = select_and_edit(markers, "layers/count"),
       .starts_section = true},
      {.id = "body/hold_layers",
       .label = "Hold layers",
       .tooltip = "Keep the heights that its layers have, whatever moves.",
       .blocked =
           for_meshes(plane_meshes,
                      [markers](const PanelContext& c) { return cannot_hold_layers(c, markers); }),
       .run = [markers](const PanelContext& c) { hold_layers(c, markers); }},
  };
}

/// What a marker can be periodic with: nothing, or another marker.
std::vector<UserCommand> partners_of(const PanelContext& context, Index marker) {
  const auto& markers = context.topology()->markers();
  const std::string& own = markers[at(marker)].name;
  const SolverSettings& settings = context.session.solver_settings();
  const GivenPeriodicity* file = settings.file_pairs();
  const auto now = partner_of(settings.smooth_options().slide, file, own),
             in_file = partner_in_file(file, own);
  std::vector<std::optional<std::string>> others{std::nullopt};
  if (in_file && in_file != own) others.push_back(in_file);
  for (const Marker& other : markers)
    if (other.name != own && other.name != in_file) others.emplace_back(other.name);
  std::vector<UserCommand> commands;
  for (const auto& other : others)
    commands.push_back(
        {.id = "periodic/" + other.value_or("none"),
         .label = other.value_or("None") + (other && other == in_file ? " (as the file says)" : ""),
         .tooltip = other ? "Nodes of " + own + " and of " + *other + " move together."
                          : own + " stays, or slides.",
         .checked = [on = now == other](const PanelContext&) { return on; },
         .run =
             [own, other](const PanelContext& c) {
               c.emit(action::PairMarkers{own, other});
             }});
  return commands;
}

std::vector<UserCommand> looking(const PanelContext& context, const std::vector<Index>& markers) {
  const MarkerLook look = context.view.markers.of(names_of(context, {markers.front()}));
  return {
      {.id = "body/zoom",
       .label = "Zoom to it",
       .tooltip = "Show it as large as the window allows.",
       .run = [markers](const PanelContext& c) { c.emit(action::FitMarkers{markers}); },
       .starts_section = true},
      {.id = "body/hide",
       .label = "Hide",
       .tooltip = "Do not draw it, and let the mouse pass through it. The list of markers shows it "
                  "again.",
       .checked = [look](const PanelContext&) { return look.hidden; },
       .run =
           change_looks(markers, [on = !look.hidden](MarkerLook& marker) { marker.hidden = on; })},
      {.id = "body/lock",
       .label = "Lock",
       .tooltip = "Draw it, but keep the mouse from selecting or moving it.",
       .checked = [look](const PanelContext&) { return look.locked; },
       .run =
           change_looks(markers, [on = !look.locked](MarkerLook& marker) { marker.locked = on; })},
      {.id = "body/periodic",
       .label = "Periodic with",
       .tooltip = "The marker whose nodes are the images of its own, shifted or turned: they then "
                  "move together. Where they do not match, it is said which do not.",
       .blocked = [markers](const PanelContext& c) -> std::string {
         if (std::string reason = why_not_served(movable_meshes, c); !reason.empty()) return reason;
         if (std::string busy = while_busy(c); !busy.empty()) return busy;
         if (markers.size() > 1) return "Of one marker at a time.";
         return c.topology()->markers().size() < 2 ? "There is no other marker." : "";
       },
       .items = [marker =
                     markers.front()](const PanelContext& c) { return partners_of(c, marker); }},
      {.id = "body/export",
       .label = "Export as curve...",
       .tooltip = "Write its nodes as a table, points or VTK lines.",
       .blocked = for_meshes(plane_meshes, without_mesh),
       .run =
           [markers](const PanelContext& c) {
             c.emit(action::SelectMarkers{markers, false});
             c.emit(action::ShowFileDialog{FilePurpose::export_markers, ".csv"});
           }},
  };
}

ContextPart of_body(const PanelContext& context, const std::vector<Index>& markers) {
  ContextPart part{names_of(context, markers), moving(markers)};
  for (UserCommand& command : looking(context, markers)) part.commands.push_back(command);
  return part;
}

/// One of what a node of the boundary can be told to do.
UserCommand override_to(const PanelContext& context, Index node, NodeOverride to,
                        UserCommand command) {
  const NodeOverride now =
      override_of(context.session.solver_settings().smooth_options().slide, node);
  command.checked = [on = now == to](const PanelContext&) { return on; };
  command.run = [node, to](const PanelContext& c) { c.emit(action::OverrideNode{node, to}); };
  return command;
}

/// What a node is told to do instead of what was found of it, where that is shown.
std::vector<UserCommand> overrides_of(const PanelContext& context, Index node) {
  // All nodes of a surface mesh slide.
  const bool boundary =
      context.session.kind() == MeshKind::surface || context.topology()->on_boundary(node);
  if (!context.view.roles || !boundary) return {};
  const auto roles = context.session.inspection().roles.find();
  const bool known = roles && at(node) < roles->roles.size();
  const NodeOverride now =
      override_of(context.session.solver_settings().smooth_options().slide, node);
  const bool periodic = known && roles->roles[at(node)] == NodeRole::periodic;
  const bool bends = known && std::ranges::binary_search(roles->bends, node);
  const bool turns = bends || now == NodeOverride::slide;
  UserCommand hold{.id = "node/hold",
                   .label = "Hold this node",
                   .tooltip =
                       "It stays where it is while the mesh is smoothed, though it would "
                       "slide. Undo takes it back.",
                   .blocked = [periodic](const PanelContext& c) -> std::string {
                     if (std::string busy = while_busy(c); !busy.empty()) return busy;
                     return periodic ? "It moves together with its partner of a periodic pair."
                                     : "";
                   },
                   .starts_section = true};
  UserCommand slide{.id = "node/slide",
                    .label = "Let it slide",
                    .tooltip =
                        "It is no corner, however much the boundary turns there: it slides "
                        "on the curve or the surface through it. Undo takes it back.",
                    .blocked = [turns](const PanelContext& c) -> std::string {
                      if (std::string busy = while_busy(c); !busy.empty()) return busy;
                      return turns ? ""
                                   : "Only for a node that the feature angle alone makes a corner "
                                     "of what slides.";
                    }};
  UserCommand none{.id = "node/as_found",
                   .label = "As found",
                   .tooltip = "It does what the feature angle says.",
                   .blocked = while_busy};
  return {override_to(context, node, NodeOverride::hold, std::move(hold)),
          override_to(context, node, NodeOverride::slide, std::move(slide)),
          override_to(context, node, NodeOverride::none, std::move(none))};
}

ContextPart of_node(const PanelContext& context, Index node) {
  const bool pinned = std::ranges::binary_search(context.session.nodes().pinned(), node);
  const auto boundary = [node](const PanelContext& c) -> std::string {
    return c.topology()->on_boundary(node) ? "A node of the boundary has no control volume." : "";
  };
  const MeshItem item{MeshItem::Kind::node, node};
  ContextPart part{"Node " + std::to_string(node), {}};
  part.commands = {{.id = "node/inspect",
                    .label = "Inspect its control volume",
                    .tooltip = "Show the node and its virtual control volume in the tab VCV.",
                    .blocked = boundary,
                    .run = [node](const PanelContext& c) { c.emit(action::InspectNode{node}); }},
                   {.id = "node/pin",
                    .label = "Pin its control volume",
                    .tooltip = "Keep it drawn over the mesh, in pictures, too.",
                    .blocked = boundary,
                    .checked = [pinned](const PanelContext&) { return pinned; },
                    .run =
                        [node, pinned](const PanelContext& c) {
                          c.emit(action::PinNodes{{node}, !pinned});
                        }},
                   {.id = "node/go_to",
                    .label = "Centre it",
                    .tooltip = "Zoom to the node and its neighbours, and say what is known of it.",
                    .run = [item](const PanelContext& c) { c.emit(action::GoTo{item}); }},
                   copying("node/copy_place", "Copy coordinates", node_place(context, node)),
                   copying("node/copy_id", "Copy node number", std::to_string(node))};
  if (context.session.in_space()) part.commands.push_back(describing("node/describe", item));
  for (UserCommand& command : overrides_of(context, node))
    part.commands.push_back(std::move(command));
  return part;
}

ContextPart of_element(const PanelContext& context, Index element) {
  const MeshItem item{MeshItem::Kind::element, element};
  const Metric* coloured = context.view.color ? context.view.color->metric() : nullptr;
  const Metric metric = coloured ? *coloured : Metric::normalized_jacobian;
  const int dimension = cell_dimension_of(context.session.kind());
  const auto shared = context.session.mesh().shared();
  const Mesh& mesh = *shared;
  const double value = element_value(mesh, element, metric);
  const bool high_is_bad = !metric_info(metric, dimension).field.larger_is_better;
  ContextPart part{"Element " + std::to_string(element) + ", " +
                       std::string(metric_info(metric, dimension).field.label) + " " +
                       (std::isfinite(value) ? short_number(value) : "of an inverted one"),
                   {}};
  part.commands = {{.id = "element/go_to",
                    .label = "Centre it",
                    .tooltip = "Zoom to the element, and say what is known of it.",
                    .run = [item](const PanelContext& c) { c.emit(action::GoTo{item}); }},
                   {.id = "element/isolate",
                    .label = "Isolate elements as bad or worse",
                    .tooltip = "Draw those in full and the others faint (I ends it).",
                    .blocked = [value](const PanelContext&) -> std::string {
                      return std::isfinite(value) ? ""
                                                  : "Nothing is worse than an inverted element.";
                    },
                    .run =
                        [metric, value, high_is_bad, dimension](const PanelContext& c) {
                          c.edit_view([&](ViewOptions& view) {
                            view.color = ElementField(metric, dimension);
                            view.isolation.on = true;
                            // This element is to be among them.
                            const double beyond = high_is_bad ? -1e300 : 1e300;
                            view.isolation.threshold = std::nextafter(value, beyond);
                            view.isolation.above = high_is_bad;
                          });
                        }},
                   copying("element/copy_id", "Copy element number", std::to_string(element))};
  if (context.session.in_space()) part.commands.push_back(describing("element/describe", item));
  return part;
}

ContextPart of_face(const PanelContext& context, Index face) {
  const MeshItem item{MeshItem::Kind::face, face};
  const double area = face_area(SpacePoints(context.session.coordinates()),
                                context.session.topology()->face(face).nodes);
  ContextPart part{"Face " + std::to_string(face) + ", area " + short_number(area), {}};
  part.commands = {{.id = "face/go_to",
                    .label = "Centre it",
                    .tooltip = "Zoom to the face, and say what is known of it.",
                    .run = [item](const PanelContext& c) { c.emit(action::GoTo{item}); }},
                   describing("face/describe", item),
                   copying("face/copy_id", "Copy face number", std::to_string(face))};
  return part;
}

/// What a place of a mesh in space is good for.
std::vector<UserCommand> in_space(const std::array<Vec3, 2>& place) {
  const Vec3 &point = place[0], &normal = place[1];
  const auto full = [](const PanelContext& c) -> std::string {
    if (std::string reason = why_not_served(volume_meshes, c); !reason.empty()) return reason;
    return c.view.space.cuts.size() < most_cuts ? "" : "There are six cuts already.";
  };
  return {{.id = "place/cut_along",
           .label = "Cut along this face",
           .tooltip = "A cut in the plane of the face; what lies before it is taken away.",
           .blocked = full,
           .run =
               [point, normal](const PanelContext& c) {
                 c.emit(action::AddCut{point, normal});
               }},
          {.id = "place/look",
           .label = "Look at this place",
           .tooltip = "Put it into the middle of the view, and zoom to it.",
           .run =
               [point](const PanelContext& c) {
                 c.emit(action::LookAt{point, 60 * c.view_state.pixel});
               }},
          copying("place/copy", "Copy coordinates", coordinates_text(point))};
}

ContextPart of_view(const PickedPlace& place) {
  ContextPart part{{}, {}};
  if (place.in_space) part.commands = in_space(*place.in_space);
  for (UserCommand& command : turn_about_place(place)) part.commands.push_back(std::move(command));
  if (place.point && !place.node)
    part.commands.push_back(
        copying("place/copy", "Copy coordinates", coordinates_text(*place.point, ", ")));
  for (const char* id : {"next_worst", "fit", "fit_selection", "pin_magnifier"})
    part.commands.push_back(user_command(id));
  return part;
}

}  // namespace

std::vector<ContextPart> context_parts(const PanelContext& context, const PickedPlace& place) {
  std::vector<ContextPart> parts;
  if (!context.session.document()) return parts;
  if (!place.markers.empty()) parts.push_back(of_body(context, place.markers));
  if (place.node) parts.push_back(of_node(context, *place.node));
  if (place.face) parts.push_back(of_face(context, *place.face));
  if (place.element) parts.push_back(of_element(context, *place.element));
  if (place.point || place.in_space || context.session.in_space()) parts.push_back(of_view(place));
  return parts;
}

}  // namespace winslow::gui
