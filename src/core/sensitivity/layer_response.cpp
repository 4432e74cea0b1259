#include "core/sensitivity/layer_response.h"

#include <set>

#include "core/formulation/target_shapes.h"
#include "core/layers/layer_control.h"

namespace winslow {

namespace {

/// The VCVs of held layers over the walls in x.
std::shared_ptr<const VirtualControlVolumes> vcvs_over(const MeshState& result,
                                                       const Coordinates& x) {
  LayerStack stack = *result.layers;
  const auto stands = column_stands(stack, x);
  for (std::size_t c = 0; c < stands.size(); ++c) set_stand(stack.columns[c], stands[c]);
  return layer_vcvs(result.mesh.topology, stack, *result.vcvs.plane(), x);
}

bool nearly_equal(std::span<const double> a, std::span<const double> b) {
  constexpr double share = 1e-6;
  return std::ranges::equal(
      a, b, [&](double p, double q) { return std::abs(p - q) <= share * std::abs(q); });
}

bool nearly_equal(const VirtualControlVolumes& a, const VirtualControlVolumes& b) {
  return std::ranges::equal(a.edits(), b.edits(), [](const auto& p, const auto& q) {
    return p.first == q.first && nearly_equal(p.second.angles, q.second.angles) &&
           nearly_equal(p.second.lengths, q.second.lengths);
  });
}

class LayerResponse final : public TargetResponse {
 public:
  LayerResponse(const VariationalWinslow& form, const HeldLayerTargets& of, const Coordinates& x)
      : topology_(of.classes.topology()) {
    find_walls(of, x);
    const auto stretch = WallStretch::find(of.classes, of.reference, x);
    find_cells(targets_over(of, stretch.get(), x));
    for (std::size_t colour = 0; colour < colours_; ++colour)
      for (int axis = 0; axis < 2; ++axis) {
        std::vector<double> slopes = gradients(form, of, stretch.get(), x, colour, axis, 1);
        const auto lower = gradients(form, of, stretch.get(), x, colour, axis, -1);
        for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] -= lower[i];
        slopes_.push_back(std::move(slopes));
      }
  }

  void add_forces(const Coordinates& velocities, Coordinates& forces) const override {
    for_each_slope([&](Index wall, int axis, Index node, const Vec2& slope) {
      forces.set_xy(node, forces.xy(node) + velocities.xy(wall)[axis] * slope);
    });
  }
  void add_transpose(const Coordinates& velocities, Coordinates& out) const override {
    for_each_slope([&](Index wall, int axis, Index node, const Vec2& slope) {
      Vec2 sum = out.xy(wall);
      sum[axis] += slope.dot(velocities.xy(node));
      out.set_xy(wall, sum);
    });
  }

 private:
  using Cell = std::array<Index, 3>;
  /// A node of a wall, without unknowns.
  struct WallNode {
    std::size_t colour;  ///< no cell depends on two nodes of one colour
    double step;         ///< of the differences, in units of the mesh
  };
  struct Dependent {
    Cell nodes;
    std::size_t place;         ///< of the cell in targets_over()
    std::vector<Index> walls;  ///< by colour: the node on which it depends; -1: none
  };

  /// Finds the nodes on which each element of the layers depends: VCVs of a column depend on the
  /// walls up to two edges away.
  void find_walls(const HeldLayerTargets& of, const Coordinates& x) {
    std::map<Index, std::set<Index>> around;
    for (Index f = 0; f < topology_.face_count(); ++f) {
      const auto face = topology_.face(f);
      if (face.elements[1] >= 0) continue;
      around[face.nodes[0]].insert(face.nodes[1]);
      around[face.nodes[1]].insert(face.nodes[0]);
    }
    std::map<Index, std::set<Index>> foot;  // of the columns at a node
    for (const LayerColumn& column : of.result.layers->columns)
      for (const Index node : column.nodes) foot[node].insert(column.wall_node);
    std::map<Index, std::set<Index>> together;
    for (Index e = 0; e < topology_.element_count(); ++e) {
      if (of.result.layers->layer_of_element[at(e)] < 0) continue;
      std::set<Index> walls;
      for (const Index node : topology_.element(e))
        walls.insert(foot[node].begin(), foot[node].end());
      for (int ring = 0; ring < 2; ++ring)
        for (const Index node : std::set<Index>(walls))
          walls.insert(around[node].begin(), around[node].end());
      std::erase_if(walls, [&](Index node) { return of.classes.moves(node); });
      for (const Index node : walls) together[node].insert(walls.begin(), walls.end());
      walls_of_[e] = {walls.begin(), walls.end()};
    }
    constexpr double share = 1e-5;
    for (const auto& [node, others] : together) {
      std::set<std::size_t> used;
      for (const Index other : others)
        if (const auto found = walls_.find(other); found != walls_.end())
          used.insert(found->second.colour);
      std::size_t colour = 0;
      while (used.contains(colour)) ++colour;
      colours_ = std::max(colours_, colour + 1);
      double edge = std::numeric_limits<double>::infinity();
      for (const Index other : around[node])
        edge = std::min(edge, (x.xy(other) - x.xy(node)).norm());
      walls_[node] = {colour, share * edge};
    }
  }

