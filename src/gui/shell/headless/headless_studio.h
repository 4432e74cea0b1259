#pragma once

#include "core/command/command.h"
#include "gui/base/input.h"
#include "gui/render/gl.h"
#include "gui/settings/picture_spec.h"
#include "gui/shell/workbench/workbench.h"

namespace winslow::gui {

/// The studio without a display: the same workbench with off-screen frames, and mouse and keyboard
/// input from a program. Errors that the studio would show are thrown.
class HeadlessStudio {
 public:
  /// width, height: of the window, pixels. Throws Error if OpenGL is not available.
  HeadlessStudio(int width, int height);

  Workbench& bench() { return *bench_; }
  InputQueue& input() { return input_; }
  void resize(int width, int height);

  /// Runs frames until all input is processed, then `more` frames.
  void frames(int more = 2);
  /// Runs frames until all work is done. Throws Error if something fails meanwhile.
  void settle();
  /// Opens a mesh and waits for it. Throws InputError.
  void open(const std::filesystem::path& mesh, const io::ReadOptions& reading = {});

  /// Carries out commands, one after the other. seen: called for every new mesh; without it the
  /// solver does not wait. Throws Error.
  /// The commands with the names of groups and the patterns replaced by markers of the open mesh.
  std::vector<Command> expanded(const std::vector<Command>& commands) const;
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

/// A script of user actions in the studio, one per line (docs/studio.md lists the words).
struct ScriptLine {
  int number = 0;                  ///< in the file, from 1
  std::vector<std::string> words;  ///< never empty; "quoted words" count as one
};
struct Script {
  std::filesystem::path file;
  std::vector<ScriptLine> lines;
};

/// Throws InputError "FILE:LINE: ..." for an unknown word, too few or too many words, or an
/// unterminated quote.
Script read_script(const std::filesystem::path& file);

/// GLFW codes of a key and its modifiers: of "F", "Ctrl+Shift+Z", "Escape". Throws UsageError.
std::vector<int> parse_keys(const std::string& text);

/// Carries out a script. `folder`: for its pictures; empty: the working folder. say: called for
/// every written file. Throws Error "FILE:LINE: ..." if a line fails.
void play_script(const Script& script, HeadlessStudio& studio, const std::filesystem::path& folder,
                 const std::function<void(const std::string&)>& say);

/// Options of the studio as a program without a window.
struct HeadlessOptions {
  std::optional<std::filesystem::path>
      mesh;                        ///< mesh to open; takes precedence over that of the recipe
  io::ReadOptions reading = {};    ///< of the mesh; zone and regions: else those of the recipe
  std::filesystem::path recipe;    ///< recipe to carry out; empty: none
  std::filesystem::path script;    ///< script to play then (docs/studio.md); empty: none
  std::filesystem::path picture;   ///< of the final state: .png, .svg or .pdf; empty: none
  std::filesystem::path frames;    ///< of the recipe: a folder, or a film (.mp4, .gif); empty: none
  std::filesystem::path folder;    ///< for a script's pictures; empty: the working folder
  RecordingSpec recording;         ///< of the frames; its PictureSpec also applies to `picture`
  int width = 1440, height = 900;  ///< of the window, pixels
  /// Called with the recipe's commands before the first is carried out; throws if one is invalid.
  std::function<void(const std::vector<Command>&, const Topology&, const std::string& file)> check;
  /// say: called after each operation, "Wrote a.png". warn: called with warnings of the mesh's
  /// reader.
  std::function<void(const std::string&)> say = [](const std::string&) {};
  std::function<void(const std::string&)> warn = [](const std::string&) {};
};

/// The result of a run.
struct HeadlessResult {
  Index inverted = 0;           ///< inverted elements of the last mesh
  double fraction_reached = 1;  ///< smallest of the recipe's motions
  bool converged = true;        ///< true if every command of the recipe converged
};

/// Throws InputError, UsageError, OutputError, Error.
HeadlessResult run_headless(const HeadlessOptions& options);

}  // namespace winslow::gui
