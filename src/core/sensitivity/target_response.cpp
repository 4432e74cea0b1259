#include "core/sensitivity/target_response.h"

namespace winslow {

namespace {

template <int D>
class ResponseOf final : public TargetResponse {
 public:
  using Form = SimplexWinslow<D>;

  ResponseOf(const Form& form, SmoothingWorkspace& workspace, WallStretchDerivative walls,
             const Coordinates& x)
      : walls_(std::move(walls)) {
    for (int parameter = 0; parameter < walls_.parameters(); ++parameter) {
      constexpr double change = 1e-5;
      const auto gradients = [&](double by) {
        const auto of_elements =
            workspace.targets_with<D>(walls_.changed(parameter, by), walls_.elements());
        cells_ = of_elements.targets.cells;
        elements_ = places_in(walls_.elements(), of_elements.elements);
        return form.cell_gradients(x, of_elements.targets);
      };
      std::vector<double> slopes = gradients(change);
      const std::vector<double> lower = gradients(-change);
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
  /// all, some: ascending.
  static std::vector<std::size_t> places_in(std::span<const Index> all,
                                            std::span<const Index> some) {
    std::vector<std::size_t> places;
    places.reserve(some.size());
    std::size_t place = 0;
    for (const Index e : some) {
      while (all[place] != e) ++place;
      places.push_back(place);
    }
    return places;
  }

  /// visit(place of the rate, node, rate of the node's part of dE/dx).
  template <typename Visit>
  void for_each_slope(const Visit& visit) const {
    for (std::size_t parameter = 0; parameter < slopes_.size(); ++parameter) {
      const double* slope = slopes_[parameter].data();
      for (std::size_t t = 0; t < cells_.size(); ++t) {
        const std::size_t rate = elements_[t] * slopes_.size() + parameter;
        for (const Index node : cells_[t]) {
          visit(rate, node, Vec<D>(slope));
          slope += D;
        }
      }
    }
  }

  WallStretchDerivative walls_;
  std::vector<std::array<Index, D + 1>> cells_;  // those whose targets depend on walls
  std::vector<std::size_t> elements_;            // of cells_, into walls_.elements()
  std::vector<std::vector<double>> slopes_;      // by parameter: of each node of each cell
};

}  // namespace

std::unique_ptr<const TargetResponse> target_response(const VariationalForm& form,
                                                      SmoothingWorkspace& workspace,
                                                      WallStretchDerivative walls,
                                                      const Coordinates& x) {
  if (walls.elements().empty()) return nullptr;
  if (const auto* plane = dynamic_cast<const VariationalWinslow*>(&form))
    return std::make_unique<const ResponseOf<2>>(*plane, workspace, std::move(walls), x);
  if (const auto* space = dynamic_cast<const VolumeWinslow*>(&form))
    return std::make_unique<const ResponseOf<3>>(*space, workspace, std::move(walls), x);
  return nullptr;
}

}  // namespace winslow
