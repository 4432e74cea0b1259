#include "io/format/parsed_mesh.h"

#include <algorithm>
#include <cmath>

#include "io/text/numbers.h"

namespace winslow::io {
namespace {

std::string shown(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

void require_finite(const Source& source, std::size_t offset, std::size_t node, double value) {
  if (std::isfinite(value)) return;
  source.fail(offset, shown(value) + " as a coordinate of node " + std::to_string(node),
              "a finite number");
}

}  // namespace

void check_finite(const Source& source, const ParsedMesh& mesh) {
  const auto values = mesh.data.coordinates.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      require_finite(source, mesh.where.nodes[i / 2], i / 2, values[i]);
  }
}

void set_planar_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh) {
  const std::size_t n = xyz.size() / 3;
  mesh.data.coordinates = Coordinates(2, static_cast<Index>(n));
  double extent = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      require_finite(source, mesh.where.nodes[i], i, xyz[3 * i + k]);
    }
    extent = std::max({extent, std::abs(xyz[3 * i] - xyz[0]), std::abs(xyz[3 * i + 1] - xyz[1])});
    mesh.data.coordinates.set_xy(static_cast<Index>(i), {xyz[3 * i], xyz[3 * i + 1]});
  }
  constexpr double noise = 1e-9;
  bool exact = true;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = xyz[3 * i + 2];
    if (std::abs(z - xyz[2]) > noise * extent) {
      source.fail(mesh.where.nodes[i],
                  "z = " + shown(z) + " after z = " + shown(xyz[2]) + " (a 3D mesh)",
                  "a 2D mesh, the same z everywhere");
    }
    // Compared with the sign of zero, for the file should come back as it was.
    exact = exact && z == xyz[2] && std::signbit(z) == std::signbit(xyz[2]);
  }
  auto& kept = mesh.details->plane_z;
  if (n > 0 && (!exact || xyz[2] != 0 || std::signbit(xyz[2]))) {
    kept.resize(exact ? 1 : n);
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = xyz[3 * i + 2];
  }
}

double plane_z(const FormatDetails* details, Index node) {
  if (details == nullptr || details->plane_z.empty()) return 0.0;
  const auto& z = details->plane_z;
  const auto i = static_cast<std::size_t>(node);
  return z.size() == 1 || i >= z.size() ? z.front() : z[i];
}

}  // namespace winslow::io
