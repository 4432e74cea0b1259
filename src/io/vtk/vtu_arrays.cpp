#include "io/vtk/vtu_arrays.h"

#include <zlib.h>

#include <cstring>

#include "io/format/foreign_formats.h"
#include "io/text/numbers.h"
#include "io/vtk/lz4.h"

namespace winslow::io::vtk {
namespace {

constexpr std::string_view alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int, 256> values_of_letters() {
  std::array<int, 256> values{};
  for (auto& value : values) value = -1;
  for (std::size_t i = 0; i < alphabet.size(); ++i) {
    values[static_cast<unsigned char>(alphabet[i])] = static_cast<int>(i);
  }
  return values;
}

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

std::optional<std::string> decode_base64(std::string_view text) {
  static constexpr auto values = values_of_letters();
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t group = 0;
  int letters = 0;
  int padding = 0;
  for (const char c : text) {
    if (is_space(c)) continue;
    const int value = values[static_cast<unsigned char>(c)];
    if (c == '=') {
      ++padding;
    } else if (value < 0 || padding > 0) {
      return std::nullopt;
    }
    group = group << 6 | static_cast<std::uint32_t>(c == '=' ? 0 : value);
    if (++letters < 4) continue;
    if (padding > 2) return std::nullopt;
    for (int k = 0; k < 3 - padding; ++k) {
      bytes += static_cast<char>(group >> (16 - 8 * k) & 0xff);
    }
    group = 0;
    letters = padding = 0;
  }
  if (letters != 0) return std::nullopt;
  return bytes;
}

std::string encode_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto piece = bytes.substr(i, 3);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < piece.size() ? static_cast<unsigned char>(piece[k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= piece.size() ? alphabet[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

namespace {

/// Largest compression ratio of deflate; that of LZ4 is smaller.
constexpr std::uint64_t best_compression = 1032;
/// Coordinates and ids differ from one another, so their compression ratio is far lower. Small data
/// is not checked.
constexpr std::uint64_t likely_compression = 200, small_enough = 1 << 20;

std::string name_of(const pugi::xml_node& array) {
  return "array " + in_quotes(array.attribute("Name").value());
}

bool unpack_zlib(std::string_view packed, std::span<char> unpacked) {
  auto length = static_cast<uLongf>(unpacked.size());
  const int result = ::uncompress(reinterpret_cast<Bytef*>(unpacked.data()), &length,
                                  reinterpret_cast<const Bytef*>(packed.data()),
                                  static_cast<uLong>(packed.size()));
  return result == Z_OK && length == unpacked.size();
}

}  // namespace

VtuArrays::VtuArrays(const Source& source, const pugi::xml_node& file, std::size_t xml_begin,
                     std::size_t appended_begin, std::size_t appended_end, bool appended_base64)
    : source_(source),
      xml_begin_(xml_begin),
      appended_begin_(appended_begin),
      appended_end_(appended_end),
      appended_base64_(appended_base64) {
  const std::string_view order = file.attribute("byte_order").as_string("LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian") {
    fail(file, "byte_order " + in_quotes(order), "LittleEndian or BigEndian");
  }
  big_endian_ = order == "BigEndian";
  const std::string_view header = file.attribute("header_type").as_string("UInt32");
  if (header != "UInt32" && header != "UInt64") {
    fail(file, "header_type " + in_quotes(header), "UInt32 or UInt64");
  }
  header_bytes_ = header == "UInt64" ? 8 : 4;
  const std::string_view compressor = file.attribute("compressor").value();
  lz4_ = compressor == "vtkLZ4DataCompressor";
  if (!compressor.empty() && !lz4_ && compressor != "vtkZLibDataCompressor") {
    fail(file, "compressor " + in_quotes(compressor),
         "vtkZLibDataCompressor, vtkLZ4DataCompressor or none; ParaView writes it so: " +
             paraview_command(source.name(), "OpenDataFile('IN'), CompressorType='ZLib'"));
  }
  compressed_ = !compressor.empty();
}

std::size_t VtuArrays::place(const pugi::xml_node& node) const {
  const auto offset = node.offset_debug();
  return xml_begin_ + (offset < 0 ? 0 : static_cast<std::size_t>(offset));
}

void VtuArrays::fail(const pugi::xml_node& array, const std::string& found,
                     const std::string& expected) const {
  source_.fail(place(array), found, expected);
}

ValueType VtuArrays::value_type(const pugi::xml_node& array) const {
  const std::string_view name = array.attribute("type").value();
  if (const auto type = xml_type(name)) return *type;
  fail(array, "type " + in_quotes(name) + " of " + name_of(array), "Float64, Int32 or the like");
}

BinaryNumber VtuArrays::type_of(const pugi::xml_node& array) const {
  const ValueType type = value_type(array);
  if (type.whole() || type.kind == ValueKind::floating) return type.number();
  fail(array, "type " + in_quotes(xml_name(type)) + " of " + name_of(array),
       "Float64, Int32 or the like");
}

/// The text between the tags in the source.
std::string_view VtuArrays::inline_text(const pugi::xml_node& array) const {
  for (const auto& child : array.children()) {
    if (child.type() != pugi::node_pcdata) continue;
    const std::size_t begin = place(child);
    const auto text = source_.text();
    const auto end = text.find('<', begin);
    return text.substr(begin, end == std::string_view::npos ? end : end - begin);
  }
  return {};
}

std::uint64_t VtuArrays::integer_at(std::string_view bytes, std::size_t begin,
                                    std::size_t width) const {
  return unsigned_at(bytes.data() + begin, width, big_endian_);
}

/// Decodes base64, removes the header and decompresses.
std::string VtuArrays::base64_content(std::string_view text, const pugi::xml_node& array,
                                      Count count) const {
  const auto bytes = decode_base64(trimmed(text));
  if (!bytes) fail(array, "malformed base64 in " + name_of(array), "base64");
  std::size_t first = 0;
  return content(*bytes, array, first, count);
}

/// `first`: receives the position in `stream` of the first byte of uncompressed data.
std::string VtuArrays::content(std::string_view stream, const pugi::xml_node& array,
                               std::size_t& first, Count count) const {
  if (stream.size() < header_bytes_)
    fail(array, "the end of the data", "the size of " + name_of(array));
  if (compressed_) return inflated(stream, array, count);
  const std::uint64_t size = integer_at(stream, 0, header_bytes_);
  if (size > stream.size() - header_bytes_) {
    fail(array, std::to_string(size) + " bytes in " + name_of(array),
         "at most the " + std::to_string(stream.size() - header_bytes_) + " that are left");
  }
  first = header_bytes_;
  return std::string(stream.substr(header_bytes_, static_cast<std::size_t>(size)));
}

/// Checks the sizes that the header of compressed data declares.
void VtuArrays::check_sizes(std::string_view stream, const pugi::xml_node& array,
                            Count count) const {
  const std::size_t w = header_bytes_;
  const std::uint64_t blocks = integer_at(stream, 0, w);
  const std::uint64_t block_size = integer_at(stream, w, w);
  const std::uint64_t last_size = integer_at(stream, 2 * w, w);
  const std::uint64_t most = stream.size() * best_compression;
  std::uint64_t total = last_size != 0 ? last_size : block_size;
  if (total <= most && block_size > 0 && blocks - 1 > (most - total) / block_size) total = most + 1;
  if (total <= most) total += (blocks - 1) * block_size;
  std::uint64_t packed = 0;
  for (std::uint64_t b = 0; b < blocks && packed <= stream.size(); ++b)
    packed += integer_at(stream, static_cast<std::size_t>(3 + b) * w, w);
  packed = std::min<std::uint64_t>(packed, stream.size());
  if (count && total != *count * type_of(array).bytes) {
    fail(array, (total > most ? "too many" : std::to_string(total)) + " bytes in " + name_of(array),
         std::to_string(*count) + " numbers, " + std::to_string(*count * type_of(array).bytes) +
             " bytes");
  }
  if (!count && total > std::max(small_enough, packed * likely_compression)) {
    fail(array,
         std::to_string(packed) + " bytes that are to unpack to " +
             (total > most ? "more than they can" : std::to_string(total)) + " in " +
             name_of(array),
         "no more than " + std::to_string(likely_compression) + " times as many");
  }
}

/// Header: number of blocks, their size, the size of the last one (0: full), compressed sizes.
std::string VtuArrays::inflated(std::string_view stream, const pugi::xml_node& array,
                                Count count) const {
  const std::size_t w = header_bytes_;
  const std::uint64_t blocks = integer_at(stream, 0, w);
  if (blocks == 0) return {};
  if (blocks > stream.size() / w || (blocks + 3) * w > stream.size()) {
    fail(array, std::to_string(blocks) + " compressed blocks in " + name_of(array),
         "at most what the data can hold");
  }
  check_sizes(stream, array, count);
  const std::uint64_t block_size = integer_at(stream, w, w);
  const std::uint64_t last_size = integer_at(stream, 2 * w, w);
  std::string data;
  std::size_t start = static_cast<std::size_t>(blocks + 3) * w;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t packed = integer_at(stream, static_cast<std::size_t>(3 + b) * w, w);
    const std::uint64_t size = b + 1 == blocks && last_size != 0 ? last_size : block_size;
    if (packed > stream.size() - start || size / best_compression > packed) {
      fail(array, "a compressed block of " + std::to_string(packed) + " bytes in " + name_of(array),
           "sizes that fit the data");
    }
    const std::size_t before = data.size();
    data.resize(before + static_cast<std::size_t>(size));
    const std::span<char> block(data.data() + before, static_cast<std::size_t>(size));
    const auto bytes = stream.substr(start, static_cast<std::size_t>(packed));
    if (!(lz4_ ? unpack_lz4(bytes, block) : unpack_zlib(bytes, block))) {
      const std::string name = lz4_ ? "LZ4" : "zlib";
      fail(array, "compressed data that " + name + " refuses in " + name_of(array), name + " data");
    }
    start += static_cast<std::size_t>(packed);
  }
  return data;
}

std::string VtuArrays::appended_bytes(const pugi::xml_node& array, std::size_t& first,
                                      Count count) const {
  const std::string_view text = array.attribute("offset").value();
  const auto offset = parse_integer(text);
  const std::size_t size = appended_end_ - appended_begin_;
  if (!offset || *offset < 0 || static_cast<std::uint64_t>(*offset) >= size) {
    fail(array, "offset " + in_quotes(text) + " of " + name_of(array),
         "an offset into AppendedData of " + std::to_string(size) + " bytes");
  }
  const std::size_t begin = appended_begin_ + static_cast<std::size_t>(*offset);
  const auto stream = source_.text().substr(begin, appended_end_ - begin);
  if (!appended_base64_) {
    std::size_t skipped = 0;
    std::string bytes = content(stream, array, skipped, count);
    first = begin + skipped;
    return bytes;
  }
  first = begin;
  return base64_content(appended_piece(stream, array), array, count);
}

/// The base64 text of one array. The next array follows directly, so only the header tells its end.
std::string_view VtuArrays::appended_piece(std::string_view stream,
                                           const pugi::xml_node& array) const {
  const auto encoded_size = [](std::uint64_t bytes) { return (bytes + 2) / 3 * 4; };
  const auto head = [&](std::uint64_t bytes) {
    const auto letters = static_cast<std::size_t>(encoded_size(bytes));
    const auto decoded = decode_base64(stream.substr(0, letters));
    if (!decoded || decoded->size() < bytes) {
      fail(array, "malformed base64 in " + name_of(array), "the size of the data");
    }
    return *decoded;
  };
  const std::uint64_t most = stream.size();
  std::string header = head(header_bytes_);
  const std::uint64_t first = integer_at(header, 0, header_bytes_);
  if (first > most) return stream;  // rejected when the data is decoded
  if (!compressed_) {
    // VTK pads the header separately; other writers encode it together with the data.
    const bool padded = stream.substr(0, encoded_size(header_bytes_)).find('=') != stream.npos;
    return stream.substr(0, padded ? encoded_size(header_bytes_) + encoded_size(first)
                                   : encoded_size(header_bytes_ + first));
  }
  const std::uint64_t header_size = (first + 3) * header_bytes_;
  if (header_size > most) return stream;
  header = head(header_size);
  std::uint64_t packed = 0;
  for (std::uint64_t b = 0; b < first; ++b) {
    const auto start = static_cast<std::size_t>(3 + b) * header_bytes_;
    packed += std::min(integer_at(header, start, header_bytes_), most);
  }
  return stream.substr(0, encoded_size(header_size) + encoded_size(std::min(packed, most)));
}

std::string VtuArrays::bytes_of(const pugi::xml_node& array, std::size_t& first,
                                Count count) const {
  const std::string_view format = array.attribute("format").as_string("ascii");
  if (format == "appended") return appended_bytes(array, first, count);
  if (format != "binary") {
    fail(array, "format " + in_quotes(format) + " of " + name_of(array),
         "ascii, binary or appended");
  }
  const auto text = inline_text(array);
  first = text.empty() ? place(array) : source_.offset_of(text);
  return text.empty() ? std::string() : base64_content(text, array, count);
}

template <class Number>
std::vector<Number> VtuArrays::read(const pugi::xml_node& array, std::vector<std::size_t>* places,
                                    Count count) const {
  const BinaryNumber type = type_of(array);
  std::vector<Number> values;
  if (std::string_view(array.attribute("format").as_string("ascii")) == "ascii") {
    const auto text = inline_text(array);
    if (text.empty()) return values;
    const std::size_t begin = source_.offset_of(text);
    Scanner scan(source_, begin, begin + text.size());
    for (auto word = scan.next_word(); !word.empty(); word = scan.next_word()) {
      if (places != nullptr) places->push_back(source_.offset_of(word));
      const auto value = parse<Number>(word);
      if (!value)
        scan.fail(word, (std::is_integral_v<Number> ? "an integer in " : "a number in ") +
                            name_of(array));
      values.push_back(*value);
    }
    return values;
  }
  if (std::is_integral_v<Number> && type.floating) {
    fail(array, "numbers with a fraction in " + name_of(array), "integers");
  }
  std::size_t first = 0;
  const std::string bytes = bytes_of(array, first, count);
  if (bytes.size() % type.bytes != 0) {
    fail(array, std::to_string(bytes.size()) + " bytes in " + name_of(array),
         "a multiple of " + std::to_string(type.bytes));
  }
  values.reserve(bytes.size() / type.bytes);
  for (std::size_t start = 0; start < bytes.size(); start += type.bytes) {
    if (places != nullptr) places->push_back(first + (compressed_ ? 0 : start));
    values.push_back(number_at<Number>(bytes.data() + start, type, big_endian_));
  }
  return values;
}

std::vector<double> VtuArrays::numbers(const pugi::xml_node& array,
                                       std::vector<std::size_t>* places, Count count) const {
  return read<double>(array, places, count);
}

std::vector<std::int64_t> VtuArrays::integers(const pugi::xml_node& array,
                                              std::vector<std::size_t>* places, Count count) const {
  return read<std::int64_t>(array, places, count);
}

}  // namespace winslow::io::vtk
