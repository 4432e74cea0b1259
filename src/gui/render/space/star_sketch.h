#pragma once

#include "core/types.h"
#include "gui/render/space/space_view.h"

namespace winslow::gui {

/// Prepares a solid of a few triangles for a draw list, which has no depth buffer: sorts triangles
/// into the order of painting, and splits lines where triangles hide them.
class StarSketch {
 public:
  struct Face {
    std::size_t triangle = 0;
    std::array<ScreenPoint, 3> at;
    bool front = false;  ///< seen from outside
    double light = 1;    ///< 0 to 1: how squarely it faces a lamp behind the viewer's left shoulder
  };
  struct Piece {
    ScreenPoint a, b;
    bool hidden = false;
  };

  /// triangles: counter-clockwise seen from outside. All pairs are compared: meant for up to some
  /// hundred.
  StarSketch(const SpaceCamera& camera, std::span<const Vec3> points,
             std::span<const std::array<Index, 3>> triangles);

  /// The furthest first: of two that overlap on screen, the one behind comes first.
  const std::vector<Face>& faces() const { return faces_; }
  /// Splits a line into visible and hidden pieces, from a to b.
  std::vector<Piece> cut(const Vec3& a, const Vec3& b) const;
  /// True if a triangle lies in front of the point.
  bool hides(const Vec3& point) const;

 private:
  struct Corner {
    ScreenPoint at;
    double depth = 0;
  };
  struct Flat {
    std::array<Corner, 3> corners;  ///< counter-clockwise on paper
    double depth = 0;               ///< of the middle
    double area = 0;                ///< twice the area on screen, positive
    double depth_at(const ScreenPoint& p) const;
  };
  void order();
  /// Negative: a lies behind b; positive: before it; 0: they do not overlap.
  double compare(const Flat& a, const Flat& b) const;

  const SpaceCamera& camera_;
  std::vector<Face> faces_;
  std::vector<Flat> flats_;  // of triangles that are not seen edge on
  double slack_ = 0;         // smaller differences of depth do not count
};

}  // namespace winslow::gui
