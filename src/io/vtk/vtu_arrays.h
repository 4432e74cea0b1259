#pragma once

#include <pugixml.hpp>

#include "io/text/numbers.h"
#include "io/text/source.h"
#include "io/vtk/data_arrays.h"

namespace winslow::io::vtk {

/// Decodes base64 text. White space is skipped; several padded pieces may follow each other (VTK
/// encodes the header of an array separately). Returns nothing if the text is malformed.
std::optional<std::string> decode_base64(std::string_view text);
std::string encode_base64(std::string_view bytes);

/// Decodes the DataArray elements of one VTK XML file.
class VtuArrays {
 public:
  /// `file`: the VTKFile element. `xml_begin`: offset in the source of the text that pugixml
  /// parsed. Appended data (what follows its '_') lies in [appended_begin, appended_end); both 0:
  /// none.
  VtuArrays(const Source& source, const pugi::xml_node& file, std::size_t xml_begin,
            std::size_t appended_begin, std::size_t appended_end, bool appended_base64);

  /// Offset of an element in the source.
  std::size_t place(const pugi::xml_node& node) const;

  /// Expected number of values, if other arrays determine it. Compressed data of another size is
  /// rejected before memory is allocated. Without a count, data with a compression ratio impossible
  /// for coordinates and ids is rejected.
  using Count = std::optional<std::size_t>;
  /// Reads all numbers of an array. `places`, if given, receives the byte offset of each (that of
  /// the array, if single numbers have none).
  std::vector<double> numbers(const pugi::xml_node& array,
                              std::vector<std::size_t>* places = nullptr, Count count = {}) const;
  std::vector<std::int64_t> integers(const pugi::xml_node& array,
                                     std::vector<std::size_t>* places = nullptr,
                                     Count count = {}) const;
  /// Reads an array to be written again. tuples: their number, if other arrays determine it. Throws
  /// InputError for another number of values.
  DataArray data_array(const pugi::xml_node& array, Count tuples) const;
  /// The type that an array names. Throws InputError for an unknown one.
  ValueType value_type(const pugi::xml_node& array) const;

 private:
  std::string values_of(const pugi::xml_node& array, const ValueType& type, Count count) const;
  BinaryNumber type_of(const pugi::xml_node& array) const;
  std::string_view inline_text(const pugi::xml_node& array) const;
  std::string bytes_of(const pugi::xml_node& array, std::size_t& first, Count count) const;
  std::string appended_bytes(const pugi::xml_node& array, std::size_t& first, Count count) const;
  std::string_view appended_piece(std::string_view stream, const pugi::xml_node& array) const;
  std::string content(std::string_view stream, const pugi::xml_node& array, std::size_t& first,
                      Count count) const;
  std::string base64_content(std::string_view text, const pugi::xml_node& array, Count count) const;
  void check_sizes(std::string_view stream, const pugi::xml_node& array, Count count) const;
  std::string inflated(std::string_view stream, const pugi::xml_node& array, Count count) const;
  std::uint64_t integer_at(std::string_view bytes, std::size_t begin, std::size_t width) const;
  [[noreturn]] void fail(const pugi::xml_node& array, const std::string& found,
                         const std::string& expected) const;
  template <class Number>
  std::vector<Number> read(const pugi::xml_node& array, std::vector<std::size_t>* places,
                           Count count) const;

  const Source& source_;
  std::size_t xml_begin_;
  std::size_t appended_begin_;
  std::size_t appended_end_;
  bool appended_base64_;
  bool big_endian_ = false;
  bool compressed_ = false;
  bool lz4_ = false;  ///< compressed by LZ4, not by zlib
  std::size_t header_bytes_ = 4;
};

}  // namespace winslow::io::vtk
