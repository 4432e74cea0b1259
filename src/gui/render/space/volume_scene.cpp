#include "gui/render/space/volume_scene.h"

#include <iterator>
#include <utility>

#include "core/error.h"
#include "core/inspect/space/plane_section.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/quality.h"
#include "core/quality/volume_element.h"
#include "gui/render/space/scene_lists.h"

namespace winslow::gui {

namespace {

/// Strength of the light's shading: less where colours are values to compare with a legend.
constexpr float form_shading = 0.85f, value_shading = 0.28f;

std::uint32_t packed(const Rgba& c) { return pack_color({c[0], c[1], c[2]}); }

bool is_set(std::span<const unsigned char> flags, Index k) {
  return !flags.empty() && flags[at(k)] != 0;
}

enum class Drawn { no, outline, surface, see_through };

/// An outline replaces the surface of a solid body, which would hide isolated elements.
Drawn drawn_as(const VolumeBoundary& boundary, const VolumeLook& look, std::size_t f) {
  const Index marker = boundary.faces[f].marker;
  const MarkerShow show = marker >= 0 && at(marker) < look.markers.size() ? look.markers[at(marker)]
                                                                          : MarkerShow::automatic;
  if (show == MarkerShow::hidden) return Drawn::no;
  if (show == MarkerShow::see_through) return Drawn::see_through;
  if (show == MarkerShow::surface) return Drawn::surface;
  if (show == MarkerShow::outline) return Drawn::outline;
  const bool outlined =
      boundary.enclosing[f] != 0 || (!boundary.encloses && !look.isolated.empty());
  return outlined ? Drawn::outline : Drawn::surface;
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

  SpaceScene build(const VolumePart& part) {
    switch (part.kind) {
      case VolumePart::Kind::elements:
        add_chosen_elements();
        break;
      case VolumePart::Kind::section:
        add_section(part.cut);
        break;
      case VolumePart::Kind::boundary:
        add_boundary();
        break;
      case VolumePart::Kind::worst:
        add_emphasised(look_.worst, style_.worst);
        break;
      case VolumePart::Kind::inverted:
        add_emphasised(look_.inverted, style_.inverted);
        break;
    }
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

  /// Adds a fill per marker, so that drawn markers can be told apart, and common edges.
  void add_surface(const SpaceFill& style, std::span<const SurfaceFace> faces, bool values) {
    if (faces.empty()) return;
    SpaceLines other = element_lines(style.clipped_by), feature = feature_lines(style.clipped_by);
    const bool with_edges = look_.edges && style.opacity == 1;
    lists_->add_edges({&feature, with_edges ? &other : nullptr}, faces, look_.feature_angle);
    std::map<Index, std::vector<SurfaceFace>> of_marker;
    for (const SurfaceFace& face : faces) of_marker[face.marker].push_back(face);
    for (const auto& [marker, own] : of_marker) {
      SpaceFill fill = style;
      fill.marker = marker;
      if (fill.opacity < 1 && marker >= 0 && at(marker) < look_.marker_opacity.size())
        fill.opacity = look_.marker_opacity[at(marker)];
      lists_->add_faces(fill, own, boundary_color(own, values));
      scene_.fills.push_back(std::move(fill));
    }
    scene_.lines.push_back(std::move(other));
    scene_.lines.push_back(std::move(feature));
  }

  /// Adds whole elements by their outer faces. All edges are features of so rough a surface.
  void add_elements(const std::vector<SurfaceFace>& faces) {
    SpaceFill fill;
    fill.shading = shading();
    lists_->add_faces(fill, faces, [&](std::size_t f) { return element_color(faces[f].element); });
    SpaceLines lines = element_lines(0);
    if (look_.edges) lists_->add_edges({&lines, &lines}, faces, 180);
    scene_.fills.push_back(std::move(fill));
    scene_.lines.push_back(std::move(lines));
  }

  void add_chosen_elements() {
    if (!look_.isolated.empty()) return add_elements(outer_faces(*mesh_.topology, look_.isolated));
    std::vector<SurfaceFace> faces = outer_faces(*mesh_.topology, look_.left);
    std::erase_if(faces, [](const SurfaceFace& face) { return face.neighbour < 0; });
    add_elements(faces);
  }

  void add_section(std::size_t k) {
    const Plane& plane = look_.cuts[k];
    const PlaneSection section = plane_section(mesh_, plane, look_.sections);
    SpaceFill fill;
    fill.clipped_by = by_all_planes & ~(1U << k);
    SpaceLines other = element_lines(fill.clipped_by), feature = feature_lines(fill.clipped_by);
    // Builds surfaces and lines in parallel: a dragged cut waits for both.
    const auto make = [&](Index half) {
      if (half == 0)
        lists_->add_section(fill, section, plane,
                            [&](std::size_t p) { return element_color(section.elements[p]); });
      else
        lists_->add_sides({&feature, look_.edges ? &other : nullptr}, section);
    };
    parallel_for(
        0, 2,
        [&](Index begin, Index end) {
          for (Index half = begin; half < end; ++half) make(half);
        },
        1);
    scene_.fills.push_back(std::move(fill));
    scene_.lines.push_back(std::move(other));
    scene_.lines.push_back(std::move(feature));
  }

  /// Faces of the boundary by how they are drawn.
  struct DrawnFaces {
    std::vector<SurfaceFace> surface, see_through, outline;
    std::vector<SurfaceFace> block;  ///< outlines where whole elements have all their sides
  };
  DrawnFaces drawn_faces() const {
    const bool solid = !boundary_.encloses;
    DrawnFaces drawn;
    for (std::size_t f = 0; f < boundary_.faces.size(); ++f) {
      const SurfaceFace& face = boundary_.faces[f];
      const Drawn how = drawn_as(boundary_, look_, f);
      if (how == Drawn::outline) {
        drawn.outline.push_back(face);
        if (is_set(look_.left, face.element)) drawn.block.push_back(face);
      } else if (solid && !look_.left.empty() && look_.left[at(face.element)] == 0) {
        continue;  // cut away
      } else if (how != Drawn::no) {
        (how == Drawn::see_through ? drawn.see_through : drawn.surface).push_back(face);
      }
    }
    return drawn;
  }

  void add_boundary() {
    const DrawnFaces drawn = drawn_faces();
    SpaceFill fill;
    fill.clipped_by = boundary_.encloses ? 0 : by_all_planes;
    const bool values = boundary_has_values(boundary_, look_);
    fill.shading = values ? value_shading : form_shading;
    add_surface(fill, drawn.surface, values);
    fill.opacity = style_.see_through;
    add_surface(fill, drawn.see_through, values);
    add_elements(drawn.block);
    SpaceLines lines{{}, style_.enclosure, style_.feature_width, 0};
    lists_->add_edges({&lines, nullptr}, drawn.outline, look_.feature_angle);
    scene_.lines.push_back(std::move(lines));
    add_borders();
  }

  /// Adds the markers of a surface mesh, which are lines.
  void add_borders() {
    const Markers& markers = mesh_.topology->markers();
    for (std::size_t m = 0; m < look_.border_colors.size(); ++m) {
      if (m < look_.markers.size() && look_.markers[m] == MarkerShow::hidden) continue;
      const Rgb& c = look_.border_colors[m];
      SpaceLines lines{{},
                       {c[0], c[1], c[2], 1},
                       1.5f * style_.feature_width,
                       by_all_planes,
                       static_cast<Index>(m)};
      lists_->add_lines(lines, markers[m].faces);
      scene_.lines.push_back(std::move(lines));
    }
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

  void add_emphasised(std::span<const unsigned char> elements, const Rgba& color) {
    const std::vector<SurfaceFace> faces = outer_faces(*mesh_.topology, elements);
    SpaceFill fill;
    fill.emphasised = true;
    fill.shading = form_shading;
    lists_->add_faces(fill, faces, [&](std::size_t) { return packed(color); });
    SpaceLines lines{{}, color, std::max(style_.edge_width, 1.0f), 0};
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
  SpaceScene scene_;
};

}  // namespace

VolumeBoundary find_boundary(const Mesh& mesh) {
  VolumeBoundary boundary;
  boundary.faces = boundary_faces(*mesh.topology);
  if (is_surface(*mesh.topology))
    boundary.enclosing.assign(boundary.faces.size(), 0);
  else
    boundary.enclosing = enclosing_faces(mesh, boundary.faces);
  boundary.encloses =
      std::ranges::any_of(boundary.enclosing, [](unsigned char e) { return e != 0; });
  return boundary;
}

std::vector<unsigned char> inverted_elements(const Mesh& mesh, std::span<const Vec3> normals) {
  const Topology& topology = *mesh.topology;
  std::vector<unsigned char> inverted(at(topology.element_count()));
  if (is_surface(topology)) {
    const auto sines = element_values(mesh, Metric::normalized_jacobian, normals);
    for (std::size_t e = 0; e < sines.size(); ++e) inverted[e] = sines[e] > 0 ? 0 : 1;
    return inverted;
  }
  parallel_for(0, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const VolumeElement element(mesh.coordinates, topology.shape(e), topology.element(e));
      inverted[at(e)] = element.inverted() ? 1 : 0;
    }
  });
  return inverted;
}

std::vector<unsigned char> peeled_elements(const Mesh& mesh, const VolumeLook& look,
                                           std::span<const Index> layers,
                                           const std::array<Index, 2>& range) {
  const std::vector<unsigned char> behind =
      look.cuts.empty() ? std::vector<unsigned char>{} : elements_behind(mesh, look.cuts);
  std::vector<unsigned char> shown(layers.size(), 0);
  for (std::size_t e = 0; e < shown.size(); ++e)
    shown[e] = layers[e] >= range[0] && layers[e] <= range[1] &&
                       (behind.empty() || behind[e] != 0) &&
                       (look.isolated.empty() || look.isolated[e] != 0)
                   ? 1
                   : 0;
  return shown;
}

bool drawn_as_surface(const VolumeBoundary& boundary, const VolumeLook& look, std::size_t face) {
  const Drawn drawn = drawn_as(boundary, look, face);
  return drawn == Drawn::surface || drawn == Drawn::see_through;
}

/// Bodies keep their own colours beside a cut, so that they differ from the cut.
bool boundary_has_values(const VolumeBoundary& boundary, const VolumeLook& look) {
  return !look.colors.empty() &&
         (!boundary.encloses || (look.cuts.empty() && look.isolated.empty()));
}

std::vector<VolumePart> parts_of(const VolumeLook& look) {
  using Kind = VolumePart::Kind;
  std::vector<VolumePart> parts;
  if (!look.isolated.empty() || (look.crinkle && !look.cuts.empty()))
    parts.push_back({Kind::elements});
  else
    for (std::size_t k = 0; k < look.cuts.size(); ++k) parts.push_back({Kind::section, k});
  parts.push_back({Kind::boundary});
  if (!look.worst.empty()) parts.push_back({Kind::worst});
  if (!look.inverted.empty()) parts.push_back({Kind::inverted});
  return parts;
}

std::vector<Plane> clip_planes_of(const VolumeLook& look) {
  const bool flat = look.isolated.empty() && !look.crinkle;
  return flat ? look.cuts : std::vector<Plane>{};
}

SpaceScene build_part(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
                      const VolumeStyle& style, const VolumePart& part) {
  return SceneBuilder(mesh, boundary, look, style).build(part);
}

SpaceScene build_scene(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
                       const VolumeStyle& style) {
  if (look.cuts.size() > most_clip_planes)
    throw UsageError("at most " + std::to_string(most_clip_planes) + " planes can cut a mesh");
  VolumeLook whole = look;
  std::vector<unsigned char> left;
  if (look.isolated.empty() && look.crinkle && !look.cuts.empty() && look.left.empty()) {
    left = elements_behind(mesh, look.cuts);
    whole.left = left;
  }
  SpaceScene scene;
  scene.extent = space_bounds(mesh);
  scene.origin = scene.extent.centre();
  scene.planes = clip_planes_of(whole);
  for (const VolumePart& part : parts_of(whole)) {
    SpaceScene made = build_part(mesh, boundary, whole, style, part);
    std::ranges::move(made.fills, std::back_inserter(scene.fills));
    std::ranges::move(made.lines, std::back_inserter(scene.lines));
  }
  return scene;
}

std::vector<unsigned char> markers_in_color(const Mesh& mesh, const VolumeBoundary& boundary,
                                            const VolumeLook& look) {
  std::vector<unsigned char> in_color(mesh.topology->markers().size(), 0);
  if (boundary_has_values(boundary, look)) return in_color;
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    const Index marker = boundary.faces[f].marker;
    if (marker >= 0 && drawn_as_surface(boundary, look, f)) in_color[at(marker)] = 1;
  }
  return in_color;
}

SpaceScene build_ghost(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
                       const VolumeStyle& style) {
  SpaceScene scene;
  scene.extent = space_bounds(mesh);
  scene.origin = scene.extent.centre();
  const SceneLists lists(mesh, scene.origin);
  SpaceLines feature{{}, style.ghost, style.feature_width, 0};
  SpaceLines other{{}, style.ghost, style.edge_width, 0};
  other.color[3] *= 0.6f;
  std::vector<SurfaceFace> bodies;
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    if (drawn_as_surface(boundary, look, f)) bodies.push_back(boundary.faces[f]);
  lists.add_edges({&feature, &other}, bodies, look.feature_angle);
  SpaceLines outlines{{}, style.ghost, style.feature_width, 0};
  for (const Plane& cut : look.cuts) lists.add_cut(outlines, bodies, cut);
  scene.lines = {std::move(other), std::move(feature), std::move(outlines)};
  return scene;
}

}  // namespace winslow::gui
