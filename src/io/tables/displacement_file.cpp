#include "io/tables/displacement_file.h"

#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io {
namespace {

/// What a column holds; `none` is one that we do not use.
enum class Column { none, node, x, y, z, dx, dy, dz };

/// Of a column among those of a vector, the first of which is that of x.
int component(Column column, Column of_x) {
  return static_cast<int>(column) - static_cast<int>(of_x);
}

std::vector<std::string_view> split(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const bool blanks_separate = line.find_first_of(",;") == std::string_view::npos;
  const std::string_view separators = blanks_separate ? " \t" : ",;";
  std::vector<std::string_view> fields;
  for (line = trimmed(line); !line.empty();) {
    const auto end = line.find_first_of(separators);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
    if (blanks_separate) line = trimmed(line);
    // A separator at the end stands for one more, empty field.
    if (line.empty()) fields.push_back(line);
  }
  return fields;
}

std::string unquoted_lower(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = field.substr(1, field.size() - 2);
  }
  std::string name(trimmed(field));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return name;
}

Column column_of(std::string_view field) {
  const std::string name = unquoted_lower(field);
  if (name == "node" || name == "id" || name == "node_id") return Column::node;
  if (name == "x") return Column::x;
  if (name == "y") return Column::y;
  if (name == "z") return Column::z;
  if (name == "dx") return Column::dx;
  if (name == "dy") return Column::dy;
  return name == "dz" ? Column::dz : Column::none;
}

class Reader {
 public:
  explicit Reader(const Source& source) : source_(source), scan_(source) {}

  DisplacementTable read() {
    DisplacementTable table;
    table.source = source_.name();
    while (!scan_.at_end()) {
      ++line_number_;
      offset_ = scan_.offset();
      const auto fields = split(scan_.line());
      if (fields.empty()) continue;
      if (columns_.empty() && !choose_columns(fields)) continue;
      table.entries.push_back(entry(fields));
    }
    if (table.entries.empty()) {
      source_.fail(source_.text().size(), "no displacement",
                   "lines \"node,dx,dy\" or \"x,y,dx,dy\", in space with z and dz");
    }
    return table;
  }

 private:
  /// Returns false if the line is one of names.
  bool choose_columns(const std::vector<std::string_view>& fields) {
    const bool names = std::none_of(fields.begin(), fields.end(), [](std::string_view field) {
      return parse_number(field).has_value();
    });
    if (!names) {
      if (fields.size() == 3) columns_ = {Column::node, Column::dx, Column::dy};
      if (fields.size() == 4) columns_ = {Column::x, Column::y, Column::dx, Column::dy};
      if (fields.size() == 6) {
        columns_ = {Column::x, Column::y, Column::z, Column::dx, Column::dy, Column::dz};
      }
      if (columns_.empty()) {
        source_.fail(offset_, std::to_string(fields.size()) + " columns",
                     "3 (node,dx,dy), 4 (x,y,dx,dy) or 6 (x,y,z,dx,dy,dz)");
      }
      return true;
    }
    for (const auto field : fields) columns_.push_back(column_of(field));
    const bool place = count(Column::node) == 1 || (count(Column::x) == 1 && count(Column::y) == 1);
    const bool ambiguous = count(Column::node) == 1 && count(Column::x) + count(Column::y) > 0;
    const bool twice = count(Column::z) > 1 || count(Column::dz) > 1;
    if (!place || ambiguous || twice || count(Column::dx) != 1 || count(Column::dy) != 1) {
      source_.fail(offset_, "other columns", "node,dx,dy or x,y,dx,dy, in space with z and dz");
    }
    return false;
  }

  std::ptrdiff_t count(Column column) const {
    return std::count(columns_.begin(), columns_.end(), column);
  }

  DisplacementEntry entry(const std::vector<std::string_view>& fields) const {
    if (fields.size() != columns_.size()) {
      source_.fail(offset_, std::to_string(fields.size()) + " columns",
                   std::to_string(columns_.size()) + " as in the first line");
    }
    DisplacementEntry entry;
    entry.line = line_number_;
    Vec3 position(0, 0, 0), displacement(0, 0, 0);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      switch (columns_[i]) {
        case Column::none:
          break;
        case Column::node:
          entry.node = node(fields[i]);
          break;
        case Column::x:
        case Column::y:
        case Column::z:
          position[component(columns_[i], Column::x)] = number(fields[i]);
          break;
        case Column::dx:
        case Column::dy:
        case Column::dz:
          displacement[component(columns_[i], Column::dx)] = number(fields[i]);
          break;
      }
    }
    entry.position = GivenVector::of(count(Column::z) == 0 ? 2 : 3, position);
    entry.displacement = GivenVector::of(count(Column::dz) == 0 ? 2 : 3, displacement);
    return entry;
  }

  double number(std::string_view field) const {
    const auto value = parse_number(field);
    if (!value || !std::isfinite(*value)) fail(field, "a finite number");
    return *value;
  }

  Index node(std::string_view field) const {
    const auto value = parse_integer(field);
    if (!value || *value < 0 || *value > std::numeric_limits<Index>::max()) {
      fail(field, "the number of a node, from 0");
    }
    return static_cast<Index>(*value);
  }

  [[noreturn]] void fail(std::string_view field, const std::string& expected) const {
    source_.fail(offset_, field.empty() ? "an empty field" : in_quotes(field), expected);
  }

  const Source& source_;
  Scanner scan_;
  std::vector<Column> columns_;
  int line_number_ = 0;
  std::size_t offset_ = 0;
};

}  // namespace

DisplacementTable read_displacements(const std::filesystem::path& path) {
  const Source source = Source::load(path);
  return Reader(source).read();
}

}  // namespace winslow::io
