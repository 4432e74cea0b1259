#pragma once

#include "core/formulation/pointwise_winslow.h"
#include "core/formulation/surface_winslow.h"
#include "core/formulation/variational_winslow.h"
#include "core/linear/linear_solver.h"
#include "core/outer/energy_newton.h"
#include "core/outer/equation_newton.h"
#include "core/outer/outer_solver.h"
#include "core/outer/picard_solver.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/smooth_options.h"
#include "core/vcv/sphere/star_builder.h"

namespace winslow {

/// Keeps what is made from some inputs, and makes it anew when one of them is another:
///
///   Keyed<PatternKey, std::shared_ptr<const Pattern>> pattern_;
///   const auto& pattern = pattern_.of({unknowns, threads}, [&] { return make_pattern(); });
///
/// The key names all inputs, and is compared by ==. Large inputs are shared_ptrs in it, compared by
/// identity: the key keeps them alive, so that no other object can come to lie where one of them
/// lay. Nothing has to say that a product is out of date.
template <typename Key, typename Product>
class Keyed {
 public:
  /// The product of this key, made by make() unless it is the last one that was asked for. If
  /// make() throws, there is none, and the next call makes it.
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

/// What the options of a smoothing run mean to its solvers.
inline NewtonOptions newton_options(const SmoothOptions& options) {
  return {options.tolerance, options.linear.tolerance};
}
inline EquationOptions equation_options(const SmoothOptions& options) {
  return {options.clip, options.tolerance, options.damping, options.adapt_damping,
          options.acceleration};
}

VolumeVcvOptions volume_vcv_options(const SmoothOptions& options);

/// Prepared solvers of a run, kept from one run to the next, so that a drag does not pay for them
/// at every move of the mouse, be it of a body or of a VCV.
///
/// Each product is a function of its inputs, and is made when it is first asked for with these
/// inputs (Keyed):
///
///   pattern         which nodes move, guarded elements
///   VCVs            of volume meshes: kind, mesh as given, stencils by hand, adjustments
///   energy          pattern, targets, mesh as given, VCVs, roles of elements, elements that
///                   count more, penalty
///   pointwise form  pattern, VCVs
///   linear solvers  which nodes move, options
///   outer solvers   form, linear solver; new ones for each run
///
/// So the patterns, and with them orderings and symbolic factorisations, outlive everything but a
/// change of the nodes that move.
class SmoothingWorkspace {
 public:
  /// Begins a run: says what is to be solved. state: its mesh is the one that targets `auto` and
  /// `rest` and the VCVs of a volume mesh refer to, kept by value where they do. Those VCVs, of the
  /// kind that the options say, are made when an equation first needs them; those given by hand are
  /// taken from the state. classes: which nodes move.
  void prepare(const MeshState& state, const std::shared_ptr<const NodeClasses>& classes,
               const SmoothOptions& options);

  /// From here to the next prepare() these elements count four times as much with `auto` targets,
  /// once more for each time they are listed.
  void count_more(std::vector<Index> elements) { run_.urgent = std::move(elements); }
  /// From here to the next prepare() the energy keeps the Jacobian of these elements positive
  /// between their corners, too (VolumeTargetDetails::guarded). Returns whether any of them was not
  /// among them.
  bool guard(std::span<const Index> elements);
  /// No longer guards elements of which some edge_tetrahedra() are inverted at x, a mesh that is
  /// valid all the same: its energy is to be finite. Returns whether there were any; the energy and
  /// newton() are others then.
  bool drop_guards_broken_at(const Coordinates& x);

  /// Whether the equations are over VCVs that follow the mesh: adjusted ones of a volume mesh.
  bool vcvs_follow_mesh() const {
    return in_space() && refers_to_vcvs(options_) && follows_mesh(options_.vcv);
  }
  /// Adjusted VCVs of a volume mesh take the angles of the mesh as it is now, up to the next
  /// prepare(); those of all other kinds stay. Returns how many changed.
  Index adjust_vcvs(const Coordinates& x);
  /// The same where they are those of a mesh that came tangled, and x is valid: what a tangle has
  /// for angles says little. Returns whether any changed.
  bool adjust_tangled_vcvs(const Coordinates& x);

  // Valid until one of their inputs changes, and no longer than to the next prepare().
  PicardSolver& picard();
  /// With the penalty of the options.
  std::shared_ptr<const VariationalForm> energy();
  EnergyNewton& newton();
  /// Newton's method on the formulation of the options.
  SteadySolver& steady_solver();
  EquationNewton& pointwise_newton();
  /// For the variational form's symmetric systems.
  LinearSolver& symmetric_linear() { return *shared_symmetric_linear(); }
  /// For the pointwise form's systems with frozen coefficients.
  LinearSolver& linear() { return *general_solver(made_.linear); }
  /// For the pointwise form's Jacobians.
  LinearSolver& newton_linear() { return *general_solver(made_.newton_linear); }
  /// Of a volume mesh, as the options, prepare() and adjust_vcvs() have them; null: of another.
  std::shared_ptr<const VolumeVcvs> volume_vcvs();
  ClipVariants<EquationProblem> pointwise();

  const NodeClasses& classes() const { return *classes_; }
  /// Of the mesh of the run at x.
  Validity validity(const Coordinates& x) const;
  const SmoothOptions& options() const { return options_; }

  /// How often each product was made, by all runs on the present topology together.
  struct TimesMade {
    std::size_t energy_patterns, pointwise_patterns, targets, vcvs, linear_solvers;
  };
  TimesMade times_made() const;

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
    GivenMesh given;  ///< null: they do not refer to it
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
    /// Which edges of guarded elements are cells depends on it with `rest` targets. Null: not so.
    GivenMesh given;
    bool operator==(const EnergyPatternKey&) const = default;
  };
  struct FormKey {
    EnergyPatternKey pattern;
    TargetBlend targets;
    GivenMesh given;  ///< null: the targets do not refer to it
    PlaneVcvs plane_vcvs;
    SpaceVcvs space_vcvs;  ///< null: the targets have no share for them
    Stencils stencils;
    std::shared_ptr<const ElementRoles> roles;
    std::vector<Index> urgent;
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
  /// What one run finds out, and the solvers that remember how it went.
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

  bool in_space() const { return classes_->topology().cell_dimension() == 3; }
  bool tangled(const Coordinates& x) const { return validity(x).inverted > 0; }
  ComputedVcvs make_vcvs(const Coordinates& x) const;
  const ComputedVcvs& computed_vcvs();
  const std::shared_ptr<LinearSolver>& general_solver(KeyedSolver& solver);
  const std::shared_ptr<LinearSolver>& shared_symmetric_linear();
  FormKey form_key();
  std::shared_ptr<const VariationalForm> make_form(const FormKey& key);
  template <typename Form>
  const typename Form::Pattern& energy_pattern(const EnergyPatternKey& key,
                                               const typename Form::Targets& targets);

  // What prepare() was told. unknowns_ and given_ stay the objects of the run before if they are
  // equal to them: keys compare objects.
  Classes unknowns_;  // whose nodes move as those of classes_ do
  Classes classes_;
  SmoothOptions options_;
  Vcvs vcvs_;
  std::shared_ptr<const ElementRoles> roles_;
  GivenMesh given_;  // null: nothing refers to it
  Run run_;
  Products made_;
};

}  // namespace winslow
