#include "io/file/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "core/error.h"

namespace winslow::io {
namespace {

/// zlib's window, and the flag that asks for a gzip header.
constexpr int gzip_window = 15 + 16;

/// Text of meshes is compressed to a fifth or a tenth. A large file that grows by more than this
/// factor is an attempt to fill the memory.
constexpr std::size_t largest_growth = 200, small_enough = std::size_t{64} << 20;

Bytef* bytes_of(char* data) { return reinterpret_cast<Bytef*>(data); }

class Inflater {
 public:
  Inflater() {
    if (::inflateInit2(&stream_, gzip_window) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { ::inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  z_stream& stream() { return stream_; }

 private:
  z_stream stream_ = {};
};

}  // namespace

bool is_gzip_name(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".gz" || extension == ".GZ";
}

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string gunzip(std::string_view bytes, const std::string& name) {
  Inflater inflater;
  z_stream& z = inflater.stream();
  std::string text;
  const std::size_t most = std::max(small_enough, bytes.size() * largest_growth);
  std::array<char, 1 << 16> piece;
  std::string_view rest = bytes;
  for (;;) {
    const auto taken = std::min<std::size_t>(rest.size(), std::numeric_limits<uInt>::max());
    z.next_in = bytes_of(const_cast<char*>(rest.data()));  // zlib does not write here
    z.avail_in = static_cast<uInt>(taken);
    z.next_out = bytes_of(piece.data());
    z.avail_out = static_cast<uInt>(piece.size());
    const int result = ::inflate(&z, Z_NO_FLUSH);
    rest.remove_prefix(taken - z.avail_in);
    text.append(piece.data(), piece.size() - z.avail_out);
    if (text.size() > most) {
      throw InputError(name + ": found compressed data that grows to more than " +
                       std::to_string(largest_growth) + " times its size, expected a mesh");
    }
    if (result == Z_STREAM_END) {
      if (!is_gzip(rest)) return text;
      ::inflateReset(&z);  // several compressed files in one
    } else if (result == Z_BUF_ERROR && rest.empty()) {
      throw InputError(name + ": found the end of the compressed data, expected more of it");
    } else if (result != Z_OK) {
      throw InputError(name + ": byte " + std::to_string(bytes.size() - rest.size()) +
                       ": found data that zlib refuses, expected a file compressed by gzip");
    }
  }
}

struct GzipBuffer::State {
  z_stream stream = {};
  std::array<char, 1 << 16> packed{};
};

GzipBuffer::GzipBuffer(std::streambuf& target)
    : target_(target), state_(std::make_unique<State>()) {
  constexpr int memory_level = 8;
  if (::deflateInit2(&state_->stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window, memory_level,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

GzipBuffer::~GzipBuffer() { ::deflateEnd(&state_->stream); }

bool GzipBuffer::pass_on(int flush) {
  z_stream& z = state_->stream;
  z.next_in = bytes_of(pbase());
  z.avail_in = static_cast<uInt>(pptr() - pbase());
  do {
    z.next_out = bytes_of(state_->packed.data());
    z.avail_out = static_cast<uInt>(state_->packed.size());
    ::deflate(&z, flush);
    const auto size = static_cast<std::streamsize>(state_->packed.size() - z.avail_out);
    good_ = good_ && target_.sputn(state_->packed.data(), size) == size;
  } while (good_ && z.avail_out == 0);
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  return good_;
}

GzipBuffer::int_type GzipBuffer::overflow(int_type c) {
  if (!pass_on(Z_NO_FLUSH)) return traits_type::eof();
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  return sputc(traits_type::to_char_type(c));
}

int GzipBuffer::sync() { return pass_on(Z_NO_FLUSH) ? 0 : -1; }

bool GzipBuffer::finish() { return pass_on(Z_FINISH) && target_.pubsync() == 0; }

}  // namespace winslow::io
