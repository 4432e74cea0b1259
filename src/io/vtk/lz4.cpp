#include "io/vtk/lz4.h"

#include <cstddef>
#include <optional>

namespace winslow::io::vtk {
namespace {

/// Unpacks the sequences of a block: literals, then a copy of what came before.
class Unpacker {
 public:
  Unpacker(std::string_view packed, std::span<char> unpacked) : in_(packed), out_(unpacked) {}

  bool run() {
    while (!in_.empty()) {
      const unsigned token = next();
      const auto literals = length(token >> 4);
      if (!literals || !take(*literals)) return false;
      if (in_.empty()) break;  // the last sequence has literals only
      if (in_.size() < 2) return false;
      const std::size_t low = next(), high = next();
      const auto copies = length(token & 15);
      constexpr std::size_t shortest = 4;
      if (!copies || !repeat(low | high << 8, *copies + shortest)) return false;
    }
    return done_ == out_.size();
  }

 private:
  unsigned next() {
    const auto byte = static_cast<unsigned char>(in_.front());
    in_.remove_prefix(1);
    return byte;
  }

  /// A length of four bits; 15 means that bytes follow that add to it, up to one below 255.
  std::optional<std::size_t> length(std::size_t bits) {
    if (bits < 15) return bits;
    for (unsigned more = 255; more == 255;) {
      if (in_.empty()) return std::nullopt;
      more = next();
      bits += more;
    }
    return bits;
  }

  bool take(std::size_t count) {
    if (count > in_.size() || count > out_.size() - done_) return false;
    in_.copy(out_.data() + done_, count);
    in_.remove_prefix(count);
    done_ += count;
    return true;
  }

  /// Byte by byte, because the copy may overlap what it copies.
  bool repeat(std::size_t distance, std::size_t count) {
    if (distance == 0 || distance > done_ || count > out_.size() - done_) return false;
    for (; count > 0; --count, ++done_) out_[done_] = out_[done_ - distance];
    return true;
  }

  std::string_view in_;
  std::span<char> out_;
  std::size_t done_ = 0;
};

}  // namespace

bool unpack_lz4(std::string_view packed, std::span<char> unpacked) {
  return Unpacker(packed, unpacked).run();
}

}  // namespace winslow::io::vtk
