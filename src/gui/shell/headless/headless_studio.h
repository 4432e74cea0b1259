#pragma once

#include "core/command/command.h"
#include "gui/base/input.h"
#include "gui/render/gl.h"
#include "gui/settings/picture_spec.h"
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

/// A script of what a user does in the studio, line by line (docs/studio.md lists the words).
struct ScriptLine {
  int number = 0;                  ///< in the file, from 1
  std::vector<std::string> words;  ///< never empty; "quoted words" are one
};
struct Script {
  std::filesystem::path file;
  std::vector<ScriptLine> lines;
};

/// Throws InputError "FILE:LINE: ..." for a word that nothing is known of, too few or too many
/// words, or a quote that does not end.
Script read_script(const std::filesystem::path& file);

/// A key and those held with it, as GLFW numbers: of "F", "Ctrl+Shift+Z", "Escape". Throws
/// UsageError.
std::vector<int> parse_keys(const std::string& text);

/// Does what a script says. `folder`: where its pictures go; empty: the working folder. Tells `say`
/// what was written. Throws Error "FILE:LINE: ..." where something cannot be done.
void play_script(const Script& script, HeadlessStudio& studio, const std::filesystem::path& folder,
                 const std::function<void(const std::string&)>& say);

/// The studio as a program without a window.
struct HeadlessOptions {
  std::optional<std::filesystem::path> mesh;  ///< to start with; before that of the recipe
  int zone = 0;                               ///< of it; 0: the recipe's, or else the first
  std::filesystem::path recipe;               ///< carried out; empty: none
  std::filesystem::path script;               ///< played then; empty: none (docs/studio.md)
  std::filesystem::path picture;              ///< of the end: .png, .svg or .pdf; empty: none
  std::filesystem::path frames;    ///< of the recipe: a folder, or a film .mp4 or .gif; empty: none
  std::filesystem::path folder;    ///< where a script's pictures go; empty: the working folder
  RecordingSpec recording;         ///< of the frames; its picture is also that of `picture`
  int width = 1440, height = 900;  ///< of the window, pixels
  /// Called with the recipe's commands before the first is carried out; throws what is wrong.
  std::function<void(const std::vector<Command>&, const Topology&, const std::string& file)> check;
  /// Told of what was done, when it was: "Wrote a.png"; and of what reading the mesh found odd.
  std::function<void(const std::string&)> say = [](const std::string&) {};
  std::function<void(const std::string&)> warn = [](const std::string&) {};
};

/// What it came to.
struct HeadlessResult {
  Index inverted = 0;           ///< elements of the last mesh
  double fraction_reached = 1;  ///< of the recipe's motions, the smallest
  bool converged = true;        ///< every command of the recipe
};

/// Throws InputError, UsageError, OutputError, Error.
HeadlessResult run_headless(const HeadlessOptions& options);

}  // namespace winslow::gui
