#include "gui/shell/window.h"

#include <imgui.h>

#include <cstdlib>
#include <utility>

#include "core/error.h"
#include "gui/render/gl.h"

namespace winslow::gui {

namespace {

std::string last_glfw_error;

constexpr const char* advice =
    " Start it on a desktop, or under a virtual display (xvfb-run winslow studio MESH). Without "
    "any "
    "display, \"winslow studio --screenshot OUT.png [MESH]\" draws the studio and \"winslow render "
    "MESH -o OUT.png\" draws a mesh.";

[[noreturn]] void fail(const std::string& what) {
  std::string reason = what;
  if (!last_glfw_error.empty()) reason += " (" + last_glfw_error + ")";
  throw Error(reason + "." + advice);
}

bool has_display() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

}  // namespace

struct Window::Cursors {
  std::array<GLFWcursor*, ImGuiMouseCursor_COUNT> shapes{};
  Cursors() {
    const auto make = [this](int which, int glfw) {
      shapes[static_cast<std::size_t>(which)] = glfwCreateStandardCursor(glfw);
    };
    make(ImGuiMouseCursor_Arrow, GLFW_ARROW_CURSOR);
    make(ImGuiMouseCursor_TextInput, GLFW_IBEAM_CURSOR);
    make(ImGuiMouseCursor_ResizeAll, GLFW_CROSSHAIR_CURSOR);
    make(ImGuiMouseCursor_ResizeEW, GLFW_HRESIZE_CURSOR);
    make(ImGuiMouseCursor_ResizeNS, GLFW_VRESIZE_CURSOR);
    make(ImGuiMouseCursor_Hand, GLFW_HAND_CURSOR);
  }
  ~Cursors() {
    for (GLFWcursor* cursor : shapes)
      if (cursor) glfwDestroyCursor(cursor);
  }
};

Window::Window(int width, int height, const std::string& title) : title_(title) {
  last_glfw_error.clear();
  glfwSetErrorCallback([](int, const char* text) { last_glfw_error = text; });
  if (!has_display()) fail("Cannot open a window: there is no display, DISPLAY is not set");
  if (!glfwInit()) fail("Cannot open a window");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SAMPLES, 4);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    glfwTerminate();
    fail("Cannot open a window with OpenGL 3.3");
  }
  // In a smaller window the side panels do not fit.
  glfwSetWindowSizeLimits(window_, 760, 480, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  try {
    load_gl(glfwGetProcAddress);
  } catch (...) {
    glfwDestroyWindow(window_);
    glfwTerminate();
    throw;
  }
  cursors_ = std::make_unique<Cursors>();
  connect_events();
}

Window::~Window() {
  cursors_.reset();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::connect_events() {
  glfwSetWindowUserPointer(window_, this);
  const auto self = [](GLFWwindow* w) { return static_cast<Window*>(glfwGetWindowUserPointer(w)); };
  static const auto get = self;
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    int window_width = 1;
    int window_height = 1;
    glfwGetWindowSize(w, &window_width, &window_height);
    // On some systems the units of windows and framebuffers differ.
    const double ratio = static_cast<double>(get(w)->width()) / std::max(window_width, 1);
    get(w)->input_.move(ScreenPoint(x * ratio, y * ratio));
  });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int entered) {
    if (!entered) get(w)->input_.leave();
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
    if (button <= GLFW_MOUSE_BUTTON_MIDDLE)
      get(w)->input_.button(static_cast<MouseButton>(button), action == GLFW_PRESS);
  });
  glfwSetScrollCallback(
      window_, [](GLFWwindow* w, double x, double y) { get(w)->input_.wheel(Vec2(x, y)); });
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int) {
    if (action != GLFW_REPEAT) get(w)->input_.key(key, action == GLFW_PRESS);
  });
  glfwSetCharCallback(
      window_, [](GLFWwindow* w, unsigned c) { get(w)->input_.text(static_cast<char32_t>(c)); });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    get(w)->input_.drop({paths, paths + count});
  });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
    glfwSetWindowShouldClose(w, GLFW_FALSE);
    get(w)->close_requested_ = true;
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { get(w)->damaged_ = true; });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { get(w)->damaged_ = true; });
}

bool Window::wait(double seconds) {
  glfwWaitEventsTimeout(seconds);
  return !input_.empty() || close_requested_ || std::exchange(damaged_, false);
}

std::array<int, 2> Window::size() const {
  std::array<int, 2> size{1, 1};
  glfwGetFramebufferSize(window_, &size[0], &size[1]);
  return size;
}

float Window::scale() const {
  float x = 1;
  float y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp(x, 1.0f, 4.0f);
}

double Window::time() const { return glfwGetTime(); }

void Window::show() { glfwSwapBuffers(window_); }

void Window::set_title(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::set_cursor(int imgui_cursor) {
  if (imgui_cursor == cursor_ || imgui_cursor < 0 || imgui_cursor >= ImGuiMouseCursor_COUNT) return;
  cursor_ = imgui_cursor;
  glfwSetCursor(window_, cursors_->shapes[static_cast<std::size_t>(imgui_cursor)]);
}

bool Window::take_close_request() { return std::exchange(close_requested_, false); }

void Window::connect_clipboard() {
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = window_;
  io.GetClipboardTextFn = [](void* window) {
    return glfwGetClipboardString(static_cast<GLFWwindow*>(window));
  };
  io.SetClipboardTextFn = [](void* window, const char* text) {
    glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
  };
}

}  // namespace winslow::gui
