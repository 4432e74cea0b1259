#include "gui/settings/settings.h"

#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "core/error.h"
#include "gui/settings/view_settings.h"
#include "io/file/atomic_file.h"

namespace winslow::gui {

namespace {

using nlohmann::json;

// A splitter under the mouse changes the layout in every frame.
constexpr double rest_seconds = 0.4;

float size_of(const json& layout, const char* key) {
  const auto it = layout.find(key);
  if (it == layout.end() || !it->is_number()) return 0;
  const auto size = it->get<double>();
  return size > 0 && size < 10000 ? static_cast<float>(size) : 0;
}

const json& object_in(const json& parent, const char* key) {
  static const json none = json::object();
  const auto it = parent.find(key);
  return it != parent.end() && it->is_object() ? *it : none;
}

/// Writes and says what went wrong.
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
  write_view(settings.view, view);
  json& layout = root["layout"];
  if (!layout.is_object()) layout = json::object();
  layout["left_width"] = settings.left_width;
  layout["right_width"] = settings.right_width;
  layout["plot_height"] = settings.plot_height;
  layout["folded"] = settings.folded;
  layout["window"] = settings.window;
  root["recent"] = settings.recent;
  root["views"] = write_kept_views(settings.views);
  // Names of files may hold any bytes.
  return root.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Settings read_settings(const std::string& text) {
  const json root = json::parse(text, nullptr, false);
  if (!root.is_object()) throw InputError("the settings are no JSON object");
  Settings settings;
  settings.view = read_view(object_in(root, "view"));
  const json& layout = object_in(root, "layout");
  settings.left_width = size_of(layout, "left_width");
  settings.right_width = size_of(layout, "right_width");
  settings.plot_height = size_of(layout, "plot_height");
  if (const auto it = layout.find("folded"); it != layout.end() && it->is_array()) {
    settings.folded.clear();
    for (const json& id : *it)
      if (id.is_string()) settings.folded.insert(id.get<std::string>());
  }
  if (const auto it = root.find("recent"); it != root.end() && it->is_array())
    for (const json& path : *it)
      if (path.is_string()) settings.recent.push_back(path.get<std::string>());
  if (const auto it = root.find("views"); it != root.end()) settings.views = read_kept_views(*it);
  if (const auto it = layout.find("window"); it != layout.end() && it->is_array() &&
                                             it->size() == 2 && (*it)[0].is_number_integer() &&
                                             (*it)[1].is_number_integer()) {
    const std::array<long, 2> size{(*it)[0].get<long>(), (*it)[1].get<long>()};
    if (std::ranges::all_of(size, [](long s) { return s >= 200 && s <= 20000; }))
      settings.window = {static_cast<int>(size[0]), static_cast<int>(size[1])};
  }
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
  std::ifstream file(path_, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  try {
    if (!file) throw InputError("the file cannot be read");
    initial_ = read_settings(text.str());
    text_ = text.str();
  } catch (const std::exception& error) {
    // Put aside, so that nothing that its owner wrote there is lost when the file is written anew.
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
