#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <streambuf>
#include <string>
#include <string_view>

namespace winslow::io {

/// True if the extension asks for compression: "mesh.su2.gz".
bool is_gzip_name(const std::filesystem::path& path);
/// True if the content of a file is compressed.
bool is_gzip(std::string_view bytes);

/// Decompresses a file; `name` is for messages. Throws InputError if the file is damaged, ends
/// early, or would grow by more than any mesh can be compressed.
std::string gunzip(std::string_view bytes, const std::string& name);

/// Compresses what is written to it and passes it on to another buffer.
class GzipBuffer : public std::streambuf {
 public:
  explicit GzipBuffer(std::streambuf& target);
  ~GzipBuffer() override;
  GzipBuffer(const GzipBuffer&) = delete;
  GzipBuffer& operator=(const GzipBuffer&) = delete;

  /// Writes the end of the compressed data. False if the target did not accept all of it.
  bool finish();

 protected:
  int_type overflow(int_type c) override;
  int sync() override;

 private:
  struct State;
  bool pass_on(int flush);

  std::streambuf& target_;
  std::unique_ptr<State> state_;
  bool good_ = true;
  std::array<char, 1 << 16> buffer_{};
};

}  // namespace winslow::io
