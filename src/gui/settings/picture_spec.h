#pragma once

#include <array>
#include <filesystem>
#include <optional>

namespace winslow::gui {

/// How a picture of the studio is drawn. Text and lines scale with the picture: one of twice the
/// size shows the same content as the window.
struct PictureSpec {
  double scale = 1;                        ///< factor of the size on screen, if no size is given
  std::optional<std::array<int, 2>> size;  ///< width and height, pixels
  bool panels = true;                      ///< true: the whole window; false: the mesh alone
  bool transparent = false;                ///< without panels: no background behind the mesh
  bool legend = true;
  /// Rotation, in degrees, of the view of a volume mesh about the vertical axis through the centre
  /// of the view.
  double turned = 0;

  bool operator==(const PictureSpec&) const = default;
};

/// A recording: frames as PNG files, and a film made of them.
struct RecordingSpec {
  enum class When {
    every_shape,  ///< one frame per change of the mesh
    timed,        ///< `rate` frames per second, if the machine is fast enough
    turntable     ///< one full turn of the view around a volume mesh
  };
  When when = When::every_shape;
  int rate = 20;             ///< frames per second of the film
  double turn_seconds = 6;   ///< duration of a turn in the film
  PictureSpec picture;       ///< of each frame
  bool keep_frames = false;  ///< in addition to a film; always kept without a film

  bool operator==(const RecordingSpec&) const = default;
};

/// Number of frames of a turn, at equal angles, so that the film can be played in a loop.
int turntable_frames(const RecordingSpec& spec);

/// Largest side of a picture, in pixels. A picture too large for the graphics card is assembled
/// from tiles.
inline constexpr int largest_picture_side = 32768;
/// Largest scale of text, relative to its size on screen.
inline constexpr double largest_picture_scale = 8;

/// Width and height, in pixels, of a picture of an area of `width` x `height` pixels on screen.
/// Throws UsageError for a size out of range.
std::array<int, 2> picture_size(const PictureSpec& spec, double width, double height);

}  // namespace winslow::gui
