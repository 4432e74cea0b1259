#include "core/problem/run_validity.h"

#include "core/quality/quality.h"

namespace winslow {

std::vector<Vec3> element_normals(const NodeClasses& classes, const Coordinates& x, int threads) {
  if (!classes.element_normals()) return {};
  return classes.element_normals()->at(x, threads);
}

Validity check_validity(const NodeClasses& classes, const Coordinates& x, int threads) {
  return check_validity(classes.topology(), x, threads, element_normals(classes, x, threads));
}

}  // namespace winslow
