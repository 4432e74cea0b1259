#include "gui/settings/settings.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "gui/render/color_scale.h"
#include "io/file/atomic_file.h"
#include "io/text/text_file.h"

namespace winslow::gui {

namespace {

using nlohmann::json;

// Dragging a splitter changes the layout in every frame.
constexpr double rest_seconds = 0.4;

// More than any settings have.
constexpr std::size_t most_bytes = std::size_t{1} << 24;
constexpr int deepest = 100;

/// True for what can be the name of a file, a mesh or a panel.
bool is_name(const std::string& text) {
  constexpr std::size_t longest = 4096;  // of a path
  return text.size() <= longest && text.find('\0') == std::string::npos;
}

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

/// Visits every saved value of the view, with its key and, for numbers, its limits.
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

/// Reads an object; missing or invalid entries leave a value unchanged.
struct Reader {
  const json& object;

  /// The entry with this key if it has this type, otherwise null.
  const json* find(const char* key, bool (json::*is)() const noexcept) const {
    const auto it = object.is_object() ? object.find(key) : object.end();
    return it != object.end() && ((*it).*is)() ? &*it : nullptr;
  }
  /// Reader of a nested object; empty if there is none.
  Reader within(const char* key) const {
    static const json none = json::object();
    const json* found = find(key, &json::is_object);
    return {found ? *found : none};
  }
  std::optional<double> number(const char* key) const {
    const json* found = find(key, &json::is_number);
    return found && std::isfinite(found->get<double>()) ? std::optional(found->get<double>())
                                                        : std::nullopt;
  }
  std::optional<std::string> text(const char* key) const {
    const json* found = find(key, &json::is_string);
    const bool usable = found && is_name(found->get_ref<const std::string&>());
    return usable ? std::optional(found->get<std::string>()) : std::nullopt;
  }
  /// The names in a list, without other entries; none: there is no list.
  std::optional<std::vector<std::string>> texts(const char* key) const {
    const json* found = find(key, &json::is_array);
    if (!found) return std::nullopt;
    std::vector<std::string> all;
    for (const json& text : *found)
      if (text.is_string() && is_name(text.get_ref<const std::string&>()))
        all.push_back(text.get<std::string>());
    return all;
  }
  /// A list of exactly `count` numbers.
  template <std::size_t count>
  std::optional<std::array<double, count>> numbers(const char* key) const {
    const json* found = find(key, &json::is_array);
    if (!found || found->size() != count) return std::nullopt;
    std::array<double, count> read{};
    for (std::size_t k = 0; k < count; ++k) {
      if (!(*found)[k].is_number()) return std::nullopt;
      read[k] = (*found)[k].get<double>();
      if (!std::isfinite(read[k])) return std::nullopt;
    }
    return read;
  }

