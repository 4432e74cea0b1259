#include "gui/menu/bodies.h"

namespace winslow::gui {

std::string names_of(const PanelContext& context, const std::vector<Index>& markers) {
  std::string text;
  for (const Index m : markers)
    text += (text.empty() ? "" : ", ") +
            context.topology()->markers()[static_cast<std::size_t>(m)].name;
  return text;
}

namespace {

/// Bodies of a volume mesh: each marker with no face that encloses other markers.
std::vector<NamedBody> space_bodies(const PanelContext& context) {
  const VolumeBoundary& boundary = *context.session.document()->boundary();
  const std::size_t count = context.topology()->markers().size();
  std::vector<unsigned char> inside(count, boundary.encloses ? 1 : 0);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    if (boundary.enclosing[f] != 0 && boundary.faces[f].marker >= 0)
      inside[at(boundary.faces[f].marker)] = 0;
  std::vector<NamedBody> found;
  for (std::size_t m = 0; m < count; ++m)
    if (inside[m] != 0)
      found.push_back({names_of(context, {static_cast<Index>(m)}), {static_cast<Index>(m)}, true});
  return found;
}

}  // namespace

std::vector<NamedBody> bodies(const PanelContext& context) {
  std::vector<NamedBody> found;
  if (context.session.in_space()) return space_bodies(context);
  if (!context.session.mesh().boundary()) return found;
  for (const auto& body : context.session.mesh().boundary()->bodies())
    if (body.hole && !body.markers.empty())
      found.push_back({names_of(context, body.markers), body.markers, true});
  return found;
}

std::vector<NamedBody> bodies_and_markers(const PanelContext& context) {
  std::vector<NamedBody> found = bodies(context);
  if (!context.topology()) return found;
  const auto count = static_cast<Index>(context.topology()->markers().size());
  for (Index m = 0; m < count; ++m) {
    const auto same = [m](const NamedBody& body) { return body.markers == std::vector<Index>{m}; };
    if (std::ranges::none_of(found, same)) found.push_back({names_of(context, {m}), {m}, false});
  }
  return found;
}

std::string locked_marker(const PanelContext& context, const std::vector<Index>& markers) {
  for (const Index m : markers) {
    std::string name = names_of(context, {m});
    if (context.view.markers.of(name).locked) return name;
  }
  return {};
}

UserCommand::Text while_locked(std::vector<Index> markers) {
  return [markers = std::move(markers)](const PanelContext& c) {
    const std::string locked = locked_marker(c, markers);
    return locked.empty() ? std::string() : locked + " is locked.";
  };
}

std::string without_bodies(const PanelContext& context) {
  if (!context.session.document()) return without_mesh(context);
  if (!bodies(context).empty()) return "";
  return context.session.in_space() ? "Nothing in this mesh is enclosed: no bodies."
                                    : "This mesh has no holes: no bodies.";
}

std::string without_selection(const PanelContext& context) {
  if (!context.session.document()) return without_mesh(context);
  return context.session.selection().empty() ? "Select a body or a marker first." : "";
}

std::string selection_in_use(const PanelContext& context) {
  if (std::string reason = while_busy(context); !reason.empty()) return reason;
  return without_selection(context);
}

const char* translation_field(const PanelContext& context) {
  return context.session.in_space() ? "motion/d_x" : "motion/dx";
}

void change_looks(const PanelContext& context, const std::vector<Index>& markers,
                  const std::function<void(MarkerLook&)>& change) {
  std::vector<Index> kept = context.session.selection().markers();
  context.edit_view([&](ViewOptions& view) {
    for (const Index m : markers) {
      const std::string name = names_of(context, {m});
      MarkerLook look = view.markers.of(name);
      change(look);
      view.markers.set(name, look);
      if (look.hidden || look.locked) std::erase(kept, m);
    }
  });
  if (kept != context.session.selection().markers())
    context.emit(action::SelectMarkers{kept, false});
}

void cycle_bodies(const PanelContext& context, int step) {
  std::vector<NamedBody> all = bodies(context);
  std::erase_if(
      all, [&](const NamedBody& body) { return !locked_marker(context, body.markers).empty(); });
  if (all.empty()) return;
  const auto count = static_cast<int>(all.size());
  const auto& selected = context.session.selection().markers();
  const auto now =
      std::ranges::find_if(all, [&](const NamedBody& body) { return body.markers == selected; });
  const int at = now == all.end() ? (step > 0 ? -1 : count) : static_cast<int>(now - all.begin());
  const int next = ((at + step) % count + count) % count;
  context.emit(action::SelectMarkers{all[static_cast<std::size_t>(next)].markers, false});
}

}  // namespace winslow::gui
