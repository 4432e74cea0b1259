#include "io/tables/slide_files.h"

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

void resolve_reference(SlideOptions& slide, const ReferenceReader& read) {
  slide.reference.surface = slide.reference.name.empty() ? nullptr : read(slide.reference.name);
}

void resolve_pairs(SlideOptions& slide, const FormatDetails* details) {
  slide.file_pairs.found = details ? details->periodic : nullptr;
}

void resolve_files(Command& command, const FormatDetails* details, const ReferenceReader& read) {
  SmoothOptions* smooth = smooth_options(command);
  if (!smooth) return;
  resolve_pairs(smooth->slide, details);
  resolve_reference(smooth->slide, read);
}

}  // namespace winslow::io
