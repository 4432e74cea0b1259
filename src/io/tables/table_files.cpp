#include "io/tables/table_files.h"

#include <deque>
#include <map>

#include "core/error.h"
#include "io/file/atomic_file.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io {

namespace {

/// Splits the edges of a marker into lines.
class LineWalk {
 public:
  explicit LineWalk(const Marker& marker) : edges_(marker.faces), used_(edges_.size(), false) {
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (Index node : edges_[e]) at_[node].push_back(e);
  }

  /// The line through an unused edge, extended in both directions.
  BoundaryLine line_from(std::size_t first) {
    used_[first] = true;
    std::deque<Index> nodes{edges_[first][0], edges_[first][1]};
    while (nodes.front() != nodes.back()) {
      const auto next = beyond(nodes.back());
      if (!next) break;
      nodes.push_back(*next);
    }
    while (nodes.front() != nodes.back()) {
      const auto next = beyond(nodes.front());
      if (!next) break;
      nodes.push_front(*next);
    }
    return {{nodes.begin(), nodes.end()}, nodes.front() == nodes.back()};
  }

  bool used(std::size_t edge) const { return used_[edge]; }

 private:
  /// The other end of an unused edge at this node. Lines end where three edges meet.
  std::optional<Index> beyond(Index node) {
    const auto& around = at_[node];
    if (around.size() != 2) return std::nullopt;
    for (std::size_t e : around) {
      if (used_[e]) continue;
      used_[e] = true;
      return edges_[e][0] == node ? edges_[e][1] : edges_[e][0];
    }
    return std::nullopt;
  }

  const std::vector<Face>& edges_;
  std::vector<bool> used_;
  std::map<Index, std::vector<std::size_t>> at_;
};

struct Curve {
  Index marker = 0;  ///< index in the mesh
  std::size_t number = 0;
  BoundaryLine line;
};

std::vector<Curve> curves_of(const Topology& topology, const std::vector<std::string>& markers) {
  if (markers.empty()) throw UsageError("no marker to write");
  std::vector<Curve> curves;
  for (const std::string& name : markers) {
    const auto m = topology.markers().find(name);
    if (!m) throw UsageError("there is no marker \"" + name + "\"");
    std::size_t number = 0;
    for (auto& line : boundary_lines(topology.markers()[static_cast<std::size_t>(*m)]))
      curves.push_back({*m, number++, std::move(line)});
  }
  return curves;
}

const std::string& name_of(const Topology& topology, const Curve& curve) {
  return topology.markers()[static_cast<std::size_t>(curve.marker)].name;
}

/// A field of a CSV file, quoted if necessary.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

void write_csv(TextWriter& out, const Mesh& mesh, const std::vector<Curve>& curves) {
  out << "marker,line,node,x,y\n";
  for (const Curve& curve : curves)
    for (Index node : curve.line.nodes) {
      const Vec2 p = mesh.coordinates.xy(node);
      out << quoted(name_of(*mesh.topology, curve)) << ',' << curve.number << ',' << node << ','
          << p.x() << ',' << p.y() << '\n';
    }
}

void write_dat(TextWriter& out, const Mesh& mesh, const std::vector<Curve>& curves) {
  bool first = true;
  for (const Curve& curve : curves) {
    if (!first) out << '\n';
    first = false;
    out << name_of(*mesh.topology, curve) << '\n';
    for (Index node : curve.line.nodes) {
      const Vec2 p = mesh.coordinates.xy(node);
      out << p.x() << ' ' << p.y() << '\n';
    }
  }
}

void write_vtk(TextWriter& out, const Mesh& mesh, const std::vector<Curve>& curves) {
  std::size_t points = 0;
  for (const Curve& curve : curves) points += curve.line.nodes.size();
  out << "# vtk DataFile Version 3.0\nboundary\nASCII\nDATASET POLYDATA\nPOINTS " << points
      << " double\n";
  for (const Curve& curve : curves)
    for (Index node : curve.line.nodes) {
      const Vec2 p = mesh.coordinates.xy(node);
      out << p.x() << ' ' << p.y() << " 0\n";
    }
  out << "LINES " << curves.size() << ' ' << points + curves.size() << '\n';
  std::size_t next = 0;
  for (const Curve& curve : curves) {
    out << curve.line.nodes.size();
    for (std::size_t k = 0; k < curve.line.nodes.size(); ++k) out << ' ' << next++;
    out << '\n';
  }
  out << "CELL_DATA " << curves.size() << "\nSCALARS marker int 1\nLOOKUP_TABLE default\n";
  for (const Curve& curve : curves)
    out << mesh.topology->markers()[static_cast<std::size_t>(curve.marker)].tag << '\n';
}

}  // namespace

