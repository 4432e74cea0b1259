#include "gui/settings/view_settings.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "gui/render/color_scale.h"

namespace winslow::gui {

namespace {

using nlohmann::json;

template <class Choice, std::size_t count>
using Names = std::array<std::pair<Choice, const char*>, count>;

constexpr Names<SideTab, 4> tabs{{{SideTab::quality, "quality"},
                                  {SideTab::view, "view"},
                                  {SideTab::vcv, "vcv"},
                                  {SideTab::history, "history"}}};
constexpr Names<Lightness, 2> looks{{{Lightness::light, "light"}, {Lightness::dark, "dark"}}};
constexpr Names<Backdrop, 5> backdrops{{{Backdrop::automatic, "automatic"},
                                        {Backdrop::white, "white"},
                                        {Backdrop::grey, "grey"},
                                        {Backdrop::gradient, "gradient"},
                                        {Backdrop::black, "black"}}};
constexpr Names<ColorAxis, 3> axes{{{ColorAxis::automatic, "automatic"},
                                    {ColorAxis::linear, "linear"},
                                    {ColorAxis::logarithmic, "logarithmic"}}};
constexpr Names<BeforeState, 2> befores{
    {{BeforeState::loaded, "loaded"}, {BeforeState::last_command, "last_command"}}};

constexpr Names<MarkerDrawing, 3> drawings{{{MarkerDrawing::automatic, "automatic"},
                                            {MarkerDrawing::surface, "surface"},
                                            {MarkerDrawing::outline, "outline"}}};

constexpr Names<LegendPlace, 6> legend_places{{{LegendPlace::right, "right"},
                                               {LegendPlace::left, "left"},
                                               {LegendPlace::top_right, "top_right"},
                                               {LegendPlace::bottom_right, "bottom_right"},
                                               {LegendPlace::bottom_left, "bottom_left"},
                                               {LegendPlace::top_left, "top_left"}}};

/// Visits every value that is kept, with its key and, for numbers, its limits.
template <class View, class Visitor>
void visit(View& view, Visitor&& visitor) {
  visitor.field("color", view.color);
  visitor.map("color_map", view.color_map);
  visitor.choice("color_axis", view.color_axis, axes);
  visitor.percentiles("percentiles", view.percentiles);
  visitor.number("bands", view.bands, 0, 64);
  visitor.flag("fill", view.fill);
  visitor.flag("wireframe", view.wireframe);
  visitor.number("line_width", view.line_width, 0.25, 4);
  visitor.flag("nodes", view.nodes);
  visitor.flag("rim_nodes", view.rim_nodes);
  visitor.flag("roles", view.roles);
  visitor.flag("directions", view.directions);
  visitor.looks("markers", view.markers);
  visitor.flag("node_ids", view.node_ids);
  visitor.flag("element_ids", view.element_ids);
  visitor.flag("legend", view.legend);
  visitor.choice("legend_place", view.legend_place, legend_places);
  visitor.flag("scale_bar", view.scale_bar);
  visitor.flag("mark_inverted", view.mark_inverted);
  visitor.choice("before", view.before, befores);
  visitor.number("magnification", view.magnifier.factor, 2, 1000);
  visitor.flag("crinkle", view.space.crinkle);
  visitor.flag("perspective", view.space.perspective);
  visitor.number("up", view.space.up, 0, 2);
  visitor.flag("axes", view.space.axes);
  visitor.flag("free_orbit", view.space.free_orbit);
  visitor.number("worst_count", view.worst_count, 1, 100);
  visitor.choice("lightness", view.lightness, looks);
  visitor.choice("backdrop", view.backdrop, backdrops);
  visitor.number("scale", view.scale, 0, 4);
  visitor.flag("left_panel", view.left_panel);
  visitor.flag("right_panel", view.right_panel);
  visitor.choice("side_tab", view.side_tab, tabs);
  visitor.flag("plot_panel", view.plot_panel);
}

struct Writer {
  json& object;

