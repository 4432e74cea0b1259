#include "core/quality/wall_field.h"

namespace winslow {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// In the order of the enumeration.
constexpr std::array infos{
    FieldInfo{.name = "first_height",
              .label = "First height",
              .help = "Height of the cells at the walls of bodies, in units of the mesh.",
              .larger_is_better = true,
              .colors = ColorRange::robust_both_sides,
              .threshold = 0,
              .judged = false,
              .unit = "units of the mesh"},
    FieldInfo{.name = "first_height_ratio",
              .label = "First height over before",
              .help =
                  "Height of the cells at the walls of bodies over what it was in the mesh that "
                  "the present one is compared with. 1 is unchanged.",
              .larger_is_better = false,
              .colors = ColorRange::around_one,
              .threshold = 1.05,
              .one_is_best = true,
              .judged = false},
    FieldInfo{.name = "first_edge_tilt",
              .label = "Tilt of the first edge",
              .help = "Degrees by which the first edges off a wall deviate from its normal.",
              .larger_is_better = false,
              .colors = ColorRange::from_zero,
              .threshold = 20,
              .unit = "degrees"},
    FieldInfo{.name = "growth",
              .label = "Growth off the wall",
              .help =
                  "Ratio of the heights of consecutive cells in the columns of quadrilaterals on "
                  "a wall, the larger over the smaller; the larger of a cell's two.",
              .larger_is_better = false,
              .colors = ColorRange::from_one,
              .threshold = 1.3,
              .judged = false},
    FieldInfo{.name = "size_ratio",
              .label = "Size ratio",
              .help = "Square root of the ratio of the areas of an element and a neighbour, the "
                      "larger over the smaller; the largest of its neighbours'.",
              .larger_is_better = false,
              .colors = ColorRange::from_one,
              .threshold = 2},
};

/// Takes one of two values of which either may be missing.
using Choice = std::function<double(double, double)>;

double chosen(double a, double b, const Choice& choice) {
  if (std::isnan(a)) return b;
  return std::isnan(b) ? a : choice(a, b);
}

double larger(double a, double b) { return std::max(a, b); }
double mean(double a, double b) { return 0.5 * (a + b); }
double further_from_one(double a, double b) {
  return std::abs(std::log(a)) >= std::abs(std::log(b)) ? a : b;
}

std::vector<double> empty_values(const Mesh& mesh) {
  return std::vector<double>(at(mesh.topology->element_count()), no_value);
}

std::vector<double> largest(const Mesh& mesh, std::span<const NeighbourRatio> ratios) {
  std::vector<double> values = empty_values(mesh);
  for (const NeighbourRatio& ratio : ratios)
    for (const Index e : ratio.elements) values[at(e)] = chosen(values[at(e)], ratio.value, larger);
  return values;
}

/// How the values at the ends of a wall edge become that of its element, and the values of several
/// edges of one element one.
struct Choices {
  Choice of_ends, of_edges;
};

/// Values of elements with an edge on a wall. at_nodes: what a wall's nodes have (#nodes of it).
template <typename AtNodes>
std::vector<double> over_walls(const Mesh& mesh, const AtNodes& at_nodes, const Choices& choices) {
  std::vector<double> values = empty_values(mesh);
  for (const Wall& wall : find_walls(mesh)) {
    const std::vector<double> list = at_nodes(wall);
    for (std::size_t i = 0; i < wall.nodes.size(); ++i) {
      const std::size_t j = (i + 1) % wall.nodes.size();
      const auto face = mesh.topology->find_face(Face(wall.nodes[i], wall.nodes[j]));
      double& value = values[at(mesh.topology->edges()[at(*face)].elements[0])];
      value = chosen(value, chosen(list[i], list[j], choices.of_ends), choices.of_edges);
    }
  }
  return values;
}

std::vector<double> height_ratios(const Mesh& mesh, const Wall& wall, const Coordinates& before) {
  std::vector<double> ratios = first_heights(mesh, wall);
  const std::vector<double> were = first_heights(Mesh{mesh.topology, before}, wall);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    ratios[i] /= were[i];
    if (!(ratios[i] > 0) || !std::isfinite(ratios[i])) ratios[i] = no_value;
  }
  return ratios;
}

std::vector<double> growths(const Mesh& mesh) {
  std::vector<NeighbourRatio> all;
  for (const Wall& wall : find_walls(mesh)) {
    const auto of_wall = column_growth(mesh, wall);
    all.insert(all.end(), of_wall.begin(), of_wall.end());
  }
  return largest(mesh, all);
}

}  // namespace

const std::vector<WallField>& all_wall_fields() {
  static const std::vector<WallField> all = [] {
    std::vector<WallField> list;
    for (std::size_t i = 0; i < infos.size(); ++i) list.push_back(static_cast<WallField>(i));
    return list;
  }();
  return all;
}

const FieldInfo& wall_field_info(WallField field) { return infos[static_cast<std::size_t>(field)]; }

std::vector<double> element_values(const Mesh& mesh, WallField field, const Coordinates* before) {
  require_plane(*mesh.topology, "cells at walls");
  switch (field) {
    case WallField::first_height:
      return over_walls(mesh, [&](const Wall& wall) { return first_heights(mesh, wall); },
                        {mean, larger});
    case WallField::first_height_ratio:
      if (!before || before->size() != mesh.coordinates.size()) return empty_values(mesh);
      return over_walls(mesh, [&](const Wall& wall) { return height_ratios(mesh, wall, *before); },
                        {further_from_one, further_from_one});
    case WallField::first_edge_tilt:
      return over_walls(mesh, [&](const Wall& wall) { return first_edge_tilts(mesh, wall); },
                        {larger, larger});
    case WallField::growth:
      return growths(mesh);
    case WallField::size_ratio:
      return largest(mesh, size_ratios(mesh));
  }
  return empty_values(mesh);
}

}  // namespace winslow
