#include "core/mesh/coordinates.h"

#include <string>

#include "core/error.h"

namespace winslow {

Coordinates::Coordinates(int dimension, Index node_count) : dimension_(dimension) {
  if (dimension != 2 && dimension != 3) {
    throw UsageError("coordinates in " + std::to_string(dimension) +
                     " dimensions, expected 2 or 3");
  }
  values_.resize(offset(node_count, dimension), 0.0);
}

void Coordinates::refuse(int expected) const {
  const auto name = [](int dimension) { return dimension == 2 ? "the plane" : "space"; };
  throw UsageError(std::string("found points of ") + name(dimension_) + ", expected points of " +
                   name(expected));
}

}  // namespace winslow
