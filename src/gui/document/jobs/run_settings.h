#pragma once

#include "core/command/command.h"
#include "core/strategy/slide_options.h"

namespace winslow::gui {

/// How a motion is solved, as the first choice that a user makes.
enum class Method {
  path,    ///< follow the boundary's motion through valid meshes
  direct,  ///< the paper's: the boundary at once, then its outer iteration on the tangled mesh
  custom   ///< a combination of options that is neither
};

/// Iterations a second at which the direct method is shown unless the user says otherwise.
constexpr double default_pace = 10;

Method method_of(const SmoothOptions& smooth, const MotionOptions& motion);

/// Sets what makes up a method and leaves the rest; `custom` changes nothing.
void use_method(Method method, SmoothOptions& smooth, MotionOptions& motion);

/// Puts a linear solver that the formulation does not take back to automatic.
void mend_linear_solver(SmoothOptions& smooth);

// file: what the file of the mesh says of periodic sides; null: nothing.

/// The other side of the periodic pair that a marker is in, be it named or, if those are wanted,
/// one of the file; none: it is in no pair.
std::optional<std::string> partner_of(const SlideOptions& slide, const GivenPeriodicity* file,
                                      const std::string& marker);
/// The other side of the pair of the file that a marker is in, wanted or not.
std::optional<std::string> partner_in_file(const GivenPeriodicity* file, const std::string& marker);

/// Takes a marker out of all pairs. The other pairs of a file that had it are named from then on.
void take_out(SlideOptions& slide, const GivenPeriodicity* file, const std::string& marker);

/// Makes two markers periodic with one another, or the first with none, and says so in a sentence.
/// Throws UsageError for sides that do not match.
std::string pair_sides(SlideOptions& slide, const GivenPeriodicity* file, const Mesh& mesh,
                       const std::string& first, const std::optional<std::string>& second);

/// For a motion of some markers, which neither slide nor are periodic then, and whose nodes are not
/// held.
void leave_to_motion(SlideOptions& slide, const GivenPeriodicity* file, const Topology& topology,
                     const std::vector<std::string>& markers);

/// Periodic pairs, name after name, that a marker is not in.
std::vector<std::string> pairs_without(const std::vector<std::string>& pairs,
                                       const std::string& marker);

}  // namespace winslow::gui
