#include "gui/document/jobs/run_settings.h"

#include "gui/base/text.h"
#include "gui/document/selection/node_overrides.h"

namespace winslow::gui {

Method method_of(const SmoothOptions& smooth, const MotionOptions& motion) {
  if (!motion.smooth_after) return Method::custom;
  const bool fixed_point =
      smooth.formulation == Formulation::pointwise && smooth.outer == OuterMethod::picard;
  if (fixed_point && motion.increments == 1) return Method::direct;
  if (!fixed_point && motion.increments == 0) return Method::path;
  return Method::custom;
}

void use_method(Method method, SmoothOptions& smooth, MotionOptions& motion) {
  if (method == Method::custom) return;
  const bool direct = method == Method::direct;
  smooth.formulation = direct ? Formulation::pointwise : SmoothOptions{}.formulation;
  smooth.outer = direct ? OuterMethod::picard : OuterMethod::automatic;
  motion.increments = direct ? 1 : 0;
  motion.smooth_after = true;
  mend_linear_solver(smooth);
}

void mend_linear_solver(SmoothOptions& smooth) {
  if (smooth.formulation != Formulation::variational &&
      linear_solver_needs_symmetry(smooth.linear.solver))
    smooth.linear.solver = LinearOptions{}.solver;
}

std::optional<std::string> partner_of(const SlideOptions& slide, const GivenPeriodicity* file,
                                      const std::string& marker) {
  const std::vector<std::string>& pairs = slide.periodic;
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) {
    if (pairs[k] == marker) return pairs[k + 1];
    if (pairs[k + 1] == marker) return pairs[k];
  }
  return slide.periodic_from_file ? partner_in_file(file, marker) : std::nullopt;
}

std::optional<std::string> partner_in_file(const GivenPeriodicity* file,
                                           const std::string& marker) {
  if (!file) return std::nullopt;
  for (const GivenPairs& given : file->pairs) {
    if (given.halo || !given.fault.empty()) continue;
    if (given.first == marker) return given.second;
    if (given.second == marker) return given.first;
  }
  return std::nullopt;
}

void take_out(SlideOptions& slide, const GivenPeriodicity* file, const std::string& marker) {
  slide.periodic = pairs_without(slide.periodic, marker);
  if (!slide.periodic_from_file || !partner_in_file(file, marker)) return;
  slide.periodic_from_file = false;
  for (const GivenPairs& given : file->pairs)
    if (!given.halo && given.first != given.second && given.first != marker &&
        given.second != marker && !partner_of(slide, file, given.first))
      slide.periodic.insert(slide.periodic.end(), {given.first, given.second});
}

std::string pair_sides(SlideOptions& slide, const GivenPeriodicity* file, const Mesh& mesh,
                       const std::string& first, const std::optional<std::string>& second) {
  take_out(slide, file, first);
  if (!second) return first + " stays where it is.";
  take_out(slide, file, *second);
  const PeriodicPairs pairs = PeriodicPairs::find(*mesh.topology, mesh.coordinates, first, *second);
  slide.periodic.insert(slide.periodic.end(), {first, *second});
  for (const std::string& name : {first, *second}) {
    stop_sliding(slide, name);
    std::erase(slide.fixed, name);
  }
  return first + " and " + *second + " are periodic: " + pairs.description + ", " +
         counted(pairs.pairs.size(), "pair") + " of nodes.";
}

void leave_to_motion(SlideOptions& slide, const GivenPeriodicity* file, const Topology& topology,
                     const std::vector<std::string>& markers) {
  for (const std::string& name : markers) {
    stop_sliding(slide, name);
    std::erase(slide.fixed, name);
    take_out(slide, file, name);
  }
  // The reference is dropped only in this copy; the settings keep it for later sliding markers.
  if (slide.markers.empty() && !is_surface(topology)) slide.reference.clear();
  drop_stale_overrides(slide, topology, markers);
}

std::vector<std::string> pairs_without(const std::vector<std::string>& pairs,
                                       const std::string& marker) {
  std::vector<std::string> kept;
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2)
    if (pairs[k] != marker && pairs[k + 1] != marker)
      kept.insert(kept.end(), {pairs[k], pairs[k + 1]});
  return kept;
}

}  // namespace winslow::gui