std::vector<BoundaryLine> boundary_lines(const Marker& marker) {
  LineWalk walk(marker);
  std::vector<BoundaryLine> lines;
  for (std::size_t e = 0; e < marker.faces.size(); ++e)
    if (!walk.used(e)) lines.push_back(walk.line_from(e));
  return lines;
}

const std::vector<std::string>& boundary_extensions() {
  static const std::vector<std::string> all{".csv", ".dat", ".vtk"};
  return all;
}

void write_boundary(const std::filesystem::path& path, const Mesh& mesh,
                    const std::vector<std::string>& markers) {
  const std::string extension = lower_case(path.extension().string());
  const auto& known = boundary_extensions();
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw UsageError(path.string() + ": found extension \"" + extension +
                     "\", expected .csv, .dat or .vtk");
  const std::vector<Curve> curves = curves_of(*mesh.topology, markers);
  write_atomically(path, [&](std::ostream& stream) {
    TextWriter out(stream);
    if (extension == ".csv") return write_csv(out, mesh, curves);
    if (extension == ".dat") return write_dat(out, mesh, curves);
    write_vtk(out, mesh, curves);
  });
}

namespace {

/// Content of a column; `none`: not used.
enum class Column { none, node, x, y, z, dx, dy, dz };

/// Component (0, 1 or 2) of a vector's column; of_x: the column of its first component.
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
    // A separator at the end means another, empty field.
    if (line.empty()) fields.push_back(line);
  }
  return fields;
}

std::string unquoted_lower(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = field.substr(1, field.size() - 2);
  }
  return lower_case(trimmed(field));
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

/// What the columns of a kind of table may be.
struct TableKind {
  const char* what;     ///< "displacement"
  const char* lines;    ///< expected of the file
  const char* names;    ///< expected of the first line of names
  const char* unnamed;  ///< expected of the columns if they have no names
  const char* instead;  ///< what to do with a file of the other kind
  /// Columns without names, by their number: 3, 4 or 6; empty: not such a number.
  std::array<std::vector<Column>, 3> by_number;
};

const TableKind& displacement_kind() {
  using enum Column;
  static const TableKind kind{"displacement",
                              "lines \"node,dx,dy\" or \"x,y,dx,dy\", in space with z and dz",
                              "node,dx,dy or x,y,dx,dy, in space with z and dz",
                              "3 (node,dx,dy), 4 (x,y,dx,dy) or 6 (x,y,z,dx,dy,dz)",
                              "; give this file as positions (--positions), not as displacements",
                              {{{node, dx, dy}, {x, y, dx, dy}, {x, y, z, dx, dy, dz}}}};
  return kind;
}

const TableKind& position_kind() {
  using enum Column;
  static const TableKind kind{"position",
                              "lines \"node,x,y\", in space \"node,x,y,z\"",
                              "node,x,y, in space with z",
                              "3 (node,x,y) or 4 (node,x,y,z)",
                              "; give this file as displacements (--displacements), not as "
                              "positions",
                              {{{node, x, y}, {node, x, y, z}, {}}}};
  return kind;
}

/// A row of a table, by its columns. Vectors of missing columns are zero.
struct TableRow {
  int line;
  std::optional<Index> node;
  GivenVector place, displacement;
};

/// Reads the rows of a table with columns of single nodes.
class RowReader {
 public:
  RowReader(const Source& source, const TableKind& kind)
      : source_(source), kind_(kind), scan_(source) {}

  template <class Add>
  void read(const Add& add) {
    int rows = 0;
    while (!scan_.at_end()) {
      ++line_number_;
      offset_ = scan_.offset();
      const auto fields = split(scan_.line());
      if (fields.empty()) continue;
      if (columns_.empty() && !choose_columns(fields)) continue;
      add(row(fields));
      ++rows;
    }
    if (rows == 0)
      source_.fail(source_.text().size(), std::string("no ") + kind_.what, kind_.lines);
  }

