#include "io/tables/boundary_file.h"

#include <cctype>
#include <deque>
#include <map>
#include <utility>

#include "core/error.h"
#include "io/file/atomic_file.h"
#include "io/text/numbers.h"

namespace winslow::io {

namespace {

/// Takes edges off a marker, one line after the other.
class LineWalk {
 public:
  explicit LineWalk(const Marker& marker) : edges_(marker.faces), used_(edges_.size(), false) {
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (Index node : edges_[e]) at_[node].push_back(e);
  }

  /// The line through an edge that is not used yet, as far as it goes both ways.
  BoundaryLine take(std::size_t first) {
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
  /// The other end of an edge from here that is not used yet. Lines end where three edges meet.
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
  Index marker = 0;  ///< of the mesh
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

/// A field of a CSV file: in quotes where it must be.
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
    if (!walk.used(e)) lines.push_back(walk.take(e));
  return lines;
}

const std::vector<std::string>& boundary_extensions() {
  static const std::vector<std::string> all{".csv", ".dat", ".vtk"};
  return all;
}

void write_boundary(const std::filesystem::path& path, const Mesh& mesh,
                    const std::vector<std::string>& markers) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
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

}  // namespace winslow::io
