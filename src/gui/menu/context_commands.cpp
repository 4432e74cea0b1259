#include "core/inspect/space/surface_measures.h"
#include "core/quality/metric.h"
#include "gui/base/text.h"
#include "gui/document/jobs/run_settings.h"
#include "gui/menu/bodies.h"

namespace winslow::gui {

namespace {

/// Coordinates with enough digits for a mesh far from the origin.
std::string coordinates_text(std::span<const double> point) {
  std::string text;
  for (const double x : point) text += (text.empty() ? "" : ", ") + formatted(x, "%.10g");
  return text;
}

UserCommand copying(std::string id, std::string label, const std::string& text) {
  return entry(std::move(id), std::move(label), {}, "To paste it elsewhere: " + text,
               emits(action::CopyText{text}));
}

/// A command that goes to an item. what: prefix of the id.
UserCommand centring(const std::string& what, const std::string& tooltip, const MeshItem& item) {
  return entry(what + "/go_to", "Centre it", {}, tooltip, emits(action::GoTo{item}));
}

/// A command that describes an item in the right column without moving the view.
UserCommand describing(const std::string& what, const MeshItem& item) {
  return entry(what + "/describe", "Say what is known of it", {},
               "Coordinates, neighbours and quality, in the panel \"Go to\".",
               [item](const PanelContext& c) {
                 c.emit(action::AskGoTo{});
                 c.emit(action::GoTo{item, false});
               });
}

/// Selects a body, then runs `then`.
UserCommand::Run select_and(const std::vector<Index>& markers, UserCommand::Run then) {
  return [markers, then = std::move(then)](const PanelContext& c) {
    c.emit(action::SelectMarkers{markers, false});
    then(c);
  };
}
UserCommand::Run select_and_edit(const std::vector<Index>& markers, const char* field) {
  return select_and(markers, emits(action::EditField{field}));
}

/// A test with the state at the time the menu was opened.
UserCommand::Test is(bool on) {
  return [on](const PanelContext&) { return on; };
}

/// Changes the looks of markers.
UserCommand::Run changing(const std::vector<Index>& markers,
                          const std::function<void(MarkerLook&)>& change) {
  return [markers, change](const PanelContext& c) { change_looks(c, markers, change); };
}

std::vector<UserCommand> moving(const std::vector<Index>& markers) {
  const auto blocked = first_of({while_busy, while_locked(markers)});
  return {
      entry("body/select", "Select", {}, "What is selected moves, the rest stays.",
            emits(action::SelectMarkers{markers, false}), {.blocked = blocked}),
      entry("body/move", "Move...", {}, "Type how far it moves, and press Enter.",
            select_and(
                markers,
                [](const PanelContext& c) { c.emit(action::EditField{translation_field(c)}); }),
            {.blocked = blocked, .serves = movable_meshes}),
      entry("body/rotate", "Rotate...", {}, "Type by how many degrees it turns, and press Enter.",
            select_and_edit(markers, "motion/rotate"),
            {.blocked = blocked, .serves = movable_meshes}),
      entry("body/deform", "Deform by a sine...", {}, "Type a sine that bends it.",
            select_and_edit(markers, "shape/amplitude"),
            {.blocked = blocked, .serves = movable_meshes}),
      entry("body/layers", "Insert layers...", {},
            "Say how many layers it gets, and how high they are.",
            select_and_edit(markers, "layers/count"),
            {.blocked = while_busy, .serves = plane_meshes, .starts_section = true}),
      entry("body/hold_layers", "Hold layers", {},
            "Keep the heights that its layers have, whatever moves.",
            [markers](const PanelContext& c) { hold_layers(c, markers); },
            {.blocked = [markers](const PanelContext& c) { return cannot_hold_layers(c, markers); },
             .serves = movable_meshes}),
  };
}

/// Possible periodic partners of a marker, including none.
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
        entry("periodic/" + other.value_or("none"),
              other.value_or("None") + (other && other == in_file ? " (as the file says)" : ""), {},
              other ? "Nodes of " + own + " and of " + *other + " move together."
                    : own + " stays, or slides.",
              emits(action::PairMarkers{own, other}), {.checked = is(now == other)}));
  return commands;
}

