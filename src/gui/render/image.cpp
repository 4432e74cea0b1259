#include "gui/render/image.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <sstream>

#include "core/error.h"
#include "io/file/atomic_file.h"

namespace winslow::gui {
namespace {

void write_bytes(png_structp png, png_bytep data, png_size_t size) {
  auto& out = *static_cast<std::ostream*>(png_get_io_ptr(png));
  out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

void flush_bytes(png_structp) {}

/// libpng reports errors by longjmp: no C++ object may live between setjmp and its calls.
bool encode(png_structp png, png_infop info, const Image& image, std::ostream& out, png_bytep* rows,
            PngEffort effort) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, &out, write_bytes, flush_bytes);
  if (effort == PngEffort::little) {
    png_set_compression_level(png, 1);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  }
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_rows(png, info, rows);
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  return true;
}

}  // namespace

std::string png_of(const Image& image, PngEffort effort) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgba.size() != 4 * width * height) return {};
  std::vector<png_bytep> rows(height);
  for (std::size_t y = 0; y < height; ++y) {
    rows[y] = const_cast<png_bytep>(image.rgba.data() + 4 * width * y);
  }
  std::ostringstream out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool good = info != nullptr && encode(png, info, image, out, rows.data(), effort);
  png_destroy_write_struct(&png, &info);
  return good ? std::move(out).str() : std::string();
}

void write_png(const std::filesystem::path& path, const Image& image, PngEffort effort) {
  const std::string bytes = png_of(image, effort);
  if (bytes.empty())
    throw OutputError(path.string() + ": the picture is empty, or could not be encoded as PNG");
  io::write_atomically(path, [&](std::ostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

Image read_png(const std::filesystem::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&header, path.c_str()) == 0)
    throw InputError(path.string() + ": " + header.message);
  header.format = PNG_FORMAT_RGBA;
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.rgba.resize(PNG_IMAGE_SIZE(header));
  if (png_image_finish_read(&header, nullptr, image.rgba.data(), 0, nullptr) == 0)
    throw InputError(path.string() + ": " + header.message);
  return image;
}

void divide_by_alpha(Image& image) {
  for (std::size_t k = 0; k + 3 < image.rgba.size(); k += 4) {
    const unsigned alpha = image.rgba[k + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t c = k; c < k + 3; ++c) {
      const unsigned color = (image.rgba[c] * 255U + alpha / 2) / alpha;
      image.rgba[c] = static_cast<std::uint8_t>(std::min(color, 255U));
    }
  }
}

}  // namespace winslow::gui
