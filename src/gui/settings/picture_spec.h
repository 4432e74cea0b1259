#pragma once

#include <array>
#include <filesystem>
#include <optional>

namespace winslow::gui {

/// How a picture of the studio is drawn. Letters and lines grow with it: a picture at twice the
/// size shows the same as the window.
struct PictureSpec {
  double scale = 1;                        ///< times the size on screen; with no size given
  std::optional<std::array<int, 2>> size;  ///< width and height, pixels
  bool panels = true;                      ///< the whole window, or else the mesh alone
  bool transparent = false;                ///< without panels: no paper behind the mesh
  bool legend = true;
  /// Degrees by which the view of a volume mesh is turned about the upright axis, through what is
  /// in the middle of the view.
  double turned = 0;

  bool operator==(const PictureSpec&) const = default;
};

/// A recording: frames as PNG files, and a film made of them.
struct RecordingSpec {
  enum class When {
    every_shape,  ///< a frame whenever the mesh has moved
    timed,        ///< `rate` frames a second, as far as the machine keeps up
    turntable     ///< of a volume mesh: while the view turns once around it
  };
  When when = When::every_shape;
  int rate = 20;             ///< frames a second, of the film
  double turn_seconds = 6;   ///< that a turn takes in the film
  PictureSpec picture;       ///< of each frame
  bool keep_frames = false;  ///< beside a film; without a film they are always kept

  bool operator==(const RecordingSpec&) const = default;
};

/// Frames of a turn: one for each step of as many degrees, so that a film of them can go round and
/// round.
int turntable_frames(const RecordingSpec& spec);

/// Largest side of a picture, in pixels. Above what the graphics card can draw at once a picture is
/// put together from tiles.
inline constexpr int largest_picture_side = 32768;
/// Letters become no larger than this times their size on screen.
inline constexpr double largest_picture_scale = 8;

/// Width and height, in pixels, of a picture of what is `width` x `height` on screen. Throws
/// UsageError for a size out of range.
std::array<int, 2> picture_size(const PictureSpec& spec, double width, double height);

}  // namespace winslow::gui