std::vector<UserCommand> looking(const PanelContext& context, const std::vector<Index>& markers) {
  const MarkerLook look = context.view.markers.of(names_of(context, {markers.front()}));
  return {
      entry("body/zoom", "Zoom to it", {}, "Show it as large as the window allows.",
            emits(action::FitMarkers{markers}), {.starts_section = true}),
      entry("body/hide", "Hide", {},
            "Do not draw it, and let the mouse pass through it. The list of markers shows it "
            "again.",
            changing(markers, [on = !look.hidden](MarkerLook& marker) { marker.hidden = on; }),
            {.checked = is(look.hidden)}),
      entry("body/lock", "Lock", {}, "Draw it, but keep the mouse from selecting or moving it.",
            changing(markers, [on = !look.locked](MarkerLook& marker) { marker.locked = on; }),
            {.checked = is(look.locked)}),
      submenu("body/periodic", "Periodic with",
              "The marker whose nodes are the images of its own, shifted or turned: they then move "
              "together. Where they do not match, it is said which do not.",
              [marker = markers.front()](const PanelContext& c) { return partners_of(c, marker); },
              {.blocked = first_of(
                   {while_busy,
                    unless([one = markers.size() == 1](const PanelContext&) { return one; },
                           "Of one marker at a time."),
                    unless([](const PanelContext& c) { return c.topology()->markers().size() > 1; },
                           "There is no other marker.")}),
               .serves = movable_meshes}),
      entry("body/export", "Export as curve...", {},
            "Write its nodes as a table, points or VTK lines.",
            select_and(markers, emits(action::ShowFileDialog{FilePurpose::export_markers, ".csv"})),
            {.blocked = without_mesh, .serves = plane_meshes}),
  };
}

ContextPart of_body(const PanelContext& context, const std::vector<Index>& markers) {
  ContextPart part{names_of(context, markers), moving(markers)};
  for (UserCommand& command : looking(context, markers)) part.commands.push_back(command);
  return part;
}

/// Commands that override the role of a node, if roles are shown.
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
  const auto told = [node, now](NodeOverride to, UserCommand command) {
    command.checked = is(now == to);
    command.run = emits(action::OverrideNode{node, to});
    return command;
  };
  return {
      told(NodeOverride::hold,
           entry(
               "node/hold", "Hold this node", {},
               "It stays where it is while the mesh is smoothed, though it would slide. Undo "
               "takes it back.",
               {},
               {.blocked = first_of(
                    {while_busy, unless([periodic](const PanelContext&) { return !periodic; },
                                        "It moves together with its partner of a periodic pair.")}),
                .starts_section = true})),
      told(NodeOverride::slide,
           entry("node/slide", "Let it slide", {},
                 "It is no corner, however much the boundary turns there: it slides on the curve "
                 "or the surface through it. Undo takes it back.",
                 {},
                 {.blocked = first_of(
                      {while_busy,
                       unless([turns](const PanelContext&) { return turns; },
                              "Only for a node that the feature angle alone makes a corner of "
                              "what slides.")})})),
      told(NodeOverride::none,
           entry("node/as_found", "As found", {}, "It does what the feature angle says.", {},
                 {.blocked = while_busy}))};
}

/// Adds a command if it is for meshes of the open kind.
void add_for(MeshKinds kinds, UserCommand command, const PanelContext& context,
             std::vector<UserCommand>& commands) {
  if (kinds.contains(context.session.kind())) commands.push_back(std::move(command));
}

