#include "core/geometry/reference_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace winslow {

ReferenceLines::ReferenceLines(const SpacePoints& x, std::span<const SurfaceFace> faces,
                               const SurfaceEdges& edges, Index node_count,
                               const ReferenceShape& shape, double angle)
    : x_(x),
      edges_(edges),
      shape_(shape),
      shortest_(at(node_count), std::numeric_limits<double>::infinity()),
      edges_at_(at(node_count)),
      lines_(edges.nodes.size(), -1),
      found_(at(shape.line_count()), 0.0) {
  const auto sharp = feature_edges(x_, faces, edges, angle);
  const auto less_sharp = feature_edges(x_, faces, edges, angle / 2);
  for (std::size_t k = 0; k < edges.nodes.size(); ++k) {
    turns_.push_back(sharp[k] != 0 ? 1.0 : less_sharp[k] != 0 ? 0.5 : 0.0);
    for (const Index node : edges.nodes[k]) {
      edges_at_[at(node)].push_back(static_cast<Index>(k));
      double& shortest = shortest_[at(node)];
      shortest = std::min(shortest, length(static_cast<Index>(k)));
    }
  }
  find_edges();
  find_chains();
  find_corners();
}

double ReferenceLines::length(Index edge) const {
  const auto [a, b] = edges_.nodes[at(edge)];
  return (x_[b] - x_[a]).norm();
}

Index ReferenceLines::line_along(Index edge, double share) const {
  const auto [a, b] = edges_.nodes[at(edge)];
  const double reach = share * std::min(shortest_[at(a)], shortest_[at(b)]);
  const auto place = shape_.nearest_line(0.5 * (x_[a] + x_[b]), reach);
  constexpr double along = 0.8;
  if (!place || std::abs(place->tangent.dot((x_[b] - x_[a]).normalized())) < along) return -1;
  for (const Index node : {a, b})
    if (shape_.foot_on_line(place->line, x_[node]).distance > reach) return -1;
  return place->line;
}

void ReferenceLines::find_edges() {
  constexpr double near = 0.3, less_near = 0.7, most = 0.5;
  const auto count = static_cast<Index>(lines_.size());
  for (Index k = 0; k < count; ++k) {
    lines_[at(k)] = line_along(k, near);
    if (lines_[at(k)] >= 0) found_[at(lines_[at(k)])] += length(k);
  }
  std::vector<double> also(found_.size(), 0.0);
  for (Index k = 0; k < count; ++k) {
    if (lines_[at(k)] >= 0 || turns_[at(k)] < 1) continue;
    const Index line = line_along(k, less_near);
    if (line < 0 || found_[at(line)] >= most * shape_.length(line)) continue;
    lines_[at(k)] = line;
    also[at(line)] += length(k);
  }
  for (std::size_t k = 0; k < also.size(); ++k) found_[k] += also[k];
}

void ReferenceLines::find_chains() {
  std::vector<std::vector<Index>> edges_about(found_.size());
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const auto [a, b] = edges_.nodes[k];
    for (const Index line : shape_.lines_about(x_[a], shortest_[at(a)]))
      edges_about[at(line)].push_back(static_cast<Index>(k));
  }
  std::vector<Index> order;
  for (Index line = 0; line < shape_.line_count(); ++line) {
    constexpr double all = 0.95;
    if (!shape_.closed(line) && found_[at(line)] < all * shape_.length(line)) order.push_back(line);
  }
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](Index line) { return shape_.length(line); });
  for (const Index line : order) {
    const std::vector<Step> chain = best_chain(steps_along(line, edges_about[at(line)]));
    constexpr double most = 0.5;
    if (chain.size() < 2) continue;
    const double covered = chain.back().end - chain.front().begin;
    if (covered <= found_[at(line)] || covered < most * shape_.length(line)) continue;
    std::ranges::replace(lines_, line, -1);
    for (const Step& step : chain) lines_[at(step.edge)] = line;
    found_[at(line)] = covered;
  }
}

