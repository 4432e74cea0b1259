#include "gui/render/cell_cover.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace winslow::gui {
namespace {

/// The values of x at which something is met.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void take(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

/// Cuts a convex polygon off where an axis exceeds a limit, or falls below it (sign -1).
std::vector<Vec2> cut_side(const std::vector<Vec2>& polygon, int axis, double limit, double sign) {
  std::vector<Vec2> kept;
  const auto beyond = [&](const Vec2& p) { return sign * (p[axis] - limit); };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2& a = polygon[k];
    const Vec2& b = polygon[(k + 1) % polygon.size()];
    if (beyond(a) <= 0) kept.push_back(a);
    if ((beyond(a) <= 0) == (beyond(b) <= 0)) continue;
    Vec2 at = a + (b - a) * ((limit - a[axis]) / (b[axis] - a[axis]));
    at[axis] = limit;
    kept.push_back(at);
  }
  return kept;
}

bool empty(const std::array<std::uint64_t, 2>& m) { return (m[0] | m[1]) == 0; }

}  // namespace

int CellCover::cell(double x) { return std::clamp(static_cast<int>(std::floor(x)), 0, count - 1); }

CellCover::Mask CellCover::mask(int begin, int end) {
  Mask m{};
  for (int word = 0; word < 2; ++word) {
    const int from = std::clamp(begin - 64 * word, 0, 64);
    const int to = std::clamp(end - 64 * word, 0, 64);
    if (from >= to) continue;
    const std::uint64_t upper = to == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << to) - 1;
    m[static_cast<std::size_t>(word)] = upper & ~((std::uint64_t{1} << from) - 1);
  }
  return m;
}

CellCover::Row CellCover::row_of(const Triangle& p, int row) {
  const double bottom = row, top = row + 1;
  Span all, at_bottom, at_top;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool rising = p[k].y() < p[(k + 1) % 3].y();
    const Vec2& a = rising ? p[k] : p[(k + 1) % 3];
    const Vec2& b = rising ? p[(k + 1) % 3] : p[k];
    if (b.y() < bottom - slack || a.y() > top + slack) continue;
    const double rise = b.y() - a.y();
    const auto x_at = [&](double y) {
      const double t = rise > 0 ? std::clamp((y - a.y()) / rise, 0.0, 1.0) : 0.0;
      return a.x() + t * (b.x() - a.x());
    };
    all.take(x_at(bottom));
    all.take(rise > 0 ? x_at(top) : b.x());
    if (a.y() <= bottom && b.y() >= bottom) at_bottom.take(x_at(bottom));
    if (a.y() <= top && b.y() >= top) at_top.take(x_at(top));
  }
  Row result;
  if (all.high < all.low) return result;
  result.touched = mask(cell(all.low - slack), cell(all.high + slack) + 1);
  const double from = std::max(at_bottom.low, at_top.low) + slack;
  const double to = std::min(at_bottom.high, at_top.high) - slack;
  if (from < to) {
    const double begin = std::max(std::ceil(from), 0.0);
    const double end = std::min(std::floor(to), static_cast<double>(count));
    if (begin < end) result.covered = mask(static_cast<int>(begin), static_cast<int>(end));
  }
  return result;
}

bool CellCover::outside(const Triangle& p) const {
  return std::ranges::any_of(p, [](const Vec2& corner) {
    return !(corner.minCoeff() >= -slack && corner.maxCoeff() <= count + slack);
  });
}

void CellCover::hand_over(const std::vector<Vec2>& cells, const Piece& piece) const {
  if (cells.size() < 2) return;
  std::vector<Vec2> polygon;
  polygon.reserve(cells.size());
  for (const Vec2& p : cells) polygon.push_back(from_cells(p));
  piece(polygon);
}

/// Rectangles of neighbouring cells of a row; or what of a triangle lies in them.
void CellCover::emit_runs(const Mask& cells, int row, const Triangle* cut,
                          const Piece& piece) const {
  const auto set = [&](int x) {
    return x < count && ((cells[static_cast<std::size_t>(x / 64)] >> (x % 64)) & 1U) != 0;
  };
  for (int x = 0; x < count;) {
    if (!set(x)) {
      ++x;
      continue;
    }
    int end = x;
    while (set(end)) ++end;
    std::vector<Vec2> polygon{{x, row}, {end, row}, {end, row + 1}, {x, row + 1}};
    if (cut) {
      polygon.assign(cut->begin(), cut->end());
      for (const int axis : {0, 1}) {
        polygon = cut_side(polygon, axis, axis == 0 ? x : row, -1);
        polygon = cut_side(polygon, axis, axis == 0 ? end : row + 1, 1);
      }
    }
    if (polygon.size() > 2) hand_over(polygon, piece);
    x = end;
  }
}

void CellCover::cut(const Triangle& triangle, bool add, const Piece& piece) {
  const Triangle p{to_cells(triangle[0]), to_cells(triangle[1]), to_cells(triangle[2])};
  const Vec2 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
  const Vec2 high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
  const Mask width = mask(cell(low.x() - slack), cell(high.x() + slack) + 1);
  const int first = cell(low.y() - slack), last = cell(high.y() + slack);
  // Of small ones there is nothing to save.
  const bool small = (high - low).maxCoeff() < 2;
  if (outside(p)) return piece({triangle.begin(), triangle.end()});
  for (int row = first; row <= last; ++row) {
    Mask& covered = covered_[static_cast<std::size_t>(row)];
    const Mask open{width[0] & ~covered[0], width[1] & ~covered[1]};
    if (empty(open)) continue;
    const Row r = row_of(p, row);
    Mask fresh{}, rim{};
    for (std::size_t w = 0; w < 2; ++w) {
      const std::uint64_t full = add ? r.covered[w] : 0;
      fresh[w] = full & open[w];
      rim[w] = r.touched[w] & ~full & open[w];
    }
    if (small && !empty(rim)) return piece({triangle.begin(), triangle.end()});
    emit_runs(fresh, row, nullptr, piece);
    emit_runs(rim, row, &p, piece);
    for (std::size_t w = 0; w < 2; ++w) covered[w] |= fresh[w];
  }
}

void CellCover::cut_line(const Vec2& a, const Vec2& b, const Piece& piece) const {
  const Triangle p{to_cells(a), to_cells(b), to_cells(b)};
  if (outside(p)) return piece({a, b});
  const int first = cell(std::min(p[0].y(), p[1].y()) - slack);
  const int last = cell(std::max(p[0].y(), p[1].y()) + slack);
  for (int row = first; row <= last; ++row) {
    const Mask& covered = covered_[static_cast<std::size_t>(row)];
    const Row r = row_of(p, row);
    const Mask open{r.touched[0] & ~covered[0], r.touched[1] & ~covered[1]};
    if (empty(open)) continue;
    const int begin = open[0] ? std::countr_zero(open[0]) : 64 + std::countr_zero(open[1]);
    const int end = open[1] ? 128 - std::countl_zero(open[1]) : 64 - std::countl_zero(open[0]);
    std::vector<Vec2> line{p[0], p[1]};
    line = cut_side(cut_side(line, 1, row, -1), 1, row + 1, 1);
    line = cut_side(cut_side(line, 0, begin, -1), 0, end, 1);
    if (line.size() < 2) continue;
    const auto far = std::ranges::max_element(
        line, {}, [&](const Vec2& q) { return (q - line.front()).squaredNorm(); });
    hand_over({line.front(), *far}, piece);
  }
}

}  // namespace winslow::gui
