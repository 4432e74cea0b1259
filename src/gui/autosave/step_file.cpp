#include "gui/autosave/step_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"

namespace winslow::gui {

namespace {

/// Also tells a machine with another order of bytes.
constexpr std::uint64_t magic = 0x0001504554534e57;  // "WNSTEP", version 1

/// FNV-1a, 64 bits.
class Checksum {
 public:
  void add(const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      value_ = (value_ ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3ull;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}
  template <class Number>
  void number(Number value) {
    static_assert(std::is_trivially_copyable_v<Number>);
    bytes(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void numbers(std::span<const double> values) {
    number<std::uint64_t>(values.size());
    bytes(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void text(std::string_view text) {
    number<std::uint64_t>(text.size());
    bytes(text.data(), text.size());
  }
  void finish() {
    const std::uint64_t sum = sum_.value();
    out_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
  }

 private:
  void bytes(const char* data, std::size_t count) {
    sum_.add(data, count);
    out_.write(data, static_cast<std::streamsize>(count));
  }
  std::ostream& out_;
  Checksum sum_;
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::filesystem::path& path) : left_(bytes), path_(path) {}
  template <class Number>
  void number(Number& value) {
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  void numbers(std::vector<double>& values) {
    const std::size_t count = length(sizeof(double));
    values.resize(count);
    if (count > 0)
      std::memcpy(values.data(), take(count * sizeof(double)).data(), count * sizeof(double));
  }
  void text(std::string& text) { text = take(length(1)); }
  /// A count of things of `size` bytes that follow.
  std::size_t length(std::size_t size) {
    std::uint64_t count = 0;
    number(count);
    if (count > left_.size() / size) fail("a length beyond its end");
    return count;
  }
  bool empty() const { return left_.empty(); }
  [[noreturn]] void fail(const std::string& found) const {
    throw InputError(path_.string() + ": found " + found + ", expected a saved step");
  }

 private:
  std::string_view take(std::size_t count) {
    if (count > left_.size()) fail("an early end");
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }
  std::string_view left_;
  const std::filesystem::path& path_;
};

/// Every field of a record, named once for reading and writing.
template <class Archive, class Record>
void record_fields(Archive& archive, Record& r) {
  archive.number(r.iteration);
  archive.number(r.residual);
  archive.number(r.largest_move);
  archive.number(r.inverted);
  archive.number(r.min_sine);
  archive.number(r.damping);
  archive.number(r.clipped);
  archive.number(r.linear_iterations);
  archive.number(r.fraction);
  archive.number(r.stage);
}

template <class Archive, class Result>
void result_fields(Archive& archive, Result& r) {
  archive.number(r.converged);
  archive.number(r.outer_iterations);
  archive.number(r.linear_solves);
  archive.number(r.residual);
  archive.number(r.out_of_iterations);
  archive.number(r.fraction_reached);
  archive.number(r.increments);
  archive.text(r.linear_solver);
  archive.number(r.inverted);
}

/// Bytes of a file without the checksum at its end.
std::string checked_content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string() + ": cannot be read: " + std::strerror(errno));
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::uint64_t expected = 0;
  if (bytes.size() < sizeof expected)
    throw InputError(path.string() + ": found " + std::to_string(bytes.size()) +
                     " bytes, expected a saved step");
  const std::size_t size = bytes.size() - sizeof expected;
  std::memcpy(&expected, bytes.data() + size, sizeof expected);
  bytes.resize(size);
  Checksum sum;
  sum.add(bytes.data(), bytes.size());
  if (sum.value() != expected)
    throw InputError(path.string() + ": found another checksum than it had when it was written");
  return bytes;
}

}  // namespace

void write_step(const std::filesystem::path& path, const Coordinates& coordinates,
                const SmoothResult& smooth) {
  io::write_atomically(path, [&](std::ostream& out) {
    Writer writer(out);
    writer.number(magic);
    writer.number(coordinates.dimension());
    writer.numbers(coordinates.values());
    result_fields(writer, smooth);
    writer.number<std::uint64_t>(smooth.history.size());
    for (const IterationRecord& record : smooth.history) record_fields(writer, record);
    writer.finish();
  });
}

StepData read_step(const std::filesystem::path& path) {
  const std::string bytes = checked_content(path);
  Reader reader(bytes, path);
  std::uint64_t found = 0;
  reader.number(found);
  if (found != magic) reader.fail("something else");
  int dimension = 0;
  reader.number(dimension);
  std::vector<double> values;
  reader.numbers(values);
  if (dimension < 2 || dimension > 3 || values.size() % static_cast<std::size_t>(dimension) != 0)
    reader.fail(std::to_string(values.size()) + " numbers in " + std::to_string(dimension) +
                " dimensions");
  StepData step;
  step.coordinates = Coordinates(
      dimension, static_cast<Index>(values.size() / static_cast<std::size_t>(dimension)));
  std::copy(values.begin(), values.end(), step.coordinates.values().begin());
  result_fields(reader, step.smooth);
  step.smooth.history.resize(reader.length(16));
  for (IterationRecord& record : step.smooth.history) record_fields(reader, record);
  if (!reader.empty()) reader.fail("more than one");
  return step;
}

}  // namespace winslow::gui
