#include "core/quality/mesh_change.h"

#include <cstdio>

#include "core/error.h"
#include "core/mesh/coordinates.h"
#include "core/quality/openfoam_measures.h"

namespace winslow {

namespace {

constexpr double changed_share = 0.05, grossly_changed = 0.2;

std::string number(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::vector<WallMeasures> heights_only(const Mesh& mesh, std::span<const Wall> walls) {
  std::vector<WallMeasures> measured;
  for (const Wall& wall : walls) {
    WallMeasures& of = measured.emplace_back();
    of.first_height = first_heights(mesh, wall);
    of.spacing = wall_spacings(mesh, wall);
    of.wall = wall;
  }
  return measured;
}

void describe_heights(const Mesh& before, const Mesh& after, Damage& damage) {
  const std::vector<Wall> walls = find_walls(before);
  const auto change =
      compare_first_heights(heights_only(before, walls), heights_only(after, walls));
  if (!change || !spoils_walls(*change)) return;
  damage.node = change->harmed_node;
  damage.stretched = change->off_stretched > 0;
  const double off = change->off_stretched + change->off_isotropic;
  const char* by = change->off_isotropic == 0   ? "by more than 5 %"
                   : change->off_stretched == 0 ? "by a factor of more than 1.5"
                                                : "by more than 5 %, of isotropic cells by a "
                                                  "factor of more than 1.5,";
  damage.text =
      std::string("first heights changed ") + by + " at " + number("%.3g", 100 * off) +
      " % of the wall nodes, at worst to " + number("%.3g", change->harmed_ratio) +
      " times what they were at " +
      place_text(place_of(after.coordinates, change->harmed_node), after.coordinates.dimension());
}

void describe_sine(double before, double after, const Mesh& mesh, Damage& damage) {
  if (after >= least_sine_kept * before) return;
  const Index worst = worst_element(mesh, Metric::normalized_jacobian);
  damage.element = worst;
  damage.text +=
      std::string(damage.text.empty() ? "" : ", and ") +
      (mesh.topology->kind() == MeshKind::volume ? "the smallest scaled Jacobian fell from "
                                                 : "the smallest sine fell from ") +
      number("%.3g", before) + " to " + number("%.3g", after) + " at " +
      place_text(element_centre(mesh, worst), mesh.coordinates.dimension());
}

void describe_faces(const Mesh& before, const Mesh& after, Damage& damage) {
  const CellFaces faces = cell_faces(*after.topology);
  const LeaningFaces leaning = newly_leaning_faces(FiniteVolumes(faces, after.coordinates),
                                                   FiniteVolumes(faces, before.coordinates));
  if (leaning.faces.empty()) return;
  damage.leaning_faces = static_cast<Index>(leaning.faces.size());
  const Index element = faces.owner[at(leaning.worst)];
  if (!damage.element) damage.element = element;
  damage.text += std::string(damage.text.empty() ? "" : ", and ") +
                 std::to_string(damage.leaning_faces) +
                 (damage.leaning_faces == 1 ? " internal face leans" : " internal faces lean") +
                 " by more than " + number("%g", largest_non_orthogonality) +
                 " degrees (non-orthogonality), at worst by " + number("%.3g", leaning.angle) +
                 " at " + place_text(element_centre(after, element), 3);
}

}  // namespace

namespace {

/// Collects the changes at single nodes.
class HeightChanges {
 public:
  void add(Index node, double ratio, bool isotropic) {
    ratios_.push_back(ratio);
    const bool changed = std::abs(ratio - 1) > FirstHeightChange::tolerance;
    const double factor = std::abs(std::log(ratio));
    if (changed) ++changed_;
    if (change_.worst_node < 0 || factor > worst_factor_) {
      worst_factor_ = factor;
      change_.worst_node = node;
      change_.worst_ratio = ratio;
    }
    if (isotropic ? factor < std::log(FirstHeightChange::isotropic_factor) : !changed) return;
    ++(isotropic ? isotropic_ : stretched_);
    if (std::abs(ratio - 1) > grossly_changed) change_.gross = true;
    if (change_.harmed_node >= 0 && factor <= harmed_factor_) return;
    harmed_factor_ = factor;
    change_.harmed_node = node;
    change_.harmed_ratio = ratio;
  }

  FirstHeightChange all() {
    if (!ratios_.empty()) {
      const auto share = [&](std::size_t count) {
        return static_cast<double>(count) / static_cast<double>(ratios_.size());
      };
      change_.off = share(changed_);
      change_.off_stretched = share(stretched_);
      change_.off_isotropic = share(isotropic_);
    }
    change_.ratio = quantiles_of(std::move(ratios_));
    return change_;
  }

