#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/quality/validity.h"

namespace winslow {

/// Unknowns of a plane mesh whose free nodes move as they like and whose others are prescribed: x
/// and y of each free node, in the order of Topology::free_nodes(). Members are as of
/// SmoothingProblem.
class FreeNodes {
 public:
  static constexpr std::size_t per_node = 2;

  /// threads: 0 for all cores; no result depends on it.
  FreeNodes(std::shared_ptr<const Topology> topology, int threads)
      : topology_(std::move(topology)), threads_(threads) {}

  const Topology& topology() const { return *topology_; }
  std::span<const Index> nodes() const { return topology_->free_nodes(); }
  int threads() const { return threads_; }
  /// Mean length of the edges at a node, in units of the mesh.
  double mean_edge(const Coordinates& x, Index node) const;

  std::size_t unknowns() const { return per_node * nodes().size(); }
  void values(const Coordinates& x, std::span<double> out) const;
  void lengths(const Coordinates& x, std::span<double> out) const;
  double advance(std::span<const double> direction, double step, Coordinates& x) const;
  void velocities(std::span<const double> rates, Coordinates& out) const;
  double largest_valid_step(const Coordinates& from, const Coordinates& to) const;
  Validity validity(const Coordinates& x) const;
  /// Residuals are differences of coordinates over edge lengths, so they carry the round-off of the
  /// coordinates in units of the edges.
  double residual_round_off(const Coordinates& x) const;

 private:
  std::shared_ptr<const Topology> topology_;
  int threads_;
};

/// The part of a problem that is the same for all formulations over free nodes.
template <typename Problem>
class OnFreeNodes : public Problem {
 public:
  std::size_t unknowns() const final { return nodes_.unknowns(); }
  void values(const Coordinates& x, std::span<double> out) const final { nodes_.values(x, out); }
  void lengths(const Coordinates& x, std::span<double> out) const final { nodes_.lengths(x, out); }
  double advance(std::span<const double> direction, double step, Coordinates& x) const final {
    return nodes_.advance(direction, step, x);
  }
  void velocities(const Coordinates& /*x*/, std::span<const double> rates,
                  Coordinates& out) const final {
    nodes_.velocities(rates, out);
  }
  double largest_valid_step(const Coordinates& from, const Coordinates& to) const final {
    return nodes_.largest_valid_step(from, to);
  }
  Validity validity(const Coordinates& x) const final { return nodes_.validity(x); }
  double residual_round_off(const Coordinates& x) const final {
    return nodes_.residual_round_off(x);
  }

 protected:
  explicit OnFreeNodes(FreeNodes nodes) : nodes_(std::move(nodes)) {}

  const FreeNodes& free_nodes() const { return nodes_; }
  const Topology& topology() const { return nodes_.topology(); }
  int threads() const { return nodes_.threads(); }

 private:
  FreeNodes nodes_;
};

}  // namespace winslow
