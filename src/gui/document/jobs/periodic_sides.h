#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/strategy/slide_options.h"

namespace winslow::gui {

/// The other side of the periodic pair that a marker is in, be it named or, if those are wanted,
/// one of the file; none: it is in no pair.
std::optional<std::string> partner_of(const SlideOptions& slide, const std::string& marker);
/// The other side of the pair of the file that a marker is in, wanted or not.
std::optional<std::string> partner_in_file(const SlideOptions& slide, const std::string& marker);

/// Takes a marker out of all pairs. The other pairs of a file that had it are named from then on.
void take_out(SlideOptions& slide, const std::string& marker);

/// Makes two markers periodic with one another, or the first with none, and says so in a sentence.
/// Throws UsageError for sides that do not match.
std::string pair_sides(SlideOptions& slide, const Mesh& mesh, const std::string& first,
                       const std::optional<std::string>& second);

/// For a motion of some markers, which neither slide nor are periodic then, and whose nodes are not
/// held.
void leave_to_motion(SlideOptions& slide, const Topology& topology,
                     const std::vector<std::string>& markers);

/// Periodic pairs, name after name, that a marker is not in.
std::vector<std::string> pairs_without(const std::vector<std::string>& pairs,
                                       const std::string& marker);

}  // namespace winslow::gui
