#include "gui/document/jobs/reference_files.h"

#include "core/mesh/surface_faces.h"
#include "gui/base/text.h"
#include "io/format/mesh_format.h"

namespace winslow::gui {

namespace {

/// The stamp of a mesh in a single file; none for a mesh in several files, each of which may
/// change.
std::optional<FileStamp> whole_stamp(const std::filesystem::path& file) {
  return io::format_of_folder(file) ? std::nullopt : stamp_of(file);
}

}  // namespace

std::shared_ptr<const ReferenceSurface> ReferenceFiles::read(const std::filesystem::path& file) {
  const std::lock_guard lock(mutex_);
  const std::optional<FileStamp> before = whole_stamp(file);
  if (known_.surface && known_.file == file && before && known_.stamp == before)
    return known_.surface;
  known_ = {};
  Known now{file, before, io::read_reference(file)};
  // A file that changed while being read is read again the next time.
  if (whole_stamp(file) != before) now.stamp.reset();
  known_ = std::move(now);
  return known_.surface;
}

namespace {

/// Mean edge length of faces, shared edges counted twice; 0 without faces.
template <class Points>
double mean_edge(const std::vector<Face>& faces, const Points& point) {
  double sum = 0;
  std::size_t count = 0;
  for (const Face& face : faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      sum += Vec3(point(face[(k + 1) % face.size()]) - point(face[k])).norm();
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// The faces of some markers; of a surface mesh all faces.
std::vector<Face> faces_of(const Topology& topology, const std::vector<std::string>& markers) {
  std::vector<Face> faces;
  if (is_surface(topology)) {
    for (const SurfaceFace& face : boundary_faces(topology)) faces.push_back(face.nodes);
  } else {
    for (const std::string& name : markers)
      if (const auto marker = topology.markers().find(name))
        for (const Face& face : topology.markers()[at(*marker)].faces) faces.push_back(face);
  }
  return faces;
}

}  // namespace

void ReferenceChoice::choose(std::filesystem::path file, std::shared_ptr<const Mesh> mesh,
                             std::vector<std::string> markers,
                             std::shared_ptr<ReferenceFiles> files) {
  // Recipes and sessions may be read from another working folder.
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(file, failed);
  if (!failed) file = whole.lexically_normal();
  wanted_ =
      Wanted{++count_, std::move(file), std::move(mesh), std::move(markers), std::move(files)};
  if (!reader_.busy()) start();
}

ReferenceChoice::Outcome ReferenceChoice::read(const Wanted& wanted) {
  Outcome out{wanted.file, {}, 0, 0, 0};
  out.error = error_of([&] {
    const auto surface = wanted.files->read(wanted.file);
    out.nodes = static_cast<Index>(surface->points.size());
    out.faces = static_cast<Index>(surface->faces.size());
    const SpacePoints x(wanted.mesh->coordinates);
    const double own = mean_edge(faces_of(*wanted.mesh->topology, wanted.markers),
                                 [&](Index node) { return x[node]; });
    const double its =
        mean_edge(surface->faces, [&](Index node) { return surface->points[at(node)]; });
    out.coarser = own > 0 ? its / own : 0;
  });
  return out;
}

void ReferenceChoice::start() {
  reader_.start([wanted = *wanted_] { return Read{wanted.number, read(wanted)}; });
}

std::optional<ReferenceChoice::Outcome> ReferenceChoice::poll() {
  auto done = reader_.poll();
  if (!done || !wanted_) return std::nullopt;
  if (done->number != wanted_->number) {
    start();
    return std::nullopt;
  }
  wanted_.reset();
  return std::move(done->outcome);
}

bool is_coarse(const ReferenceChoice::Outcome& read) {
  constexpr double much = 1.5;
  return read.coarser >= much;
}

std::string describe(const ReferenceChoice::Outcome& read) {
  std::string text = "Nodes slide on " + read.file.filename().string() + ": " +
                     counted(read.nodes, "node") + ", " + counted(read.faces, "face");
  if (is_coarse(read))
    text += ". Its edges are " + short_number(read.coarser) +
            " times as long as those of the mesh: where it is curved, its shape between its nodes "
            "is a guess.";
  return text;
}

}  // namespace winslow::gui
