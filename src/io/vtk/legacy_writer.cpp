
#include "io/vtk/grid.h"

namespace winslow::io::vtk {
namespace {

using Kind = ValueKind;

/// Encodes a name: white space would end it, and '%' starts a code.
std::string encoded(const std::string& name) {
  static constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= ' ' || c == '%' || c == '"' || byte == 0x7f) {
      text += '%';
      text += digits[byte >> 4];
      text += digits[byte & 15];
    } else {
      text += c;
    }
  }
  return text;
}

/// Writes the numbers of an array, as text or as big-endian bytes.
class ArrayWriter {
 public:
  ArrayWriter(TextWriter& out, bool binary) : out_(out), binary_(binary) {}

  template <class Number>
  void put(Number value, char separator) {
    if (binary_) {
      out_.raw(value, true);
    } else {
      out_ << value << separator;
    }
  }
  void end() {
    if (binary_) out_ << '\n';
  }

 private:
  TextWriter& out_;
  bool binary_;
};

/// What the list of cells says of a cell: its nodes, of a polyhedron its face stream.
std::span<const std::int64_t> listed(const Grid& grid, std::size_t cell) {
  return grid.types[cell] == polyhedron ? grid.face_stream(cell) : grid.nodes(cell);
}

void write_cells(TextWriter& out, ArrayWriter& array, const Grid& grid) {
  std::size_t size = grid.cell_count();
  for (std::size_t c = 0; c < grid.cell_count(); ++c) size += listed(grid, c).size();
  out << "CELLS " << grid.cell_count() << ' ' << index_count(size, "numbers in a list of cells")
      << '\n';
  for (std::size_t c = 0; c < grid.cell_count(); ++c) {
    const auto numbers = listed(grid, c);
    array.put(static_cast<std::int32_t>(numbers.size()), ' ');
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      array.put(static_cast<std::int32_t>(numbers[k]), k + 1 == numbers.size() ? '\n' : ' ');
    }
  }
  array.end();
  out << "CELL_TYPES " << grid.cell_count() << '\n';
  for (const auto type : grid.types) array.put(static_cast<std::int32_t>(type), '\n');
  array.end();
}

/// The type as the source spelled it, if that is still the type.
std::string_view type_word(const DataArray& array) {
  return legacy_type(array.type_word) == array.type ? std::string_view(array.type_word)
                                                    : legacy_name(array.type);
}

