#include "io/tables/convergence_csv.h"

#include <charconv>

#include "io/file/atomic_file.h"

namespace winslow::io {
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

void write_convergence_csv(const std::filesystem::path& path,
                           const std::vector<ConvergenceTable>& tables) {
  write_atomically(path, [&](std::ostream& out) {
    out << "iteration,residual,largest_move,inverted,min_sine,damping,clipped,linear_iterations,"
           "fraction,command,stage\n";
    for (const ConvergenceTable& table : tables) {
      for (const IterationRecord& r : table.records) {
        out << r.iteration << ',' << Exact(r.residual) << ',' << Exact(r.largest_move) << ','
            << r.inverted << ',' << Exact(r.min_sine) << ',' << Exact(r.damping) << ','
            << (r.clipped ? 1 : 0) << ',' << r.linear_iterations << ',' << Exact(r.fraction) << ','
            << table.command << ',' << stage_name(r.stage) << '\n';
      }
    }
  });
}

}  // namespace winslow::io
