#include "gui/files/thumbnails.h"

#include <utility>

#include "core/error.h"
#include "core/quality/quality.h"
#include "gui/files/assets.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/gl.h"
#include "gui/render/image.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/space/space_renderer.h"
#include "gui/render/space/space_view.h"
#include "gui/render/space/volume_scene.h"
#include "gui/render/view.h"
#include "io/format/mesh_file.h"

namespace winslow::gui {

namespace {

constexpr double seconds_before = 0.4;

/// The bodies with a margin; the whole mesh if they fill much of it.
Bounds interesting(const Mesh& mesh) {
  Bounds all = bounds(mesh);
  std::vector<Index> nodes;
  for (const auto& loop : mesh.topology->boundary_loops()) {
    const Bounds box = bounds(mesh.coordinates, loop);
    if (box.size().maxCoeff() < 0.5 * all.size().maxCoeff())
      nodes.insert(nodes.end(), loop.begin(), loop.end());
  }
  if (nodes.empty()) return all;
  Bounds bodies = bounds(mesh.coordinates, nodes);
  if (bodies.size().maxCoeff() > 0.3 * all.size().maxCoeff()) return all;
  const Vec2 room = Vec2::Constant(0.25 * bodies.size().maxCoeff());
  return {bodies.min - room, bodies.max + room};
}

/// Cuts across the longest extent of the bodies, where sections are most instructive. Returns the
/// axis that points up on screen.
int choose_cut(const Mesh& mesh, const VolumeBoundary& boundary, VolumeLook& look) {
  if (!boundary.encloses) return 2;
  const SpacePoints x(mesh.coordinates);
  Box<3> bodies = Box<3>::empty();
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    if (boundary.enclosing[f] == 0)
      for (const Index node : boundary.faces[f].nodes) bodies.add(x[node]);
  Index axis = 1;
  for (const Index k : {0, 2})
    if (bodies.size()[k] > 1.01 * bodies.size()[axis]) axis = k;
  look.cuts = {Plane(bodies.centre(), (axis == 1 ? -1 : 1) * Vec3::Unit(axis))};
  return axis == 2 ? 1 : 2;
}

/// Draws the mesh with a cut through the bodies, if any.
Image draw_volume(const Mesh& mesh) {
  const VolumeBoundary boundary = find_boundary(mesh);
  VolumeLook look;
  const int up = choose_cut(mesh, boundary, look);
  VolumeStyle style;
  style.fill = {0.90f, 0.93f, 0.98f, 1};
  style.edge = {0.22f, 0.35f, 0.60f, 0.7f};
  style.feature_width = 2.4f;
  for (std::size_t m = 0; m < mesh.topology->markers().size(); ++m)
    look.marker_colors.push_back({0.55f, 0.68f, 0.90f});
  SpaceCamera camera;
  camera.set_viewport(0, 0, Thumbnails::width, Thumbnails::height);
  camera.look_from(automatic_view(look.cuts, up));
  std::vector<Vec3> points;
  const SpacePoints x(mesh.coordinates);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    if (!boundary.encloses || boundary.enclosing[f] == 0)
      for (const Index node : boundary.faces[f].nodes) points.push_back(x[node]);
  camera.fit(points, boundary.encloses ? 0.16 : 0.04);
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  FrameBuffer buffer(Thumbnails::width, Thumbnails::height, 4);
  buffer.clear({1, 1, 1, 1});
  SpaceRenderer renderer;
  const SpaceScene scene = build_scene(mesh, boundary, look, style);
  camera.set_content(scene.extent);
  renderer.set_scene(scene);
  renderer.draw(camera, Thumbnails::height);
  Image image = buffer.read();
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
  return image;
}

}  // namespace

bool Thumbnails::possible() {
  static const bool installed = !assets_folder().empty();
  return installed;
}

std::vector<Thumbnails::Loaded> Thumbnails::read() {
  std::vector<Loaded> all;
  for (const BundledMesh& bundled : bundled_meshes()) {
    try {
      all.push_back(
          {bundled.id, io::read_mesh(assets_folder() / "coarse" / bundled.file).mesh, {}});
    } catch (const std::exception&) {
      // A missing picture is no error; opening the mesh will report what is wrong.
      continue;
    }
  }
  std::error_code ignored;
  for (const auto& entry :
       std::filesystem::directory_iterator(assets_folder() / "demos", ignored)) {
    if (entry.path().extension() != ".png") continue;
    try {
      all.push_back({"demo/" + entry.path().stem().string(), {}, read_png(entry.path())});
    } catch (const std::exception&) {
      continue;  // as above
    }
  }
  return all;
}

Image Thumbnails::draw(const Mesh& mesh) {
  if (mesh.topology->space_dimension() == 3) return draw_volume(mesh);
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  FrameBuffer buffer(width, height, 4);
  buffer.clear({1, 1, 1, 1});
  Camera camera;
  camera.set_viewport(0, 0, width, height);
  camera.fit(interesting(mesh), 0.02);
  MeshRenderer renderer;
  renderer.set_mesh(mesh.topology, mesh.coordinates);
  MeshStyle style;
  style.fill_color = {0.90f, 0.93f, 0.98f, 1};
  style.edge_color = {0.22f, 0.35f, 0.60f, 1};
  style.boundary_width = 3;
  renderer.draw(camera, style, height);
  Image image = buffer.read();
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
  return image;
}

void Thumbnails::update(double seconds) {
  shown_ += seconds;
  if (!started_ && shown_ > seconds_before && possible()) {
    started_ = true;
    reader_.start([] { return read(); });
  }
  if (auto loaded = reader_.poll()) waiting_ = std::move(*loaded);
  if (waiting_.empty()) return;
  const Loaded& next = waiting_.back();
  textures_[next.id] = std::make_unique<Texture>(next.mesh ? draw(*next.mesh) : next.picture);
  waiting_.pop_back();
}

const Texture* Thumbnails::find(const std::string& id) const {
  const auto it = textures_.find(id);
  return it == textures_.end() ? nullptr : it->second.get();
}

namespace {

std::optional<Mesh> mesh_in(const std::filesystem::path& file) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed) ||
      std::filesystem::file_size(file, failed) > MeshPreview::largest)
    return std::nullopt;
  try {
    return io::read_mesh(file).mesh;
  } catch (const std::exception&) {
    return std::nullopt;  // opening it will report the error
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
