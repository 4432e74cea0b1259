#include "gui/view/mesh/volume_layer.h"

#include "core/inspect/space/plane_section.h"
#include "core/inspect/space/surface_measures.h"
#include "core/quality/quality.h"
#include "core/quality/volume_element.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/space/volume_scene.h"
#include "gui/view/mesh/mesh_colors.h"

namespace winslow::gui {

namespace {

/// A scene of fewer nodes is made within a frame, faster than a thread could hand it over.
constexpr Index small_volume = 1500;  // nodes
/// From this size on, an index of sections pays.
constexpr Index large_volume = 20000;  // elements

}  // namespace

struct VolumeScenes::Memory {
  using Flags = std::vector<unsigned char>;

  struct Painted {
    std::shared_ptr<const QualityMonitor::Measured> measured;
    ColorChoice choice;
    Isolation isolation;
    bool plain = true;
    std::vector<std::uint32_t> rgba;  // of elements; empty: plain
    Flags isolated;                   // empty: not asked for
    std::optional<Legend> legend;
  };

  /// What a part depends on, besides the look of the wish, on which all parts depend.
  struct PartKey {
    VolumePart part;
    const void* mesh = nullptr;         // of parts inside the mesh
    std::uint64_t boundary_places = 0;  // of the boundary
    const void* painted = nullptr;
    const void* flags = nullptr;     // of the elements of the part
    const void* inverted = nullptr;  // elements that are red in the part
    bool isolated = false;           // outlines replace the surfaces of a solid mesh
    std::optional<CutPlane> cut;
    bool operator==(const PartKey&) const = default;
  };

  std::uint64_t boundary_places = 0;  // grows when nodes of the boundary move
  std::shared_ptr<const Painted> painted;
  std::shared_ptr<const Flags> inverted, left, worst;
  std::shared_ptr<const std::vector<Index>> layers;  // of the elements at the peeled marker
  std::shared_ptr<const Flags> peeled;               // elements that are left
  std::shared_ptr<const SectionIndex> sections;      // of this mesh, or of one before
  std::weak_ptr<const Mesh> sections_of;
  std::vector<PartKey> keys;  // of parts
};

namespace {

using Flags = VolumeScenes::Memory::Flags;
using Painted = VolumeScenes::Memory::Painted;
using PartKey = VolumeScenes::Memory::PartKey;

bool boundary_stays(const VolumeWish& a, const VolumeWish& b) {
  if (a.mesh == b.mesh) return true;
  if (a.boundary != b.boundary) return false;
  for (const SurfaceFace& face : a.boundary->faces)
    for (const Index node : face.nodes)
      if (!a.mesh->coordinates.same_place(node, b.mesh->coordinates)) return false;
  return true;
}

std::vector<Vec3> normals_of(const VolumeWish& wish) {
  return wish.surface ? wish.surface->normals->of_elements(wish.mesh->coordinates, 0)
                      : std::vector<Vec3>();
}

double size_of(const Mesh& mesh, Index e) {
  const Topology& topology = *mesh.topology;
  if (is_surface(topology))
    return face_area(SpacePoints(mesh.coordinates), Face(topology.element(e)));
  return VolumeElement(mesh.coordinates, topology.shape(e), topology.element(e)).volume();
}

std::shared_ptr<const Painted> paint(const VolumeWish& wish, bool any_inverted) {
  auto painted = std::make_shared<Painted>();
  painted->measured = wish.measured;
  painted->choice = wish.colors;
  painted->isolation = wish.isolation;
  painted->plain = !wish.surfaces;
  if (!wish.measured || !wish.measured->field) return painted;
  const std::vector<double>& values = wish.measured->values;
  const ElementField& field = *wish.measured->field;
  const ColorScale scale = color_scale(field, values, wish.colors);
  if (wish.surfaces) {
    painted->rgba = element_colors(values, scale);
    painted->legend = legend_of(field, values, scale);
    const Rgba& red = wish.style.inverted;
    if (any_inverted && wish.mark_inverted) painted->legend->inverted = Rgb{red[0], red[1], red[2]};
  }
  if (!wish.isolation.on) return painted;
  // Elements that are not at walls have no values of the fields for these.
  const bool some = field.wall() != nullptr;
  for (const double v : values) {
    const bool counts = !std::isfinite(v) && !(some && std::isnan(v));
    painted->isolated.push_back(isolated(v, wish.isolation) || counts ? 1 : 0);
  }
  return painted;
}

/// Makes one picture, and reuses what it can of the last one.
class SceneMaker {
 public:
  SceneMaker(VolumeWish wish, std::shared_ptr<const VolumeScenes> last)
      : wish_(std::move(wish)), last_(std::move(last)), memory_(std::make_shared<Memory>()) {
    if (last_ && last_->of.generation != wish_.generation) last_.reset();
    if (last_ && last_->memory) before_ = last_->memory.get();
  }

