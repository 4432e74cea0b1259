#include "core/strategy/face_angles.h"

#include "core/error.h"
#include "core/formulation/face_penalty.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/outer/energy_descent.h"
#include "core/quality/openfoam_measures.h"
#include "core/quality/volume_element.h"

namespace winslow {

namespace {

constexpr FacePenalty::Angles penalised{60, 68};  // degrees

/// Whether no measure of checkMesh but the angles has more faces or cells beyond its limit.
bool others_kept(const OpenFoamMeasures& after, const OpenFoamMeasures& before) {
  for (std::size_t k = 0; k < after.rows.size(); ++k)
    if (after.rows[k].name != "non_orthogonality" && after.rows[k].beyond > before.rows[k].beyond)
      return false;
  return after.orthogonality_errors <= before.orthogonality_errors &&
         after.pyramid_errors <= before.pyramid_errors &&
         after.poor_divisions <= before.poor_divisions &&
         after.concave_cells <= before.concave_cells;
}

/// The nodes and elements around some faces, and the energy of the nodes.
class Surroundings {
 public:
  Surroundings(const MeshState& state, const NodeClasses& classes, const SmoothOptions& options,
               const WallStretch* wall_stretch, const CellFaces& faces,
               std::span<const Index> leaning, const Coordinates& x)
      : topology_(*state.mesh.topology),
        faces_(faces),
        reference_(reference_of(state)),
        inside_(at(topology_.element_count()), 0) {
    find_elements(leaning);
    find_nodes(classes, x);
    if (nodes_.empty()) return;
    auto local = std::make_shared<NodeClasses>(state.mesh.topology);
    std::vector<Index> held;
    for (const Index node : topology_.interior_nodes())
      if (!std::ranges::binary_search(nodes_, node)) held.push_back(node);
    local->set_fixed(held);
    const VolumeTargetDetails details{
        .classes = local.get(), .roles = state.roles.get(), .wall_stretch = wall_stretch};
    const CellTargets<3> targets = volume_targets(topology_, nullptr, TargetBlend::keeping(),
                                                  reference_.get(), options.threads, {}, details);
    energy_.emplace(local, targets, options.penalty, options.threads);
    angles_ = faces_around();
    penalty_.emplace(faces_, angles_, penalised);
  }

  bool has_nodes() const { return !nodes_.empty(); }
  std::span<const Index> nodes() const { return nodes_; }
  std::span<const double> lengths() const { return lengths_; }
  const FacePenalty& penalty() const { return *penalty_; }
  /// The internal faces whose angles depend on the nodes.
  std::span<const Index> faces() const { return angles_; }

  /// Energy per element at x.
  double mean_energy(const Coordinates& x) const {
    return energy_->energy(x) / static_cast<double>(elements_.size());
  }
  /// The energy and `factor` times the penalty; infinite where an element is inverted. slopes
  /// (#nodes() by 3): receives the derivatives.
  double value(const Coordinates& x, double factor, std::vector<double>& slopes) {
    const double energy = energy_->energy(x);
    if (!std::isfinite(energy) || !valid(x)) return std::numeric_limits<double>::infinity();
    slopes.resize(3 * nodes_.size());
    energy_->residual(x, slopes);
    of_nodes_.assign(at(topology_.node_count()), Vec3(0, 0, 0));
    const double penalty = penalty_->add(x, factor, of_nodes_);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        slopes[3 * i + k] =
            of_nodes_[at(nodes_[i])][static_cast<Eigen::Index>(k)] - slopes[3 * i + k];
    return energy + factor * penalty;
  }

 private:
  /// The cells of the faces, and two layers of elements around them.
  void find_elements(std::span<const Index> leaning) {
    constexpr int layers = 2;
    for (const Index f : leaning)
      for (const Index e : {faces_.owner[at(f)], faces_.neighbour[at(f)]}) add(e);
    for (int layer = 0; layer < layers; ++layer) {
      const std::vector<Index> known = elements_;
      for (const Index e : known)
        for (const Index node : topology_.element(e))
          for (const Index other : topology_.star(node)) add(other);
    }
    std::ranges::sort(elements_);
  }
  void add(Index element) {
    if (std::exchange(inside_[at(element)], 1) == 0) elements_.push_back(element);
  }
  /// The free nodes of which all elements are among these.
  void find_nodes(const NodeClasses& classes, const Coordinates& x) {
    const SpacePoints points(x);
    for (const Index e : elements_)
      for (const Index node : topology_.element(e)) nodes_.push_back(node);
    sort_unique(nodes_);
    std::erase_if(nodes_, [&](Index node) {
      return classes[node] != NodeClass::free || topology_.on_boundary(node) ||
             std::ranges::any_of(topology_.star(node),
                                 [&](Index e) { return inside_[at(e)] == 0; });
    });
    for (const Index node : nodes_) {
      double least = std::numeric_limits<double>::infinity();
      for (const Index other : topology_.neighbours(node))
        least = std::min(least, (points[other] - points[node]).norm());
      lengths_.push_back(least);
    }
  }
  std::vector<Index> faces_around() const {
    std::vector<Index> list;
    for (const Index e : elements_)
      for (const Index f : faces_.of_cell[e])
        if (faces_.internal(f)) list.push_back(f);
    sort_unique(list);
    return list;
  }
  bool valid(const Coordinates& x) const {
    const SpacePoints points(x);
    return std::ranges::all_of(elements_, [&](Index e) {
      return has_positive_jacobian(points, topology_.shape(e), topology_.element(e));
    });
  }

