#include "gui/document/history/document.h"

#include <system_error>

#include "core/strategy/surface_shape.h"

namespace winslow::gui {

namespace {

std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code ignored;
  auto result = std::filesystem::weakly_canonical(path, ignored);
  return ignored ? path : result;
}

}  // namespace

std::span<const int> SourceFile::zones() const {
  if (!details) return {};
  return details->zones;
}

int SourceFile::zone() const { return zones().empty() ? 0 : details->zone; }

std::string SourceFile::zone_text() const {
  const auto all = zones();
  if (all.size() < 2) return {};
  return "zone " + std::to_string(zone()) + " of " + std::to_string(all.size());
}

void SavedFile::mark_saved(const std::filesystem::path& path, std::uint64_t revision) {
  path_ = path;
  saved_revision_ = revision;
  written_.insert(resolved(path));
}

bool SavedFile::wrote(const std::filesystem::path& path) const {
  return written_.contains(resolved(path));
}

const std::filesystem::path& zone_file(const SourceFile& source, const SavedFile& saved) {
  const bool kept =
      saved.wrote(saved.path()) && source.details && io::keeps_zones(saved.path(), *source.details);
  return kept ? saved.path() : source.path;
}

Document::Loaded Document::load(const std::filesystem::path& path, const io::ReadOptions& reading) {
  Loaded loaded;
  loaded.path = path;
  loaded.reading = reading;
  loaded.stamp = stamp_of(path);
  loaded.file = io::read_mesh(path, reading);
  loaded.state = make_state(loaded.file.mesh);
  examine(loaded);
  if (stamp_of(path) != loaded.stamp) loaded.stamp.reset();
  return loaded;
}

void examine(Document::Loaded& loaded) {
  const Mesh& mesh = loaded.state.mesh;
  // For a surface mesh: the shape that smoothing needs; smoothing reports errors. It also
  // determines which elements are oriented correctly.
  loaded.state.surface = own_shape(mesh);
  if (loaded.state.surface) loaded.given = std::make_shared<const SurfaceDistance>(mesh);
  const std::vector<Vec3> normals = reference_normals(loaded.state, mesh.coordinates);
  QualityOptions options;
  options.normals = normals;
  loaded.quality = measure_quality(mesh, options);
  if (mesh.topology->space_dimension() == 3)
    loaded.boundary = std::make_shared<const VolumeBoundary>(find_boundary(mesh));
}

Document::Document(Loaded loaded)
    : source_{loaded.path, loaded.stamp, std::move(loaded.file.details),
              std::move(loaded.file.warnings), std::move(loaded.reading)},
      saved_(std::move(loaded.path)),
      loaded_quality_(std::move(loaded.quality)),
      boundary_(std::move(loaded.boundary)),
      given_(std::move(loaded.given)),
      edits_(std::move(loaded.state)) {}

}  // namespace winslow::gui
