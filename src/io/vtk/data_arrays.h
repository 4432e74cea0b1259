#pragma once

#include <utility>
#include <vector>

#include "io/text/numbers.h"

/// The arrays on points and cells and of the field of a VTK file, kept from reading to writing:
///
///     DataArray array{"MaterialIDs", {ValueKind::signed_integer, 4}};
///     append_value(array.bytes, array.type, "3");
///     array.value_count();  // 1
namespace winslow::io::vtk {

enum class ValueKind : std::uint8_t { signed_integer, unsigned_integer, floating, bit, text };

/// The type of the values of an array.
struct ValueType {
  ValueKind kind = ValueKind::floating;
  std::size_t bytes = 8;  ///< of a value; 1 for bits and characters

  bool operator==(const ValueType&) const = default;
  bool whole() const {
    return kind == ValueKind::signed_integer || kind == ValueKind::unsigned_integer;
  }
  BinaryNumber number() const {
    return {kind == ValueKind::floating, kind == ValueKind::signed_integer, bytes};
  }
};

/// Names of types: "Float64", "Int32" in XML; "double", "int" in legacy files. Legacy names of both
/// cases are known, and vtkIdType, which such files hold in 32 bits.
std::optional<ValueType> xml_type(std::string_view name);
std::string xml_name(const ValueType& type);
std::optional<ValueType> legacy_type(std::string_view name);
std::string_view legacy_name(const ValueType& type);

/// One array. What only one of the two formats says about it stays with it, for the way back.
struct DataArray {
  std::string name;
  ValueType type;
  std::size_t components = 1;
  /// The values, tuple after tuple, little-endian. Bits: eight in a byte, the first one highest.
  /// Texts: each ended by a zero.
  std::string bytes = {};
  std::size_t bits = 0;  ///< number of values of an array of bits

  /// Of the XML element, beside name, type and place of the data.
  std::vector<std::pair<std::string, std::string>> attributes = {};
  std::string children = {};   ///< XML of the elements inside (InformationKey)
  bool plain_element = false;  ///< an <Array>, as older files have it, and no <DataArray>

  std::string keyword = {};       ///< SCALARS, VECTORS, ... of a legacy file; empty: in a FIELD
  std::string field = {};         ///< name of that FIELD
  std::string type_word = {};     ///< the type as the legacy file spells it
  std::string lookup_table = {};  ///< of SCALARS
  std::string metadata = {};      ///< lines of METADATA behind the array, with the empty one

  /// Number of values; of texts, of characters with the zeros.
  std::size_t value_count() const;
  double number(std::size_t value) const;
};

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// All arrays of a file, in its order.
struct DataArrays {
  std::vector<DataArray> points, cells, field;
  Attributes point_attributes, cell_attributes;  ///< of <PointData> and <CellData>: active arrays

  bool empty() const { return points.empty() && cells.empty() && field.empty(); }
  /// "Pressure, Velocity and 3 more": for messages. Without winslow's own arrays, which are made
  /// anew from markers and regions; empty if there are no others.
  std::string names() const;
};

/// Appends the number that a word says. A whole number may be written with a fraction of zero.
/// Returns false for a word that is no such number.
bool append_value(std::string& bytes, const ValueType& type, std::string_view word);
/// Appends a value as the shortest text that gives the same value again.
void append_text(std::string& text, const DataArray& array, std::size_t value);
/// Writes the values of an array in lines of `per_line`.
void write_lines(TextWriter& out, const DataArray& array, std::size_t per_line);
/// Packs zeros and ones into bits, and the other way.
std::string packed_bits(const std::string& values);
bool bit_at(const std::string& bytes, std::size_t index);
/// Reverses the bytes of each value, for the other byte order.
void swap_bytes(std::string& bytes, std::size_t width);

/// An array of 32-bit integers.
DataArray integer_array(std::string name, const std::vector<int>& values);

}  // namespace winslow::io::vtk