  void flag(const char* key, bool value) { object[key] = value; }
  void number(const char* key, auto value, double, double) { object[key] = value; }
  void map(const char* key, const std::string& value) { object[key] = value; }
  void field(const char* key, const std::optional<ElementField>& value) {
    object[key] = value ? json(field_info(*value).name) : json();
  }
  void looks(const char* key, const MarkerLooks& value) {
    json looks = json::object();
    for (const auto& [name, look] : value.by_name) {
      json& entry = looks[name];
      entry = {{"hidden", look.hidden}, {"locked", look.locked}};
      if (look.color) entry["color"] = *look.color;
      Writer of_marker{entry};
      of_marker.choice("drawing", look.drawing, drawings);
      of_marker.number("opacity", look.opacity, 0.1, 1);
    }
    object[key] = {{"mesh", value.mesh}, {"looks", std::move(looks)}};
  }
  void percentiles(const char* key, const std::optional<std::array<double, 2>>& value) {
    object[key] = value ? json(*value) : json();
  }
  template <class Choice, std::size_t count>
  void choice(const char* key, Choice value, const Names<Choice, count>& names) {
    for (const auto& [each, name] : names)
      if (each == value) object[key] = name;
  }
};

struct Reader {
  const json& object;

  const json* find(const char* key) const {
    const auto it = object.find(key);
    return it == object.end() ? nullptr : &*it;
  }
  void flag(const char* key, bool& value) {
    if (const json* found = find(key); found && found->is_boolean()) value = found->get<bool>();
  }
  template <class Number>
  void number(const char* key, Number& value, double least, double most) {
    const json* found = find(key);
    if (!found || !found->is_number()) return;
    const auto read = found->get<double>();
    if (read >= least && read <= most) value = static_cast<Number>(read);
  }
  void map(const char* key, std::string& value) {
    const json* found = find(key);
    if (!found || !found->is_string()) return;
    const auto names = color_map_choices();
    const auto read = found->get<std::string>();
    if (std::ranges::find(names, read) != names.end()) value = read;
  }
  void percentiles(const char* key, std::optional<std::array<double, 2>>& value) {
    const json* found = find(key);
    if (!found || !found->is_array() || found->size() != 2) return;
    if (!(*found)[0].is_number() || !(*found)[1].is_number()) return;
    const auto read = found->get<std::array<double, 2>>();
    if (read[0] >= 0 && read[0] < read[1] && read[1] <= 100) value = read;
  }
  void field(const char* key, std::optional<ElementField>& value) {
    const json* found = find(key);
    if (found && found->is_null()) value.reset();
    if (!found || !found->is_string()) return;
    // A field of another version: the one that a new studio shows is as good as any.
    for (const MeshKind kind : {MeshKind::plane, MeshKind::surface}) {
      const std::vector<ElementField>& all = all_element_fields(kind);
      const auto same = std::ranges::find_if(all, [&](const ElementField& f) {
        return field_info(f).name == found->get<std::string>();
      });
      if (same == all.end()) continue;
      value = *same;
      return;
    }
  }
  void looks(const char* key, MarkerLooks& value) {
    const json* found = find(key);
    if (!found || !found->is_object()) return;
    const auto mesh = found->find("mesh");
    const auto list = found->find("looks");
    if (mesh == found->end() || !mesh->is_string() || list == found->end() || !list->is_object())
      return;
    value.mesh = mesh->get<std::string>();
    for (const auto& [name, entry] : list->items()) {
      if (!entry.is_object()) continue;
      MarkerLook look;
      Reader of_marker{entry};
      of_marker.flag("hidden", look.hidden);
      of_marker.flag("locked", look.locked);
      of_marker.choice("drawing", look.drawing, drawings);
      of_marker.number("opacity", look.opacity, 0.1, 1);
      look.color = of_marker.color("color");
      value.set(name, look);
    }
  }
  std::optional<std::array<float, 3>> color(const char* key) const {
    const json* found = find(key);
    if (!found || !found->is_array() || found->size() != 3) return std::nullopt;
    std::array<float, 3> read{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(*found)[k].is_number()) return std::nullopt;
      read[k] = std::clamp((*found)[k].get<float>(), 0.0f, 1.0f);
    }
    return read;
  }
  template <class Choice, std::size_t count>
  void choice(const char* key, Choice& value, const Names<Choice, count>& names) {
    const json* found = find(key);
    if (!found || !found->is_string()) return;
    for (const auto& [each, name] : names)
      if (found->get<std::string>() == name) value = each;
  }
};

}  // namespace