/// The texts of an array of strings.
std::vector<std::string_view> strings_of(const DataArray& array) {
  std::vector<std::string_view> strings;
  std::string_view left = array.bytes;
  while (!left.empty()) {
    const auto end = std::min(left.find('\0'), left.size());
    strings.push_back(left.substr(0, end));
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return strings;
}

std::size_t tuples_of(const DataArray& array) {
  const std::size_t values =
      array.type.kind == Kind::text ? strings_of(array).size() : array.value_count();
  return array.components == 0 ? 0 : values / array.components;
}

bool has_colours(const DataArray& array) {
  return array.keyword == "LOOKUP_TABLE" || array.keyword == "COLOR_SCALARS";
}

/// Colours as numbers from 0 to 1, as text files have them, for bytes, and the other way.
DataArray with_other_colours(const DataArray& array) {
  DataArray other = array;
  const bool to_bytes = array.type.kind == Kind::floating;
  other.type = to_bytes ? ValueType{Kind::unsigned_integer, 1} : ValueType{Kind::floating, 4};
  other.bytes.clear();
  for (std::size_t i = 0; i < array.value_count(); ++i) {
    const double value = array.number(i);
    const double scaled = to_bytes ? std::round(255 * std::clamp(value, 0.0, 1.0)) : value / 255;
    append_value(other.bytes, other.type, std::to_string(scaled));
  }
  return other;
}

/// Writes the header and the values of the arrays of a legacy file.
class DataWriter {
 public:
  DataWriter(TextWriter& out, bool binary) : out_(out), binary_(binary) {}

  /// Arrays of one FIELD follow each other; the others have a keyword of their own.
  void write(const std::vector<DataArray>& arrays) {
    for (auto first = arrays.begin(); first != arrays.end();) {
      if (!first->keyword.empty()) {
        write_attribute(*first++);
        continue;
      }
      const auto last = std::find_if(first, arrays.end(), [&](const DataArray& array) {
        return !array.keyword.empty() || array.field != first->field;
      });
      out_ << "FIELD " << (first->field.empty() ? "FieldData" : first->field) << ' '
           << (last - first) << '\n';
      for (; first != last; ++first) {
        out_ << encoded(first->name) << ' ' << first->components << ' ' << tuples_of(*first) << ' '
             << type_word(*first) << '\n';
        write_values(*first);
      }
    }
  }

 private:
  void write_attribute(const DataArray& array) {
    const std::string& keyword = array.keyword;
    if (has_colours(array) && (array.type.kind == Kind::floating) == binary_)
      return write_attribute(with_other_colours(array));
    out_ << keyword << ' ' << encoded(array.name);
    if (keyword == "LOOKUP_TABLE")
      out_ << ' ' << tuples_of(array);
    else if (keyword == "COLOR_SCALARS" || keyword == "TEXTURE_COORDINATES")
      out_ << ' ' << array.components;
    if (keyword != "LOOKUP_TABLE" && keyword != "COLOR_SCALARS") out_ << ' ' << type_word(array);
    if (keyword == "SCALARS") {
      out_ << ' ' << array.components;
      if (!array.lookup_table.empty()) out_ << "\nLOOKUP_TABLE " << array.lookup_table;
    }
    out_ << '\n';
    write_values(array);
  }

  void write_values(const DataArray& array) {
    if (array.type.kind == Kind::text) {
      write_strings(array);
    } else if (!binary_) {
      write_lines(out_, array, std::max<std::size_t>(array.components, 1));
    } else {
      std::string bytes = array.bytes;
      swap_bytes(bytes, array.type.bytes);
      out_ << bytes << '\n';
    }
    out_ << array.metadata;
  }

  void write_strings(const DataArray& array) {
    for (const std::string_view text : strings_of(array)) {
      if (!binary_) {
        out_ << encoded(std::string(text)) << '\n';
        continue;
      }
      // The longest form of the length: 00 in the two top bits, then 62 bits.
      out_.raw(static_cast<std::uint64_t>(text.size()), true);
      out_ << text;
    }
    if (binary_) out_ << '\n';
  }

  TextWriter& out_;
  bool binary_;
};

void write_data(TextWriter& out, bool binary, const Grid& grid) {
  DataWriter writer(out, binary);
  const auto write = [&](const char* section, std::size_t count,
                         const std::vector<DataArray>& arrays) {
    if (arrays.empty()) return;
    out << section << ' ' << count << '\n';
    writer.write(arrays);
  };
  // Not before POINTS, where VTK itself puts them, because Gmsh expects POINTS in that line.
  writer.write(grid.data.field);
  write("CELL_DATA", grid.cell_count(), grid.data.cells);
  write("POINT_DATA", grid.points.size() / 3, grid.data.points);
}

}  // namespace

std::vector<std::string> write_legacy(std::ostream& stream, const Mesh& mesh,
                                      const FormatDetails* source, const WriteOptions& options) {
  std::vector<std::string> warnings;
  const Grid grid = to_grid(mesh, source, warnings);
  TextWriter out(stream);
  ArrayWriter array(out, options.binary);
  out << "# vtk DataFile Version 3.0\nmesh\n" << (options.binary ? "BINARY\n" : "ASCII\n");
  out << "DATASET UNSTRUCTURED_GRID\n";
  out << "POINTS " << grid.points.size() / 3 << " double\n";
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    array.put(grid.points[i], i % 3 == 2 ? '\n' : ' ');
  }
  array.end();
  write_cells(out, array, grid);
  write_data(out, options.binary, grid);
  return warnings;
}

}  // namespace winslow::io::vtk