  std::shared_ptr<const VolumeScenes> make() {
    auto scenes = std::make_shared<VolumeScenes>();
    if (wish_.ghost) return make_ghost(std::move(scenes));
    check(*scenes);
    choose();
    count_alone(*scenes);
    scenes->legend = memory_->painted->legend;
    scenes->planes = clip_planes_of(look_);
    const bool same_look = last_ && look_stays();
    for (const VolumePart& part : parts_of(look_)) {
      PartKey key = key_of(part);
      scenes->parts.push_back(part_of(key, same_look));
      memory_->keys.push_back(key);
    }
    scenes->memory = memory_;
    scenes->of = std::move(wish_);
    return scenes;
  }

 private:
  using Memory = VolumeScenes::Memory;

  std::shared_ptr<const VolumeScenes> make_ghost(std::shared_ptr<VolumeScenes> scenes) {
    choose_look();
    scenes->parts = {std::make_shared<const SpaceScene>(
        build_ghost(*wish_.mesh, *wish_.boundary, look_, wish_.style))};
    scenes->of = std::move(wish_);
    return scenes;
  }

  void check(VolumeScenes& scenes) {
    const Mesh& mesh = *wish_.mesh;
    const bool same = before_ && last_->of.mesh == wish_.mesh;
    scenes.shown.shape = wish_.shape;
    const std::vector<Vec3> normals = same ? std::vector<Vec3>() : normals_of(wish_);
    scenes.shown.validity =
        same ? last_->shown.validity : check_validity(*mesh.topology, mesh.coordinates, 0, normals);
    any_inverted_ = scenes.shown.validity.inverted > 0;
    if (same)
      memory_->inverted = before_->inverted;
    else if (any_inverted_)
      memory_->inverted = std::make_shared<const Flags>(inverted_elements(mesh, normals));
    else
      memory_->inverted = std::make_shared<const Flags>(at(mesh.topology->element_count()), 0);
    const bool boundary_same = before_ && boundary_stays(last_->of, wish_);
    memory_->boundary_places = before_ ? before_->boundary_places + (boundary_same ? 0 : 1) : 0;
  }

  /// The elements that are shown alone, and their volume.
  void count_alone(VolumeScenes& scenes) const {
    if (look_.isolated.empty()) return;
    const bool same = before_ && last_->of.mesh == wish_.mesh &&
                      before_->painted == memory_->painted && before_->peeled == memory_->peeled;
    if (same) {
      scenes.shown.alone = last_->shown.alone;
      return;
    }
    const Topology& topology = *wish_.mesh->topology;
    ShownAlone alone;
    for (Index e = 0; e < topology.element_count(); ++e) {
      if (look_.isolated[at(e)] == 0) continue;
      ++alone.count;
      alone.size += size_of(*wish_.mesh, e);
    }
    scenes.shown.alone = alone;
  }

  void choose() {
    const bool same_paint = before_ && before_->painted->measured == wish_.measured &&
                            before_->painted->choice == wish_.colors &&
                            before_->painted->isolation == wish_.isolation &&
                            before_->painted->plain == !wish_.surfaces;
    memory_->painted = same_paint ? before_->painted : paint(wish_, any_inverted_);
    choose_look();
    look_.isolated = memory_->painted->isolated;
    look_.colors = memory_->painted->rgba;
    if (wish_.peel.on) choose_peeled();
    choose_left();
    choose_marked();
    choose_sections();
  }

  /// An index pays if a mesh is cut repeatedly. It is made when a mesh is opened and, when nodes
  /// have moved, with the second picture of the moved mesh.
  void choose_sections() {
    if (wish_.mesh->topology->element_count() < large_volume) return;
    const bool same_topology = before_ && last_->of.mesh->topology == wish_.mesh->topology;
    const auto known = same_topology ? before_->sections : nullptr;
    if (known) {
      memory_->sections = known;
      memory_->sections_of = before_->sections_of;
    }
    if (look_.cuts.empty() || look_.crinkle) return;
    if (!known || memory_->sections_of.lock() != wish_.mesh) {
      if (known && last_->of.mesh != wish_.mesh) return;
      memory_->sections = known ? std::make_shared<const SectionIndex>(*wish_.mesh, *known)
                                : std::make_shared<const SectionIndex>(*wish_.mesh);
      memory_->sections_of = wish_.mesh;
    }
    look_.sections = memory_->sections.get();
  }

  void choose_look() {
    for (const CutPlane& cut : wish_.cuts) look_.cuts.push_back(plane_of(cut));
    look_.crinkle = wish_.crinkle;
    look_.markers = wish_.markers;
    look_.marker_opacity = wish_.opacity;
    look_.marker_colors = wish_.marker_colors;
    look_.border_colors = wish_.border_colors;
    look_.feature_angle = wish_.feature_angle;
    look_.edges = wish_.edges;
  }

