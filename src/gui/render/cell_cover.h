#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/mesh/mesh.h"

namespace winslow::gui {

using Triangle = std::array<Vec2, 3>;

/// A box divided into cells, and which of them are covered by a triangle: what lies behind those
/// alone is not seen.
class CellCover {
 public:
  explicit CellCover(const Bounds& box)
      : origin_(box.min), size_((box.size().array() / count).matrix()) {}

  /// What of a triangle is seen: whole, or convex pieces of it (counter-clockwise or as the
  /// triangle is turned).
  using Piece = std::function<void(const std::vector<Vec2>& polygon)>;

  /// Hands over what of a triangle is not behind what is covered so far. add: covers what it
  /// covers.
  void cut(const Triangle& triangle, bool add, const Piece& piece);
  /// The parts of a line that are not behind what is covered.
  void cut_line(const Vec2& a, const Vec2& b, const Piece& piece) const;

 private:
  static constexpr int count = 128;
  static constexpr double slack = 1e-4;  // of a cell: single precision moves corners

  /// Cells of a row, from the left, 64 a word.
  using Mask = std::array<std::uint64_t, 2>;
  /// Where a triangle lies in a row: cells that it touches, and those that it covers.
  struct Row {
    Mask touched{}, covered{};
  };
  static Mask mask(int begin, int end);
  static Row row_of(const Triangle& p, int row);
  static int cell(double x);
  bool outside(const Triangle& p) const;
  Vec2 to_cells(const Vec2& p) const { return (p - origin_).cwiseQuotient(size_); }
  Vec2 from_cells(const Vec2& p) const { return origin_ + p.cwiseProduct(size_); }
  void hand_over(const std::vector<Vec2>& cells, const Piece& piece) const;
  void emit_runs(const Mask& cells, int row, const Triangle* cut, const Piece& piece) const;

  Vec2 origin_, size_;
  std::array<Mask, count> covered_{};
};

}  // namespace winslow::gui
