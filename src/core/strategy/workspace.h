#pragma once

#include "core/formulation/pointwise_winslow.h"
#include "core/formulation/surface_winslow.h"
#include "core/formulation/variational_winslow.h"
#include "core/formulation/wall_stretch.h"
#include "core/linear/linear_solver.h"
#include "core/outer/energy_newton.h"
#include "core/outer/equation_newton.h"
#include "core/outer/outer_solver.h"
#include "core/outer/picard_solver.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/smooth_options.h"
#include "core/vcv/sphere/star_builder.h"

namespace winslow {

/// Caches a product of some inputs, and remakes it when an input changes:
///
///   Keyed<PatternKey, std::shared_ptr<const Pattern>> pattern_;
///   const auto& pattern = pattern_.of({unknowns, threads}, [&] { return make_pattern(); });
///
/// The key holds all inputs and is compared by ==. Large inputs are shared_ptrs, compared by
/// identity: the key keeps them alive, so no other object can get their address. Explicit
/// invalidation is not needed.
template <typename Key, typename Product>
class Keyed {
 public:
  /// Returns the product of this key; calls make() unless the key equals that of the last call. If
  /// make() throws, nothing is kept, and the next call makes the product.
  template <typename Make>
  const Product& of(const Key& key, Make&& make) {
    if (!kept_ || !(kept_->key == key)) {
      kept_.reset();
      Product product = std::forward<Make>(make)();
      kept_.emplace(Kept{key, std::move(product)});
      ++times_made_;
    }
    return kept_->product;
  }
  /// The product that is kept; null: none.
  const Product* kept() const { return kept_ ? &kept_->product : nullptr; }
  /// Takes the product that is kept out, unless it is that of the key. Returns it with its key.
  std::optional<std::pair<Key, Product>> take_other(const Key& key) {
    if (!kept_ || kept_->key == key) return std::nullopt;
    std::pair<Key, Product> taken(std::move(kept_->key), std::move(kept_->product));
    kept_.reset();
    return taken;
  }
  /// How often a product was made.
  std::size_t times_made() const { return times_made_; }

 private:
  struct Kept {
    Key key;
    Product product;
  };
  std::optional<Kept> kept_;
  std::size_t times_made_ = 0;
};

/// Converts the options of a smoothing run into those of its solvers, for meshes of this cell
/// dimension.
inline NewtonOptions newton_options(const SmoothOptions& options, int cell_dimension) {
  return {tolerance_of(options, cell_dimension), options.linear.tolerance};
}
inline EquationOptions equation_options(const SmoothOptions& options, int cell_dimension) {
  return {options.clip, tolerance_of(options, cell_dimension), options.damping,
          options.adapt_damping, options.acceleration};
}

/// The options for the VCVs of a volume mesh. VcvKind::automatic stands for adjusted ones, in a
/// mesh with polyhedra for equal ones: a node of a dual mesh has four edges, and four solid angles
/// leave their directions open. Those that follow the mesh keep its poor shapes as targets.
VolumeVcvOptions volume_vcv_options(const SmoothOptions& options, const Topology& topology);

/// Prepared solvers of a run, kept from one run to the next, so that a drag of a body or a VCV does
/// not remake them at every mouse move.
///
/// Each product is a function of its inputs, and is made at the first request with these inputs
/// (Keyed):
///
///   pattern         which nodes move, guarded elements
///   VCVs            of volume meshes: kind, mesh as given, stencils by hand, adjustments
///   energy          pattern, targets, mesh as given, stretch of walls, shapes of layers, VCVs,
///                   roles of elements, elements that count more, penalty
///   pointwise form  pattern, VCVs
///   linear solvers  which nodes move, options
///   outer solvers   form, linear solver; new ones for each run
///
/// So the patterns, with their orderings and symbolic factorisations, are kept until the set of
/// moving nodes changes.
class SmoothingWorkspace {
 public:
  SmoothingWorkspace() = default;
  /// For another run of its own. Has the same products but for the linear solvers and what was
  /// found during the last run.
  std::shared_ptr<SmoothingWorkspace> fork() const;

  /// Begins a run with its inputs. state: the targets and the VCVs of a volume mesh refer to its
  /// mesh, which is copied if needed, or to `reference` if that is not null. The VCVs, of the kind
  /// in the options, are made when an equation first needs them; those given by hand come from the
  /// state. classes: which nodes move. wall_stretch: for targets `keep`; null: no wall is
  /// stretched. layer_shapes: VolumeTargetDetails::layer_shapes.
  void prepare(const MeshState& state, const std::shared_ptr<const NodeClasses>& classes,
               const SmoothOptions& options,
               const std::shared_ptr<const Coordinates>& reference = nullptr,
               std::shared_ptr<const WallStretch> wall_stretch = nullptr,
               std::shared_ptr<const Coordinates> layer_shapes = nullptr);

