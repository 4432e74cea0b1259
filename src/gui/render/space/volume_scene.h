#pragma once

#include "core/inspect/space/plane_section.h"
#include "core/mesh/enclosing_faces.h"
#include "core/mesh/mesh.h"
#include "core/mesh/surface_faces.h"
#include "gui/render/space/space_scene.h"

namespace winslow::gui {

/// The boundary of a volume mesh, or all of a surface mesh, found once since it depends neither on
/// cuts nor on colours.
struct VolumeBoundary {
  std::vector<SurfaceFace> faces;
  std::vector<unsigned char> enclosing;  ///< per face; see enclosing_faces()
  bool encloses = false;                 ///< some do: there are bodies inside
};
VolumeBoundary find_boundary(const Mesh& mesh);

/// How a marker is shown. automatic: bodies as surfaces, what encloses them as outlines; a solid
/// mesh as a surface.
enum class MarkerShow { automatic, surface, outline, see_through, hidden };

/// What is shown of a mesh in space. An empty span or a null pointer stands for nothing of its
/// kind.
struct VolumeLook {
  /// What lies in front of any of these planes is cut away; bodies stay whole if something encloses
  /// them.
  std::vector<Plane> cuts;
  bool crinkle = false;  ///< cuts leave whole elements
  /// Elements that are shown whole and alone, with bodies and outlines (#elements); cuts are left
  /// out then.
  std::span<const unsigned char> isolated;
  /// Elements that are red wherever they are (#elements).
  std::span<const unsigned char> inverted;
  /// Elements shown through what hides them, in a colour of their own (#elements).
  std::span<const unsigned char> worst;
  /// Colours of elements (#elements), packed as by element_colors(): on cuts and single elements,
  /// and on the boundary unless bodies stand beside a cut.
  std::span<const std::uint32_t> colors;
  /// Elements that a crinkled cut leaves (#elements), if known: elements_behind().
  std::span<const unsigned char> left;
  /// Index of the mesh, if many cuts of it are wanted.
  const SectionIndex* sections = nullptr;
  std::vector<MarkerShow> markers;    ///< per marker; those left out are automatic
  std::vector<float> marker_opacity;  ///< per marker, of see-through ones; else the style's
  std::vector<Rgb> marker_colors;     ///< per marker, of surfaces without other colours
  std::vector<Rgb> border_colors;     ///< per marker of a surface mesh, of its line
  bool edges = true;                  ///< of elements
  double feature_angle = 40;          ///< degrees by which a surface turns at an edge that is drawn
};

/// Colours and widths of a scene, of the theme.
struct VolumeStyle {
  Rgba fill{0.93f, 0.94f, 0.96f, 1};  ///< of what has no other colour
  Rgba edge{0.25f, 0.28f, 0.33f, 0.55f};
  Rgba feature{0.13f, 0.15f, 0.18f, 1};    ///< edges that show the form
  Rgba enclosure{0.45f, 0.48f, 0.53f, 1};  ///< outlines of what encloses
  Rgba inverted{0.90f, 0.10f, 0.12f, 1};
  Rgba worst{0.93f, 0.50f, 0.05f, 1};
  Rgba ghost{0.80f, 0.20f, 0.70f, 1};  ///< of the bodies before
  float edge_width = 1, feature_width = 1.6f;
  float see_through = 0.35f;  ///< opacity of such markers

  bool operator==(const VolumeStyle&) const = default;
};

/// A part of a scene that can be built separately. Its dependence on the scene's cuts: whole
/// elements and the boundary of a solid mesh depend on crinkled cuts, a section on its own plane,
/// the rest on none.
struct VolumePart {
  enum class Kind { elements, section, boundary, worst, inverted };
  Kind kind = Kind::boundary;
  std::size_t cut = 0;  ///< of a section

  auto operator<=>(const VolumePart&) const = default;
};
/// Per element 1 if it is turned over, else 0. normals: of a surface mesh, towards its correct
/// side.
std::vector<unsigned char> inverted_elements(const Mesh& mesh, std::span<const Vec3> normals);
/// Per element 1 if it is of these layers (`layers`: of each element), the look isolates it, and
/// the look's cuts leave it; else 0.
std::vector<unsigned char> peeled_elements(const Mesh& mesh, const VolumeLook& look,
                                           std::span<const Index> layers,
                                           const std::array<Index, 2>& range);

/// The parts of a scene, in drawing order.
std::vector<VolumePart> parts_of(const VolumeLook& look);
/// Builds a part. It has no planes: those of look.cuts clip a scene of flat cuts.
SpaceScene build_part(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
                      const VolumeStyle& style, const VolumePart& part);
/// The planes that clip the parts: those of flat cuts.
std::vector<Plane> clip_planes_of(const VolumeLook& look);
/// True if a face of the boundary is drawn as a surface, see-through or not.
bool drawn_as_surface(const VolumeBoundary& boundary, const VolumeLook& look, std::size_t face);
/// True if colours of elements show on the boundary, too.
bool boundary_has_values(const VolumeBoundary& boundary, const VolumeLook& look);

/// Builds all parts as one scene. Throws UsageError for more than most_clip_planes cuts.
SpaceScene build_scene(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
                       const VolumeStyle& style);

/// Per marker 1 if its surface is visible in such a scene and has the marker's colour, so that a
/// key of colours lists it (#markers).
std::vector<unsigned char> markers_in_color(const Mesh& mesh, const VolumeBoundary& boundary,
                                            const VolumeLook& look);

/// Builds the bodies of a mesh as lines alone, to overlay another state of the mesh: their edges,
/// feature edges more strongly, and their intersections with cuts.
SpaceScene build_ghost(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
                       const VolumeStyle& style);

}  // namespace winslow::gui