  /// Finds the elements of some layers below a marker that are isolated and lie behind all cuts.
  void choose_peeled() {
    const Topology& topology = *wish_.mesh->topology;
    const Peel& peel = wish_.peel;
    const bool same_layers = before_ && before_->layers && last_->of.peel.marker == peel.marker &&
                             last_->of.mesh->topology == wish_.mesh->topology;
    memory_->layers = same_layers ? before_->layers
                                  : std::make_shared<const std::vector<Index>>(element_layers(
                                        topology, topology.markers().nodes_of({&peel.marker, 1})));
    const bool same = same_layers && before_->peeled && last_->of.peel == peel &&
                      before_->painted == memory_->painted && last_->of.cuts == wish_.cuts &&
                      (wish_.cuts.empty() || last_->of.mesh == wish_.mesh);
    memory_->peeled = same ? before_->peeled
                           : std::make_shared<const Flags>(peeled_elements(
                                 *wish_.mesh, look_, *memory_->layers, {peel.from, peel.to}));
    look_.isolated = *memory_->peeled;
  }

  void choose_left() {
    if (!look_.crinkle || look_.cuts.empty() || !look_.isolated.empty()) return;
    const bool same =
        before_ && before_->left && last_->of.mesh == wish_.mesh && last_->of.cuts == wish_.cuts;
    memory_->left = same ? before_->left
                         : std::make_shared<const Flags>(elements_behind(*wish_.mesh, look_.cuts));
    look_.left = *memory_->left;
  }

  /// Sets the elements shown through what hides them.
  void choose_marked() {
    if (wish_.mark_inverted && any_inverted_) look_.inverted = *memory_->inverted;
    if (wish_.worst.empty()) return;
    const bool same =
        before_ && before_->worst && last_->of.mesh == wish_.mesh && last_->of.worst == wish_.worst;
    if (same) {
      memory_->worst = before_->worst;
    } else {
      auto worst = std::make_shared<Flags>(memory_->inverted->size(), 0);
      for (const Index e : wish_.worst)
        if (at(e) < worst->size()) (*worst)[at(e)] = 1;
      memory_->worst = std::move(worst);
    }
    look_.worst = *memory_->worst;
  }

  bool look_stays() const {
    const VolumeWish& was = last_->of;
    return was.markers == wish_.markers && was.opacity == wish_.opacity &&
           was.marker_colors == wish_.marker_colors && was.border_colors == wish_.border_colors &&
           was.feature_angle == wish_.feature_angle && was.edges == wish_.edges &&
           was.style == wish_.style;
  }

  PartKey key_of(const VolumePart& part) const {
    PartKey key;
    key.part = part;
    if (!look_.inverted.empty()) key.inverted = memory_->inverted.get();
    switch (part.kind) {
      case VolumePart::Kind::section:
        key.cut = wish_.cuts[part.cut];
        [[fallthrough]];
      case VolumePart::Kind::elements:
        key.mesh = wish_.mesh.get();
        key.painted = memory_->painted.get();
        key.flags = memory_->peeled ? memory_->peeled.get() : memory_->left.get();
        break;
      case VolumePart::Kind::boundary:
        key.boundary_places = memory_->boundary_places;
        // Whole elements have faces on the outlines of the enclosure.
        key.flags = memory_->left.get();
        if (key.flags != nullptr || boundary_has_values(*wish_.boundary, look_))
          key.painted = memory_->painted.get();
        key.isolated = !look_.isolated.empty();
        break;
      case VolumePart::Kind::worst:
        key.flags = memory_->worst.get();
        [[fallthrough]];
      case VolumePart::Kind::inverted:
        key.mesh = wish_.mesh.get();
        break;
    }
    return key;
  }

  std::shared_ptr<const SpaceScene> part_of(const PartKey& key, bool same_look) const {
    if (same_look && before_)
      for (std::size_t k = 0; k < before_->keys.size(); ++k)
        if (before_->keys[k] == key) return last_->parts[k];
    return std::make_shared<const SpaceScene>(
        build_part(*wish_.mesh, *wish_.boundary, look_, wish_.style, key.part));
  }

  VolumeWish wish_;
  std::shared_ptr<const VolumeScenes> last_;
  std::shared_ptr<Memory> memory_;
  const Memory* before_ = nullptr;
  bool any_inverted_ = false;
  VolumeLook look_;
};

}  // namespace

void VolumeLayer::want(VolumeWish wish) {
  if (wanted_ == wish) return;
  if (wanted_ && wanted_->generation != wish.generation) scenes_.reset();
  wanted_ = wish;
  waiting_ = std::move(wish);
  start();
}

void VolumeLayer::start() {
  if (!waiting_ || worker_.busy()) return;
  VolumeWish wish = *std::exchange(waiting_, std::nullopt);
  if (wish.mesh->topology->node_count() < small_volume)
    return adopt(SceneMaker(std::move(wish), scenes_).make());
  worker_.start([wish = std::move(wish), last = scenes_] { return SceneMaker(wish, last).make(); });
}

bool VolumeLayer::poll() {
  auto made = worker_.poll();
  if (made) adopt(std::move(*made));
  start();
  return made.has_value();
}

void VolumeLayer::adopt(std::shared_ptr<const VolumeScenes> scenes) {
  if (!wanted_ || scenes->of.generation != wanted_->generation) return;
  scenes_ = std::move(scenes);
  ++revision_;
}

void VolumeLayer::clear() {
  waiting_.reset();
  wanted_.reset();
  scenes_.reset();
}

}  // namespace winslow::gui