  /// The walls that a motion stretches, and the elements in layers over them. Takes no time if the
  /// last call had the same reference mesh and the same nodes that move.
  const WallLayers& walls(const std::shared_ptr<const NodeClasses>& classes,
                          const std::shared_ptr<const Coordinates>& reference);

  /// Until the next prepare(), multiplies the weight of these elements under `auto` targets by four
  /// for each time they are listed.
  void count_more(std::vector<Index> elements) { run_.urgent = std::move(elements); }
  /// Until the next prepare(), the energy keeps the Jacobian of these elements positive between
  /// their corners, too (VolumeTargetDetails::guarded). Returns whether any of the elements is new.
  bool guard(std::span<const Index> elements);
  /// Stops guarding elements with inverted edge_tetrahedra() at x, a valid mesh, so that its energy
  /// is finite. Returns whether there were any; if so, energy() and newton() change.
  bool drop_guards_broken_at(const Coordinates& x);

  /// Whether the equations depend on VCVs that follow the mesh: adjusted ones of a volume mesh.
  bool vcvs_follow_mesh() const {
    return in_space() && refers_to_vcvs(options_) && follows_mesh(options_.vcv);
  }
  /// Recomputes adjusted VCVs of a volume mesh from the angles of the mesh x, until the next
  /// prepare(); other kinds stay unchanged. Returns the number of changed VCVs.
  Index adjust_vcvs(const Coordinates& x);
  /// The same if the VCVs were computed from a tangled mesh and x is valid: the angles of a tangled
  /// mesh are meaningless. Returns whether any changed.
  bool adjust_tangled_vcvs(const Coordinates& x);

  /// Makes all linear solvers anew for the next run.
  void forget_linear_solvers();

  // Valid until one of their inputs changes, at most until the next prepare().
  PicardSolver& picard();
  /// With the penalty of the options.
  std::shared_ptr<const VariationalForm> energy();
  EnergyNewton& newton();
  /// Targets of elements (ascending) of a plane (D = 2) or a volume mesh (D = 3) if its walls were
  /// stretched otherwise; energy() has the others.
  template <int D>
  TargetsOfSome<D> targets_with(const std::shared_ptr<const WallStretch>& stretch,
                                std::span<const Index> elements);
  /// Newton's method on the formulation of the options.
  SteadySolver& steady_solver();
  EquationNewton& pointwise_newton();
  /// For the variational form's symmetric systems.
  LinearSolver& symmetric_linear() { return *shared_symmetric_linear(); }
  /// For the pointwise form's systems with frozen coefficients.
  LinearSolver& linear() { return *general_solver(made_.linear); }
  /// For the pointwise form's Jacobians.
  LinearSolver& newton_linear() { return *general_solver(made_.newton_linear); }
  /// VCVs of a volume mesh after prepare() and adjust_vcvs(), of the kind in the options; null for
  /// other meshes.
  std::shared_ptr<const VolumeVcvs> volume_vcvs();
  ClipVariants<EquationProblem> pointwise();

  const NodeClasses& classes() const { return *classes_; }
  /// Validity of the run's mesh at x.
  Validity validity(const Coordinates& x) const;
  const SmoothOptions& options() const { return options_; }
  /// The tolerance in effect on the run's mesh.
  double tolerance() const { return tolerance_of(options_, cell_dimension()); }

  /// How often each product was made, by all runs on the present topology together.
  struct TimesMade {
    std::size_t energy_patterns, pointwise_patterns, targets, vcvs, linear_solvers;
  };
  TimesMade times_made() const;
  /// Adds the memory of all products but outer solvers.
  void count(MemoryUse& use) const;

 private:
  using Classes = std::shared_ptr<const NodeClasses>;
  using GivenMesh = std::shared_ptr<const Coordinates>;
  using PlaneVcvs = Vcvs::Plane;
  using SpaceVcvs = std::shared_ptr<const VolumeVcvs>;
  using Stencils = Vcvs::ByHand;

  struct SolverKey {
    Classes unknowns;
    int threads;
    LinearOptions options;
    bool operator==(const SolverKey&) const = default;
  };
  using KeyedSolver = Keyed<SolverKey, std::shared_ptr<LinearSolver>>;

  /// VCVs of a volume mesh without those given by hand.
  struct ComputedVcvs {
    SpaceVcvs vcvs;
    bool of_tangle = false;  ///< adjusted to a mesh with inverted elements
  };
  struct ComputedVcvsKey {
    std::shared_ptr<const Topology> topology;
    VcvKind kind;
    double lengths;
    int threads;
    GivenMesh given;  ///< null: the VCVs do not refer to it
    bool operator==(const ComputedVcvsKey&) const = default;
  };
  struct SpaceVcvsKey {
    SpaceVcvs computed;
    Stencils stencils;
    bool operator==(const SpaceVcvsKey&) const = default;
  };

