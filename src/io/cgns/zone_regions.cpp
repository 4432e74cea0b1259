#include "io/cgns/zone_regions.h"

#include "io/cgns/point_set.h"

namespace winslow::io::cgns {

void read_regions(const NodeView& zone, const ElementNumbers& numbers, MeshData& mesh,
                  std::vector<std::string>& warnings) {
  for (const NodeView& part : zone.children("ZoneSubRegion_t")) {
    const auto set = read_point_set(part, 1);
    if (!set || (!set->elements && set->location != "CellCenter")) continue;
    const auto region = static_cast<Index>(mesh.regions.size());
    std::int64_t others = 0;
    mesh.element_region.resize(mesh.types.size(), -1);
    set->for_each_number([&](std::int64_t number) {
      const ElementPlace place = numbers.find(number);
      if (place.kind == ElementPlace::Kind::none) {
        set->view.fail("element " + std::to_string(number),
                       "1 to " + std::to_string(numbers.last()) + ", as the sections have them");
      }
      const bool free =
          place.kind == ElementPlace::Kind::cell && mesh.element_region[at(place.index)] < 0;
      if (free) mesh.element_region[at(place.index)] = region;
      others += free ? 0 : 1;
    });
    mesh.regions.push_back({part.name(), region + 1});
    if (others > 0) {
      warnings.push_back(std::to_string(others) + " elements of region \"" + part.name() +
                         "\" are no cells or in another region, too: they stay out of it");
    }
  }
}

}  // namespace winslow::io::cgns
