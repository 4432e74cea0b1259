#include "core/strategy/smooth_options.h"

#include <initializer_list>

#include "core/error.h"

namespace winslow {

namespace {

constexpr double tight_tolerance = 1e-10, volume_tolerance = 1e-4;

void require(bool good, const std::string& message) {
  if (!good) throw UsageError(message);
}

bool is_variational(const SmoothOptions& o) { return o.formulation == Formulation::variational; }

/// Also true if the fixed point untangles for Newton's method, or replaces it.
bool uses_fixed_point(const SmoothOptions& o) {
  return o.outer == OuterMethod::picard || o.untangle != Untangle::energy ||
         (!is_variational(o) && o.outer == OuterMethod::automatic);
}

bool accelerates(const SmoothOptions& o) {
  return uses_fixed_point(o) && !is_variational(o) && o.outer != OuterMethod::newton;
}

bool solves_iteratively(const LinearOptions& o) {
  return o.solver != "automatic" && o.solver != "direct";
}

std::vector<ChoiceItem> linear_solvers(bool symmetric) {
  std::vector<ChoiceItem> items;
  for (const std::string& name : linear_solver_names()) {
    items.push_back({name, name, linear_solver_summary(name),
                     symmetric || !linear_solver_needs_symmetry(name)});
  }
  return items;
}

Option targets_option(SmoothOptions& o) {
  return {.key = "targets",
          .value =
              SharesOption{
                  .parts = {{"auto", "As the mesh is made",
                             "regular elements where the mesh is isotropic, each element's own "
                             "shape where it is stretched like its neighbours",
                             &o.targets.automatic},
                            {"element", "Make regular",
                             "equilateral triangles, square corners everywhere; for isotropic "
                             "meshes only",
                             &o.targets.element},
                            {"vcv", "VCV stencils",
                             "the virtual control volumes, with their angles and edge lengths",
                             &o.targets.vcv},
                            {"rest", "Keep current shapes",
                             "each element's own shape before the motion, to keep a graded or "
                             "stretched mesh as it is",
                             &o.targets.rest},
                            {"keep", "Keep the mesh as it is",
                             "each element's own shape in the reference mesh, and guards that keep "
                             "the worst elements from becoming worse",
                             &o.targets.keep}},
                  .none = {"default", "As the command needs",
                           "keep for motions, auto for everything else"}},
          .label = "Targets",
          .help = "Variational: shapes that the elements are driven towards, alone or blended",
          .applies = is_variational(o)};
}

/// Rows for volume meshes. Forms, which are for plane meshes, show them only if they were set.
OptionTable vcv_rows(SmoothOptions& o) {
  return {
      {.key = "vcv",
       .value = ChoiceOption(
           o.vcv,
           {{"auto", "Automatic",
             "adjusted ones of a volume mesh, equal ones of a plane mesh and of one with "
             "polyhedra"},
            {"equal", "Equal angles", "each triangle of a star has the same angle"},
            {"existing", "Existing angles",
             "the solid angles of the mesh as given; volume meshes only"},
            {"adjusted", "Adjusted angles",
             "the mean of equal and existing solid angles; volume meshes only"},
            {"perturbation", "By perturbation",
             "adjusted ones, found by the paper's random perturbation, for comparison; volume "
             "meshes only"}}),
       .label = "VCVs",
       .help = "Pointwise form and targets vcv: virtual control volumes of the interior nodes",
       .applies = o.vcv != VcvKind::automatic},
      {.key = "vcv_lengths",
       .value = RealOption{&o.vcv_lengths, between(0, 1)},
       .label = "VCV lengths",
       .help = "VCVs of volume meshes: power of the edge lengths of the mesh as given that their "
               "edges have; 0: unit edges, 1: those of the mesh",
       .advice = "Raise it to 0.25 or 0.5 where the pointwise form draws nodes to a body, or where "
                 "sizes jump.",
       .applies = o.vcv_lengths > 0},
      {.key = "vcv_updates",
       .value = IntegerOption{&o.vcv_updates, between(0, 1000)},
       .label = "VCV updates",
       .help = "Adjusted VCVs of volume meshes: how often, at most, they are worked out anew from "
               "the mesh that the run has led to; 0: from the mesh as given alone",
       .advice = "They are in any case where the mesh as given is tangled.",
       .applies = o.vcv_updates > 0},
  };
}

Option outer_option(SmoothOptions& o) {
  return {
      .key = "outer",
      .value = ChoiceOption(
          o.outer,
          {{"auto", "Automatic",
            "newton, after descent in volume meshes of 2,000 free nodes or more; pointwise: "
            "picard where that does not end converged"},
           {"newton", "Newton", "Newton's method; boundary motions through valid meshes"},
           {"descent", "First-order",
            "first-order steps (L-BFGS) to the solution, or near it: newton goes on where these "
            "are slow; variational, volume meshes only",
            is_variational(o)},
           {"picard", "Fixed point",
            "the paper's damped iteration, coefficients frozen (pointwise only)",
            !is_variational(o)}}),
      .label = "Iteration",
      .help = "Outer iteration",
      .applies = !is_variational(o) || o.outer == OuterMethod::descent};
}

OptionTable equations(SmoothOptions& o) {
  const bool variational = is_variational(o);
  return {
      {.key = "formulation",
       .value = ChoiceOption(
           o.formulation, {{std::string(formulation_name(Formulation::variational)), "variational",
                            "an energy with a barrier against inversion, minimised by Newton's "
                            "method through valid meshes only"},
                           {std::string(formulation_name(Formulation::pointwise)), "pointwise",
                            "the paper's operator, node by node, for comparison"}}),
       .label = "Formulation",
       .help = "Equations solved over the virtual control volumes"},
      targets_option(o),
      {.key = "exponent",
       .value = RealOption{&o.penalty.exponent, between(1, 64)},
       .label = "Exponent",
       .help = "Variational: power by which distortion beyond the knee is penalised",
       .advice = "1: all elements count alike; larger: better worst elements, more iterations.",
       .applies = variational},
      {.key = "knee",
       .value = RealOption{&o.penalty.knee, {.low = 1, .low_included = false, .also = 0.0}},
       .label = "Knee",
       .help = "Variational: distortion (1 is perfect) from which the power counts; 0: everywhere",
       .advice = "Raise it to let well-shaped elements alone.",
       .applies = variational},
      {.key = "raise_worst",
       .value = SwitchOption{&o.raise_worst},
       .label = "Raise worst",
       .help = "Variational: after the solution, make the worst element as good as it can be, at "
               "the expense of the others",
       .advice = "Of quadrilaterals and hexahedra with regular targets this is the smallest scaled "
                 "Jacobian; where targets keep elements stretched there may be nothing to gain. "
                 "Takes many more iterations, in drags too.",
       .applies = variational},
      outer_option(o),
      {.key = "untangle",
       .value = ChoiceOption(
           o.untangle,
           {{"auto", "Automatic",
             "scrambles by energy first, moved boundaries by picard, then the other"},
            {"picard", "Fixed point", "the paper's damped iteration, negative weights clipped"},
            {"energy", "Energy", "the variational form with a regularised determinant"}}),
       .label = "Untangling",
       .help = "How inverted elements are untangled before Newton's method begins",
       .advice = "Choose one of them if the other wastes time.",
       .applies = o.outer != OuterMethod::picard},
  };
}

OptionTable linear_rows(SmoothOptions& o) {
  const bool iterative = solves_iteratively(o.linear);
  return {
      {.key = "solver",
       .value = ChoiceOption(o.linear.solver, linear_solvers(is_variational(o))),
       .label = "Linear solver",
       .help = "How the linear systems are solved; the converged mesh is the same",
       .object = "linear",
       .flag = "linear"},
      {.key = "tolerance",
       .value = RealOption{&o.linear.tolerance, inside(0, 1)},
       .label = "Linear tolerance",
       .help = "Relative residual at which an iterative linear solver stops",
       .advice =
           "The outer iteration corrects what is left, and Newton's method on the energy chooses "
           "its own between 1e-2 and 1e-6: tighten it only if outer iterations stall.",
       .object = "linear",
       .applies = iterative},
      {.key = "max_iterations",
       .value = IntegerOption{&o.linear.max_iterations, at_least(1)},
       .label = "Linear iterations",
       .help = "Limit of sweeps or Krylov iterations for one linear system",
       .object = "linear",
       .applies = iterative},
      {.key = "restart",
       .value = IntegerOption{&o.linear.restart, at_least(1)},
       .label = "Restart",
       .help = "Krylov vectors that GMRES keeps before it restarts",
       .advice = "More: fewer iterations, more memory.",
       .object = "linear",
       .applies = o.linear.solver == "gmres"},
  };
}

OptionTable fixed_point(SmoothOptions& o) {
  const bool used = uses_fixed_point(o);
  return {
      {.key = "damping",
       .value = RealOption{&o.damping, {.low = 0, .high = 1, .low_included = false}},
       .label = "Damping",
       .help = "Fixed point: share of each linear solution that is taken",
       .advice =
           "Smaller is safer and slower: lower it where the iteration swings or the mesh does not "
           "untangle.",
       .applies = used},
      {.key = "adapt_damping",
       .value = SwitchOption{&o.adapt_damping, "fixed-damping",
                             "Fixed point: keep the damping where the iteration makes no progress, "
                             "instead of halving it"},
       .label = "Adapt damping",
       .help = "Fixed point: halve the damping where the iteration makes no progress",
       .applies = used},
      {.key = "acceleration",
       .value = IntegerOption{&o.acceleration, between(0, 100)},
       .label = "Acceleration",
       .help = "Fixed point: earlier iterates that Anderson acceleration combines once the mesh is "
               "valid; 0: the plain iteration of the paper",
       .applies = accelerates(o)},
      {.key = "clip",
       .value = ChoiceOption(o.clip, {{"auto", "Automatic", "while the mesh is tangled"},
                                      {"on", "Always", "in every iteration"},
                                      {"off", "Never", "not at all"}}),
       .label = "Clip weights",
       .help = "Fixed point: whether negative weights of the operator are set to zero",
       .advice = "Without them no node is drawn out of its neighbours.",
       .applies = used},
  };
}

OptionTable limits(SmoothOptions& o) {
  return {
      {.key = "max_iterations",
       .value = IntegerOption{&o.max_iterations, at_least(0)},
       .label = "Max. iterations",
       .help = "Limit of outer iterations: variational: of all stages of a command together; "
               "pointwise: of each attempt at a motion",
       .advice = "Raise it if a run ends valid but not converged."},
      {.key = "tolerance",
       .value = OptionalRealOption{&o.tolerance, inside(0, 1), "1e-10; volume meshes: 1e-4"},
       .label = "Tolerance",
       .help = "Largest scaled residual at which the mesh counts as converged",
       .advice = "1e-4 is enough for the eye. Drags and sweeps begin from other meshes and take "
                 "1e-10 in volume meshes too."},
      {.key = "threads",
       .value = IntegerOption{&o.threads, between(0, 4096)},
       .label = "Threads",
       .help = "Threads; 0: all cores, or one under MPI. The result does not depend on it"},
  };
}

}  // namespace

std::string_view formulation_name(Formulation formulation) {
  return formulation == Formulation::variational ? "variational" : "pointwise";
}

double default_tolerance(int cell_dimension) {
  return cell_dimension == 3 ? volume_tolerance : tight_tolerance;
}

double tolerance_of(const SmoothOptions& options, int cell_dimension) {
  return options.tolerance.value_or(default_tolerance(cell_dimension));
}

SmoothOptions independent_of_start(SmoothOptions options) {
  options.tolerance = options.tolerance.value_or(tight_tolerance);
  return options;
}

OptionTable option_table(SmoothOptions& options) {
  OptionTable table = equations(options);
  for (auto* rows : {vcv_rows, linear_rows, fixed_point, limits})
    table = joined(std::move(table), rows(options));
  return joined(joined(std::move(table), option_table(options.keep_outside)),
                option_table(options.slide));
}

void validate(const SmoothOptions& options) {
  SmoothOptions copy = options;
  check(option_table(copy));
  validate(options.keep_outside);
  require(!(is_variational(options) && options.outer == OuterMethod::picard),
          "the variational form has no fixed-point iteration: choose the outer method newton, or "
          "the formulation pointwise");
  require(is_variational(options) || options.outer != OuterMethod::descent,
          "the pointwise form has no energy for first-order steps to lower: choose another outer "
          "method than descent, or the formulation variational");
  require(
      is_variational(options) || !linear_solver_needs_symmetry(options.linear.solver),
      "the linear solver " + options.linear.solver +
          " takes symmetric systems only: choose automatic, direct or gmres, or the formulation "
          "variational");
  require(is_variational(options) || !options.raise_worst,
          "raise_worst: the pointwise form minimises nothing: choose the formulation variational");
  require(options.slide.reference.empty() || !options.slide.has_pairs(),
          "slide: a reference surface and periodic pairs do not go together");
  require(options.slide.reference.empty() || !options.slide.holds_spacing(),
          "slide: spacing is held along the curves of the mesh itself, not along those of a "
          "reference surface");
  for (const std::string& name : options.slide.held_markers)
    require(std::ranges::find(options.slide.markers, name) != options.slide.markers.end(),
            "slide.hold_spacing: marker \"" + name + "\" does not slide");
  require(!options.slide.given() || is_variational(options),
          "slide: the pointwise form knows no geometry of the boundary: choose the formulation "
          "variational");
  require(!options.slide.given() || options.untangle != Untangle::picard,
          "slide: the fixed point knows no geometry of the boundary: choose the untangling energy "
          "or auto");
  require(options.vcv_updates == 0 || follows_mesh(options.vcv),
          "equal and existing VCVs do not follow the mesh: vcv_updates needs the VCVs adjusted");
}

void validate_vcvs(const SmoothOptions& options, int cell_dimension) {
  if (cell_dimension == 3) return;
  require(options.vcv == VcvKind::automatic || options.vcv == VcvKind::equal,
          "vcv: solid angles of volume meshes only; a plane mesh takes auto or equal");
  require(options.vcv_lengths == 0,
          "vcv_lengths: for volume meshes only; the edges of a plane mesh's VCVs have the lengths "
          "that they are given");
  require(options.vcv_updates == 0,
          "vcv_updates: for volume meshes only; the VCVs of a plane mesh do not change");
}

bool refers_to_vcvs(const SmoothOptions& options) {
  return !is_variational(options) || options.targets.vcv > 0;
}

bool follows_mesh(VcvKind kind) { return kind != VcvKind::equal && kind != VcvKind::existing; }

namespace {

/// The same choice, restricted to these items.
template <class Value>
ChoiceOption left_of(Value& value, const OptionValue& option,
                     std::initializer_list<std::string_view> names) {
  std::vector<ChoiceItem> items = std::get<ChoiceOption>(option).items();
  for (ChoiceItem& item : items)
    item.applies = std::ranges::find(names, std::string_view(item.name)) != names.end();
  return {value, std::move(items)};
}

/// Options hidden for surface meshes: only the energy of the variational form smooths and untangles
/// them, and all nodes slide.
constexpr std::array<std::pair<std::string_view, std::string_view>, 13> hidden{
    {{"", "formulation"},
     {"", "outer"},
     {"", "untangle"},
     {"", "damping"},
     {"", "adapt_damping"},
     {"", "acceleration"},
     {"", "clip"},
     {"", "vcv_lengths"},
     {"", "vcv_updates"},
     {"slide", "markers"},
     {"slide", "fixed"},
     {"slide", "surface_first"},
     {"slide", "periodic"}}};

bool is_hidden(const Option& option) {
  return option.object == "keep_outside" ||
         std::ranges::find(hidden, std::pair(option.object, option.key)) != hidden.end();
}

}  // namespace

OptionTable surface_option_table(SmoothOptions& options) {
  OptionTable table = option_table(options);
  for (Option& option : table) {
    if (is_hidden(option)) option.applies = false;
    if (option.object == "slide" && (option.key == "feature_angle" || option.key == "features"))
      option.applies = true;
    if (!option.object.empty()) continue;
    if (option.key == "formulation")
      option.value = left_of(options.formulation, option.value, {"variational"});
    else if (option.key == "outer")
      option.value = left_of(options.outer, option.value, {"auto", "newton"});
    else if (option.key == "untangle")
      option.value = left_of(options.untangle, option.value, {"auto", "energy"});
    else if (option.key == "vcv")
      option.value = left_of(options.vcv, option.value, {"auto", "equal"});
  }
  return table;
}

OptionTable option_table(SmoothOptions& options, MeshKind kind) {
  OptionTable table =
      kind == MeshKind::surface ? surface_option_table(options) : option_table(options);
  for (Option& option : table) {
    if (auto* real = std::get_if<OptionalRealOption>(&option.value);
        real && real->value == &options.tolerance)
      real->instead = default_tolerance(cell_dimension_of(kind));
  }
  return table;
}

void settle_for_surface(SmoothOptions& options) {
  settle(surface_option_table(options));
  // Replaces a linear solver that only the pointwise form supports, and vice versa.
  settle(surface_option_table(options));
  options.vcv_lengths = 0;
  options.vcv_updates = 0;
  options.keep_outside = {};
  SlideOptions& slide = options.slide;
  slide.markers.clear();
  slide.fixed.clear();
  slide.periodic.clear();
  slide.surface_first = false;
}

}  // namespace winslow
