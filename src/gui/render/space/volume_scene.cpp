#include "gui/render/space/volume_scene.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/inspect/space/plane_section.h"
#include "gui/render/space/scene_lists.h"

namespace winslow::gui {

namespace {

/// How strongly the light shows the form: less where colours are values that are read off a legend.
constexpr float form_shading = 0.85f, value_shading = 0.28f;

std::uint32_t packed(const Rgba& c) { return pack_color({c[0], c[1], c[2]}); }

bool is_set(std::span<const unsigned char> flags, Index k) {
  return !flags.empty() && flags[at(k)] != 0;
}

enum class Drawn { no, outline, surface, see_through };

/// A solid body would hide its isolated elements.
Drawn drawn_as(const VolumeBoundary& boundary, const VolumeLook& look, std::size_t f) {
  const Index marker = boundary.faces[f].marker;
  const MarkerShow show = marker >= 0 && at(marker) < look.markers.size() ? look.markers[at(marker)]
                                                                          : MarkerShow::automatic;
  if (show == MarkerShow::hidden) return Drawn::no;
  if (show == MarkerShow::see_through) return Drawn::see_through;
  if (show == MarkerShow::surface) return Drawn::surface;
  const bool outlined =
      boundary.enclosing[f] != 0 || (!boundary.encloses && !look.isolated.empty());
  return outlined ? Drawn::outline : Drawn::surface;
}

/// Bodies keep their own colours beside a cut, so that they are told from what is cut.
bool boundary_has_values(const VolumeBoundary& boundary, const VolumeLook& look) {
  return !look.colors.empty() &&
         (!boundary.encloses || (look.cuts.empty() && look.isolated.empty()));
}

class SceneBuilder {
 public:
  SceneBuilder(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
               const VolumeStyle& style)
      : mesh_(mesh), boundary_(boundary), look_(look), style_(style) {
    scene_.extent = space_bounds(mesh);
    scene_.origin = scene_.extent.centre();
    lists_.emplace(mesh, scene_.origin);
  }

  SpaceScene build() {
    if (!look_.isolated.empty()) {
      add_elements(outer_faces(*mesh_.topology, look_.isolated));
    } else if (look_.crinkle && !look_.cuts.empty()) {
      left_ = elements_behind(mesh_, look_.cuts);
      add_crinkle();
    } else {
      scene_.planes = look_.cuts;
      for (std::size_t k = 0; k < look_.cuts.size(); ++k) add_section(k);
    }
    add_boundary();
    if (!look_.inverted.empty()) add_inverted();
    return std::move(scene_);
  }

 private:
  std::uint32_t element_color(Index e) const {
    if (is_set(look_.inverted, e)) return packed(style_.inverted);
    return look_.colors.empty() ? packed(style_.fill) : look_.colors[at(e)];
  }
  float shading() const { return look_.colors.empty() ? form_shading : value_shading; }

  /// Lists of lines over a surface, in the order in which they are drawn.
  SpaceLines element_lines(unsigned clipped_by) const {
    return {{}, style_.edge, style_.edge_width, clipped_by};
  }
  SpaceLines feature_lines(unsigned clipped_by) const {
    return {{}, style_.feature, style_.feature_width, clipped_by};
  }

  void add_surface(SpaceFill fill, std::span<const SurfaceFace> faces,
                   const SceneLists::Color& color) {
    if (faces.empty()) return;
    lists_->add_faces(fill, faces, color);
    SpaceLines other = element_lines(fill.clipped_by), feature = feature_lines(fill.clipped_by);
    const bool with_edges = look_.edges && fill.opacity == 1;
    lists_->add_edges({&feature, with_edges ? &other : nullptr}, faces, look_.feature_angle);
    scene_.fills.push_back(std::move(fill));
    scene_.lines.push_back(std::move(other));
    scene_.lines.push_back(std::move(feature));
  }

  /// Whole elements, by the faces around them. All their edges are features of so rough a surface.
  void add_elements(const std::vector<SurfaceFace>& faces) {
    SpaceFill fill;
    fill.shading = shading();
    lists_->add_faces(fill, faces, [&](std::size_t f) { return element_color(faces[f].element); });
    SpaceLines lines = element_lines(0);
    if (look_.edges) lists_->add_edges({&lines, &lines}, faces, 180);
    scene_.fills.push_back(std::move(fill));
    scene_.lines.push_back(std::move(lines));
  }

  void add_crinkle() {
    std::vector<SurfaceFace> faces = outer_faces(*mesh_.topology, left_);
    std::erase_if(faces, [](const SurfaceFace& face) { return face.neighbour < 0; });
    add_elements(faces);
  }

