#include "app/output/history_csv.h"

#include <array>
#include <charconv>
#include <ostream>
#include <string_view>

#include "io/atomic_file.h"

namespace winslow::app {
namespace {

/// A number that reads back to the same bits, whatever the locale.
class Exact {
 public:
  explicit Exact(double value)
      : end_(std::to_chars(text_.data(), text_.data() + text_.size(), value).ptr) {}
  friend std::ostream& operator<<(std::ostream& out, const Exact& number) {
    return out << std::string_view(number.text_.data(),
                                   static_cast<std::size_t>(number.end_ - number.text_.data()));
  }

 private:
  std::array<char, 32> text_;
  char* end_;
};

}  // namespace

void write_history(const std::filesystem::path& path, const std::vector<CommandRecord>& commands) {
  io::write_atomically(path, [&](std::ostream& out) {
    out << "iteration,residual,largest_move,inverted,min_sine,damping,clipped,linear_iterations,"
           "fraction,command,stage\n";
    int number = 0;
    for (const CommandRecord& command : commands) {
      ++number;
      for (const IterationRecord& r : command.result.history) {
        out << r.iteration << ',' << Exact(r.residual) << ',' << Exact(r.largest_move) << ','
            << r.inverted << ',' << Exact(r.min_sine) << ',' << Exact(r.damping) << ','
            << (r.clipped ? 1 : 0) << ',' << r.linear_iterations << ',' << Exact(r.fraction) << ','
            << number << ',' << stage_name(r.stage) << '\n';
      }
    }
  });
}

}  // namespace winslow::app
