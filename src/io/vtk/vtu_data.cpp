#include <sstream>

#include "io/vtk/vtu_arrays.h"

namespace winslow::io::vtk {
namespace {

/// Attributes that say where the data are and how they are encoded: those of the output differ.
bool is_kept(std::string_view name) {
  return name != "type" && name != "Name" && name != "format" && name != "offset" &&
         name != "encoding";
}

/// The XML of the elements inside an array.
std::string children_of(const pugi::xml_node& array) {
  std::ostringstream text;
  for (const auto& child : array.children())
    if (child.type() == pugi::node_element) child.print(text, "", pugi::format_raw);
  return text.str();
}

}  // namespace

/// The values; bits of a text one by one, each in a byte. count: their number, if it is known.
std::string VtuArrays::values_of(const pugi::xml_node& array, const ValueType& type,
                                 Count count) const {
  const std::string what = "array " + in_quotes(array.attribute("Name").value());
  if (std::string_view(array.attribute("format").as_string("ascii")) == "ascii") {
    std::string bytes;
    const auto text = inline_text(array);
    if (text.empty()) return bytes;
    const std::size_t begin = source_.offset_of(text);
    Scanner scan(source_, begin, begin + text.size());
    for (auto word = scan.next_word(); !word.empty(); word = scan.next_word()) {
      if (!append_value(bytes, type, word))
        scan.fail(word, "a value of the type " + xml_name(type) + " in " + what);
    }
    return bytes;
  }
  std::size_t first = 0;
  std::string bytes = bytes_of(array, first, type.kind == ValueKind::bit ? Count() : count);
  if (bytes.size() % type.bytes != 0)
    fail(array, std::to_string(bytes.size()) + " bytes in " + what,
         "a multiple of " + std::to_string(type.bytes));
  if (big_endian_) swap_bytes(bytes, type.bytes);
  return bytes;
}

DataArray VtuArrays::data_array(const pugi::xml_node& array, Count tuples) const {
  DataArray kept{array.attribute("Name").value(), value_type(array)};
  const std::string what = "array " + in_quotes(kept.name);
  const std::string_view components = array.attribute("NumberOfComponents").as_string("1");
  const auto number = parse_integer(components);
  constexpr std::int64_t most = 1 << 20;
  if (!number || *number < 0 || *number > most)
    fail(array, "NumberOfComponents " + in_quotes(components) + " of " + what,
         "0 to " + std::to_string(most));
  kept.components = static_cast<std::size_t>(*number);
  Count count;
  if (tuples && kept.type.kind != ValueKind::text) count = *tuples * kept.components;
  kept.bytes = values_of(array, kept.type, count);
  if (kept.type.kind == ValueKind::bit) {
    const bool text = std::string_view(array.attribute("format").as_string("ascii")) == "ascii";
    const std::size_t held = text ? kept.bytes.size() : 8 * kept.bytes.size();
    kept.bits = !text && count && (*count + 7) / 8 == kept.bytes.size() ? *count : held;
    if (text) kept.bytes = packed_bits(kept.bytes);
  }
  if (count && *count != kept.value_count())
    fail(array, std::to_string(kept.value_count()) + " values in " + what,
         std::to_string(*tuples) + " times " + std::to_string(kept.components));
  for (const auto& attribute : array.attributes())
    if (is_kept(attribute.name()))
      kept.attributes.emplace_back(attribute.name(), attribute.value());
  kept.children = children_of(array);
  kept.plain_element = std::string_view(array.name()) == "Array";
  return kept;
}

}  // namespace winslow::io::vtk