ContextPart of_node(const PanelContext& context, Index node) {
  const bool pinned = std::ranges::binary_search(context.session.nodes().pinned(), node);
  const auto boundary =
      unless([node](const PanelContext& c) { return !c.topology()->on_boundary(node); },
             "A node of the boundary has no control volume.");
  const MeshItem item{MeshItem::Kind::node, node};
  const Coordinates& x = context.session.coordinates();
  const auto dimension = static_cast<std::size_t>(x.dimension());
  ContextPart part{"Node " + std::to_string(node), {}};
  part.commands = {
      entry("node/inspect", "Inspect its control volume", {},
            "Show the node and its virtual control volume in the tab VCV.",
            emits(action::InspectNode{node}), {.blocked = boundary}),
      entry("node/pin", "Pin its control volume", {},
            "Keep it drawn over the mesh, in pictures, too.",
            emits(action::PinNodes{{node}, !pinned}), {.blocked = boundary, .checked = is(pinned)}),
      centring("node", "Zoom to the node and its neighbours, and say what is known of it.", item),
      copying("node/copy_place", "Copy coordinates",
              coordinates_text(x.values().subspan(at(node) * dimension, dimension))),
      copying("node/copy_id", "Copy node number", std::to_string(node))};
  add_for(meshes_in_space, describing("node", item), context, part.commands);
  for (UserCommand& command : overrides_of(context, node))
    part.commands.push_back(std::move(command));
  return part;
}

ContextPart of_element(const PanelContext& context, Index element) {
  const MeshItem item{MeshItem::Kind::element, element};
  const Metric* coloured = context.view.color ? context.view.color->metric() : nullptr;
  const Metric metric = coloured ? *coloured : Metric::normalized_jacobian;
  const int dimension = cell_dimension_of(context.session.kind());
  const FieldInfo& field = metric_info(metric, dimension).field;
  const double value = element_value(*context.session.mesh().shared(), element, metric);
  const bool finite = std::isfinite(value), high_is_bad = !field.larger_is_better;
  const auto isolate = [metric, value, high_is_bad, dimension](ViewOptions& view) {
    view.color = ElementField(metric, dimension);
    view.isolation.on = true;
    // Include this element.
    view.isolation.threshold = std::nextafter(value, high_is_bad ? -1e300 : 1e300);
    view.isolation.above = high_is_bad;
  };
  ContextPart part{"Element " + std::to_string(element) + ", " + std::string(field.label) + " " +
                       (finite ? short_number(value) : "of an inverted one"),
                   {}};
  part.commands = {
      centring("element", "Zoom to the element, and say what is known of it.", item),
      entry("element/isolate", "Isolate elements as bad or worse", {},
            "Draw those in full and the others faint (I ends it).",
            [isolate](const PanelContext& c) { c.edit_view(isolate); },
            {.blocked = unless(is(finite), "Nothing is worse than an inverted element.")}),
      copying("element/copy_id", "Copy element number", std::to_string(element))};
  add_for(meshes_in_space, describing("element", item), context, part.commands);
  return part;
}

ContextPart of_face(const PanelContext& context, Index face) {
  const MeshItem item{MeshItem::Kind::face, face};
  const double area = face_area(SpacePoints(context.session.coordinates()),
                                context.session.topology()->face(face).nodes);
  return {"Face " + std::to_string(face) + ", area " + short_number(area),
          {centring("face", "Zoom to the face, and say what is known of it.", item),
           describing("face", item),
           copying("face/copy_id", "Copy face number", std::to_string(face))}};
}

/// Commands at a place of a mesh in space.
std::vector<UserCommand> place_commands(const std::array<Vec3, 2>& place) {
  const auto& [point, normal] = place;
  return {entry("place/cut_along", "Cut along this face", {},
                "A cut in the plane of the face; what lies before it is taken away.",
                emits(action::AddCut{point, normal}),
                {.blocked = while_cuts_are_full(), .serves = volume_meshes}),
          entry("place/look", "Look at this place", {},
                "Put it into the middle of the view, and zoom to it.",
                [point = point](const PanelContext& c) {
                  c.emit(action::LookAt{point, 60 * c.view_state.pixel});
                }),
          copying("place/copy", "Copy coordinates", coordinates_text({point.data(), 3}))};
}

ContextPart of_view(const PickedPlace& place) {
  ContextPart part{{}, {}};
  if (place.in_space) part.commands = place_commands(*place.in_space);
  for (UserCommand& command : turn_about_place(place)) part.commands.push_back(std::move(command));
  if (place.point && !place.node)
    part.commands.push_back(
        copying("place/copy", "Copy coordinates", coordinates_text({place.point->data(), 2})));
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
