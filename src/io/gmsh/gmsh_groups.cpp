#include "io/gmsh/gmsh_groups.h"

#include <cstdlib>
#include <limits>
#include <span>
#include <unordered_map>

#include "core/index.h"
#include "io/format/groups.h"

namespace winslow::io::gmsh {
namespace {

/// Physical groups of one dimension: those with a name first, as $PhysicalNames lists them, then
/// the others as they turn up.
GroupIndex groups_of(const Details& details, int dimension, const char* prefix) {
  GroupIndex groups(prefix);
  for (const PhysicalName& name : details.physical_names) {
    if (name.dimension == dimension) groups.add(name.tag, name.name);
  }
  return groups;
}

/// Gmsh marks with the sign of a tag that the group holds the reversed entity.
int group_tag(int signed_tag) {
  return signed_tag == std::numeric_limits<int>::min() ? 0 : std::abs(signed_tag);
}

/// Physical tags of entities by dimension and tag.
using Physicals = std::array<std::unordered_map<int, const std::vector<int>*>, 4>;

Physicals physicals_by_entity(const Details& details) {
  Physicals physicals;
  for (std::size_t d = 0; d < 4; ++d) {
    for (const Entity& entity : details.entities[d]) physicals[d][entity.tag] = &entity.physicals;
  }
  return physicals;
}

}  // namespace

void collect_groups(std::span<const std::size_t> offsets, Details& details, ParsedMesh& mesh) {
  static constexpr std::array<const char*, 4> prefixes{"point_", "curve_", "surface_", "volume_"};
  const int side = details.dimension - 1;
  GroupIndex markers = groups_of(details, side, prefixes[at(side)]);
  GroupIndex regions = groups_of(details, details.dimension, prefixes[at(details.dimension)]);
  const Physicals physicals = physicals_by_entity(details);
  auto& element_region = mesh.data.element_region;
  element_region.assign(mesh.data.types.size(), -1);
  Index loose_sides = 0;
  for (std::size_t i = 0; i < details.items.size(); ++i) {
    const Item& item = details.items[i];
    const int dimension = info_of(item.shape).dimension;
    if (dimension < side) continue;
    const bool is_side = dimension == side;
    std::span<const int> tags;
    if (!details.version_4) {
      if (item.physical != 0) tags = {&item.physical, 1};
    } else if (const auto& of = physicals[at(dimension)]; of.contains(item.entity)) {
      tags = *of.at(item.entity);
    }
    if (is_side && tags.empty()) ++loose_sides;
    for (const int tag : tags) {
      if (is_side) {
        // In 2.2 the nodes of the element are in the order of the group already.
        const bool reversed = details.version_4 && tag < 0;
        add_marker_side(markers.find(group_tag(tag)), reversed ? ~item.index : item.index,
                        offsets[i], details, mesh);
      } else {
        auto& region = element_region[static_cast<std::size_t>(item.index)];
        const auto found = static_cast<Index>(regions.find(group_tag(tag)));
        if (region < 0) region = found;
      }
    }
  }
  make_markers(markers.all(), details, mesh);
  mesh.data.regions = regions.all();
  if (mesh.data.regions.empty()) element_region.clear();
  if (loose_sides > 0) {
    mesh.warnings.push_back(std::to_string(loose_sides) + (side == 1 ? " line" : " surface") +
                            " elements are in no physical group: they are kept, but are no "
                            "marker");
  }
}

}  // namespace winslow::io::gmsh