  void flag(const char* key, bool& value) const {
    if (const json* found = find(key, &json::is_boolean)) value = found->get<bool>();
  }
  template <class Number>
  void number(const char* key, Number& value, double least, double most) const {
    const auto read = number(key);
    if (read && *read >= least && *read <= most) value = static_cast<Number>(*read);
  }
  void map(const char* key, std::string& value) const {
    const auto names = color_map_choices();
    const auto read = text(key);
    if (read && std::ranges::find(names, *read) != names.end()) value = *read;
  }
  void percentiles(const char* key, std::optional<std::array<double, 2>>& value) const {
    const auto read = numbers<2>(key);
    if (read && (*read)[0] >= 0 && (*read)[0] < (*read)[1] && (*read)[1] <= 100) value = read;
  }
  void field(const char* key, std::optional<ElementField>& value) const {
    if (find(key, &json::is_null)) value.reset();
    const auto read = text(key);
    if (!read) return;
    // A field unknown to this version falls back to the default.
    for (const MeshKind kind : {MeshKind::plane, MeshKind::surface}) {
      const std::vector<ElementField>& all = all_element_fields(kind);
      const auto same = std::ranges::find_if(
          all, [&](const ElementField& f) { return field_info(f).name == *read; });
      if (same == all.end()) continue;
      value = *same;
      return;
    }
  }
  void looks(const char* key, MarkerLooks& value) const {
    const Reader kept = within(key);
    const auto mesh = kept.text("mesh");
    const json* list = kept.find("looks", &json::is_object);
    if (!mesh || !list) return;
    value.mesh = *mesh;
    for (const auto& [name, entry] : list->items()) {
      if (!entry.is_object()) continue;
      MarkerLook look;
      const Reader of_marker{entry};
      of_marker.flag("hidden", look.hidden);
      of_marker.flag("locked", look.locked);
      of_marker.choice("drawing", look.drawing, drawings);
      of_marker.number("opacity", look.opacity, 0.1, 1);
      if (const auto color = of_marker.numbers<3>("color")) {
        look.color.emplace();
        for (std::size_t k = 0; k < 3; ++k)
          (*look.color)[k] = static_cast<float>(std::clamp((*color)[k], 0.0, 1.0));
      }
      value.set(name, look);
    }
  }
  template <class Choice, std::size_t count>
  void choice(const char* key, Choice& value, const Names<Choice, count>& names) const {
    const auto read = text(key);
    for (const auto& [each, name] : names)
      if (read == name) value = each;
  }
};

ViewOptions read_view(const Reader& object) {
  ViewOptions view;
  visit(view, object);
  // Scales below 0.5 would be illegible; 0 means that of the screen.
  if (view.scale < 0.5) view.scale = 0;
  return view;
}

std::vector<CutPlane> cuts_in(const Reader& object) {
  std::vector<CutPlane> cuts;
  const json* list = object.find("cuts", &json::is_array);
  for (const json& entry : list ? *list : json::array()) {
    if (!entry.is_object() || cuts.size() == most_cuts) continue;
    const Reader kept{entry};
    const auto point = kept.numbers<3>("point"), normal = kept.numbers<3>("normal");
    if (!point || !normal || *normal == std::array<double, 3>{0, 0, 0}) continue;
    cuts.push_back({*point, *normal, false});
    kept.flag("on", cuts.back().on);
  }
  return cuts;
}

Peel peel_in(const Reader& object) {
  const Reader kept = object.within("peel");
  const auto marker = kept.text("marker");
  const auto from = kept.number("from"), to = kept.number("to");
  if (!marker || !from || !to || !(*from >= 1 && *from <= *to && *to < 1e9)) return {};
  Peel peel{false, *marker, static_cast<int>(*from), static_cast<int>(*to)};
  kept.flag("on", peel.on);
  return peel;
}

std::optional<KeptView> kept_view(const Reader& entry) {
  const auto mesh = entry.text("mesh");
  const auto centre = entry.numbers<3>("centre");
  const auto height = entry.number("height"), azimuth = entry.number("azimuth"),
             elevation = entry.number("elevation"), up = entry.number("up");
  if (!mesh || !centre || !height || !(*height > 0) || !azimuth || !elevation ||
      !(std::abs(*elevation) <= 90) || !up || !(*up >= 0 && *up < 3))
    return std::nullopt;
  const double roll = entry.number("roll").value_or(0);
  return KeptView{
      *mesh,          *centre,       *height, *azimuth, *elevation, roll, static_cast<int>(*up),
      cuts_in(entry), peel_in(entry)};
}

std::vector<KeptView> read_kept_views(const Reader& root) {
  std::vector<KeptView> views;
  const json* list = root.find("views", &json::is_array);
  for (const json& entry : list ? *list : json::array()) {
    if (views.size() == most_kept_views) break;
    if (auto view = kept_view({entry})) views.push_back(std::move(*view));
  }
  return views;
}

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

/// Writes a file and returns the error; empty: none.
std::string write_file(const std::filesystem::path& path, const std::string& text) {
  try {
    std::error_code failed;
    std::filesystem::create_directories(path.parent_path(), failed);
    io::write_atomically(path, [&](std::ostream& out) { out << text; });
    return {};
  } catch (const std::exception& error) {
    return std::string("The settings cannot be kept: ") + error.what();
  }
}

}  // namespace

std::string write_settings(const Settings& settings, const std::string& previous) {
  json root = json::parse(previous, nullptr, false);
  if (!root.is_object()) root = json::object();
  json& view = root["view"];
  if (!view.is_object()) view = json::object();
  visit(settings.view, Writer{view});
  json& layout = root["layout"];
  if (!layout.is_object()) layout = json::object();
  layout["left_width"] = settings.left_width;
  layout["right_width"] = settings.right_width;
  layout["plot_height"] = settings.plot_height;
  layout["folded"] = settings.folded;
  layout["window"] = settings.window;
  root["recent"] = settings.recent;
  root["views"] = write_kept_views(settings.views);
  // File names may contain any bytes.
  return root.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Settings read_settings(const std::string& text) {
  if (io::nested_deeper(text, deepest))
    throw InputError("the settings have more than " + std::to_string(deepest) +
                     " lists in each other");
  const json parsed = json::parse(text, nullptr, false);
  if (!parsed.is_object()) throw InputError("the settings are no JSON object");
  const Reader root{parsed}, layout = root.within("layout");
  Settings settings;
  settings.view = read_view(root.within("view"));
  const auto size = [&](const char* key, float& side) {
    const double read = layout.number(key).value_or(0);
    if (read > 0 && read < 10000) side = static_cast<float>(read);
  };
  size("left_width", settings.left_width);
  size("right_width", settings.right_width);
  size("plot_height", settings.plot_height);
  if (const auto folded = layout.texts("folded"))
    settings.folded = {folded->begin(), folded->end()};
  settings.recent = root.texts("recent").value_or(std::vector<std::string>{});
  settings.views = read_kept_views(root);
  if (const auto window = layout.numbers<2>("window"))
    if (std::ranges::all_of(*window, [](double side) {
          return side >= 200 && side <= 20000 && side == std::round(side);
        }))
      settings.window = {static_cast<int>((*window)[0]), static_cast<int>((*window)[1])};
  return settings;
}

SettingsFile::SettingsFile(const std::filesystem::path& profile) {
  if (profile.empty()) return;
  path_ = profile / "settings.json";
  read();
  kept_ = written_ = initial_;
}

SettingsFile::~SettingsFile() {
  if (path_.empty()) return;
  while (writer_.busy()) writer_.poll();
  if (kept_ != written_) write_file(path_, write_settings(kept_, text_));
}

void SettingsFile::read() {
  std::error_code ignored;
  if (!std::filesystem::exists(path_, ignored)) return;
  try {
    const std::string text = io::read_text_file(path_, most_bytes);
    initial_ = read_settings(text);
    text_ = text;
  } catch (const std::exception& error) {
    // Rename the damaged file, so that its content is not lost when the file is rewritten.
    std::filesystem::path aside = path_;
    aside += ".damaged";
    std::filesystem::rename(path_, aside, ignored);
    problem_ = "The settings of " + path_.string() + " were not used (" + error.what() +
               "); all is as designed.";
  }
}

void SettingsFile::keep(const Settings& now, double seconds) {
  if (path_.empty()) return;
  if (auto failed = writer_.poll(); failed && !failed->empty()) problem_ = std::move(*failed);
  rested_ = now == kept_ ? rested_ + seconds : 0;
  kept_ = now;
  if (rested_ >= rest_seconds && kept_ != written_ && !writer_.busy()) write_now();
}

void SettingsFile::write_now() {
  text_ = write_settings(kept_, text_);
  written_ = kept_;
  writer_.start([path = path_, text = text_] { return write_file(path, text); });
}

std::string SettingsFile::take_problem() { return std::exchange(problem_, {}); }

}  // namespace winslow::gui
