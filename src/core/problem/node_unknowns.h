#pragma once

#include "core/mesh/coordinates.h"
#include "core/problem/node_classes.h"
#include "core/quality/validity.h"

namespace winslow {

/// Reference normals of the elements of a surface mesh at x; empty where the classes have none.
std::vector<Vec3> element_normals(const NodeClasses& classes, const Coordinates& x, int threads);

/// check_validity() for the mesh of a run: for a surface mesh by the reference normals.
Validity check_validity(const NodeClasses& classes, const Coordinates& x, int threads);

/// The unknowns of a mesh, in ascending order of the nodes. The unknowns of a free node are its
/// coordinates; those of a node on a curve or a surface are its distances from the origin along the
/// directions of its frame. Members with the same name as in SmoothingProblem are documented there.
/// Copies share the numbering.
///
/// The validity of a surface mesh is checked by the element normals of the classes.
class NodeUnknowns {
 public:
  enum class Layout {
    packed,  ///< each node has as many numbers as it has unknowns
    blocks   ///< each node has as many as the elements have dimensions; the surplus is unused
  };
  /// threads: 0 for all cores; no result depends on it.
  NodeUnknowns(std::shared_ptr<const NodeClasses> classes, int threads,
               Layout layout = Layout::packed);

  const NodeClasses& classes() const { return *classes_; }
  const Topology& topology() const { return classes_->topology(); }
  int threads() const { return threads_; }

  /// The nodes that have unknowns, ascending.
  std::span<const Index> nodes() const { return layout_->nodes; }
  /// The nodes that are images of others, ascending.
  std::span<const NodeImage> images() const { return layout_->images; }
  /// The rows whose inner nodes follow their ends.
  std::span<const std::shared_ptr<const CurveRow>> rows() const { return classes_->tied().rows(); }
  /// Number of the first unknown of nodes()[i].
  std::size_t first(std::size_t i) const { return layout_->first[i]; }
  /// Number of unknowns of nodes()[i].
  std::size_t count(std::size_t i) const { return layout_->first[i + 1] - layout_->first[i]; }
  /// Throws UsageError unless all nodes with unknowns are free and in the interior, for
  /// formulations without boundary geometry. what: names the formulation.
  void require_free_interior(const char* what) const;
  /// Throws UsageError if a free boundary node has no image: nothing would hold it.
  void require_held_boundary(const char* what) const;

  /// Throws UsageError unless all nodes with unknowns slide: free nodes would leave the shape of a
  /// surface mesh.
  void require_sliding(const char* what) const;

  /// Mean length of the edges at a node, in units of the mesh.
  double mean_edge(const Coordinates& x, Index node) const;

  std::size_t unknowns() const { return layout_->first.back(); }
  void values(const Coordinates& x, std::span<double> out) const;
  void lengths(const Coordinates& x, std::span<double> out) const;
  double advance(std::span<const double> direction, double step, Coordinates& x) const;
  void velocities(const Coordinates& x, std::span<const double> rates, Coordinates& out) const;
  double largest_valid_step(const Coordinates& from, const Coordinates& to, double most) const;
  Validity validity(const Coordinates& x) const;
  /// Residuals are differences of coordinates divided by edge lengths, so they contain the
  /// round-off of the coordinates in units of the edges.
  double residual_round_off(const Coordinates& x) const;

 private:
  struct Numbers {
    std::vector<Index> nodes;
    std::vector<std::size_t> first;  // one more than nodes
    std::vector<NodeImage> images;
  };
  /// Computes the positions of nodes without their own unknowns from the other nodes.
  void place_others(Coordinates& x) const;
  template <int D>
  Vec<D> move_of(std::size_t i, const Vec<D>& from, std::span<const double> rates) const;

  std::shared_ptr<const NodeClasses> classes_;
  std::shared_ptr<const Numbers> layout_;
  int threads_;
};

/// Finds nodes that get stuck at jumps and folds of their curve or surface. The energy has no
/// derivative there, and no step of Newton's method moves a node across.
///
/// Adds to `stuck` (#nodes with unknowns) the sliding nodes that a step moves across a jump or a
/// fold; returns their number. At a jump the feet of x and `there` are farther apart than the step
/// length. At a fold the surface direction changes abruptly between them, not gradually as on a
/// curved surface.
///
/// The step is `step` times the direction, from x to `there`. stride: numbers per node in the
/// direction, those of its unknowns first.
Index add_nodes_led_astray(const NodeUnknowns& nodes, const Coordinates& x,
                           const Coordinates& there, std::span<const double> direction,
                           std::size_t stride, double step, std::vector<bool>& stuck);

/// The common part of all formulations over the nodes of a mesh. Problem: the base class, a kind of
/// SmoothingProblem.
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
