#include "gui/files/mesh_preview.h"

#include <system_error>
#include <utility>

#include "gui/files/thumbnails.h"
#include "io/format/mesh_file.h"

namespace winslow::gui {

namespace {

std::optional<Mesh> mesh_in(const std::filesystem::path& file) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed) ||
      std::filesystem::file_size(file, failed) > MeshPreview::largest)
    return std::nullopt;
  try {
    return io::read_mesh(file).mesh;
  } catch (const std::exception&) {
    return std::nullopt;  // opening it will say what is wrong
  }
}

}  // namespace

void MeshPreview::want(const std::filesystem::path& file) {
  wanted_ = file;
  if (auto read = reader_.poll()) {
    shown_ = read->file;
    texture_ = read->mesh ? std::make_unique<Texture>(Thumbnails::draw(*read->mesh)) : nullptr;
  }
  if (shown_ == wanted_ || reader_.busy()) return;
  texture_.reset();
  if (wanted_.empty()) {
    shown_.clear();
    return;
  }
  reader_.start([file = wanted_] { return Read{file, mesh_in(file)}; });
}

}  // namespace winslow::gui
