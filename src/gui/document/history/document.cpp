#include "gui/document/history/document.h"

#include <system_error>
#include <utility>

#include "core/strategy/surface_shape.h"

namespace winslow::gui {

namespace {

std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code ignored;
  auto result = std::filesystem::weakly_canonical(path, ignored);
  return ignored ? path : result;
}

}  // namespace

Document::Loaded Document::load(const std::filesystem::path& path, int zone) {
  Loaded loaded;
  loaded.path = path;
  loaded.stamp = stamp_of(path);
  loaded.file = io::read_mesh(path, {.zone = zone});
  loaded.state = make_state(loaded.file.mesh);
  examine(loaded);
  if (stamp_of(path) != loaded.stamp) loaded.stamp.reset();
  return loaded;
}

void examine(Document::Loaded& loaded) {
  const Mesh& mesh = loaded.state.mesh;
  if (is_surface(*mesh.topology)) {
    // What smoothing would find anyway, and says why where it cannot: which elements face the right
    // way is told by it.
    loaded.state.surface = own_shape(mesh);
    if (loaded.state.surface) loaded.given = std::make_shared<const SurfaceDistance>(mesh);
  }
  const std::vector<Vec3> normals = reference_normals(loaded.state, mesh.coordinates);
  QualityOptions options;
  options.normals = normals;
  loaded.quality = measure_quality(mesh, options);
  if (mesh.topology->space_dimension() == 3)
    loaded.boundary = std::make_shared<const VolumeBoundary>(find_boundary(mesh));
}

Document::Document(Loaded loaded)
    : source_(loaded.path),
      path_(std::move(loaded.path)),
      source_stamp_(loaded.stamp),
      details_(std::move(loaded.file.details)),
      warnings_(std::move(loaded.file.warnings)),
      loaded_quality_(std::move(loaded.quality)),
      boundary_(std::move(loaded.boundary)),
      given_(std::move(loaded.given)),
      edits_(std::move(loaded.state)) {}

std::span<const int> Document::zones() const {
  if (!details_) return {};
  return details_->zones;
}

int Document::zone() const { return zones().empty() ? 0 : details_->zone; }

const std::filesystem::path& Document::zone_file() const {
  const bool kept =
      written_.contains(resolved(path_)) && details_ && io::keeps_zones(path_, *details_);
  return kept ? path_ : source_;
}

std::string Document::zone_text() const {
  const auto all = zones();
  if (all.size() < 2) return {};
  return "zone " + std::to_string(zone()) + " of " + std::to_string(all.size());
}

void Document::mark_saved(const std::filesystem::path& path, std::uint64_t revision) {
  path_ = path;
  saved_revision_ = revision;
  written_.insert(resolved(path));
}

bool Document::wrote(const std::filesystem::path& path) const {
  return written_.contains(resolved(path));
}

}  // namespace winslow::gui
