// winslow with its default options against incremental linear elasticity (linear_elasticity.h), on
// meshes from files: the inner boundary with the most edges is turned about its centre and moved by
// a twentieth of its length. Both methods have the same boundary; what elasticity needs is counted
// without reading and measuring, as for winslow.
//
//   bench/elasticity_bench [--angle DEGREES]... [--increments N]... MESH ...
//
// default: 15 and 60 degrees; 1, 10 and 50 increments, each with stiffness by wall distance and by
// volume. Heights: area over wall edge of the elements at the wall (of triangles twice that),
// |after / before - 1|, 95th percentile and worst, in per cent. Sines: over all corners, smallest
// and mean of the elements' smallest. CPU: of all threads.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "core/error.h"
#include "elasticity/linear_elasticity.h"
#include "io/format/mesh_file.h"

namespace {

using namespace winslow;
using namespace winslow::bench;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The inner boundary with the most edges.
struct Body {
  std::vector<std::string> markers;
  std::vector<Index> nodes;
  std::vector<std::array<Index, 2>> edges;
  Vec2 centre{0, 0};
  double length = 0;
};

double extent(const std::vector<Index>& loop, const Coordinates& x) {
  Vec2 low = x.xy(loop.front()), high = low;
  for (const Index node : loop) {
    low = low.cwiseMin(x.xy(node));
    high = high.cwiseMax(x.xy(node));
  }
  return (high - low).maxCoeff();
}

Body body_of(const Mesh& mesh) {
  auto loops = mesh.topology->boundary_loops();
  const auto size = [&](const auto& loop) { return extent(loop, mesh.coordinates); };
  loops.erase(std::ranges::max_element(loops, {}, size));
  if (loops.empty()) throw UsageError("the mesh has no inner boundary");
  const auto& loop = *std::ranges::max_element(loops, {}, [](const auto& l) { return l.size(); });
  Body body;
  body.nodes = loop;
  body.length = size(loop);
  const std::set<Index> inside(loop.begin(), loop.end());
  double perimeter = 0;
  for (const Marker& marker : mesh.topology->markers()) {
    if (marker.faces.empty() || !std::ranges::all_of(marker.faces, [&](const Face& face) {
          return inside.contains(face.edge()[0]) && inside.contains(face.edge()[1]);
        })) {
      continue;
    }
    body.markers.push_back(marker.name);
    for (const Face& face : marker.faces) {
      const auto [a, b] = face.edge();
      body.edges.push_back({a, b});
      const double length = (mesh.coordinates.xy(b) - mesh.coordinates.xy(a)).norm();
      body.centre += 0.5 * length * (mesh.coordinates.xy(a) + mesh.coordinates.xy(b));
      perimeter += length;
    }
  }
  if (body.edges.size() != loop.size()) {
    throw UsageError("no markers make up the inner boundary exactly");
  }
  body.centre /= perimeter;
  return body;
}

std::vector<double> first_heights(const Mesh& mesh, const Body& body, const Coordinates& x) {
  std::vector<double> heights;
  for (const auto& edge : body.edges) {
    const Topology::Edge& found =
        mesh.topology
            ->edges()[static_cast<std::size_t>(*mesh.topology->find_face({edge[0], edge[1]}))];
    const auto nodes = mesh.topology->element(std::max(found.elements[0], found.elements[1]));
    double twice_area = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vec2 a = x.xy(nodes[k]), b = x.xy(nodes[(k + 1) % nodes.size()]);
      twice_area += a.x() * b.y() - a.y() * b.x();
    }
    const double width = (x.xy(edge[0]) - x.xy(edge[1])).norm();
    heights.push_back(twice_area / width / (nodes.size() == 3 ? 1 : 2));
  }
  return heights;
}

struct Outcome {
  double sine = 1, mean = 0, first_95 = 0, first_worst = 0, cpu = 0;
  Index inverted = 0;
  std::string fault;
};

void measure(const Mesh& before, const Body& body, const Coordinates& x, Outcome& outcome) {
  const Topology& topology = *before.topology;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const auto nodes = topology.element(e);
    const std::size_t n = nodes.size();
    double smallest = 1;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 u = x.xy(nodes[(k + 1) % n]) - x.xy(nodes[k]);
      const Vec2 v = x.xy(nodes[(k + n - 1) % n]) - x.xy(nodes[k]);
      smallest = std::min(smallest, (u.x() * v.y() - u.y() * v.x()) / (u.norm() * v.norm()));
    }
    outcome.sine = std::min(outcome.sine, smallest);
    outcome.mean += smallest / topology.element_count();
    if (!(smallest > 0)) ++outcome.inverted;
  }
  const auto was = first_heights(before, body, before.coordinates);
  const auto is = first_heights(before, body, x);
  std::vector<double> off;
  for (std::size_t k = 0; k < was.size(); ++k) off.push_back(100 * std::abs(is[k] / was[k] - 1));
  std::ranges::sort(off);
  outcome.first_95 = off[static_cast<std::size_t>(0.95 * static_cast<double>(off.size() - 1))];
  outcome.first_worst = off.back();
}

