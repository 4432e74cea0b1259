#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "gui/support/rig.h"
#include "memory.h"

namespace winslow::gui::test {

/// Uses the studio at random, as a script, and checks after everything it does that no promise is
/// broken: each position of the history is the same mesh to the bit whenever it is shown, and no
/// inverted mesh is accepted in silence.
class Soak {
 public:
  explicit Soak(std::uint64_t seed);

  /// One random operation, then the checks. Throws std::runtime_error saying what went wrong.
  void step();

  int operations() const { return operations_; }
  int comparisons() const { return comparisons_; }
  int meshes() const { return meshes_; }
  int restored() const { return restored_; }
  int ended() const { return ended_; }
  /// Between one studio and the next.
  const MemoryWatch& memory() const { return memory_; }
  /// Of a running studio, each time that the same mesh was opened, shown in the same way.
  const MemoryWatch& running() const { return running_; }
  /// What was done last, latest last.
  const std::vector<std::string>& trail() const { return trail_; }

 private:
  using Operation = void (Soak::*)();
  struct Choice {
    int weight;
    const char* name;
    Operation run;
  };
  static const std::vector<Choice>& choices();

  // Operations (operations.cpp)
  void click_anything();
  void fill_anything();
  void press_keys();
  void click_in_picture();
  void drag_in_picture();
  void wheel_somewhere();
  void move_selection();
  void select_something();
  void walk_history();
  void change_history();
  void solve();
  void set_options();
  void write_files();
  void read_files();
  void resize_window();
  void settle_down();
  void insert_layers();
  void crash();
  bool kept_somewhere() const;
  void begin_again();

  void open_next();
  void sample_running();
  void resize(int width, int height);
  void answer_dialogs();
  void check();
  void note(const std::string& what);
  bool safe(const std::string& widget) const;
  bool inside(const std::filesystem::path& folder) const;

  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  bool chance(int percent) { return pick(100) < percent; }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1.0p-53);
  }
  ScreenPoint somewhere();
  ScreenPoint at_pivot() const;

  std::mt19937_64 random_;
  TemporaryFolder folder_;  // all that is written is below it
  std::unique_ptr<Rig> rig_;
  std::vector<std::filesystem::path> sources_;
  std::map<std::uint64_t, Coordinates> known_;  // mesh of each revision of the open document
  std::uint64_t generation_ = 0;
  static constexpr int first_width = 1100, first_height = 720;
  int width_ = first_width, height_ = first_height;
  int operations_ = 0, comparisons_ = 0, meshes_ = 0, restored_ = 0, ended_ = 0, since_open_ = 0;
  MemoryWatch memory_, running_;
  std::vector<std::string> trail_;
};

}  // namespace winslow::gui::test
