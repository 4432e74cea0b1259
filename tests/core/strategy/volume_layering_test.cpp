#include "core/strategy/volume_layering.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "core/layers/volume_measures.h"
#include "core/quality/quality.h"
#include "core/quality/volume_element.h"
#include "support/volume_layers.h"

using namespace winslow;
using namespace winslow::test;

namespace {

LayerRequest request_at(const std::string& wall) {
  LayerRequest request;
  request.layers.walls = {{{wall}, {}}};
  return request;
}

struct Opened {
  MeshState state;
  SmoothResult result;
};

Opened open(const Mesh& mesh, const VolumeLayerInsertion& layers, const LayerRequest& request,
            const RunOptions& run = {}) {
  Opened out{make_state(mesh), {}};
  out.result = open_volume_layers(layers, request, out.state, run);
  return out;
}

/// The largest |height / wanted - 1| of the lowest layers, or of all: the smallest distance of a
/// node from the planes of the wall's faces at its column, less that of the node below.
double largest_error(const LayerStack& stack, const Coordinates& x, bool first_only) {
  std::vector<std::vector<Vec3>> normals(stack.columns.size());
  for (const ColumnFace& face : stack.faces) {
    const auto place = [&](std::size_t k) {
      return x.xyz(stack.columns[face.columns[k]].wall_node);
    };
    const Vec3 n = (place(1) - place(0)).cross(place(2) - place(0)).normalized();
    for (const std::size_t c : face.corners()) normals[c].push_back(n);
  }
  double largest = 0;
  for (std::size_t c = 0; c < stack.columns.size(); ++c) {
    const LayerColumn& column = stack.columns[c];
    for (std::size_t k = 0; k < (first_only ? 1 : column.count()); ++k) {
      double height = std::numeric_limits<double>::infinity();
      for (const Vec3& n : normals[c])
        height = std::min(height, n.dot(x.xyz(column.nodes[k + 1]) - x.xyz(column.nodes[k])));
      largest = std::max(largest, std::abs(height / column.heights[k] - 1));
    }
  }
  return largest;
}

/// The smallest scaled Jacobian of the elements with a node inside, in layers or outside.
double worst(const Mesh& mesh, std::span<const int> layer_of_element, bool in_layers) {
  const Topology& topology = *mesh.topology;
  double least = 1;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const bool in_one = !layer_of_element.empty() && layer_of_element[at(e)] >= 0;
    const auto nodes = topology.element(e);
    if (in_one != in_layers ||
        std::ranges::all_of(nodes, [&](Index node) { return topology.on_boundary(node); }))
      continue;
    least = std::min(least,
                     VolumeElement(mesh.coordinates, topology.shape(e), nodes).scaled_jacobian());
  }
  return least;
}

void check_opened(const Mesh& before, const VolumeLayerInsertion& layers, const Opened& opened) {
  const Coordinates& x = opened.state.mesh.coordinates;
  REQUIRE(opened.state.layers);
  const LayerStack& stack = *opened.state.layers;
  CHECK(opened.result.converged);
  CHECK(opened.result.inverted == 0);
  CHECK(check_validity(*opened.state.mesh.topology, x).inverted == 0);
  CHECK(largest_error(stack, x, true) < 0.01);
  CHECK(largest_error(stack, x, false) < 0.02);
  CHECK(opened.result.linear_solves <= 30);
  const double given = worst(before, {}, false);
  const double outside = worst(opened.state.mesh, stack.layer_of_element, false);
  CAPTURE(given);
  CHECK((outside >= 0.8 * given || outside >= 0.15));
  for (const LayerColumn& column : stack.columns)
    CHECK(x.xyz(column.wall_node) == layers.mesh.coordinates.xyz(column.wall_node));
}

class Counter final : public SolverMonitor {
 public:
  explicit Counter(int most) : most_(most) {}
  void on_topology(const std::shared_ptr<const Topology>& topology) override {
    topology_ = topology;
  }
  bool on_iteration(const IterationRecord& record, const Coordinates& x) override {
    CHECK(record.inverted == 0);
    REQUIRE(topology_);
    CHECK(x.size() == topology_->node_count());
    return ++count_ < most_;
  }
  int count() const { return count_; }

 private:
  std::shared_ptr<const Topology> topology_;
  int most_, count_ = 0;
};

}  // namespace

TEST_CASE("Layers around a cube open to the wanted heights, on faces of every kind") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::prisms, Volumes::hexahedra}) {
    CAPTURE(std::string(name_of(volumes)));
    const Mesh mesh = make_mesh(cube_with_cavity(6, volumes));
    const auto layers = extruded(mesh, {{"cavity"}, growing_heights(6, 0.002, 1.3), {}});
    const Opened opened = open(mesh, layers, request_at("cavity"));
    check_opened(mesh, layers, opened);
    CHECK(worst(opened.state.mesh, opened.state.layers->layer_of_element, true) > 0.3);
  }
}

