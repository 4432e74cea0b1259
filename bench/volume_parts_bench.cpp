// The parts of a run on a volume mesh outside the linear solver, one line for each: reading,
// topology, targets, patterns, energy and its derivatives, validity, quality, contact, writing.
//
//   bench/volume_parts_bench MESH [--threads N] [--repeat K] [--marker NAME]
//
// Each line has the CPU time of all threads and the wall time, both the least of K tries, the CPU
// time for each element, and a checksum of the bits of the result: it depends neither on the number
// of threads nor on the processor. The step is to a mesh whose interior nodes are 2 % farther from
// the origin; contact is that of the marker as it turns by 45 degrees about z.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "core/error.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/motion/contact.h"
#include "core/quality/quality.h"
#include "io/format/mesh_file.h"

namespace {

using namespace winslow;

struct Request {
  std::string mesh, marker;
  int threads = 0, repeat = 3;
};

Request read_request(const std::vector<std::string>& arguments) {
  Request out;
  const char* usage = "usage: volume_parts_bench MESH [--threads N] [--repeat K] [--marker NAME]";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& key = arguments[i];
    if (key != "--threads" && key != "--repeat" && key != "--marker") {
      out.mesh = key;
      continue;
    }
    if (++i == arguments.size()) throw UsageError(usage);
    if (key == "--marker")
      out.marker = arguments[i];
    else
      (key == "--threads" ? out.threads : out.repeat) = std::atoi(arguments[i].c_str());
  }
  if (out.mesh.empty() || out.threads < 0 || out.repeat < 1) throw UsageError(usage);
  return out;
}