  void add_section(std::size_t k) {
    const Plane& plane = look_.cuts[k];
    const PlaneSection section = plane_section(mesh_, plane);
    SpaceFill fill;
    fill.clipped_by = all_planes() & ~(1U << k);
    lists_->add_section(fill, section, plane,
                        [&](std::size_t p) { return element_color(section.elements[p]); });
    SpaceLines other = element_lines(fill.clipped_by), feature = feature_lines(fill.clipped_by);
    lists_->add_sides({&feature, look_.edges ? &other : nullptr}, section);
    scene_.fills.push_back(std::move(fill));
    scene_.lines.push_back(std::move(other));
    scene_.lines.push_back(std::move(feature));
  }

  unsigned all_planes() const { return (1U << scene_.planes.size()) - 1; }

  void add_boundary() {
    const bool solid = !boundary_.encloses;
    std::vector<SurfaceFace> surface, see_through, outline, block;
    for (std::size_t f = 0; f < boundary_.faces.size(); ++f) {
      const SurfaceFace& face = boundary_.faces[f];
      const Drawn drawn = drawn_as(boundary_, look_, f);
      if (drawn == Drawn::outline) {
        outline.push_back(face);
        if (is_set(left_, face.element)) block.push_back(face);  // whole elements have all sides
      } else if (solid && !left_.empty() && left_[at(face.element)] == 0)
        continue;  // cut away
      else if (drawn != Drawn::no)
        (drawn == Drawn::see_through ? see_through : surface).push_back(face);
    }
    SpaceFill fill;
    fill.clipped_by = solid ? all_planes() : 0;
    const bool values = boundary_has_values(boundary_, look_);
    fill.shading = values ? value_shading : form_shading;
    add_surface(fill, surface, boundary_color(surface, values));
    fill.opacity = style_.see_through;
    add_surface(fill, see_through, boundary_color(see_through, values));
    add_elements(block);
    SpaceLines lines{{}, style_.enclosure, style_.feature_width, 0};
    lists_->add_edges({&lines, nullptr}, outline, look_.feature_angle);
    scene_.lines.push_back(std::move(lines));
  }

  SceneLists::Color boundary_color(const std::vector<SurfaceFace>& faces, bool values) const {
    return [this, &faces, values](std::size_t f) {
      const auto marker = static_cast<std::size_t>(faces[f].marker);
      if (values || is_set(look_.inverted, faces[f].element))
        return element_color(faces[f].element);
      if (faces[f].marker < 0 || marker >= look_.marker_colors.size()) return packed(style_.fill);
      return pack_color(look_.marker_colors[marker]);
    };
  }

  void add_inverted() {
    const std::vector<SurfaceFace> faces = outer_faces(*mesh_.topology, look_.inverted);
    SpaceFill fill;
    fill.emphasised = true;
    fill.shading = form_shading;
    lists_->add_faces(fill, faces, [&](std::size_t) { return packed(style_.inverted); });
    SpaceLines lines{{}, style_.inverted, std::max(style_.edge_width, 1.0f), 0};
    for (std::size_t c = 0; c < 3; ++c) lines.color[c] *= 0.6f;
    if (look_.edges) lists_->add_edges({&lines, &lines}, faces, 180);
    scene_.fills.push_back(std::move(fill));
    scene_.lines.push_back(std::move(lines));
  }

  const Mesh& mesh_;
  const VolumeBoundary& boundary_;
  const VolumeLook& look_;
  const VolumeStyle& style_;
  std::optional<SceneLists> lists_;
  std::vector<unsigned char> left_;  // by a crinkled cut; empty: there is none
  SpaceScene scene_;
};

}  // namespace

VolumeBoundary find_boundary(const Mesh& mesh) {
  VolumeBoundary boundary;
  boundary.faces = boundary_faces(*mesh.topology);
  boundary.enclosing = enclosing_faces(mesh, boundary.faces);
  boundary.encloses =
      std::ranges::any_of(boundary.enclosing, [](unsigned char e) { return e != 0; });
  return boundary;
}

SpaceScene build_scene(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
                       const VolumeStyle& style) {
  if (look.cuts.size() > most_clip_planes)
    throw UsageError("at most " + std::to_string(most_clip_planes) + " planes can cut a mesh");
  return SceneBuilder(mesh, boundary, look, style).build();
}

std::vector<unsigned char> markers_in_color(const Mesh& mesh, const VolumeBoundary& boundary,
                                            const VolumeLook& look) {
  std::vector<unsigned char> in_color(mesh.topology->markers().size(), 0);
  if (boundary_has_values(boundary, look)) return in_color;
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    const Index marker = boundary.faces[f].marker;
    const Drawn drawn = drawn_as(boundary, look, f);
    if (marker >= 0 && (drawn == Drawn::surface || drawn == Drawn::see_through))
      in_color[at(marker)] = 1;
  }
  return in_color;
}

}  // namespace winslow::gui