TEST_CASE("Layers around a ball open from first heights of a thousandth to a millionth") {
  const Mesh mesh = box_with_ball(6, Volumes::tetrahedra);
  for (const double first : {1e-3, 1e-4, 1e-6}) {
    CAPTURE(first);
    const int count = first < 1e-5 ? 40 : 15;
    const double ratio = std::pow(0.008 / first, 1.0 / (count - 1));
    const auto layers = extruded(mesh, {{"cavity"}, growing_heights(count, first, ratio), {}});
    Counter counter(1000);
    RunOptions run;
    run.monitor = &counter;
    const Opened opened = open(mesh, layers, request_at("cavity"), run);
    check_opened(mesh, layers, opened);
    CHECK(counter.count() > 0);
    const LayerMeasures measures =
        measure_layers(*opened.state.layers, opened.state.mesh.coordinates);
    CHECK(measures.first_height.min > 0.99 * first);
    CHECK(measures.first_height.max < 1.01 * first);
    CHECK(measures.orthogonality.max <
          measure_layers(layers.stack, layers.ideal).orthogonality.max + 0.1);
  }
}

TEST_CASE("Corrections bring the heights nearer to those wanted") {
  const Mesh mesh = box_with_ball(6, Volumes::tetrahedra);
  const auto layers = extruded(mesh, {{"cavity"}, growing_heights(6, 0.002, 1.3), {}});
  LayerRequest request = request_at("cavity");
  request.smooth.tolerance = 1e-9;
  request.tolerance = 1;
  const Opened rough = open(mesh, layers, request);
  request.tolerance = 1e-9;
  const Opened fine = open(mesh, layers, request);
  request.most_corrections = 0;
  const Opened none = open(mesh, layers, request);
  const auto error = [](const Opened& opened) {
    return measure_layers(*opened.state.layers, opened.state.mesh.coordinates).spacing_error.max;
  };
  CHECK(error(rough) > 1e-6);
  CHECK(error(fine) < 0.01 * error(rough));
  CHECK(fine.result.converged);
  CHECK(fine.result.linear_solves > rough.result.linear_solves);
  CHECK(none.state.mesh.coordinates == rough.state.mesh.coordinates);
  for (const LayerColumn& column : rough.state.layers->columns) CHECK(column.corrections.empty());
  for (const LayerColumn& column : fine.state.layers->columns)
    CHECK(column.corrections.size() == column.count());
}

TEST_CASE("Columns on planes of symmetry and on the edge between them stay there") {
  const Mesh mesh = make_mesh(box_with_body_on_two_planes(9, Volumes::tetrahedra));
  const auto layers = extruded(mesh, {{"body"}, growing_heights(6, 0.002, 1.3), {"side", "floor"}});
  const Opened opened = open(mesh, layers, request_at("body"));
  check_opened(mesh, layers, opened);
  const Coordinates& x = opened.state.mesh.coordinates;
  const Markers& markers = opened.state.mesh.topology->markers();
  std::size_t on_both = 0, on_side = 0;
  const auto on = [&](const char* marker, Index node) {
    return std::ranges::binary_search(markers.nodes(*markers.find(marker)), node);
  };
  for (const LayerColumn& column : opened.state.layers->columns) {
    for (std::size_t k = 1; k < column.nodes.size(); ++k) {
      const Index node = column.nodes[k];
      const bool side = on("side", node), floor = on("floor", node);
      on_side += side ? 1 : 0;
      on_both += side && floor ? 1 : 0;
      if (side) CHECK(std::abs(x.xyz(node).y()) < 1e-12);
      if (floor) CHECK(std::abs(x.xyz(node).z()) < 1e-12);
    }
  }
  CHECK(on_side > 6);
  CHECK(on_both == 12);  // two columns of six layers
}

TEST_CASE("Columns on the edges of one marker slide along them") {
  const Mesh mesh = make_mesh(cube(4, Volumes::tetrahedra));
  const auto layers = extruded(mesh, {{"floor"}, growing_heights(6, 0.002, 1.3), {"walls"}});
  const Opened opened = open(mesh, layers, request_at("floor"));
  check_opened(mesh, layers, opened);
  std::size_t at_edges = 0;
  for (const LayerColumn& column : opened.state.layers->columns)
    for (const Index node : column.nodes) {
      const Vec3 p = opened.state.mesh.coordinates.xyz(node);
      const Vec3 foot = mesh.coordinates.xyz(column.wall_node);
      const auto side = [&](int axis) { return foot[axis] < 1e-9 || foot[axis] > 1 - 1e-9; };
      for (const int axis : {0, 1})
        if (side(axis)) CHECK(std::abs(p[axis] - foot[axis]) < 1e-12);
      at_edges += side(0) && side(1) ? 1 : 0;
    }
  CHECK(at_edges == 28);  // four columns of seven nodes
}

