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

SlideFiles resolve_files(const SlideOptions& slide, const FormatDetails* details,
                         const ReferenceReader& read) {
  SlideFiles files;
  if (!slide.reference.empty()) files.reference = read(slide.reference);
  if (slide.periodic_from_file && details) files.periodic = details->periodic;
  return files;
}

ResolvedCommand resolve_files(Command command, const FormatDetails* details,
                              const ReferenceReader& read) {
  const SmoothOptions* smooth = smooth_options(command);
  SlideFiles files = smooth ? resolve_files(smooth->slide, details, read) : SlideFiles{};
  return {std::move(command), std::move(files)};
}

}  // namespace winslow::io
