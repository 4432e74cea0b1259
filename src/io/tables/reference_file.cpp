#include "io/tables/reference_file.h"

#include "io/surface/surface.h"

namespace winslow::io {

std::shared_ptr<const ReferenceSurface> read_reference(const std::filesystem::path& path) {
  const MeshFile file = read_mesh(path);
  const surface::WrittenSurface written(file.mesh, file.details.get());
  auto out = std::make_shared<ReferenceSurface>();
  out->source = path.filename().string();
  for (Index i = 0; i < written.node_count(); ++i) out->points.push_back(written.node(i));
  for (const FileCorners& corners : written.faces())
    out->faces.emplace_back(std::span<const Index>(corners.data(), corners.size()));
  return out;
}

void load_reference(Command& command) {
  SmoothOptions* smooth = smooth_options(command);
  if (!smooth) return;
  ReferenceFile& reference = smooth->slide.reference;
  if (reference.name.empty())
    reference.surface = nullptr;
  else if (!reference.surface)
    reference.surface = read_reference(reference.name);
}

void give_pairs(Command& command, const FormatDetails* details) {
  if (SmoothOptions* smooth = smooth_options(command))
    smooth->slide.file_pairs.found = details ? details->periodic : nullptr;
}

}  // namespace winslow::io
