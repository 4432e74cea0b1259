#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "gui/base/input.h"
#include "gui/render/gl_context.h"
#include "gui/shell/workbench/workbench.h"

namespace winslow::gui {

/// The studio without a display: the same workbench, its frames drawn off-screen, its mouse and
/// keyboard worked by a program. What the studio would show as an error is thrown.
class HeadlessStudio {
 public:
  /// width, height: of the window, pixels. Throws Error where no OpenGL can be had.
  HeadlessStudio(int width, int height);

  Workbench& bench() { return *bench_; }
  InputQueue& input() { return input_; }
  void resize(int width, int height);

  /// Runs frames until all input is taken, then `more` of them.
  void frames(int more = 2);
  /// Runs frames until nothing is under way. Throws what went wrong on the way as Error.
  void settle();
  /// Opens a mesh and waits for it. Throws InputError.
  void open(const std::filesystem::path& mesh, int zone = 0);

  /// Carries out commands, one after the other. seen: called with every new mesh on the way;
  /// without it the solver is not held up. Throws Error.
  void replay(const std::vector<Command>& commands, const std::function<void()>& seen = {});

 private:
  void frame();
  void throw_if_wrong() const;
  void run_stepwise(const std::function<void()>& seen);

  std::unique_ptr<HeadlessContext> context_;
  std::unique_ptr<Workbench> bench_;
  InputQueue input_;
  int width_, height_;
  Coordinates last_seen_;
};

}  // namespace winslow::gui
