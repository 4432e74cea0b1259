#include "core/strategy/slide_options.h"

#include "core/error.h"

namespace winslow {

namespace {

OptionTable sliding_rows(SlideOptions& slide) {
  return {
      {.key = "markers",
       .value = NamesOption{&slide.markers},
       .label = "Sliding markers",
       .help = "Markers whose nodes may slide along the boundary, which keeps its shape: corners "
               "stay; variational form only",
       .advice = "Far fields, walls of a channel and planes of symmetry that a moving body draws "
                 "the mesh along.",
       .object = "slide",
       .flag = "slide",
       .applies = !slide.markers.empty()},
      {.key = "fixed",
       .value = NamesOption{&slide.fixed},
       .label = "Fixed markers",
       .help = "Markers that stay where a moving body stands on them; without, straight lines, "
               "circles, planes, cylinders and spheres give way: their nodes slide",
       .advice = "Where the nodes of such a marker must keep their places: the body then goes as "
                 "far as the elements at its foot allow.",
       .object = "slide",
       .flag = "fixed",
       .applies = !slide.fixed.empty()},
      {.key = "feature_angle",
       .value = RealOption{&slide.feature_angle, between(0, 180)},
       .label = "Feature angle",
       .help =
           "Where a sliding marker turns by more than this is a corner, which stays, in space an "
           "edge",
       .unit = "degrees",
       .object = "slide",
       .flag = "feature-angle",
       .applies = !slide.markers.empty()},
      {.key = "features",
       .value = SwitchOption{&slide.features},
       .label = "Slide along edges",
       .help = "In space: nodes slide along the edges of sliding markers and of surface meshes, "
               "instead of staying",
       .object = "slide",
       .applies = !slide.markers.empty()},
      {.key = "surface_first",
       .value = SwitchOption{&slide.surface_first},
       .label = "Surface first",
       .help = "Smoothing a volume mesh: sliding markers are smoothed as surface meshes, then the "
               "interior within them; without, all at once",
       .advice = "For elements of the boundary that are as good as they can be by themselves.",
       .object = "slide",
       .flag = "surface-first",
       .applies = !slide.markers.empty()},
      {.key = "reference",
       .value = FileOption{&slide.reference},
       .label = "Reference surface",
       .help = "In space: a surface mesh, from CAD or a scan, that nodes slide on instead of the "
               "surface of the mesh as given; they are put onto it first",
       .advice = "Where the mesh is coarser than the shape that it stands for, or tangled.",
       .object = "slide",
       .flag = "reference-surface",
       .applies = !slide.reference.empty()},
  };
}

OptionTable node_rows(SlideOptions& slide) {
  return {
      {.key = "hold_nodes",
       .value = NodesOption{&slide.hold_nodes},
       .label = "Held nodes",
       .help = "Nodes that stay where they are, of the boundary or inside; counted from 0 in the "
               "order of the mesh file",
       .advice = "Where a node would slide that belongs to a place: a trailing edge, a probe.",
       .object = "slide",
       .flag = "hold-node",
       .applies = !slide.hold_nodes.empty()},
      {.key = "smooth_nodes",
       .value = NodesOption{&slide.smooth_nodes},
       .label = "Smooth nodes",
       .help = "Nodes of sliding markers and of surface meshes that are no corners, however much "
               "the boundary turns there: they slide on what runs through them",
       .advice = "For a kink of a coarse mesh that the shape does not have.",
       .object = "slide",
       .flag = "smooth-node",
       .applies = !slide.smooth_nodes.empty()},
  };
}

OptionTable spacing_rows(SlideOptions& slide) {
  return {
      {.key = "spacing",
       .value = ChoiceOption{slide.spacing,
                             {{"auto", "Auto",
                               "Held for walls: markers around a body, and those whose elements "
                               "are flat, three times as long as high or more"},
                              {"held", "Held", "For all sliding markers"},
                              {"free", "Free", "For none"}}},
       .label = "Spacing along curves",
       .help = "Whether the edges of a sliding curve keep their shares of its length: a closed "
               "curve then turns as a whole, others follow their ends",
       .advice = "Held where nodes are clustered, as at leading edges and walls; free where they "
                 "may go where the mesh draws them.",
       .object = "slide",
       .applies = !slide.markers.empty()},
      {.key = "hold_spacing",
       .value = NamesOption{&slide.held_markers},
       .label = "Markers with held spacing",
       .help = "Sliding markers whose spacing is held whatever is chosen for the others",
       .object = "slide",
       .flag = "hold-spacing",
       .applies = !slide.held_markers.empty()},
  };
}

OptionTable pair_rows(SlideOptions& slide) {
  return {
      {.key = "periodic",
       .value = NamesOption{&slide.periodic, true},
       .label = "Periodic pairs",
       .help = "Two markers of which one is the image of the other by a translation or a rotation: "
               "their nodes move together and keep matching; variational form only",
       .advice = "The sides of a passage: they give way to a blade that turns.",
       .object = "slide",
       .flag = "periodic",
       .applies = !slide.periodic.empty()},
      {.key = "periodic_from_file",
       .value = SwitchOption{&slide.periodic_from_file},
       .label = "Periodic pairs of the file",
       .help =
           "Take all periodic pairs that the mesh file names: $Periodic of Gmsh, NPERIODIC= and "
           "SEND_RECEIVE of SU2, Periodic_t of CGNS; winslow quality lists them",
       .advice = "SU2 of today names them in its configuration file (MARKER_PERIODIC=) and not in "
                 "the mesh: choose these two markers as a pair instead.",
       .object = "slide",
       .flag = "periodic-from-file",
       .applies = slide.periodic_from_file},
  };
}

OptionTable interface_rows(SlideOptions& slide) {
  return {
      {.key = "interfaces",
       .value = ChoiceOption{slide.interfaces,
                             {{.name = "auto",
                               .label = "Auto",
                               .help = "Held while a mesh is smoothed, free in a motion"},
                              {.name = "held",
                               .label = "Held",
                               .help = "Nodes in which regions of the mesh meet stay where they "
                                       "are, as smoothing without a motion has it anyway",
                               .flag = "hold-interfaces"},
                              {.name = "slide",
                               .label = "Slide",
                               .help = "Nodes in which regions of the mesh meet slide along the "
                                       "curve or the surface that the mesh has there; corners and "
                                       "places where more than two regions meet stay",
                               .flag = "slide-interfaces"},
                              {.name = "free",
                               .label = "Free",
                               .help = "Nodes in which regions of the mesh meet move as any other "
                                       "node, as motions have it anyway",
                               .flag = "free-interfaces"}}},
       .label = "Where regions meet",
       .help = "What nodes do in which regions of the mesh meet: the physical groups or references "
               "of its elements",
       .advice =
           "Slide where elements beside an interface should get better and the interface must "
           "keep its shape.",
       .object = "slide",
       .applies = slide.interfaces != Interfaces::automatic},
  };
}

}  // namespace

OptionTable option_table(SlideOptions& slide) {
  OptionTable table = sliding_rows(slide);
  for (auto* rows : {spacing_rows, node_rows, pair_rows, interface_rows})
    for (Option& row : rows(slide)) table.push_back(std::move(row));
  return table;
}

FeatureRules feature_rules(const SlideOptions& slide) {
  FeatureRules rules{slide.feature_angle, slide.features, slide.hold_nodes, slide.smooth_nodes};
  if (interfaces_in(slide.interfaces, false) != Interfaces::free)
    rules.interfaces = Interfaces::held;
  return rules;
}

Interfaces interfaces_in(Interfaces wanted, bool motion) {
  if (wanted != Interfaces::automatic) return wanted;
  return motion ? Interfaces::free : Interfaces::held;
}

namespace {

/// "holds 42", "slides 40 and holds 2", "leaves free 42".
std::string what_they_do(const InterfaceNodes& nodes) {
  std::string text;
  const auto add = [&](const char* verb, Index count) {
    if (count > 0) text += (text.empty() ? "" : " and ") + (verb + std::to_string(count));
  };
  add("slides ", nodes.sliding);
  add("holds ", nodes.held);
  add("leaves free ", nodes.free);
  return text;
}

}  // namespace

std::string text_of(const InterfaceReport& report) {
  if (report.all.count() == 0) return {};
  const std::string text =
      what_they_do(report.all) + (report.all.count() == 1 ? " node" : " nodes") + " in which ";
  if (report.each.size() == 1) return text + "the regions " + report.each.front().regions + " meet";
  constexpr std::size_t few = 3;
  std::string list;
  for (std::size_t k = 0; k < report.each.size() && k < few; ++k)
    list += (k == 0 ? "" : ", ") + report.each[k].regions + ' ' +
            std::to_string(report.each[k].count());
  if (report.each.size() > few)
    list += " and " + std::to_string(report.each.size() - few) + " more";
  return text + "regions meet (" + list + ")";
}

void require_fixed(const SlideOptions& slide, const Topology& topology,
                   std::span<const std::string> moving) {
  topology.markers().nodes_of(slide.fixed);  // throws with a list of the markers if one is unknown
  const auto in = [](std::span<const std::string> names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  for (const std::string& name : slide.fixed) {
    const char* what = in(slide.markers, name)    ? "to slide"
                       : in(slide.periodic, name) ? "to be periodic"
                       : in(moving, name)         ? "to move"
                                                  : nullptr;
    if (what)
      throw UsageError("slide.fixed: marker \"" + name + "\" is to be fixed and " + what +
                       ": expected one");
  }
}

std::string HeldFoothold::description() const {
  const bool several = body.find(',') != std::string::npos;
  return (body.empty() ? "what moves" : body) + (several ? " share " : " shares ") +
         std::to_string(nodes) + (nodes == 1 ? " node" : " nodes") + " with " + marker +
         ", which stays (" + by + ")";
}

bool stop_sliding(SlideOptions& slide, const std::string& marker) {
  std::erase(slide.held_markers, marker);
  return std::erase(slide.markers, marker) > 0;
}

ResolvedSlide::ResolvedSlide(SlideOptions slide, SlideFiles files)
    : SlideOptions(std::move(slide)), files_(std::move(files)) {
  if (!reference.empty() && !files_.reference)
    throw UsageError(reference + ": this reference surface was not read");
  if (periodic_from_file && !files_.periodic)
    throw UsageError("slide.periodic_from_file: the file of the mesh was not read");
  if (reference.empty()) files_.reference.reset();
  if (!periodic_from_file) files_.periodic.reset();
}

namespace {

/// The pairs of the file, except those that the options name, too. Throws UsageError if the file
/// names none.
std::vector<GivenPairs> pairs_of_file(const SlideOptions& slide, const GivenPeriodicity& file) {
  if (file.pairs.empty())
    throw UsageError(file.source +
                     ": found no periodic pairs in the file, expected $Periodic (Gmsh), "
                     "PERIODIC_INDEX= (SU2), Periodic_t (CGNS) or cyclic patches (OpenFOAM) for "
                     "its markers; name the two "
                     "markers instead");
  std::vector<GivenPairs> wanted;
  for (const GivenPairs& pair : file.pairs) {
    bool named = false;
    for (std::size_t k = 0; k + 1 < slide.periodic.size(); k += 2)
      named = named || (slide.periodic[k] == pair.first && slide.periodic[k + 1] == pair.second) ||
              (slide.periodic[k] == pair.second && slide.periodic[k + 1] == pair.first);
    const bool held = std::ranges::find(slide.fixed, pair.first) != slide.fixed.end() ||
                      std::ranges::find(slide.fixed, pair.second) != slide.fixed.end();
    if ((!named && !held) || pair.halo) wanted.push_back(pair);
  }
  return wanted;
}

/// The pairs of a file on a mesh derived from the file's, e.g. with layers: then found by position.
std::optional<PeriodicPairs> pairs_on(const Mesh& mesh, const GivenPeriodicity& file,
                                      const GivenPairs& given) {
  const Topology& topology = *mesh.topology;
  if (file.fits(topology)) return PeriodicPairs::of(topology, mesh.coordinates, given);
  if (given.halo) return std::nullopt;  // new meshes are written without halo nodes
  if (!given.fault.empty()) throw UsageError(given.fault);
  return PeriodicPairs::find(topology, mesh.coordinates, given.first, given.second);
}

void require_at_rest(const std::string& marker, std::span<const Index> nodes,
                     std::span<const Index> moving) {
  for (const Index node : nodes)
    if (std::ranges::binary_search(moving, node))
      throw UsageError("marker \"" + marker +
                       "\" is to slide or to be periodic, and the motion takes its nodes");
}

/// Nodes of a motion or of a pair cannot be fixed.
void require_not_held(const SlideOptions& slide, const PeriodicPairs& pairs) {
  for (const auto* list : {&pairs.pairs, &pairs.corners})
    for (const PeriodicPair& pair : *list)
      for (const Index node : slide.hold_nodes)
        if (pair.node == node || pair.image == node)
          throw UsageError("node " + std::to_string(node) +
                           " is to be held and moves with one of the periodic pair " + pairs.first +
                           ", " + pairs.second + ": expected one");
}

void hold(const SlideOptions& slide, std::span<const Index> moving, NodeClasses& classes) {
  classes.set_fixed(slide.hold_nodes);
  for (const Index node : slide.hold_nodes)
    if (std::ranges::binary_search(moving, node))
      throw UsageError("node " + std::to_string(node) + " is to be held, and the motion takes it");
}

}  // namespace

std::vector<PeriodicPairs> periodic_pairs(const ResolvedSlide& slide, const Mesh& mesh) {
  std::vector<PeriodicPairs> list;
  for (std::size_t k = 0; k + 1 < slide.periodic.size(); k += 2)
    list.push_back(PeriodicPairs::find(*mesh.topology, mesh.coordinates, slide.periodic[k],
                                       slide.periodic[k + 1]));
  if (const GivenPeriodicity* file = slide.files().periodic.get())
    for (const GivenPairs& given : pairs_of_file(slide, *file))
      if (auto pairs = pairs_on(mesh, *file, given)) list.push_back(std::move(*pairs));
  for (const PeriodicPairs& pairs : list)
    for (const std::string& name : {pairs.first, pairs.second})
      if (std::ranges::find(slide.markers, name) != slide.markers.end())
        throw UsageError("marker \"" + name + "\" is to slide and to be periodic: expected one");
  std::stable_partition(list.begin(), list.end(),
                        [](const PeriodicPairs& pairs) { return !pairs.halo; });
  return list;
}

namespace {

/// Keeps only the corners that move: those found to slide, and their periodic copies.
void keep_sliding_corners(const std::vector<PeriodicPair>& sliding, const NodeClasses& classes,
                          PeriodicPairs& pairs) {
  std::erase_if(pairs.corners, [&](const PeriodicPair& pair) {
    if (!pairs.halo) return std::ranges::find(sliding, pair) == sliding.end();
    return !classes.slides(pair.node) || classes.tied().has_image(pair.node) ||
           classes[pair.image] == NodeClass::image;
  });
}

/// Removes the nodes of a motion, which takes them, from the parts where regions meet.
void leave_to_motion(std::span<const Index> taken, std::vector<SlidingPart>& parts) {
  for (SlidingPart& part : parts)
    std::erase_if(part.nodes, [&](Index node) { return std::ranges::binary_search(taken, node); });
  std::erase_if(parts, [](const SlidingPart& part) { return part.nodes.empty(); });
}

/// Removes the pairs that a motion takes with both nodes.
void leave_to_motion(std::span<const Index> taken, PeriodicPairs& pairs) {
  const auto is_taken = [&](const PeriodicPair& pair) {
    return std::ranges::binary_search(taken, pair.node) &&
           std::ranges::binary_search(taken, pair.image);
  };
  for (auto* list : {&pairs.pairs, &pairs.corners}) std::erase_if(*list, is_taken);
}

/// Sets the nodes of a boundary to slide. Returns the corners of periodic sides that do.
std::vector<PeriodicPair> add_sliding(const Mesh& mesh, SlidingBoundary boundary,
                                      std::span<const Index> taken, MovingBoundary& out,
                                      NodeClasses& classes) {
  for (SlidingPart& part : boundary.parts) {
    if (!part.of_regions) require_at_rest(part.marker, part.nodes, taken);
    classes.set_sliding(part.nodes, boundary.geometry, mesh.coordinates);
    out.sliding.push_back(std::move(part));
  }
  out.bends.insert(out.bends.end(), boundary.bends.begin(), boundary.bends.end());
  sort_unique(out.bends);
  return std::move(boundary.corners);
}

/// Counts the nodes in which regions meet and that could move, and fixes those that are held.
InterfaceReport hold_interfaces(const Topology& topology, Interfaces wanted,
                                std::span<const Index> taken, NodeClasses& classes) {
  InterfaceReport report;
  std::map<Index, InterfaceNodes> of_node;  // one count of each is 1
  const auto count = [&](Index node) {
    InterfaceNodes what;
    const bool sliding =
        wanted == Interfaces::slide && classes.slides(node) && !topology.on_boundary(node);
    (wanted == Interfaces::free ? what.free : sliding ? what.sliding : what.held) = 1;
    return what;
  };
  const auto add = [](const InterfaceNodes& one, InterfaceNodes& sum) {
    sum.held += one.held;
    sum.sliding += one.sliding;
    sum.free += one.free;
  };
  for (const RegionInterface& meeting : topology.interfaces()) {
    InterfaceNodes sum{topology.name_of(meeting)};
    for (const Index node : meeting.nodes) {
      const bool moves = classes.moves(node) || !topology.on_boundary(node);
      if (!moves || std::ranges::binary_search(taken, node)) continue;
      const auto [place, is_new] = of_node.try_emplace(node, count(node));
      add(place->second, sum);
      if (!is_new) continue;
      add(place->second, report.all);
      if (place->second.held > 0) report.held.push_back(node);
    }
    if (sum.count() > 0) report.each.push_back(std::move(sum));
  }
  std::ranges::sort(report.held);
  classes.set_fixed(report.held);
  return report;
}

}  // namespace

MovingBoundary make_boundary_move(const ResolvedSlide& slide, const Mesh& mesh,
                                  std::span<const Index> moving, NodeClasses& classes) {
  MovingBoundary out;
  std::vector<Index> taken(moving.begin(), moving.end());
  std::ranges::sort(taken);
  const Topology& topology = *mesh.topology;
  const Interfaces wanted = interfaces_in(slide.interfaces, !moving.empty());
  const bool slides_inside = wanted == Interfaces::slide && !topology.interfaces().empty();
  if (slide.markers.empty() && !slides_inside && !slide.smooth_nodes.empty())
    throw UsageError("smooth_nodes: no marker slides: name the marker of node " +
                     std::to_string(slide.smooth_nodes.front()));
  out.periodic = periodic_pairs(slide, mesh);
  std::vector<PeriodicPair> corners;
  FeatureRules rules = feature_rules(slide), inside = rules;
  if (slides_inside) {
    const std::vector<Index> nodes = interface_nodes_inside(topology);
    const auto is_inside = [&](Index node) { return std::ranges::binary_search(nodes, node); };
    std::erase_if(rules.smooth, is_inside);
    std::erase_if(inside.smooth, std::not_fn(is_inside));
  }
  rules.interfaces = wanted == Interfaces::free ? Interfaces::free : Interfaces::held;
  inside.interfaces = Interfaces::slide;
  if (!slide.markers.empty()) {
    corners = add_sliding(mesh,
                          SlidingBoundary::find(topology, mesh.coordinates, slide.markers, rules,
                                                slide.files().reference.get(), out.periodic),
                          taken, out, classes);
  } else if (slides_inside && !rules.smooth.empty()) {
    throw UsageError("smooth_nodes: no marker of node " + std::to_string(rules.smooth.front()) +
                     " slides, and no two regions meet there: name its marker");
  }
  if (slides_inside) {
    SlidingBoundary boundary = SlidingBoundary::find(topology, mesh.coordinates, {}, inside);
    leave_to_motion(taken, boundary.parts);
    add_sliding(mesh, std::move(boundary), taken, out, classes);
  }
  for (PeriodicPairs& pairs : out.periodic) {
    keep_sliding_corners(corners, classes, pairs);
    leave_to_motion(taken, pairs);
    require_not_held(slide, pairs);
    for (const auto* list : {&pairs.pairs, &pairs.corners})
      for (const auto& [node, image] : *list) {
        require_at_rest(pairs.first, {&node, 1}, taken);
        require_at_rest(pairs.second, {&image, 1}, taken);
      }
    classes.set_periodic(pairs);
  }
  out.interfaces = hold_interfaces(topology, wanted, taken, classes);
  hold(slide, taken, classes);
  out.held = static_cast<Index>(slide.hold_nodes.size());
  return out;
}

}  // namespace winslow
