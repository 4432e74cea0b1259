#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

namespace winslow::gui {

/// How a marker of a volume mesh is drawn; automatic: a body as a surface, what encloses bodies as
/// an outline.
enum class MarkerDrawing { automatic, surface, outline };

/// How one marker is shown, and whether the mouse may take it.
struct MarkerLook {
  bool hidden = false;                        ///< not drawn; the mouse passes through it
  bool locked = false;                        ///< drawn, but neither selected nor moved
  std::optional<std::array<float, 3>> color;  ///< red, green, blue, 0 to 1; none: by its number
  // In space.
  MarkerDrawing drawing = MarkerDrawing::automatic;
  double opacity = 1;  ///< of its surface, 0.1 to 1

  bool operator==(const MarkerLook&) const = default;
};

/// The looks of the markers of one mesh; those as designed are left out.
struct MarkerLooks {
  std::string mesh;  ///< file of that mesh
  std::map<std::string, MarkerLook> by_name;

  bool operator==(const MarkerLooks&) const = default;

  /// As designed where nothing else was chosen.
  MarkerLook of(const std::string& marker) const {
    const auto it = by_name.find(marker);
    return it == by_name.end() ? MarkerLook() : it->second;
  }
  void set(const std::string& marker, const MarkerLook& look) {
    if (look == MarkerLook())
      by_name.erase(marker);
    else
      by_name[marker] = look;
  }
};

}  // namespace winslow::gui
