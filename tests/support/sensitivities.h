#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "core/sensitivity/mesh_sensitivity.h"
#include "support/random.h"

/// Derivatives of meshes, compared with differences of whole runs.
namespace winslow::test {

/// A smooth field of displacements, of about unit size.
inline Vec3 wave(const Vec3& p, double phase) {
  return {std::sin(3 * p.y() + phase) + 0.4 * p.x(), std::cos(2 * p.x() - phase) * 0.7,
          std::sin(2.5 * p.x() + 1.5 * p.y() - 2 * p.z() + phase)};
}

inline Coordinates random_field(const Coordinates& like, Random& random) {
  Coordinates out(like.dimension(), like.size());
  for (double& value : out.values()) value = random.uniform(-1, 1);
  return out;
}

/// A mesh by a parameter, 0 where its derivative is wanted.
using Runs = std::function<Coordinates(double parameter)>;

/// Two steps of Richardson's extrapolation of central differences: the error is of fourth order.
inline Coordinates difference_of(const Runs& runs, double step) {
  const auto central = [&](double by) {
    Coordinates out = runs(by);
    const Coordinates lower = runs(-by);
    for (std::size_t i = 0; i < out.values().size(); ++i)
      out.values()[i] = (out.values()[i] - lower.values()[i]) / (2 * by);
    return out;
  };
  Coordinates out = central(step);
  const Coordinates coarse = central(2 * step);
  for (std::size_t i = 0; i < out.values().size(); ++i)
    out.values()[i] = (4 * out.values()[i] - coarse.values()[i]) / 3;
  return out;
}

/// The largest error of a node's velocity, as a share of the largest velocity.
inline double error_of(const Coordinates& found, const Coordinates& expected) {
  double largest = 0, error = 0;
  for (Index node = 0; node < expected.size(); ++node) {
    const Vec3 wanted = place_of(expected, node);
    largest = std::max(largest, wanted.norm());
    error = std::max(error, (place_of(found, node) - wanted).norm());
  }
  return error / largest;
}

/// The largest velocity of a node inside the mesh.
inline double largest_inside(const Topology& topology, const Coordinates& velocities) {
  double largest = 0;
  for (const Index node : topology.interior_nodes())
    largest = std::max(largest, place_of(velocities, node).norm());
  return largest;
}

/// Compares the transposed product with the forward one.
inline void check_transpose(const MeshSensitivity& sensitivity) {
  Random random(8);
  const Coordinates& like = sensitivity.mesh();
  const Coordinates function = random_field(like, random), any = random_field(like, random);
  const Coordinates transposed = sensitivity.transpose(function);
  Coordinates on_boundary(like.dimension(), like.size());
  for (const Index node : sensitivity.boundary()) on_boundary.copy_node(node, any);
  const double forward = scalar_product(function, sensitivity.forward(on_boundary));
  CHECK(std::abs(scalar_product(transposed, on_boundary) - forward) <
        1e-11 * std::sqrt(scalar_product(function, function) *
                          scalar_product(on_boundary, on_boundary)));
  // Nodes that are not of the boundary have no part in it.
  Coordinates others = transposed;
  for (const Index node : sensitivity.boundary()) set_place(others, node, Vec3::Zero());
  CHECK(scalar_product(others, others) == 0);
}

}  // namespace winslow::test