/// Of the bits of some numbers (FNV-1a).
class Checksum {
 public:
  template <typename T>
  Checksum& add(std::span<const T> values) {
    for (const std::byte byte : std::as_bytes(values))
      hash_ = (hash_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3U;
    return *this;
  }
  template <typename T>
  Checksum& add(const std::vector<T>& values) {
    return add(std::span<const T>(values));
  }
  Checksum& add(double value) { return add(std::span<const double>(&value, 1)); }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

/// Prints the least times of several calls, in all and for each element.
class Table {
 public:
  explicit Table(int repeat) : repeat_(repeat) {}

  void set_elements(Index elements) { elements_ = static_cast<double>(elements); }

  /// sum(checksum): adds the result of the last call.
  void line(const std::string& name, const std::function<void()>& part,
            const std::function<void(Checksum&)>& sum) const {
    double least_cpu = std::numeric_limits<double>::infinity(), least_wall = least_cpu;
    for (int i = 0; i < repeat_; ++i) {
      const std::clock_t cpu = std::clock();
      const auto wall = std::chrono::steady_clock::now();
      part();
      least_cpu = std::min(least_cpu, static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - wall;
      least_wall = std::min(least_wall, took.count());
    }
    Checksum checksum;
    sum(checksum);
    std::printf("%-26s %10.1f %10.1f %10.0f   %016llx\n", name.c_str(), 1e3 * least_cpu,
                1e3 * least_wall, 1e9 * least_cpu / elements_,
                static_cast<unsigned long long>(checksum.value()));
    std::fflush(stdout);
  }

 private:
  int repeat_;
  double elements_ = 1;
};

void add(const CellTargets<3>& targets, Checksum& sum) {
  for (const auto& cell : targets.cells) sum.add(std::span<const Index>(cell));
  sum.add(targets.offsets).add(targets.inverse_limits);
  for (const VolumeTerm& t : targets.terms)
    for (const double v : {t.a11, t.a12, t.a13, t.a22, t.a23, t.a33, t.weight}) sum.add(v);
}

void time_form(const Table& table, const Mesh& mesh, const std::string& name,
               const TargetBlend& blend, int threads) {
  const auto classes = std::make_shared<const NodeClasses>(mesh.topology);
  CellTargets<3> targets;
  table.line(
      name + ": targets",
      [&] { targets = volume_targets(*mesh.topology, nullptr, blend, &mesh.coordinates, threads); },
      [&](Checksum& sum) { add(targets, sum); });
  std::shared_ptr<const VolumeWinslow::Pattern> pattern;
  table.line(
      name + ": pattern",
      [&] { pattern = std::make_shared<const VolumeWinslow::Pattern>(classes, targets, threads); },
      [&](Checksum& sum) { sum.add(pattern->structure->rows.pattern()->columns); });
  std::shared_ptr<const VolumeWinslow> form;
  table.line(
      name + ": form on the pattern",
      [&] { form = std::make_shared<const VolumeWinslow>(*pattern, targets, PenaltyOptions()); },
      [&](Checksum& sum) { add(form->shapes(), sum); });
  double energy = 0;
  table.line(
      name + ": energy", [&] { energy = form->energy(mesh.coordinates); },
      [&](Checksum& sum) { sum.add(energy); });
  std::vector<double> residual(form->unknowns());
  ResidualNorms norms;
  table.line(
      name + ": residual", [&] { norms = form->residual(mesh.coordinates, residual); },
      [&](Checksum& sum) { sum.add(residual).add(norms.max).add(norms.rms); });
  SparseMatrix hessian;
  for (const Curvature curvature : {Curvature::exact, Curvature::projected}) {
    const bool exact = curvature == Curvature::exact;
    table.line(
        name + (exact ? ": exact Hessian" : ": projected Hessian"),
        [&] { energy = form->linearise(mesh.coordinates, curvature, hessian, residual).energy; },
        [&](Checksum& sum) { sum.add(hessian.values).add(residual).add(energy); });
  }
}

void time_quality(const Table& table, const Mesh& mesh, int threads) {
  Validity validity;
  table.line(
      "validity", [&] { validity = check_validity(*mesh.topology, mesh.coordinates, threads); },
      [&](Checksum& sum) { sum.add(validity.min_sine).add(validity.inverted); });
  Coordinates to = mesh.coordinates;
  for (const Index node : mesh.topology->interior_nodes()) to.set_xyz(node, 1.02 * to.xyz(node));
  double step = 0;
  table.line(
      "largest valid step",
      [&] { step = largest_valid_step(*mesh.topology, mesh.coordinates, to, 1.0, threads); },
      [&](Checksum& sum) { sum.add(step); });
  QualityOptions options;
  options.threads = threads;
  QualityReport report;
  table.line(
      "quality", [&] { report = measure_quality(mesh, options); },
      [&](Checksum& sum) {
        for (const auto& metric : report.metrics) {
          sum.add(metric.statistics.min).add(metric.statistics.avg).add(metric.statistics.max);
          sum.add(metric.histogram.counts);
          for (const WorstElement& worst : metric.worst) sum.add(worst.value).add(worst.element);
        }
      });
}

void time_contact(const Table& table, const Mesh& mesh, const std::string& marker) {
  RigidMotion turn;
  turn.rotate = 45;
  turn.axis = Vec3(0, 0, 1);
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, {marker}, turn);
  std::optional<Contact> found;
  table.line(
      "contact", [&] { found = find_contact(*mesh.topology, mesh.coordinates, *motion); },
      [&](Checksum& sum) { sum.add(found ? found->fraction : -1); });
}

void add(const Topology& topology, Checksum& sum) {
  sum.add(topology.elements().values).add(topology.neighbour_rows().values);
  for (Index node = 0; node < topology.node_count(); ++node) sum.add(topology.star(node));
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    sum.add(std::span<const Index>(face.nodes)).add(std::span<const Index>(face.elements));
  }
}

void time_parts(const Request& request) {
  Table table(request.repeat);
  const io::MeshFile file = io::read_mesh(request.mesh);
  const Mesh& mesh = file.mesh;
  const Topology& topology = *mesh.topology;
  if (topology.kind() != MeshKind::volume) throw UsageError(request.mesh + " is no volume mesh");
  table.set_elements(topology.element_count());
  std::printf("%d nodes, %d elements\n%-26s %10s %10s %10s   %s\n", topology.node_count(),
              topology.element_count(), "", "CPU ms", "wall ms", "ns/element", "checksum");
  io::MeshFile again;
  table.line(
      "read", [&] { again = io::read_mesh(request.mesh); },
      [&](Checksum& sum) { add(*again.mesh.topology, sum); });
  time_quality(table, mesh, request.threads);
  time_form(table, mesh, "auto", TargetBlend::automatically(), request.threads);
  time_form(table, mesh, "keep", TargetBlend::keeping(), request.threads);
  if (!request.marker.empty()) time_contact(table, mesh, request.marker);
  const auto out = std::filesystem::temp_directory_path() /
                   ("volume_parts_bench_" + std::to_string(std::clock()) + ".su2");
  table.line(
      "write", [&] { io::write_mesh(out, mesh, file.details.get()); },
      [&](Checksum& sum) { sum.add(static_cast<double>(std::filesystem::file_size(out))); });
  std::filesystem::remove(out);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    time_parts(read_request({arguments + 1, arguments + count}));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "volume_parts_bench: %s\n", error.what());
    return 1;
  }
}