 private:
  /// Returns false if the line is a header of names.
  bool choose_columns(const std::vector<std::string_view>& fields) {
    const bool names = std::none_of(fields.begin(), fields.end(), [](std::string_view field) {
      return parse_number(field).has_value();
    });
    if (!names) {
      constexpr std::array<std::size_t, 3> numbers{3, 4, 6};
      const std::size_t k = index_of(numbers, fields.size());
      if (k < numbers.size()) columns_ = kind_.by_number[k];
      if (columns_.empty())
        source_.fail(offset_, std::to_string(fields.size()) + " columns", kind_.unnamed);
      return true;
    }
    for (const auto field : fields) columns_.push_back(column_of(field));
    if (const std::string found = wrong_columns(); !found.empty())
      source_.fail(offset_, found,
                   std::string(kind_.names) + (found == other ? "" : kind_.instead));
    return false;
  }

  /// What is wrong with the named columns; empty: nothing.
  std::string wrong_columns() const {
    using enum Column;
    const bool by_node = count(node) == 1, by_place = count(x) == 1 && count(y) == 1;
    const bool ways = count(dx) == 1 && count(dy) == 1;
    const bool no_ways = count(dx) + count(dy) + count(dz) == 0;
    const bool twice = count(z) > 1 || count(dz) > 1;
    if (&kind_ == &position_kind()) {
      if (by_node && by_place && no_ways && !twice) return {};
      return no_ways ? other : "columns of displacements";
    }
    const bool ambiguous = by_node && count(x) + count(y) > 0;
    if ((by_node || by_place) && ways && !ambiguous && !twice) return {};
    return by_node && by_place && no_ways ? "columns of positions" : other;
  }

  std::ptrdiff_t count(Column column) const {
    return std::count(columns_.begin(), columns_.end(), column);
  }

  TableRow row(const std::vector<std::string_view>& fields) const {
    if (fields.size() != columns_.size()) {
      source_.fail(offset_, std::to_string(fields.size()) + " columns",
                   std::to_string(columns_.size()) + " as in the first line");
    }
    TableRow row{line_number_, {}, {}, {}};
    Vec3 position(0, 0, 0), displacement(0, 0, 0);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      switch (columns_[i]) {
        case Column::none:
          break;
        case Column::node:
          row.node = node(fields[i]);
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
    row.place = GivenVector::of(count(Column::z) == 0 ? 2 : 3, position);
    row.displacement = GivenVector::of(count(Column::dz) == 0 ? 2 : 3, displacement);
    return row;
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

  static constexpr const char* other = "other columns";

  const Source& source_;
  const TableKind& kind_;
  Scanner scan_;
  std::vector<Column> columns_;
  int line_number_ = 0;
  std::size_t offset_ = 0;
};

}  // namespace

DisplacementTable read_displacements(const std::filesystem::path& path) {
  const Source source = Source::load(path);
  DisplacementTable table;
  table.source = source.name();
  RowReader(source, displacement_kind()).read([&](const TableRow& row) {
    table.entries.push_back({row.node, row.place, row.displacement, row.line});
  });
  return table;
}

PositionTable read_positions(const std::filesystem::path& path) {
  const Source source = Source::load(path);
  PositionTable table;
  table.source = source.name();
  RowReader(source, position_kind()).read([&](const TableRow& row) {
    table.entries.push_back({*row.node, row.place, row.line});
  });
  return table;
}

void write_convergence_csv(const std::filesystem::path& path,
                           const std::vector<ConvergenceTable>& tables) {
  write_atomically(path, [&](std::ostream& stream) {
    TextWriter out(stream);
    out << "iteration,residual,largest_move,inverted,min_sine,damping,clipped,linear_iterations,"
           "fraction,command,stage\n";
    for (const ConvergenceTable& table : tables) {
      for (const IterationRecord& r : table.records) {
        out << r.iteration << ',' << r.residual << ',' << r.largest_move << ',' << r.inverted << ','
            << r.min_sine << ',' << r.damping << ',' << (r.clipped ? 1 : 0) << ','
            << r.linear_iterations << ',' << r.fraction << ',' << table.command << ','
            << stage_name(r.stage) << '\n';
      }
    }
  });
}

}  // namespace winslow::io
