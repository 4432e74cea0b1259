#pragma once

#include "gui/base/screen.h"
#include "gui/menu/panel_context.h"
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

/// What a picture shows and how large it is; its file is chosen next.
class PictureDialog : public Panel {
 public:
  void open() { wanted_ = opened_ = true; }
  /// On screen, pixels: of the window, and of the mesh alone.
  void set_extents(const ScreenVector& window, const ScreenVector& mesh);
  void draw(const PanelContext& context) override;

 private:
  bool wanted_ = false, opened_ = false;
  ScreenVector window_{1, 1}, mesh_{1, 1};
  PictureSettings settings_;
};

/// How the mesh is recorded; where to is chosen next.
class RecordDialog : public Panel {
 public:
  /// step: of the history, that is to be carried out again and recorded.
  void open(std::optional<std::size_t> step);
  /// On screen, pixels: of the window, and of the mesh alone.
  void set_extents(const ScreenVector& window, const ScreenVector& mesh);
  void draw(const PanelContext& context) override;

 private:
  bool wanted_ = false, opened_ = false;
  std::optional<std::size_t> step_;
  ScreenVector window_{1, 1}, mesh_{1, 1};
  PictureSettings settings_;
  RecordingSpec spec_;
};

/// The recording under way: how many frames there are, how far the film is.
class RecordingPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
