#include "io/cgns/cgns.h"

#include <iterator>

#include "io/format/mesh_in_space.h"
#include "io/format/periodicity.h"

namespace winslow::io::cgns {

const MeshFormat format{.name = "cgns",
                        .title = "CGNS",
                        .encodings = "HDF5, ADF",
                        .markers = "yes, by name",
                        .regions = "yes, not in structured zones",
                        .writes = {true, false, true},
                        .polyhedra = true,
                        .keeps_periodic = true,
                        .missing = no_library,
                        .recognise =
                            [](const Content& content) {
                              return signature_if(container_of(content.whole).has_value());
                            },
                        .read_zone = read_zone,
                        .read_zones = read_zones,
                        .write = write,
                        .write_zones = write_zones};

namespace {

/// A copy of the base to which the missing ones of these families are added.
NodePtr with_families(const Node& base, const std::vector<NodePtr>& families) {
  auto copy = own_copy(base);
  for (const NodePtr& family : families)
    if (!child_named(*copy, family->name)) copy->children.push_back(family);
  return copy;
}

/// True if MIXED sections hold offsets, which they do only in files of CGNS 3.4 and 4.
bool has_start_offsets(const Node& root) {
  const NodePtr node = child_labelled(root, "CGNSLibraryVersion_t");
  const auto numbers = node ? reals_of(node->content()) : std::vector<double>();
  // libcgns compares the same numbers.
  const int version = numbers.empty() ? 0 : static_cast<int>(std::lround(numbers[0] * 1000));
  return version == 3400 || version >= 4000;
}

/// Connections are only written as part of the tree that they were read from, so others get a
/// warning.
void warn_of_pairs(const FormatDetails* details, std::vector<std::string>& warnings) {
  if (details == nullptr || !details->periodic) return;
  if (const std::string names = named_pairs(*details->periodic); !names.empty())
    warnings.push_back("the periodic pairs of the source (" + names + ") are not written");
}

NodePtr with_zone(const NodePtr& root, const Mesh& mesh, const Details& details,
                  std::vector<std::string>& warnings) {
  const NodePtr base = child_named(*root, details.base_name);
  const NodePtr zone = child_named(base->content(), details.zone_name);
  if (!details.fits(mesh)) warn_of_pairs(&details, warnings);
  if (details.fits(mesh)) {
    std::ranges::move(stale_pairs(details, mesh), std::back_inserter(warnings));
    const NodePtr moved = moved_zone(zone, mesh, details, warnings);
    return with_child(*root, *base, with_child(*base, *zone, moved));
  }
  NewZoneSource source;
  source.name = zone->name;
  source.old = &zone->content();
  source.place = source.details = &details;
  const auto dimensions = integers_of(base->content());
  source.physical_dimension = dimensions.size() > 1 ? static_cast<int>(dimensions[1]) : 2;
  source.start_offsets = has_start_offsets(*root);
  NewZone made = make_zone(mesh, source, warnings);
  const NodePtr with_new = with_child(*base, *zone, std::move(made.zone));
  return with_child(*root, *base, with_families(*with_new, made.families));
}

/// The tree with only one of its zones, and without interfaces to the other zones.
NodePtr with_zone_only(const Node& root, const Details& details,
                       std::vector<std::string>& warnings) {
  auto tree = std::make_shared<Node>(root);
  std::erase_if(tree->children, [&](const NodePtr& child) {
    return child->content().label == "CGNSBase_t" && child->name != details.base_name;
  });
  const NodePtr base = child_named(*tree, details.base_name);
  auto alone = own_copy(*base);
  std::erase_if(alone->children, [&](const NodePtr& child) {
    return child->content().label == "Zone_t" && child->name != details.zone_name;
  });
  const NodePtr zone = child_named(*alone, details.zone_name);
  auto open = own_copy(*zone);
  std::vector<std::string> lost;
  for (NodePtr& all : open->children) {
    if (all->content().label != "ZoneGridConnectivity_t") continue;
    auto kept = own_copy(*all);
    std::erase_if(kept->children, [&](const NodePtr& interface) {
      const bool leads = interface->content().label.starts_with("GridConnectivity");
      const bool away = leads && text_of(interface->content()) != details.zone_name;
      if (away) lost.push_back(interface->name);
      return away;
    });
    all = kept->children.empty() ? nullptr : NodePtr(std::move(kept));
  }
  std::erase(open->children, nullptr);
  if (!lost.empty()) {
    warnings.push_back("the interfaces " + listed_names(lost) +
                       " lead to other zones: they are not written");
  }
  return with_child(*tree, *base, with_child(*alone, *zone, open));
}

/// The tree of a file that holds only the mesh.
NodePtr new_tree(const Mesh& mesh, const FormatDetails* details,
                 std::vector<std::string>& warnings) {
  NewZoneSource source;
  source.place = details;
  const int cell_dimension = mesh.topology->cell_dimension();
  source.physical_dimension = coordinates_in_file(mesh, details);
  const auto& markers = mesh.topology->markers();
  // Zones and families are siblings, which must have different names.
  while (markers.find(source.name)) source.name += "_1";
  NewZone made = make_zone(mesh, source, warnings);
  auto base = make_integers("Base", "CGNSBase_t", {cell_dimension, source.physical_dimension});
  base->children.push_back(std::move(made.zone));
  auto root = make_node("", "");
  // Programs with an older libcgns refuse files of CGNS 4, and no feature of CGNS 4 is needed here.
  constexpr float version = 3.3F;
  root->children.push_back(
      make_single_reals("CGNSLibraryVersion", "CGNSLibraryVersion_t", {version}));
  root->children.push_back(with_families(*base, made.families));
  return root;
}

Container container_for(const WriteOptions& options, Container source) {
  if (options.cgns_container.empty()) return source;
  return options.cgns_container == "adf" ? Container::adf : Container::hdf5;
}

void put(std::ostream& out, const Node& root, Container container) {
  const std::string bytes = write_tree(root, container);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* details,
                               const WriteOptions& options) {
  std::vector<std::string> warnings;
  const auto* own = dynamic_cast<const Details*>(details);
  if (own == nullptr) {
    warn_of_pairs(details, warnings);
    put(out, *new_tree(mesh, details, warnings), container_for(options, Container::hdf5));
    return warnings;
  }
  NodePtr root = own->root;
  if (own->zones.size() > 1) root = with_zone_only(*root, *own, warnings);
  put(out, *with_zone(root, mesh, *own, warnings), container_for(options, own->container));
  return warnings;
}

std::vector<std::string> write_zones(std::ostream& out, std::span<const MeshZone> zones,
                                     const WriteOptions& options) {
  std::vector<std::string> warnings;
  const auto& first = dynamic_cast<const Details&>(*zones.front().details);
  NodePtr root = first.root;
  for (const MeshZone& zone : zones) {
    std::vector<std::string> own;
    const auto& details = dynamic_cast<const Details&>(*zone.details);
    root = with_zone(root, *zone.mesh, details, own);
    for (const std::string& text : own) {
      warnings.push_back(
          details.zones.empty() ? text : "zone " + std::to_string(details.zone) + ": " + text);
    }
  }
  put(out, *root, container_for(options, first.container));
  return warnings;
}

}  // namespace winslow::io::cgns