 private:
  FirstHeightChange change_;
  std::vector<double> ratios_;
  std::size_t changed_ = 0, stretched_ = 0, isotropic_ = 0;
  double worst_factor_ = 0, harmed_factor_ = 0;
};

}  // namespace

std::optional<FirstHeightChange> compare_first_heights(std::span<const WallMeasures> before,
                                                       std::span<const WallMeasures> after) {
  const auto same = [](const WallMeasures& a, const WallMeasures& b) {
    return a.wall.nodes == b.wall.nodes;
  };
  if (!std::ranges::equal(before, after, same)) return std::nullopt;
  HeightChanges changes;
  for (std::size_t w = 0; w < before.size(); ++w)
    for (std::size_t k = 0; k < before[w].first_height.size(); ++k) {
      const double height = before[w].first_height[k], ratio = after[w].first_height[k] / height;
      if (!std::isfinite(ratio)) continue;
      const bool isotropic = before[w].spacing[k] < FirstHeightChange::isotropic_stretch * height;
      changes.add(before[w].wall.nodes[k], ratio, isotropic);
    }
  return changes.all();
}

bool spoils_walls(const FirstHeightChange& change) {
  return change.gross || change.off_stretched + change.off_isotropic > changed_share;
}

Damage find_damage(const Mesh& before, const Mesh& after) {
  Damage damage;
  if (before.topology != after.topology) return damage;
  const Validity was = check_validity(*before.topology, before.coordinates);
  const Validity is = check_validity(*after.topology, after.coordinates);
  if (was.inverted > 0 || is.inverted > 0) return damage;
  if (!is_surface(*before.topology)) describe_heights(before, after, damage);
  describe_sine(was.min_sine, is.min_sine, after, damage);
  if (after.topology->has_polyhedra()) describe_faces(before, after, damage);
  return damage;
}

namespace {

std::string broken(const FieldInfo& info, double limit) {
  char text[80];
  std::snprintf(text, sizeof text, " would be %s than %.6g",
                info.larger_is_better ? "less" : "more", limit);
  return std::string(info.label) + text;
}

/// False for NaN.
bool within(const FieldInfo& info, double value, double limit) {
  return info.larger_is_better ? value >= limit : value <= limit;
}

/// Whether an element was no better in the given mesh, up to round-off, which changes the last
/// digits of elements that move as a whole.
bool was_no_better(const Mesh& mesh, const Coordinates& given, Index e, Metric metric,
                   double value) {
  constexpr double round_off = 1e-6;
  const FieldInfo& info = metric_info(metric, 3).field;
  const double before = element_value({mesh.topology, given}, e, metric);
  const double slack = round_off * std::abs(before);
  return before == value || within(info, value, before + (info.larger_is_better ? -slack : slack));
}

}  // namespace

const std::vector<Metric>& limited_metrics() {
  static const std::vector<Metric> all = [] {
    std::vector<Metric> list = rating_metrics(2);
    for (const Metric metric : rating_metrics(3))
      if (std::ranges::find(list, metric) == list.end()) list.push_back(metric);
    return list;
  }();
  return all;
}

bool QualityFloor::given() const {
  return std::ranges::any_of(limits, [](const auto& limit) { return limit.has_value(); });
}

void QualityFloor::set(Metric metric, double limit) {
  const auto& limited = limited_metrics();
  const std::size_t m = index_of(limited, metric);
  if (m == limited.size())
    throw UsageError("no limit can be set to the " + std::string(metric_name(metric)) +
                     ": it is not reported, and says nothing of the quality");
  limits[m] = limit;
}

void QualityFloor::require_dimension(int cell_dimension) const {
  const auto& rating = rating_metrics(cell_dimension);
  for (std::size_t m = 0; m < limits.size(); ++m) {
    const Metric metric = limited_metrics()[m];
    if (!limits[m] || std::ranges::find(rating, metric) != rating.end()) continue;
    throw UsageError("a limit of the quality (min-quality): found " +
                     std::string(metric_name(metric)) + ", which " +
                     (cell_dimension == 2 ? "plane" : "volume") +
                     " elements do not have, expected one of: " + listed(rating, metric_name));
  }
}

std::string QualityFloor::fault(const Mesh& mesh, const Coordinates& given) const {
  const Topology& topology = *mesh.topology;
  const int dimension = topology.cell_dimension();
  std::vector<Metric> metrics;
  std::vector<double> least;
  for (std::size_t m = 0; m < limits.size(); ++m) {
    if (!limits[m]) continue;
    metrics.push_back(limited_metrics()[m]);
    least.push_back(*limits[m]);
  }
  const auto values = element_values(mesh, metrics);
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    const FieldInfo& info = metric_info(metrics[m], dimension).field;
    for (Index e = 0; e < topology.element_count(); ++e) {
      const double value = values[m][at(e)];
      if (within(info, value, least[m])) continue;
      const bool apart = topology.kind() == MeshKind::volume && all_on_boundary(topology, e);
      if (!apart || !was_no_better(mesh, given, e, metrics[m], value))
        return broken(info, least[m]);
    }
  }
  return {};
}

}  // namespace winslow
