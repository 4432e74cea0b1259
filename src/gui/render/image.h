#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace winslow::gui {

/// 8-bit RGBA pixels, row after row from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x));
  }
};

/// How much time is spent to make the file small.
enum class PngEffort { normal, little };

/// Writes a PNG, first under a temporary name. Throws OutputError.
void write_png(const std::filesystem::path& path, const Image& image,
               PngEffort effort = PngEffort::normal);

/// The same as bytes: an empty string where the picture is empty or could not be encoded.
std::string png_of(const Image& image, PngEffort effort = PngEffort::normal);

/// Reads a PNG of any colour type. Throws InputError.
Image read_png(const std::filesystem::path& path);

/// Divides colours by their alpha, as files need them: OpenGL's blending over a transparent
/// background leaves them multiplied by it.
void divide_by_alpha(Image& image);

}  // namespace winslow::gui
