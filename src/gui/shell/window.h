#pragma once

#include <memory>

#include "gui/base/input.h"

struct GLFWwindow;
struct GLFWcursor;

namespace winslow::gui {

/// A window with an OpenGL 3.3 core context, made current. Its events go into an InputQueue.
class Window {
 public:
  /// Throws Error with advice if there is no display.
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Waits for events, at most this long; false if there were none.
  bool wait(double seconds);
  InputQueue& input() { return input_; }
  std::array<int, 2> size() const;  ///< of the framebuffer, pixels
  int width() const { return size()[0]; }
  int height() const { return size()[1]; }
  /// Pixels per unit of layout on this screen.
  float scale() const;
  double time() const;  ///< seconds
  void show();          ///< shows what was drawn since the last call
  void set_title(const std::string& title);
  void set_cursor(int imgui_cursor);
  /// True once for each request of the user to close the window.
  bool take_close_request();
  /// Connects copy and paste of the current ImGui context to this window.
  void connect_clipboard();

 private:
  void connect_events();

  GLFWwindow* window_ = nullptr;
  std::string title_;
  InputQueue input_;
  bool close_requested_ = false, damaged_ = false;
  int cursor_ = 0;
  struct Cursors;
  std::unique_ptr<Cursors> cursors_;
};

}  // namespace winslow::gui