std::vector<ReferenceLines::Step> ReferenceLines::steps_along(Index line,
                                                              std::span<const Index> edges) const {
  std::vector<Step> steps;
  for (const Index edge : edges) {
    if (lines_[at(edge)] >= 0 && lines_[at(edge)] != line) continue;
    auto [from, to] = edges_.nodes[at(edge)];
    auto begin = shape_.foot_on_line(line, x_[from]), end = shape_.foot_on_line(line, x_[to]);
    if (begin.arc > end.arc) {
      std::swap(from, to);
      std::swap(begin, end);
    }
    constexpr double along = 0.7, near = 0.5, less_near = 1;
    const double off_begin = begin.distance / shortest_[at(from)];
    const double off_end = end.distance / shortest_[at(to)];
    const double reach = turns_[at(edge)] > 0 ? less_near : near;
    if (std::max(off_begin, off_end) > reach || end.arc - begin.arc < along * length(edge))
      continue;
    // Within the line no chain crosses another.
    const double margin = length(edge) / 2;
    const auto passes = [&](Index node, double arc) {
      return arc < margin || arc > shape_.length(line) - margin || !meets_other_line(node, line);
    };
    if (!passes(from, begin.arc) || !passes(to, end.arc)) continue;
    const double off = (off_begin + off_end) / 2;
    steps.push_back({edge, from, to, begin.arc, end.arc,
                     (end.arc - begin.arc) * (1 - off * off) * (1 + turns_[at(edge)])});
  }
  std::ranges::stable_sort(steps, {}, &Step::begin);
  return steps;
}

std::vector<ReferenceLines::Step> ReferenceLines::best_chain(std::span<const Step> steps) const {
  std::map<Index, std::vector<std::size_t>> ending_at;  // node: steps
  std::vector<double> worth;                            // of the best chain that ends with a step
  std::vector<std::optional<std::size_t>> before;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    double most = 0;
    before.emplace_back();
    for (const std::size_t other : ending_at[steps[k].from])
      // A line that does not turn does not go around the corner of a face.
      if (worth[other] > most && !share_face(steps[k].edge, steps[other].edge)) {
        most = worth[other];
        before.back() = other;
      }
    worth.push_back(most + steps[k].worth);
    ending_at[steps[k].to].push_back(k);
  }
  std::vector<Step> chain;
  if (steps.empty()) return chain;
  std::optional<std::size_t> step =
      static_cast<std::size_t>(std::ranges::max_element(worth) - worth.begin());
  for (; step; step = before[*step]) chain.push_back(steps[*step]);
  std::ranges::reverse(chain);
  return chain;
}

bool ReferenceLines::meets_other_line(Index node, Index line) const {
  return std::ranges::any_of(edges_at_[at(node)], [&](Index edge) {
    return lines_[at(edge)] >= 0 && lines_[at(edge)] != line;
  });
}

bool ReferenceLines::share_face(Index edge, Index other) const {
  const auto of_other = edges_.faces[other];
  return std::ranges::any_of(edges_.faces[edge], [&](Index face) {
    return std::ranges::find(of_other, face) != of_other.end();
  });
}

void ReferenceLines::find_corners() {
  std::map<Index, std::map<Index, int>> nodes_of;  // line: nodes, edges along it at each
  for (std::size_t k = 0; k < lines_.size(); ++k)
    if (lines_[k] >= 0)
      for (const Index node : edges_.nodes[k]) ++nodes_of[lines_[k]][node];
  struct Claim {
    double distance;
    Index node;
    Vec3 corner;
  };
  std::vector<Claim> claims;
  for (const auto& [line, nodes] : nodes_of)
    for (const auto& [node, count] : nodes) {
      if (count != 1 || shape_.closed(line)) continue;
      const double arc = shape_.foot_on_line(line, x_[node]).arc;
      const bool first = arc < shape_.length(line) / 2;
      const double left = first ? arc : shape_.length(line) - arc;
      const auto [end, fades_out] = shape_.ends(line)[first ? 0 : 1];
      const double distance = (x_[node] - end).norm(), reach = mean_length(node);
      if (fades_out) {
        constexpr double near = 0.3;
        if (distance > near * shortest_[at(node)]) fading_.insert(node);
      } else if (left <= reach && distance <= reach) {
        claims.push_back({distance, node, end});
      }
    }
  std::ranges::stable_sort(claims, {}, &Claim::distance);
  std::vector<Vec3> taken;
  for (const Claim& claim : claims) {
    if (std::ranges::find(taken, claim.corner) != taken.end()) continue;
    if (corners_.try_emplace(claim.node, claim.corner).second) taken.push_back(claim.corner);
  }
  constexpr double near = 0.5;
  std::erase_if(corners_, [&](const auto& corner) {
    const auto& [node, place] = corner;
    return (x_[node] - place).norm() <= near * mean_length(node);
  });
}

double ReferenceLines::mean_length(Index node) const {
  double sum = 0;
  for (const Index edge : edges_at_[at(node)]) sum += length(edge);
  return sum / static_cast<double>(edges_at_[at(node)].size());
}

}  // namespace winslow