TEST_CASE("Opened layers are held by motions that follow") {
  const Mesh mesh = box_with_ball(6, Volumes::tetrahedra);
  const auto layers = extruded(mesh, {{"cavity"}, growing_heights(6, 0.002, 1.3), {}});
  LayerRequest request = request_at("cavity");
  CHECK(open(mesh, layers, request).state.held_walls == std::vector<std::string>{"cavity"});
  request.control = false;
  const Opened free = open(mesh, layers, request);
  CHECK(free.state.held_walls.empty());
  CHECK(check_validity(*free.state.mesh.topology, free.state.mesh.coordinates).inverted == 0);
}

TEST_CASE("Opening layers can be cancelled, and leaves the state as it was") {
  const Mesh mesh = box_with_ball(6, Volumes::tetrahedra);
  const auto layers = extruded(mesh, {{"cavity"}, growing_heights(6, 0.002, 1.3), {}});
  MeshState state = make_state(mesh);
  Counter counter(3);
  RunOptions run;
  run.monitor = &counter;
  CHECK_THROWS_AS(open_volume_layers(layers, request_at("cavity"), state, run), Cancelled);
  CHECK(counter.count() == 3);
  CHECK(state.mesh.topology == mesh.topology);
  CHECK(state.mesh.coordinates == mesh.coordinates);
  CHECK_FALSE(state.layers);
}

TEST_CASE("Starts that cannot be opened are refused, with the place") {
  const Mesh mesh = make_mesh(cube_with_cavity(6, Volumes::tetrahedra));
  auto layers = extruded(mesh, {{"cavity"}, growing_heights(6, 0.002, 1.3), {}});
  const auto refused = [&](const LayerRequest& request) {
    MeshState state = make_state(mesh);
    std::string message;
    try {
      open_volume_layers(layers, request, state, {});
    } catch (const Error& error) {
      message = error.what();
    }
    CHECK(state.mesh.topology == mesh.topology);
    CHECK_FALSE(state.layers);
    return message;
  };
  SUBCASE("wanted layers that cross") {
    const LayerColumn& column = layers.stack.columns.front();
    layers.ideal.set_xyz(column.nodes[3], layers.ideal.xyz(column.nodes[1]));
    const std::string message = refused(request_at("cavity"));
    CAPTURE(message);
    CHECK(message.find("cross") != std::string::npos);
    CHECK(message.find("node " + std::to_string(column.wall_node)) != std::string::npos);
  }
  SUBCASE("an inverted element in the collapsed mesh") {
    const LayerColumn& column = layers.stack.columns.front();
    layers.mesh.coordinates.set_xyz(column.nodes[1], {0.9, 0.9, 0.9});
    CHECK(refused(request_at("cavity")).find("inverted") != std::string::npos);
  }
  SUBCASE("another formulation") {
    LayerRequest request = request_at("cavity");
    request.smooth.formulation = Formulation::pointwise;
    CHECK(refused(request).find("variational") != std::string::npos);
  }
  SUBCASE("too few iterations") {
    LayerRequest request = request_at("cavity");
    request.smooth.max_iterations = 1;
    const std::string message = refused(request);
    CAPTURE(message);
    CHECK(message.find("thinner") != std::string::npos);
    CHECK(message.find("node ") != std::string::npos);
  }
}

TEST_CASE("Nodes outside a region stay while layers open, and layers have to be inside") {
  const Mesh mesh = box_with_ball(9, Volumes::tetrahedra);
  const auto layers = extruded(mesh, {{"cavity"}, growing_heights(6, 0.002, 1.3), {}});
  LayerRequest request = request_at("cavity");
  request.smooth.keep_outside.radius = 0.35;  // about the ball of .2
  const Opened opened = open(mesh, layers, request);
  CHECK(opened.result.converged);
  CHECK(largest_error(*opened.state.layers, opened.state.mesh.coordinates, false) < 0.02);
  Index stayed = 0, moved = 0;
  for (Index node = 0; node < mesh.topology->node_count(); ++node) {
    const Vec3 before = mesh.coordinates.xyz(node);
    const bool same = opened.state.mesh.coordinates.xyz(node) == before;
    if ((before - Vec3::Constant(0.5)).norm() > 0.35) {
      CHECK(same);
      ++stayed;
    } else if (!same) {
      ++moved;
    }
  }
  CHECK(stayed > 0);
  CHECK(moved > 0);
  request.smooth.keep_outside.radius = 0.205;
  MeshState state = make_state(mesh);
  CHECK_THROWS_WITH_AS(open_volume_layers(layers, request, state, {}),
                       doctest::Contains("keep-outside: there are layers of the wall 'cavity'"),
                       UsageError);
}

TEST_CASE("Columns on a boundary that is to stay are refused") {
  const Mesh mesh = make_mesh(box_with_body_on_two_planes(6, Volumes::tetrahedra));
  const auto layers = extruded(mesh, {{"body"}, growing_heights(3, 0.002, 1.3), {"side", "floor"}});
  LayerRequest request = request_at("body");
  request.smooth.slide.fixed = {"floor"};
  MeshState state = make_state(mesh);
  CHECK_THROWS_WITH_AS(open_volume_layers(layers, request, state, {}),
                       doctest::Contains("'floor', which is to stay"), UsageError);
}
