#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "core/problem/node_unknowns.h"

namespace winslow {

/// The part of a problem that is the same for all formulations over the nodes of a mesh. Problem:
/// the kind of SmoothingProblem that it is.
template <typename Problem>
class NodeProblem : public Problem {
 public:
  std::size_t unknowns() const final { return nodes_.unknowns(); }
  void values(const Coordinates& x, std::span<double> out) const final { nodes_.values(x, out); }
  void lengths(const Coordinates& x, std::span<double> out) const final { nodes_.lengths(x, out); }
  double advance(std::span<const double> direction, double step, Coordinates& x) const final {
    return nodes_.advance(direction, step, x);
  }
  void velocities(const Coordinates& x, std::span<const double> rates,
                  Coordinates& out) const final {
    nodes_.velocities(x, rates, out);
  }
  double largest_valid_step(const Coordinates& from, const Coordinates& to,
                            double most) const final {
    return nodes_.largest_valid_step(from, to, most);
  }
  Validity validity(const Coordinates& x) const final { return nodes_.validity(x); }
  double residual_round_off(const Coordinates& x) const final {
    return nodes_.residual_round_off(x);
  }

 protected:
  explicit NodeProblem(NodeUnknowns nodes) : nodes_(std::move(nodes)) {}

  const NodeUnknowns& node_unknowns() const { return nodes_; }
  const Topology& topology() const { return nodes_.topology(); }
  int threads() const { return nodes_.threads(); }

 private:
  NodeUnknowns nodes_;
};

}  // namespace winslow
