#pragma once

#include <string>

#include "gui/settings/picture_spec.h"

namespace winslow::gui {

/// The controls of a PictureSpec, for the dialogs that have one.
class PictureSettings {
 public:
  /// Starts from a spec; width and height of what is on screen, pixels.
  void set(const PictureSpec& spec, double width, double height);
  /// Draws the controls; their ids begin with `id`. film: no transparency.
  void draw(const std::string& id, bool film, double width, double height);
  /// What is wrong with the size; empty if nothing is.
  const std::string& error() const { return error_; }
  const PictureSpec& spec() const { return spec_; }

 private:
  PictureSpec spec_;
  int width_ = 1600, height_ = 1200;  // as typed
  std::string error_;
};

}  // namespace winslow::gui
