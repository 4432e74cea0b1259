#pragma once

#include <set>

#include "gui/base/background.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// The settings kept between runs of the studio. View options that belong to one mesh are not kept:
/// isolated elements, comparison, magnifier and a range of colours.
struct Settings {
  ViewOptions view;
  /// Sizes of the panels, in units of the layout; 0: default.
  float left_width = 0, right_width = 0, plot_height = 0;
  /// Folded sections of panels, by id; by default the rarely used ones.
  std::set<std::string> folded{"section/mesh", "section/shape", "section/layers",
                               "section/measures"};
  std::vector<KeptView> views;      ///< of volume meshes, the last one first
  std::vector<std::string> recent;  ///< meshes opened last, absolute paths, the last one first
  std::array<int, 2> window{0, 0};  ///< size of the window in units of the layout; 0: default

  bool operator==(const Settings&) const = default;
};

/// The settings as text (JSON). Unknown keys of `previous`, the text that was read before, are kept
/// for other versions of the studio.
std::string write_settings(const Settings& settings, const std::string& previous = {});
/// Reads settings from a text; missing or invalid values get their defaults. Throws InputError if
/// the text is not a JSON object.
Settings read_settings(const std::string& text);

/// The file "settings.json" in the profile folder. It is written atomically in the background,
/// shortly after the last change, and at the end.
class SettingsFile {
 public:
  /// Reads the file. profile empty: nothing is read and nothing is kept.
  explicit SettingsFile(const std::filesystem::path& profile);
  /// Writes unsaved changes.
  ~SettingsFile();
  SettingsFile(const SettingsFile&) = delete;
  SettingsFile& operator=(const SettingsFile&) = delete;

  /// The settings read from the file.
  const Settings& initial() const { return initial_; }
  /// Passes the present settings. seconds: since the last call.
  void keep(const Settings& now, double seconds);
  /// The error since the last call, for the user; empty: none.
  std::string take_problem();

 private:
  void read();
  void write_now();

  std::filesystem::path path_;  // empty: nothing is saved
  std::string text_;            // of the file
  Settings initial_, kept_, written_;
  double rested_ = 0;  // seconds since kept_ changed
  std::string problem_;
  Background<std::string> writer_;
};

}  // namespace winslow::gui
