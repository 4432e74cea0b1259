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
  /// Colour elements by this; none: plain. A field of the mesh's kind: has to be set for a surface
  /// mesh.
  std::optional<ElementField> color = ElementField(Metric::normalized_jacobian, 3);
  /// The mesh as it was given. Of a surface mesh it is the reference for deviations and for the
  /// side to which elements face; null: the mesh itself. Of a volume mesh it is the earlier one for
  /// WallField::first_height_ratio; null: that field has no values.
  std::shared_ptr<const Mesh> given;
  ColorChoice colors;  ///< of what is coloured; on_dark follows dark

  /// Cut planes; what lies in front of any of them is cut away. None given: one plane through the
  /// middle of the bodies, if something encloses them and no layers are peeled; else no plane.
  std::optional<std::vector<Plane>> cuts;
  bool crinkle = false;  ///< cuts leave whole elements
  /// Shows only elements of these layers below a marker, whole: see Peel. Its `on` is ignored.
  std::optional<Peel> peel;
  /// Elements whose value of the colour is worse than this are shown alone, whole. Needs color.
  std::optional<double> isolate;
  std::vector<std::string> show;         ///< markers that are drawn, as surfaces; empty: see hide
  std::vector<std::string> hide;         ///< markers that are not drawn
  std::vector<std::string> see_through;  ///< markers that are drawn as see-through surfaces

  std::optional<ViewDirection> view;  ///< none: onto the cuts, or three quarters
  int up = 2;                         ///< of the view: axis that is up on screen, 0 to 2
  bool perspective = false;
  std::optional<Vec3> centre;        ///< point in the middle of the picture; none: all is shown
  std::optional<double> half_width;  ///< of what is seen there, in mesh units; none: all is shown

  std::optional<Box<3>> extent;  ///< what "all" means for these two; none: what is drawn

  std::vector<Index> vcvs;  ///< nodes whose virtual control volumes are drawn over the mesh
  VolumeVcvOptions vcv_kind = {VcvAngles::adjusted};  ///< how these are made

  bool wireframe = true;  ///< edges of elements
  bool legend = true;     ///< only with color
  bool marker_key = true;
  std::string title;  ///< top left; empty: none
  bool dark = false;
  int samples = 4;  ///< multisampling
};

/// Draws a picture; inverted elements are red, seen through what hides them, and counted in a
/// caption. Throws Error if OpenGL is not available, and UsageError for a plane mesh, cuts and VCVs
/// of a surface mesh, an unknown colour map or marker, a cut that meets no element, a node without
/// a VCV, a size or a number out of range.
Image draw_volume_picture(const Mesh& mesh, const VolumePictureOptions& options);

/// The same as vector graphics, without hidden surfaces and lines; width and height are points. If
/// more than 60,000 faces are visible, the figure has a raster of the mesh, see figure.scene. Only
/// that needs OpenGL.
VectorFigure volume_picture_figure(const Mesh& mesh, const VolumePictureOptions& options);

/// The cuts of a picture, and the scale of its colours (needs options.color); pictures to compare
/// should all use the same ones.
std::vector<Plane> cuts_of_picture(const Mesh& mesh, const VolumePictureOptions& options);
ColorScale volume_picture_scale(const Mesh& mesh, const VolumePictureOptions& options);
/// A box around everything that a picture shows; join the boxes of pictures that need the same
/// view. Empty if nothing is shown. Needs no OpenGL.
Box<3> volume_picture_extent(const Mesh& mesh, const VolumePictureOptions& options);

}  // namespace winslow::gui