  struct PointwisePatternKey {
    Classes unknowns;
    int threads;
    bool operator==(const PointwisePatternKey&) const = default;
  };
  struct PointwiseKey {
    std::shared_ptr<const PointwisePattern> pattern;
    PlaneVcvs plane_vcvs;
    SpaceVcvs space_vcvs;
    bool operator==(const PointwiseKey&) const = default;
  };

  using EnergyPattern = std::variant<std::shared_ptr<const VariationalWinslow::Pattern>,
                                     std::shared_ptr<const VolumeWinslow::Pattern>,
                                     std::shared_ptr<const SurfaceWinslow::Pattern>>;
  struct EnergyPatternKey {
    Classes unknowns;
    int threads;
    std::vector<Index> guarded;
    /// With `rest` targets, determines which edges of guarded elements are cells. Null: other
    /// targets.
    GivenMesh given;
    bool operator==(const EnergyPatternKey&) const = default;
  };
  struct FormKey {
    EnergyPatternKey pattern;
    TargetBlend targets;
    GivenMesh given;  ///< null: the targets do not refer to it
    PlaneVcvs plane_vcvs;
    SpaceVcvs space_vcvs;  ///< null: the targets do not use them
    Stencils stencils;
    std::shared_ptr<const ElementRoles> roles;
    std::vector<Index> urgent;
    std::shared_ptr<const WallStretch> wall_stretch;
    std::shared_ptr<const Coordinates> layer_shapes;  ///< null: layers have targets like others
    bool operator==(const FormKey&) const = default;
  };
  struct EnergyKey {
    std::shared_ptr<const VariationalForm> form;
    PenaltyOptions penalty;
    bool operator==(const EnergyKey&) const = default;
  };

  template <typename Problem>
  struct OuterKey {
    std::shared_ptr<const Problem> problem;
    std::shared_ptr<LinearSolver> linear;
    bool operator==(const OuterKey&) const = default;
  };
  /// Data found during one run, and the solvers, which keep the run's history.
  struct Run {
    std::vector<Index> urgent;   ///< see count_more()
    std::vector<Index> guarded;  ///< see guard(); ascending
    ComputedVcvs adjusted;       ///< VCVs; null: those of the mesh as given
    Keyed<OuterKey<EquationProblem>, std::unique_ptr<PicardSolver>> picard;
    Keyed<OuterKey<EquationProblem>, std::unique_ptr<EquationNewton>> pointwise_newton;
    Keyed<OuterKey<VariationalForm>, std::unique_ptr<EnergyNewton>> newton;
  };

  struct Products {
    KeyedSolver linear, symmetric_linear, newton_linear;
    Keyed<ComputedVcvsKey, ComputedVcvs> computed_vcvs;
    Keyed<SpaceVcvsKey, SpaceVcvs> space_vcvs;
    Keyed<PointwisePatternKey, std::shared_ptr<const PointwisePattern>> pointwise_pattern;
    Keyed<PointwiseKey, ClipVariants<EquationProblem>> pointwise;
    Keyed<EnergyPatternKey, EnergyPattern> energy_pattern;
    Keyed<FormKey, std::shared_ptr<const VariationalForm>> form;
    Keyed<EnergyKey, std::shared_ptr<const VariationalForm>> energy;
  };

  int cell_dimension() const { return classes_->topology().cell_dimension(); }
  bool in_space() const { return cell_dimension() == 3; }
  bool tangled(const Coordinates& x) const { return validity(x).inverted > 0; }
  ComputedVcvs make_vcvs(const Coordinates& x) const;
  const ComputedVcvs& computed_vcvs();
  const std::shared_ptr<LinearSolver>& general_solver(KeyedSolver& solver);
  const std::shared_ptr<LinearSolver>& shared_symmetric_linear();
  FormKey form_key();
  std::shared_ptr<const VariationalForm> make_form(const FormKey& key);
  template <int D>
  TargetsOfSome<D> targets_of(const FormKey& key, std::span<const Index> elements,
                              bool any_without_shape);
  std::shared_ptr<const VariationalForm> stretched_form(
      const FormKey& key, FormKey last, std::shared_ptr<const VariationalForm> form);
  template <typename Form>
  const typename Form::Pattern& energy_pattern(const EnergyPatternKey& key,
                                               const typename Form::Targets& targets);

  // Inputs of prepare(). unknowns_ and given_ keep the objects of the previous run if they are
  // equal to the new ones: keys compare objects.
  Classes unknowns_;  // same moving nodes as in classes_
  Classes classes_;
  SmoothOptions options_;
  Vcvs vcvs_;
  std::shared_ptr<const ElementRoles> roles_;
  GivenMesh given_;  // null: nothing refers to it
  std::shared_ptr<const WallStretch> wall_stretch_;
  std::shared_ptr<const Coordinates> layer_shapes_;
  std::optional<WallLayers> wall_layers_;  // of the last call of walls()
  Run run_;
  Products made_;
  std::vector<double> matrix_memory_;  // of the last run by Newton's method
};

}  // namespace winslow
