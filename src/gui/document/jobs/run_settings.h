#pragma once

#include "core/command/command.h"
#include "core/strategy/slide_options.h"

namespace winslow::gui {

/// The method for solving a motion, the user's first choice.
enum class Method {
  path,    ///< follow the boundary's motion through valid meshes
  direct,  ///< the paper's: move the boundary in one step, then iterate on the tangled mesh
  custom   ///< any other combination of options
};

/// Default rate at which iterations of the direct method are shown, per second.
constexpr double default_pace = 10;

Method method_of(const SmoothOptions& smooth, const MotionOptions& motion);

/// Sets the options that define a method, and no others; `custom` changes nothing.
void use_method(Method method, SmoothOptions& smooth, MotionOptions& motion);

/// Resets a linear solver that the formulation does not support to automatic.
void mend_linear_solver(SmoothOptions& smooth);

// file: periodic sides given in the mesh file; null: none.

/// The periodic partner of a marker: from the named pairs or, if enabled, from those of the file;
/// none: the marker is in no pair.
std::optional<std::string> partner_of(const SlideOptions& slide, const GivenPeriodicity* file,
                                      const std::string& marker);
/// The periodic partner of a marker according to the file, whether or not its pairs are enabled.
std::optional<std::string> partner_in_file(const GivenPeriodicity* file, const std::string& marker);

/// Removes a marker from all pairs. If the file had a pair with it, the other pairs of the file
/// become named ones.
void take_out(SlideOptions& slide, const GivenPeriodicity* file, const std::string& marker);

/// Makes two markers periodic with one another, or removes the pair of the first. Returns a
/// sentence about it. Throws UsageError for sides that do not match.
std::string pair_sides(SlideOptions& slide, const GivenPeriodicity* file, const Mesh& mesh,
                       const std::string& first, const std::optional<std::string>& second);

/// Prepares a motion of some markers: they neither slide nor are periodic, and their nodes are not
/// held.
void leave_to_motion(SlideOptions& slide, const GivenPeriodicity* file, const Topology& topology,
                     const std::vector<std::string>& markers);

/// The periodic pairs (a flat list of names) that do not contain a marker.
std::vector<std::string> pairs_without(const std::vector<std::string>& pairs,
                                       const std::string& marker);

}  // namespace winslow::gui
