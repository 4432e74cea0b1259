#pragma once

#include <map>

#include "core/mesh/mesh.h"
#include "gui/base/background.h"
#include "gui/render/imgui_renderer.h"

namespace winslow::gui {

/// Small pictures of the bundled meshes, drawn by the studio's own renderer from the coarse ones,
/// and of the guided demos, which the program comes with (assets/demos, drawn by
/// docs/make_demo_pictures.py). Files are read on a thread of their own, one mesh is drawn a frame,
/// and nothing begins before the first frames are on screen.
class Thumbnails {
 public:
  static constexpr int width = 384, height = 240;  ///< pixels, twice as fine as shown

  /// Once a frame in which pictures are wanted. seconds: since the last.
  void update(double seconds);
  /// Pictures that are wanted are not all there yet.
  bool busy() const { return (!started_ && possible()) || reader_.busy() || !waiting_.empty(); }
  /// Of a bundled mesh, or of a demo: "demo/A". Null until it is there.
  const Texture* find(const std::string& id) const;
  /// A picture of a plane or volume mesh.
  static Image draw(const Mesh& mesh);

 private:
  struct Loaded {
    std::string id;
    std::optional<Mesh> mesh;  ///< to be drawn; else there is a picture
    Image picture;
  };
  /// The bundled meshes are installed.
  static bool possible();
  static std::vector<Loaded> read();

  double shown_ = 0;  // seconds for which pictures were wanted
  bool started_ = false;
  Background<std::vector<Loaded>> reader_;
  std::vector<Loaded> waiting_;
  std::map<std::string, std::unique_ptr<Texture>> textures_;
};

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
