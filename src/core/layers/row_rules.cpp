#include "core/layers/row_rules.h"

#include <map>

namespace winslow {

namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

void shorten(Strip& strip, std::size_t rows, LayerEnd why) {
  if (strip.rows.size() <= rows) return;
  strip.rows.resize(rows);
  strip.end = why;
}

LayerEnd fault_of_row(const Strip& strip, double height, double width) {
  constexpr double least_aspect = 2, steepest_rise = 3, steepest_fall = 0.5;
  if (!strip.fan && width < least_aspect * height) return LayerEnd::isotropic;
  if (strip.rows.empty()) return LayerEnd::none;
  const double ratio = height / strip.rows.back().height;
  return ratio > steepest_rise || ratio < steepest_fall ? LayerEnd::growth : LayerEnd::none;
}

void close_where_heights_shrink(const std::vector<Strip>& strips,
                                const std::function<void(std::size_t)>& close) {
  constexpr double least_ratio = 0.95;
  std::map<std::size_t, std::vector<double>> ratios;
  for (const Strip& strip : strips) {
    if (!strip.open || strip.rows.empty()) continue;
    ratios[strip.chain].push_back(strip.next_height / strip.rows.back().height);
  }
  for (auto& [chain, values] : ratios) {
    if (median(values) >= least_ratio) continue;
    for (std::size_t s = 0; s < strips.size(); ++s) {
      if (strips[s].open && strips[s].chain == chain) close(s);
    }
  }
}

void end_where_growth_ends(std::vector<Strip>& strips, std::size_t chain) {
  constexpr double least_ratio = 1.01;
  std::size_t most = 0;
  for (const Strip& strip : strips) {
    if (strip.chain == chain) most = std::max(most, strip.rows.size());
  }
  std::size_t last = 0;  // rows that are left
  for (std::size_t k = 1; k < most; ++k) {
    std::vector<double> ratios;
    for (const Strip& strip : strips) {
      if (strip.chain != chain || strip.rows.size() <= k) continue;
      ratios.push_back(strip.rows[k].height / strip.rows[k - 1].height);
    }
    if (median(ratios) >= least_ratio) last = k + 1;
  }
  for (Strip& strip : strips) {
    if (strip.chain == chain) shorten(strip, last, LayerEnd::growth);
  }
}

void level_neighbours(std::vector<Strip>& strips, std::size_t columns) {
  std::vector<std::optional<std::size_t>> on_left(columns), on_right(columns);
  for (std::size_t s = 0; s < strips.size(); ++s) {
    on_right[strips[s].left] = s;
    on_left[strips[s].right] = s;
  }
  const auto settle = [&](std::size_t s) {
    bool changed = false;
    for (const auto& beside : {on_left[strips[s].left], on_right[strips[s].right]}) {
      if (!beside) continue;
      const std::size_t most = strips[*beside].rows.size() + (strips[s].fan ? 0 : 2);
      changed = changed || strips[s].rows.size() > most;
      shorten(strips[s], most, LayerEnd::neighbours);
    }
    return changed;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t s = 0; s < strips.size(); ++s) changed = settle(s) || changed;
    for (std::size_t s = strips.size(); s-- > 0;) changed = settle(s) || changed;
  }
}

std::vector<StripStep> steps_above(const Topology& topology, OpenMesh::HalfedgeHandle edge) {
  const HalfEdgeMesh& mesh = topology.half_edges();
  const auto from = [&](auto h) { return mesh.from_vertex_handle(h).idx(); };
  const auto to = [&](auto h) { return mesh.to_vertex_handle(h).idx(); };
  const Index first = mesh.face_handle(edge).idx();
  if (first < 0) return {};
  const auto rising = mesh.next_halfedge_handle(edge);  // at the right column, if it is a quad
  const auto second_side = mesh.next_halfedge_handle(rising);
  const auto opposite = [&](auto h) { return mesh.opposite_halfedge_handle(h); };
  if (topology.element_type(first) == ElementType::quadrilateral) {
    return {{to(second_side), from(second_side), {first, -1}, opposite(second_side)}};
  }
  std::vector<StripStep> steps;
  // The diagonal is the side on the right (the apex lies in the left column), or that on the left.
  for (const bool right : {true, false}) {
    const auto beyond = opposite(right ? rising : second_side);
    const Index second = mesh.face_handle(beyond).idx();
    if (second < 0 || topology.element_type(second) != ElementType::triangle) continue;
    const auto a = mesh.next_halfedge_handle(beyond), b = mesh.next_halfedge_handle(a);
    const auto far = right ? b : a;  // from the right column to the left one
    steps.push_back({to(far), from(far), {first, second}, opposite(far)});
  }
  return steps;
}

}  // namespace winslow
