#pragma once

#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types.h"

/// Heights of layers, from the wall outwards:
///
///     const winslow::LayerSpacing spacing{.count = 20, .first = 1e-4, .ratio = 1.2};
///     const std::vector<double> heights = winslow::layer_heights(spacing);
namespace winslow {

constexpr int most_layers = 1000;

inline double sum_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Heights of the layers at a wall: h_0 = first, h_(k+1) = h_k r_k, r_k = ratio growth^k.
///
/// AIAA 2009-1362, section "Layers Added to Circle Mesh": "initial progression factor 1.15,
/// multiplied by a growth rate of 1.01 for each subsequent layer".
struct LayerSpacing {
  int count = 15;        ///< layers
  double first = 0.001;  ///< height of the layer at the wall, in units of the mesh
  double ratio = 1.15;   ///< of the second height to the first
  double growth = 1.01;  ///< of the ratio, from one layer to the next
  /// Thickness of all layers together, in units of the mesh. It replaces `ratio`.
  std::optional<double> total = std::nullopt;
  /// The last layer gets the height of the elements outside. This replaces `count`, and the ratio
  /// is adjusted for each column.
  bool match_outside = false;

  bool operator==(const LayerSpacing&) const = default;
};

/// Throws UsageError naming the number that is out of range.
void validate(const LayerSpacing& spacing);

/// Heights of all layers (#count) from the wall outwards. Throws UsageError if `total` is less than
/// the layers take at a constant height.
std::vector<double> layer_heights(const LayerSpacing& spacing);

/// The same with all ratios scaled so that the sum of the heights is `thickness`; the first height
/// stays. If even constant heights are too thick there are fewer layers, or none if there is no
/// room for one.
std::vector<double> layer_heights_within(const LayerSpacing& spacing, double thickness);

/// The same with all ratios scaled so that the last height is `last`; layer_heights() if that needs
/// ratios below 1.
std::vector<double> layer_heights_ending_with(const LayerSpacing& spacing, double last);

/// Number of layers, at the given ratio and growth, until one is at least `last` high.
int layers_until(const LayerSpacing& spacing, double last);

/// Height of the first node above a wall at a wanted y+ = u_tau y / nu, from the turbulent
/// flat-plate friction C_f = 0.026 / Re^(1/7) (F. M. White, Fluid Mechanics, 5th ed., section 7.4),
/// u_tau / U = sqrt(C_f / 2).
/// reynolds: of the reference length; length: that length in units of the mesh. Throws UsageError
/// for numbers that are not positive.
double first_height_for_y_plus(double y_plus, double reynolds, double length);

/// A box, in units of the mesh. The default is the whole plane.
struct WallPart {
  double xmin = -std::numeric_limits<double>::infinity();
  double xmax = std::numeric_limits<double>::infinity();
  double ymin = -std::numeric_limits<double>::infinity();
  double ymax = std::numeric_limits<double>::infinity();

  bool holds(const Vec2& p) const {
    return p.x() >= xmin && p.x() <= xmax && p.y() >= ymin && p.y() <= ymax;
  }
  bool operator==(const WallPart&) const = default;
};

/// A wall and its wanted layers.
struct LayerWall {
  std::vector<std::string> markers;
  LayerSpacing spacing;
  WallPart part = {};  ///< only edges of the markers with both ends in this box

  bool operator==(const LayerWall&) const = default;
};

}  // namespace winslow
