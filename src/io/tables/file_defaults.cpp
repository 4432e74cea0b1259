#include "io/tables/file_defaults.h"

#include "core/error.h"
#include "core/geometry/sliding_boundary.h"
#include "core/strategy/slide_options.h"
#include "core/strategy/sliding.h"
#include "io/text/source.h"

namespace winslow::io {
namespace {

using Names = std::vector<std::string>;

bool contains(std::span<const std::string> names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// Replaces each name by those that markers_of(name) gives, each once.
template <typename MarkersOf>
void expand(Names& names, const MarkersOf& markers_of) {
  Names expanded;
  for (const std::string& name : names) {
    const std::optional<Names> markers = markers_of(name);
    for (const std::string& marker : markers.value_or(Names{name}))
      if (!markers || !contains(expanded, marker)) expanded.push_back(marker);
  }
  names = std::move(expanded);
}

/// The same for all lists of markers of a command.
template <typename MarkersOf>
void expand(Command& command, const MarkersOf& markers_of) {
  std::visit(
      [&](auto& c) {
        if constexpr (requires { c.markers; }) {
          expand(c.markers, markers_of);
        } else if constexpr (requires { c.bodies; }) {
          for (MovingBody& body : c.bodies) expand(body.markers, markers_of);
        } else if constexpr (requires { c.layers.walls; }) {
          for (LayerWall& wall : c.layers.walls) expand(wall.markers, markers_of);
        }
      },
      command);
  if (SmoothOptions* smooth = smooth_options(command))
    for (Names* names : {&smooth->slide.markers, &smooth->slide.fixed, &smooth->slide.held_markers})
      expand(*names, markers_of);
}

/// Whether a name is what a pattern says, in which * stands for any characters.
bool matches(std::string_view pattern, std::string_view name) {
  // The last * seen, and the part of the name that it does not stand for yet: one more character
  // goes to it wherever the rest does not fit.
  std::size_t p = 0, n = 0, star = std::string_view::npos, rest = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      rest = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++rest;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

/// Whether a node of a marker can slide.
bool can_slide(const Mesh& mesh, const std::string& marker, const SlideOptions& slide) {
  FeatureRules rules;
  rules.angle = slide.feature_angle;
  const Names names{marker};
  try {
    const auto boundary = SlidingBoundary::find(*mesh.topology, mesh.coordinates, names, rules);
    return !boundary.parts.empty();
  } catch (const UsageError&) {
    return false;
  }
}

std::string listed(const Names& names) {
  return list_of(names, [](const std::string& name) { return name; });
}

/// Adds the markers that slide; returns them with the file's words.
Names add_sliding(SlideOptions& slide, std::span<const std::string> moving, const MeshFile& file,
                  const MarkerRoles& roles) {
  Names added;
  for (const auto& [name, word] : roles.symmetry) {
    const bool taken = contains(slide.markers, name) || contains(slide.fixed, name) ||
                       contains(slide.periodic, name) || contains(moving, name);
    if (taken || !file.mesh.topology->markers().find(name) || !can_slide(file.mesh, name, slide))
      continue;
    slide.markers.push_back(name);
    added.push_back(name + " (" + word + ")");
  }
  return added;
}

/// Adds the pairs of the file; returns them. faults: of those that cannot be used.
Names add_pairs(SlideOptions& slide, const MeshFile& file, Names& faults) {
  Names added;
  if (!file.details->roles.pairs_move || !file.details->periodic || slide.periodic_from_file)
    return added;
  for (const GivenPairs& given : file.details->periodic->pairs) {
    if (contains(slide.fixed, given.first) || contains(slide.fixed, given.second)) continue;
    if (!given.fault.empty()) {
      faults.push_back(given.first + " and " + given.second + " stay: " + given.fault);
      for (const std::string& name : {given.first, given.second}) slide.fixed.push_back(name);
    } else if (!contains(slide.periodic, given.first) && !given.pairs.empty()) {
      added.push_back(given.first + " and " + given.second);
    }
  }
  slide.periodic_from_file = !added.empty();
  return added;
}

/// Adds pairs of markers that are named without their nodes.
void add_named_pairs(SlideOptions& slide, const MeshFile& file, const MarkerRoles& roles,
                     Names& added) {
  const Markers& markers = file.mesh.topology->markers();
  for (const auto& sides : roles.pairs) {
    const std::string &first = sides.first, &second = sides.second;
    const bool taken = std::ranges::any_of(std::array{first, second}, [&](const std::string& name) {
      return contains(slide.fixed, name) || contains(slide.periodic, name) ||
             contains(slide.markers, name) || !markers.find(name);
    });
    const bool known =
        slide.periodic_from_file && file.details->periodic &&
        std::ranges::any_of(file.details->periodic->pairs, [&](const GivenPairs& of) {
          return of.first == first || of.second == first;
        });
    if (taken || known) continue;
    slide.periodic.insert(slide.periodic.end(), {first, second});
    added.push_back(first + " and " + second);
  }
}

}  // namespace

void expand_groups(Command& command, const MarkerRoles& roles, const Topology& topology) {
  expand(command, [&](const std::string& name) -> std::optional<Names> {
    const auto group = roles.groups.find(name);
    if (group == roles.groups.end() || topology.markers().find(name)) return std::nullopt;
    return group->second;
  });
}

std::vector<Command> with_names_expanded(std::vector<Command> commands,
                                         const FormatDetails* details, const Topology& topology) {
  const std::array topologies{&topology};
  for (Command& command : commands) {
    if (details) expand_groups(command, details->roles, topology);
    expand_patterns(command, topologies);
  }
  return commands;
}

void expand_patterns(Command& command, std::span<const Topology* const> topologies) {
  expand(command, [&](const std::string& name) -> std::optional<Names> {
    if (name.find('*') == std::string::npos) return std::nullopt;
    std::string pattern = name;
    for (std::size_t at = 0; (at = pattern.find(".*", at)) != std::string::npos;)
      pattern.erase(at, 1);
    Names found;
    for (const Topology* topology : topologies) {
      if (topology->markers().find(name)) return std::nullopt;
      for (const Marker& marker : topology->markers())
        if (matches(pattern, marker.name)) found.push_back(marker.name);
    }
    if (found.empty()) return std::nullopt;
    return found;
  });
}

std::string add_file_defaults(SmoothOptions& smooth, std::span<const std::string> moving,
                              const MeshFile& file, const MarkerRoles& more) {
  if (!file.details || !what_holds_footholds(smooth).empty()) return {};
  Names faults;
  Names pairs = add_pairs(smooth.slide, file, faults);
  add_named_pairs(smooth.slide, file, more, pairs);
  Names sliding;
  for (const MarkerRoles* roles : {&file.details->roles, &more})
    for (std::string& name : add_sliding(smooth.slide, moving, file, *roles))
      sliding.push_back(std::move(name));
  Names said;
  if (!sliding.empty())
    said.push_back(listed(sliding) + (sliding.size() == 1 ? " slides" : " slide"));
  if (!pairs.empty()) said.push_back(listed(pairs) + " move together");
  std::string text =
      said.empty() ? "" : "As the file says, " + list_of(said, [](const std::string& part) {
                            return part;
                          }) + "; --fixed NAME holds a marker";
  for (const std::string& fault : faults) text += (text.empty() ? "" : "; ") + fault;
  return text;
}

std::string add_file_defaults(Command& command, const MeshFile& file, const MarkerRoles& more) {
  const std::vector<std::string> moving = markers_of(command);
  SmoothOptions* smooth = smooth_options(command);
  return smooth ? add_file_defaults(*smooth, moving, file, more) : std::string();
}

}  // namespace winslow::io
