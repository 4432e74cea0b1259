#include "core/sensitivity/target_response.h"

namespace winslow {

namespace {

template <int D>
class ResponseOf final : public TargetResponse {
 public:
  using Form = SimplexWinslow<D>;
  using Cell = std::array<Index, D + 1>;

  ResponseOf(const Form& form, WallStretchDerivative walls, const FormWithStretch& with_stretch,
             const Topology& topology, const Coordinates& x)
      : walls_(std::move(walls)) {
    find_cells(form, topology);
    for (int parameter = 0; parameter < walls_.parameters(); ++parameter) {
      constexpr double change = 1e-5;
      std::vector<double> slopes = gradients(form, with_stretch, parameter, change, x);
      const std::vector<double> lower = gradients(form, with_stretch, parameter, -change, x);
      for (std::size_t i = 0; i < slopes.size(); ++i)
        slopes[i] = (slopes[i] - lower[i]) / (2 * change);
      slopes_.push_back(std::move(slopes));
    }
  }

  void add_forces(const Coordinates& velocities, Coordinates& forces) const override {
    std::vector<double> rates(walls_.elements().size() * slopes_.size());
    walls_.add_rates(velocities, rates);
    for_each_slope([&](std::size_t rate, Index node, const Vec<D>& slope) {
      forces.set<D>(node, forces.get<D>(node) + rates[rate] * slope);
    });
  }
  void add_transpose(const Coordinates& velocities, Coordinates& out) const override {
    std::vector<double> multipliers(walls_.elements().size() * slopes_.size());
    for_each_slope([&](std::size_t rate, Index node, const Vec<D>& slope) {
      multipliers[rate] += slope.dot(velocities.get<D>(node));
    });
    walls_.add_transpose(multipliers, out);
  }

 private:
  /// A cell of the energy whose targets depend on the walls.
  struct Dependent {
    Cell nodes;
    std::size_t element;  // into walls_.elements()
    std::size_t place;    // of the cell in the form
  };

  /// The simplices of which the energy of an element is made.
  static std::vector<Cell> cells_of(const Topology& topology, Index e) {
    std::vector<Cell> cells;
    const ElementShape& shape = topology.shape(e);
    const auto nodes = topology.element(e);
    const auto add = [&](const auto& list) {
      for (const auto& corner : list) {
        Cell cell;
        for (std::size_t k = 0; k <= D; ++k) cell[k] = nodes[at(corner[k])];
        cells.push_back(cell);
      }
    };
    if constexpr (D == 2) {
      add(shape.corner_triangles);
    } else {
      add(shape.corner_tetrahedra);
      add(shape.edge_tetrahedra);
      add(shape.face_tetrahedra);
    }
    return cells;
  }

  void find_cells(const Form& form, const Topology& topology) {
    std::map<Cell, std::size_t> element_of;
    for (std::size_t k = 0; k < walls_.elements().size(); ++k)
      for (const Cell& cell : cells_of(topology, walls_.elements()[k])) element_of[cell] = k;
    const auto& cells = form.shapes().cells;
    for (std::size_t t = 0; t < cells.size(); ++t) {
      const auto found = element_of.find(cells[t]);
      if (found != element_of.end()) cells_.push_back({cells[t], found->second, t});
    }
  }

  /// Gradients of the energies of cells_ with one parameter of all elements changed.
  std::vector<double> gradients(const Form& form, const FormWithStretch& with_stretch,
                                int parameter, double change, const Coordinates& x) const {
    const auto other = with_stretch(walls_.changed(parameter, change));
    const CellTargets<D>& all = dynamic_cast<const Form&>(*other).shapes();
    CellTargets<D> own;
    for (const Dependent& cell : cells_) own.add_cell(all, cell.place);
    return form.cell_gradients(x, own);
  }

  /// visit(place of the rate, node, rate of the node's part of dE/dx).
  template <typename Visit>
  void for_each_slope(const Visit& visit) const {
    for (std::size_t parameter = 0; parameter < slopes_.size(); ++parameter) {
      const double* slope = slopes_[parameter].data();
      for (const Dependent& cell : cells_) {
        const std::size_t rate = cell.element * slopes_.size() + parameter;
        for (std::size_t k = 0; k <= D; ++k, slope += D) visit(rate, cell.nodes[k], Vec<D>(slope));
      }
    }
  }

  WallStretchDerivative walls_;
  std::vector<Dependent> cells_;
  std::vector<std::vector<double>> slopes_;  // by parameter: of each node of each cell
};

}  // namespace

std::unique_ptr<const TargetResponse> target_response(const VariationalForm& form,
                                                      WallStretchDerivative walls,
                                                      const FormWithStretch& with_stretch,
                                                      const Topology& topology,
                                                      const Coordinates& x) {
  if (walls.elements().empty()) return nullptr;
  if (const auto* plane = dynamic_cast<const VariationalWinslow*>(&form))
    return std::make_unique<const ResponseOf<2>>(*plane, std::move(walls), with_stretch, topology,
                                                 x);
  if (const auto* space = dynamic_cast<const VolumeWinslow*>(&form))
    return std::make_unique<const ResponseOf<3>>(*space, std::move(walls), with_stretch, topology,
                                                 x);
  return nullptr;
}

}  // namespace winslow
