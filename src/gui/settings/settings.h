#pragma once

#include <set>

#include "gui/base/background.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// What the studio remembers from one run to the next. Of the view it is what does not belong to
/// one mesh: isolated elements, comparison, magnifier and a range of colours start anew.
struct Settings {
  ViewOptions view;
  /// Sizes of the panels, in units of the layout; 0: as designed.
  float left_width = 0, right_width = 0, plot_height = 0;
  /// Sections of panels that are folded, by id; at first those that few need.
  std::set<std::string> folded{"section/mesh", "section/shape", "section/layers",
                               "section/measures"};
  std::vector<KeptView> views;      ///< of volume meshes, the last one first
  std::vector<std::string> recent;  ///< meshes opened last, absolute paths, the last one first
  std::array<int, 2> window{0, 0};  ///< size of the window in units of the layout; 0: as designed

  bool operator==(const Settings&) const = default;
};

/// The settings as text (JSON). Keys of `previous` (the text that the settings came from) that are
/// not known here are kept: another version of the studio may want them.
std::string write_settings(const Settings& settings, const std::string& previous = {});
/// The settings of a text: what is missing or makes no sense is as designed. Throws InputError if
/// the text is no JSON object.
Settings read_settings(const std::string& text);

/// The file "settings.json" in the profile folder. Written in the background, whole or not at all,
/// once the settings have rested for a moment, and at the end.
class SettingsFile {
 public:
  /// Reads the file. profile empty: nothing is read and nothing is kept.
  explicit SettingsFile(const std::filesystem::path& profile);
  /// Writes what is not written yet.
  ~SettingsFile();
  SettingsFile(const SettingsFile&) = delete;
  SettingsFile& operator=(const SettingsFile&) = delete;

  /// As read from the file.
  const Settings& initial() const { return initial_; }
  /// Takes the settings as they are now. seconds: since the last call.
  void keep(const Settings& now, double seconds);
  /// What went wrong since the last call, for the user; empty: nothing.
  std::string take_problem();

 private:
  void read();
  void write_now();

  std::filesystem::path path_;  // empty: nothing is kept
  std::string text_;            // of the file
  Settings initial_, kept_, written_;
  double rested_ = 0;  // seconds since kept_ changed
  std::string problem_;
  Background<std::string> writer_;
};

}  // namespace winslow::gui