  /// The targets of the whole mesh with the walls at x, in an order of their own.
  static TargetShapes targets_over(const HeldLayerTargets& of, const WallStretch* stretch,
                                   const Coordinates& x) {
    return TargetShapes::build(*vcvs_over(of.result, x), of.targets, &of.reference, of.threads, {},
                               &of.classes, {}, {of.result.roles.get(), stretch});
  }

  void find_cells(const TargetShapes& targets) {
    std::map<Cell, Index> element_of;
    for (const auto& [e, walls] : walls_of_) {
      const auto nodes = topology_.element(e);
      for (const auto& corner : topology_.shape(e).corner_triangles)
        element_of[{nodes[at(corner[0])], nodes[at(corner[1])], nodes[at(corner[2])]}] = e;
    }
    const auto& cells = targets.cells;
    for (std::size_t t = 0; t < cells.size(); ++t) {
      const auto found = element_of.find(cells[t]);
      if (found == element_of.end()) continue;
      Dependent cell{cells[t], t, std::vector<Index>(colours_, -1)};
      for (const Index node : walls_of_[found->second]) cell.walls[walls_[node].colour] = node;
      cells_.push_back(std::move(cell));
    }
  }

  /// Gradients of the energies of cells_ with the wall nodes of one colour displaced.
  std::vector<double> gradients(const VariationalWinslow& form, const HeldLayerTargets& of,
                                const WallStretch* stretch, const Coordinates& x,
                                std::size_t colour, int axis, double sign) const {
    Coordinates walls = x;
    for (const auto& [node, wall] : walls_)
      if (wall.colour == colour)
        walls.set_xy(node, walls.xy(node) + sign * wall.step * Vec2::Unit(axis));
    const TargetShapes all = targets_over(of, stretch, walls);
    CellTargets<2> own;
    for (const Dependent& cell : cells_) own.add_cell(all, cell.place);
    return form.cell_gradients(x, own);
  }

  /// visit(node of a wall, axis, node of a cell, rate of its part of dE/dx).
  template <typename Visit>
  void for_each_slope(const Visit& visit) const {
    for (std::size_t k = 0; k < slopes_.size(); ++k) {
      const double* slope = slopes_[k].data();
      for (const Dependent& cell : cells_) {
        const Index wall = cell.walls[k / 2];
        for (std::size_t corner = 0; corner < 3; ++corner, slope += 2)
          if (wall >= 0)
            visit(wall, static_cast<int>(k % 2), cell.nodes[corner],
                  Vec2(Vec2(slope) / (2 * walls_.at(wall).step)));
      }
    }
  }

  const Topology& topology_;
  std::map<Index, std::vector<Index>> walls_of_;  // by element of the layers
  std::map<Index, WallNode> walls_;
  std::size_t colours_ = 0;
  std::vector<Dependent> cells_;
  std::vector<std::vector<double>> slopes_;  // by colour and axis: of each node of each cell
};

}  // namespace

std::unique_ptr<const TargetResponse> layer_response(const VariationalWinslow& form,
                                                     const HeldLayerTargets& of,
                                                     const Coordinates& x) {
  if (!nearly_equal(*vcvs_over(of.result, x), *of.result.vcvs.plane())) return nullptr;
  return std::make_unique<const LayerResponse>(form, of, x);
}

}  // namespace winslow
