#pragma once

#include <map>

#include "core/mesh/mesh.h"
#include "gui/base/background.h"
#include "gui/render/imgui_renderer.h"

namespace winslow::gui {

/// Small pictures of the bundled meshes, rendered from the coarse versions, and of the guided
/// demos, from files of the program (assets/demos, made by docs/make_demo_pictures.py). Reads files
/// on a separate thread, draws one mesh per frame, and starts only after the first frames are on
/// screen.
class Thumbnails {
 public:
  static constexpr int width = 384, height = 240;  ///< pixels, twice as fine as shown

  /// Call it in every frame that needs pictures. seconds: since the last.
  void update(double seconds);
  /// True until all pictures are available.
  bool busy() const { return (!started_ && possible()) || reader_.busy() || !waiting_.empty(); }
  /// Picture of a bundled mesh, or of a demo: "demo/A". Null until it is available.
  const Texture* find(const std::string& id) const;
  /// A picture of a plane or volume mesh.
  static Image draw(const Mesh& mesh);

 private:
  struct Loaded {
    std::string id;
    std::optional<Mesh> mesh;  ///< to be drawn; none: `picture` is given
    Image picture;
  };
  /// True if the bundled meshes are installed.
  static bool possible();
  static std::vector<Loaded> read();

  double shown_ = 0;  // seconds for which pictures were needed
  bool started_ = false;
  Background<std::vector<Loaded>> reader_;
  std::vector<Loaded> waiting_;
  std::map<std::string, std::unique_ptr<Texture>> textures_;
};

/// A small picture of the mesh in a file, read on a separate thread. There is none for large files
/// and for files without a mesh.
class MeshPreview {
 public:
  static constexpr std::uintmax_t largest = 40'000'000;  ///< bytes

  /// Call it in every frame with the file to show; empty: none.
  void want(const std::filesystem::path& file);
  bool busy() const { return reader_.busy(); }
  /// Null until it is available.
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