void write_view(const ViewOptions& view, json& object) { visit(view, Writer{object}); }

ViewOptions read_view(const json& object) {
  ViewOptions view;
  visit(view, Reader{object});
  // Between 0, the screen's own, and a scale at which nothing could be read any more.
  if (view.scale < 0.5) view.scale = 0;
  return view;
}

namespace {

std::optional<double> number_in(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end() || !it->is_number()) return std::nullopt;
  const auto value = it->get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<std::array<double, 3>> vector_in(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end() || !it->is_array() || it->size() != 3) return std::nullopt;
  std::array<double, 3> v{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(*it)[k].is_number()) return std::nullopt;
    v[k] = (*it)[k].get<double>();
    if (!std::isfinite(v[k])) return std::nullopt;
  }
  return v;
}

bool flag_in(const json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_boolean() && it->get<bool>();
}

std::vector<CutPlane> cuts_in(const json& object) {
  std::vector<CutPlane> cuts;
  const auto it = object.find("cuts");
  if (it == object.end() || !it->is_array()) return cuts;
  for (const json& entry : *it) {
    if (!entry.is_object() || cuts.size() == most_cuts) continue;
    const auto point = vector_in(entry, "point"), normal = vector_in(entry, "normal");
    if (!point || !normal || *normal == std::array<double, 3>{0, 0, 0}) continue;
    cuts.push_back({*point, *normal, flag_in(entry, "on")});
  }
  return cuts;
}

Peel peel_in(const json& object) {
  Peel peel;
  const auto it = object.find("peel");
  if (it == object.end() || !it->is_object()) return peel;
  const auto marker = it->find("marker");
  const auto from = number_in(*it, "from"), to = number_in(*it, "to");
  if (marker == it->end() || !marker->is_string() || !from || !to) return peel;
  if (!(*from >= 1 && *from <= *to && *to < 1e9)) return peel;
  return {flag_in(*it, "on"), marker->get<std::string>(), static_cast<int>(*from),
          static_cast<int>(*to)};
}

std::optional<KeptView> view_in(const json& entry) {
  if (!entry.is_object()) return std::nullopt;
  const auto mesh = entry.find("mesh");
  const auto centre = vector_in(entry, "centre");
  const auto height = number_in(entry, "height"), azimuth = number_in(entry, "azimuth"),
             elevation = number_in(entry, "elevation"), up = number_in(entry, "up");
  if (mesh == entry.end() || !mesh->is_string() || !centre || !height || !(*height > 0) ||
      !azimuth || !elevation || !(std::abs(*elevation) <= 90) || !up || !(*up >= 0 && *up < 3))
    return std::nullopt;
  return KeptView{mesh->get<std::string>(),
                  *centre,
                  *height,
                  *azimuth,
                  *elevation,
                  number_in(entry, "roll").value_or(0),
                  static_cast<int>(*up),
                  cuts_in(entry),
                  peel_in(entry)};
}

}  // namespace

json write_kept_views(const std::vector<KeptView>& views) {
  json list = json::array();
  for (const KeptView& view : views) {
    json cuts = json::array();
    for (const CutPlane& cut : view.cuts)
      cuts.push_back({{"point", cut.point}, {"normal", cut.normal}, {"on", cut.on}});
    list.push_back({{"mesh", view.mesh},
                    {"centre", view.centre},
                    {"height", view.height},
                    {"azimuth", view.azimuth},
                    {"elevation", view.elevation},
                    {"roll", view.roll},
                    {"up", view.up},
                    {"cuts", std::move(cuts)},
                    {"peel",
                     {{"on", view.peel.on},
                      {"marker", view.peel.marker},
                      {"from", view.peel.from},
                      {"to", view.peel.to}}}});
  }
  return list;
}

std::vector<KeptView> read_kept_views(const json& list) {
  std::vector<KeptView> views;
  if (!list.is_array()) return views;
  for (const json& entry : list) {
    if (views.size() == most_kept_views) break;
    if (auto view = view_in(entry)) views.push_back(std::move(*view));
  }
  return views;
}

}  // namespace winslow::gui
