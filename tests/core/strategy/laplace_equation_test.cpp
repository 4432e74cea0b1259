#include "core/strategy/laplace_equation.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::vector<bool> boundary_of(const Mesh& mesh) {
  std::vector<bool> known(at(mesh.topology->node_count()));
  for (Index node = 0; node < mesh.topology->node_count(); ++node)
    known[at(node)] = mesh.topology->on_boundary(node);
  return known;
}

/// 1 at the nodes of a marker, 0 at all others.
std::vector<double> one_on(const Mesh& mesh, const std::string& marker) {
  std::vector<double> field(at(mesh.topology->node_count()));
  for (const Index node : mesh.topology->markers().nodes_of(std::span(&marker, 1)))
    field[at(node)] = 1;
  return field;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

TEST_CASE("A linear field is extended exactly, whatever the elements and the exponent") {
  std::vector<Mesh> meshes;
  for (const Volumes volumes : all_volumes) meshes.push_back(make_mesh(cube(4, volumes)));
  for (const Cells cells : {Cells::triangles, Cells::quads})
    meshes.push_back(make_mesh(square(7, cells)));
  for (const Mesh& mesh : meshes) {
    const bool in_space = mesh.topology->cell_dimension() == 3;
    std::vector<double> linear, start;
    const auto known = boundary_of(mesh);
    for (Index node = 0; node < mesh.coordinates.size(); ++node) {
      const Vec3 p = in_space
                         ? mesh.coordinates.xyz(node)
                         : Vec3(mesh.coordinates.xy(node).x(), mesh.coordinates.xy(node).y(), 0);
      linear.push_back(0.3 + p.dot(Vec3(1, -2, 0.5)));
      start.push_back(known[at(node)] ? linear.back() : 7);
    }
    for (const double exponent : {2.0, 2.5, 3.0}) {
      CAPTURE(exponent);
      std::vector<std::vector<double>> fields{start};
      LaplaceEquation equation(*mesh.topology, mesh.coordinates, known, 1);
      equation.solve({.exponent = exponent, .accuracy = 1e-12}, fields);
      // A larger exponent weakens the elements where the guess is flat, not the solution.
      CHECK(largest_difference(fields[0], linear) < (exponent == 2 ? 1e-8 : 0.05));
      equation.solve({.exponent = exponent, .accuracy = 1e-12}, fields);
      CHECK(largest_difference(fields[0], linear) < (exponent == 2 ? 1e-8 : 0.02));
    }
  }
}

TEST_CASE("A field between two circles follows the solution of its p-Laplace equation") {
  for (const Cells cells : {Cells::triangles, Cells::quads}) {
    CAPTURE(name_of(cells));
    const Mesh mesh = make_mesh(annulus(48, 24, 1 + 6.0 / 48, cells));
    const auto inner = one_on(mesh, "inner");
    double outside = 0;
    for (Index node = 0; node < mesh.coordinates.size(); ++node)
      outside = std::max(outside, mesh.coordinates.xy(node).norm());
    for (const double exponent : {2.0, 2.5, 3.0}) {
      CAPTURE(exponent);
      std::vector<std::vector<double>> fields{inner};
      LaplaceEquation equation(*mesh.topology, mesh.coordinates, boundary_of(mesh), 1);
      equation.solve({.exponent = exponent, .accuracy = 1e-8}, fields);
      // r |u'|^(p-1) is constant.
      const double power = (exponent - 2) / (exponent - 1);
      const auto integral = [&](double r) {
        return exponent == 2 ? std::log(r) : std::pow(r, power) / power;
      };
      double worst = 0;
      for (Index node = 0; node < mesh.coordinates.size(); ++node) {
        const double r = mesh.coordinates.xy(node).norm();
        const double exact =
            (integral(outside) - integral(r)) / (integral(outside) - integral(1.0));
        worst = std::max(worst, std::abs(fields[0][at(node)] - exact));
      }
      // Solutions for exponents 2 and 3 are .2 apart.
      CHECK(worst < (exponent == 2 ? 0.005 : 0.05));
    }
  }
}

TEST_CASE("Fields that add up to one where they are known do so everywhere") {
  const Mesh mesh = make_mesh(square_with_two_holes(10, Cells::triangles));
  std::vector<std::vector<double>> fields;
  for (const char* marker : {"hole_a", "hole_b", "outer"}) fields.push_back(one_on(mesh, marker));
  LaplaceEquation equation(*mesh.topology, mesh.coordinates, boundary_of(mesh), 1);
  equation.solve({.exponent = 3, .accuracy = 1e-12}, fields);
  for (std::size_t node = 0; node < fields[0].size(); ++node) {
    CHECK(fields[0][node] + fields[1][node] + fields[2][node] == doctest::Approx(1));
    for (const auto& field : fields) CHECK(field[node] > -1e-9);
  }
}

TEST_CASE("Without any known value a field is zero, and with all known nothing is solved") {
  const Mesh mesh = make_mesh(cube(3, Volumes::hexahedra));
  for (const bool known : {false, true}) {
    const std::vector<double> start(at(mesh.topology->node_count()), 1.0);
    std::vector<std::vector<double>> fields{start};
    LaplaceEquation equation(*mesh.topology, mesh.coordinates,
                             std::vector<bool>(start.size(), known), 1);
    equation.solve({.exponent = 3}, fields);
    if (known) CHECK(fields[0] == start);
    if (!known) CHECK(largest_difference(fields[0], std::vector<double>(start.size())) < 1e-6);
  }
}

TEST_CASE("A field does not depend on the number of threads") {
  const Mesh mesh = make_mesh(cube_with_cavity(24, Volumes::tetrahedra));
  const auto solve = [&](int threads) {
    std::vector<std::vector<double>> fields{one_on(mesh, "cavity")};
    LaplaceEquation equation(*mesh.topology, mesh.coordinates, boundary_of(mesh), threads);
    equation.solve({.exponent = 3}, fields);
    return fields[0];
  };
  CHECK(solve(1) == solve(3));
}