  const Topology& topology_;
  const CellFaces& faces_;
  std::shared_ptr<const Coordinates> reference_;
  std::vector<unsigned char> inside_;
  std::vector<Index> elements_, nodes_, angles_;
  std::vector<double> lengths_;  // #nodes: of the shortest edge
  std::optional<VolumeWinslow> energy_;
  std::optional<FacePenalty> penalty_;
  std::vector<Vec3> of_nodes_;
};

/// Minimises the sum of an energy and a penalty by L-BFGS, from a valid mesh through valid meshes.
class Descent {
 public:
  Descent(Surroundings& around, double factor, int threads)
      : around_(around), factor_(factor), memory_(8, threads) {}

  /// Makes a step. Returns false if none lowers the sum.
  bool step(Coordinates& x) {
    if (slopes_.empty()) {
      value_ = around_.value(x, factor_, slopes_);
      preconditioned_ = preconditioned(slopes_);
    }
    std::vector<double> direction(slopes_.size());
    memory_.direction(preconditioned_, direction);
    double slope = std::inner_product(direction.begin(), direction.end(), slopes_.begin(), 0.0);
    if (!(slope < 0)) {
      memory_.clear();
      memory_.direction(preconditioned_, direction);
      slope = std::inner_product(direction.begin(), direction.end(), slopes_.begin(), 0.0);
    }
    double t = largest_step(direction);
    constexpr int halvings = 25;
    for (int k = 0; k < halvings; ++k, t /= 2) {
      Coordinates next = x;
      for (std::size_t i = 0; i < around_.nodes().size(); ++i) {
        const Index node = around_.nodes()[i];
        next.set_xyz(node, next.xyz(node) + t * Vec3(direction.data() + 3 * i));
      }
      std::vector<double> slopes;
      const double value = around_.value(next, factor_, slopes);
      if (!(value <= value_ + 1e-4 * t * slope)) continue;
      for (double& d : direction) d *= t;
      const std::vector<double> after = preconditioned(slopes);
      memory_.add(direction, slopes_, preconditioned_, slopes, after);
      value_ = value;
      slopes_ = std::move(slopes);
      preconditioned_ = after;
      x = std::move(next);
      return true;
    }
    return false;
  }

 private:
  /// By the squares of the lengths of edges, as the derivatives of energies without units ask for.
  std::vector<double> preconditioned(const std::vector<double>& slopes) const {
    std::vector<double> out = slopes;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double h = around_.lengths()[i / 3];
      out[i] *= h * h;
    }
    return out;
  }
  /// At most 1, so that no node moves by more than a quarter of its shortest edge.
  double largest_step(const std::vector<double>& direction) const {
    constexpr double share = 0.25;
    double t = 1;
    for (std::size_t i = 0; i < around_.nodes().size(); ++i) {
      const double move = Vec3(direction.data() + 3 * i).norm();
      if (move * t > share * around_.lengths()[i]) t = share * around_.lengths()[i] / move;
    }
    return t;
  }

  Surroundings& around_;
  double factor_;
  CurvatureMemory memory_;
  double value_ = 0;
  std::vector<double> slopes_, preconditioned_;
};

/// Moves the nodes around the faces until none of all faces around leans that did not before.
void straighten(Surroundings& around, const FiniteVolumes& reference, const SmoothOptions& options,
                SolverMonitor* monitor, Coordinates& x) {
  constexpr int rounds = 5, steps = 40;
  const double cosine = std::cos(radians(largest_non_orthogonality));
  const auto leans = [&](Index f) {
    return around.penalty().cosine(x, f) < cosine && reference.orthogonality(f) >= cosine;
  };
  double factor = around.mean_energy(x);
  for (int round = 0; round < rounds; ++round, factor *= 4) {
    Descent descent(around, factor, options.threads);
    for (int step = 0; step < steps; ++step) {
      if (monitor && monitor->cancelled()) throw Cancelled();
      if (!descent.step(x)) break;
      if (std::ranges::none_of(around.faces(), leans)) return;
    }
  }
}

}  // namespace

FaceAngles keep_face_angles(const MeshState& state, const NodeClasses& classes,
                            const SmoothOptions& options, const WallStretch* wall_stretch,
                            SolverMonitor* monitor, Coordinates& x) {
  constexpr std::size_t most = 5'000;  // faces: a mesh with more is beyond local mends
  const CellFaces faces = cell_faces(*state.mesh.topology);
  const FiniteVolumes reference(faces, *reference_of(state), options.threads);
  const auto leaning_in = [&](const Coordinates& mesh) {
    return newly_leaning_faces(FiniteVolumes(faces, mesh, options.threads), reference);
  };
  const LeaningFaces before = leaning_in(x);
  const auto count = static_cast<Index>(before.faces.size());
  const FaceAngles as_it_is{count, 0, before.angle};
  if (before.faces.empty() || before.faces.size() > most) return as_it_is;
  Surroundings around(state, classes, options, wall_stretch, faces, before.faces, x);
  if (!around.has_nodes()) return as_it_is;
  Coordinates mended = x;
  straighten(around, reference, options, monitor, mended);
  const LeaningFaces after = leaning_in(mended);
  const auto left = static_cast<Index>(after.faces.size());
  if (left >= count || !others_kept(openfoam_measures(faces, mended, options.threads),
                                    openfoam_measures(faces, x, options.threads)))
    return as_it_is;
  x = std::move(mended);
  return {left, count - left, after.angle};
}

}  // namespace winslow