RigidMotion motion_of(const Body& body, double degrees) {
  RigidMotion motion;
  motion.rotate = degrees;
  motion.pivot = body.centre;
  motion.translate = Vec2(0.05 * body.length, 0);
  return motion;
}

Outcome by_winslow(const Mesh& mesh, const Body& body, double degrees) {
  Outcome outcome;
  MoveCommand move;
  move.bodies[0].markers = body.markers;
  move.bodies[0].motion = motion_of(body, degrees);
  MeshState state = make_state(mesh);
  const double begin = cpu_seconds();
  const CommandResult result = execute(move, state);
  outcome.cpu = cpu_seconds() - begin;
  if (!result.smooth.converged) outcome.fault = "not converged";
  measure(mesh, body, result.state.mesh.coordinates, outcome);
  return outcome;
}

Outcome by_elasticity(const Mesh& mesh, const Body& body, double degrees,
                      const ElasticityOptions& options) {
  Outcome outcome;
  const double angle = degrees * pi / 180;
  const BoundaryMotion motion = [&](double share, Coordinates& x) {
    const double c = std::cos(share * angle), s = std::sin(share * angle);
    for (const Index node : body.nodes) {
      const Vec2 r = mesh.coordinates.xy(node) - body.centre;
      x.set_xy(node, body.centre + Vec2(c * r.x() - s * r.y(), s * r.x() + c * r.y()) +
                         share * Vec2(0.05 * body.length, 0));
    }
  };
  Coordinates x = mesh.coordinates;
  const double begin = cpu_seconds();
  try {
    ElasticSolid<2> solid(mesh.topology, body.nodes, options);
    deform_in_increments(solid, motion, options.increments, x);
  } catch (const Error& error) {
    outcome.fault = "the matrix has no Cholesky factor";
  }
  outcome.cpu = cpu_seconds() - begin;
  if (outcome.fault.empty()) measure(mesh, body, x, outcome);
  return outcome;
}

void print(const char* method, const Outcome& outcome, double reference) {
  if (!outcome.fault.empty()) {
    std::printf("  %-28s %s, %.2f s\n", method, outcome.fault.c_str(), outcome.cpu);
    return;
  }
  std::printf("  %-28s %9.4f %7.4f %8d %8.2f %9.2f %8.2f %7.1f\n", method, outcome.sine,
              outcome.mean, static_cast<int>(outcome.inverted), outcome.first_95,
              outcome.first_worst, outcome.cpu, outcome.cpu / reference);
  std::fflush(stdout);
}

void compare(const std::string& name, const Mesh& mesh, const std::vector<double>& angles,
             const std::vector<int>& increments) {
  const Body body = body_of(mesh);
  Outcome before;
  measure(mesh, body, mesh.coordinates, before);
  for (const double degrees : angles) {
    std::printf("%s, %d nodes, %g degrees (smallest sine before: %.4f)\n", name.c_str(),
                static_cast<int>(mesh.topology->node_count()), degrees, before.sine);
    const Outcome ours = by_winslow(mesh, body, degrees);
    print("winslow", ours, ours.cpu);
    for (const int n : increments) {
      for (const Modulus modulus : {Modulus::wall_distance, Modulus::volume}) {
        ElasticityOptions options;
        options.modulus = modulus;
        options.increments = n;
        char method[64];
        std::snprintf(method, sizeof method, "elasticity, %s, %d",
                      modulus == Modulus::volume ? "1/volume" : "1/distance", n);
        print(method, by_elasticity(mesh, body, degrees, options), ours.cpu);
      }
    }
  }
}

double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') throw UsageError("found \"" + text + "\", expected a number");
  return value;
}

int run(const std::vector<std::string>& arguments) {
  std::vector<double> angles;
  std::vector<int> increments;
  std::vector<std::string> files;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool angle = arguments[i] == "--angle";
    if (!angle && arguments[i] != "--increments") {
      files.push_back(arguments[i]);
      continue;
    }
    if (i + 1 == arguments.size()) throw UsageError(arguments[i] + " needs a number");
    const double value = number(arguments[++i]);
    if (angle) {
      angles.push_back(value);
    } else if (value >= 1 && value == std::floor(value) && value < 1e6) {
      increments.push_back(static_cast<int>(value));
    } else {
      throw UsageError("--increments: expected a whole number of at least 1");
    }
  }
  if (files.empty())
    throw UsageError("usage: elasticity_bench [--angle A] [--increments N] MESH ...");
  if (angles.empty()) angles = {15, 60};
  if (increments.empty()) increments = {1, 10, 50};
  std::printf("  %-28s %9s %7s %8s %8s %9s %8s %7s\n", "method", "sine min", "mean", "inverted",
              "off 95%", "off worst", "CPU s", "ratio");
  for (const std::string& file : files) {
    compare(std::filesystem::path(file).stem().string(), io::read_mesh(file).mesh, angles,
            increments);
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run({arguments + 1, arguments + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "elasticity_bench: %s\n", error.what());
    return 1;
  }
}
