#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "core/mesh/mesh.h"
#include "gui/base/background.h"
#include "gui/render/texture.h"

namespace winslow::gui {

/// A small picture of the mesh in a file, read on a thread of its own. Of files that are too large
/// to be read in passing, or hold no mesh, none.
class MeshPreview {
 public:
  static constexpr std::uintmax_t largest = 40'000'000;  ///< bytes

  /// In every frame: the file that is looked at now; empty: none.
  void want(const std::filesystem::path& file);
  bool busy() const { return reader_.busy(); }
  /// Null until it is there.
  const Texture* picture() const { return texture_.get(); }

 private:
  struct Read {
    std::filesystem::path file;
    std::optional<Mesh> mesh;
  };

  Background<Read> reader_;
  std::filesystem::path wanted_, shown_;
  std::unique_ptr<Texture> texture_;  // of shown_
};

}  // namespace winslow::gui
