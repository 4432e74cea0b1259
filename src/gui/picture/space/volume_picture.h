#pragma once

#include "core/inspect/element_field.h"
#include "core/inspect/space/plane_section.h"
#include "core/vcv/sphere/node_vcv.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/render/color_scale.h"
#include "gui/render/image.h"
#include "gui/render/space/space_view.h"
#include "gui/render/space/volume_scene.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// A picture of a volume mesh or of a surface mesh, drawn without a display.
struct VolumePictureOptions {
  int width = 1200, height = 900;  ///< pixels
  /// Colour elements by this; none: plain. Of what such elements have, which has to be given for a
  /// surface mesh.
  std::optional<ElementField> color = ElementField(Metric::normalized_jacobian, 3);
  /// The surface mesh as it was given, which deviations are from and which tells the side to which
  /// elements face; null: the mesh itself.
  std::shared_ptr<const Mesh> given;
  ColorChoice colors;  ///< of what is coloured; on_dark follows dark

  /// Planes that cut; what lies in front of any is taken away. None given: where something encloses
  /// bodies, and no layers are peeled, one through their middle, else none.
  std::optional<std::vector<Plane>> cuts;
  bool crinkle = false;  ///< cuts leave whole elements
  /// Only elements of these layers below a marker, whole: see Peel. Its `on` is not asked.
  std::optional<Peel> peel;
  /// Elements whose value of the colour is worse than this are shown alone, whole. Needs color.
  std::optional<double> isolate;
  std::vector<std::string> show;         ///< markers that are drawn, as surfaces; empty: see hide
  std::vector<std::string> hide;         ///< markers that are not
  std::vector<std::string> see_through;  ///< markers that are drawn as such surfaces

  std::optional<ViewDirection> view;  ///< none: onto the cuts, or three quarters
  int up = 2;                         ///< of that view: axis that is up on screen, 0 to 2
  bool perspective = false;
  std::optional<Vec3> centre;        ///< in the middle of the picture; none: all is
  std::optional<double> half_width;  ///< of what is seen there, units of the mesh; none: all

  std::optional<Box<3>> extent;  ///< that all means there; none: what is drawn

  std::vector<Index> vcvs;  ///< nodes whose virtual control volumes are drawn over the mesh
  VolumeVcvOptions vcv_kind = {VcvAngles::adjusted};  ///< how these are made

  bool wireframe = true;  ///< edges of elements
  bool legend = true;     ///< only with color
  bool marker_key = true;
  std::string title;  ///< top left; empty: none
  bool dark = false;
  int samples = 4;  ///< multisampling
};

/// Inverted elements are red, seen through what hides them, and counted in a caption. Throws Error
/// where no OpenGL can be had, and UsageError for a plane mesh, cuts and VCVs of a surface mesh, an
/// unknown colour map or marker, a cut that meets no element, a node without a VCV, a size or a
/// number out of range.
Image draw_volume_picture(const Mesh& mesh, const VolumePictureOptions& options);

/// The same as vector graphics, hidden surfaces and lines left out; width and height are points.
/// Where more than 60,000 faces are seen, the mesh is a raster in it: figure.scene says so. Needs
/// OpenGL for that alone.
VectorFigure volume_picture_figure(const Mesh& mesh, const VolumePictureOptions& options);

/// The cuts of such a picture, and the scale of its colours (needs options.color): of several that
/// are to be compared, take one.
std::vector<Plane> cuts_of_picture(const Mesh& mesh, const VolumePictureOptions& options);
ColorScale volume_picture_scale(const Mesh& mesh, const VolumePictureOptions& options);
/// A box around all that such a picture shows: of several that are to be seen alike, join them.
/// Holds no point where nothing is shown. Needs no OpenGL.
Box<3> volume_picture_extent(const Mesh& mesh, const VolumePictureOptions& options);

}  // namespace winslow::gui
