#include <set>
#include <system_error>

#include "core/error.h"
#include "core/mesh/element_type.h"
#include "core/types.h"
#include "io/format/cell_of_faces.h"
#include "io/openfoam/cell_zones.h"
#include "io/openfoam/openfoam.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io::openfoam {
namespace {

/// Splits a file of OpenFOAM into words: skips comments; each of ( ) { } ; [ ] is a word.
class FoamScanner {
 public:
  FoamScanner(const Source& source, Source::Range range)
      : source_(source), scan_(source, range.begin, range.end), range_(range) {}

  /// Offset of the next word.
  std::size_t offset() {
    skip();
    return scan_.offset();
  }

  /// Offset right after the last word.
  std::size_t position() const { return scan_.offset(); }
  std::size_t bytes_left() const { return scan_.bytes_left(); }
  /// The next word; empty at the end of the file.
  std::string_view next() {
    skip();
    const auto text = source_.text().substr(0, range_.end);
    const std::size_t begin = std::min(scan_.offset(), text.size());
    std::size_t end = begin;
    if (begin < text.size() && text[begin] == '"') {
      end = std::min(text.find('"', begin + 1), text.size() - 1) + 1;
    } else if (begin < text.size() &&
               std::string_view("(){};[]").find(text[begin]) != std::string_view::npos) {
      end = begin + 1;
    } else {
      end = std::min(text.find_first_of("(){};[] \t\r\n\v\f", begin), text.size());
    }
    scan_.seek(end);
    return text.substr(begin, end - begin);
  }

  std::string_view peek() {
    const std::size_t here = offset();
    const auto word = next();
    scan_.seek(here);
    return word;
  }

  /// Reads the next word. Throws InputError if it is another one.
  void expect(std::string_view word) {
    const auto found = next();
    if (found != word) fail(found, "'" + std::string(word) + "'");
  }

  std::int64_t integer(const Expected& expected) {
    const auto word = next();
    const auto value = parse_integer(word);
    if (!value) fail(word, expected.text());
    return *value;
  }

  double number(const Expected& expected) {
    const auto word = next();
    const auto value = parse_number(word);
    if (!value) fail(word, expected.text());
    return *value;
  }

  /// Reads the length of a list with entries of at least `bytes_each` bytes.
  Index count(const Expected& expected, std::size_t bytes_each) {
    const std::size_t start = offset();
    return checked_count(source_, start, integer(expected), bytes_each, bytes_left(), expected);
  }

  [[noreturn]] void fail(std::string_view word, const std::string& expected) const {
    scan_.fail(word, expected);
  }

 private:
  void skip() {
    const auto text = source_.text().substr(0, range_.end);
    for (;;) {
      scan_.skip_space();
      const auto rest = text.substr(std::min(scan_.offset(), text.size()));
      if (rest.starts_with("//")) {
        scan_.line();
      } else if (rest.starts_with("/*")) {
        const auto end = text.find("*/", scan_.offset() + 2);
        if (end == std::string_view::npos)
          source_.fail(scan_.offset(), "a comment without end", "*/");
        scan_.seek(end + 2);
      } else {
        return;
      }
    }
  }

  const Source& source_;
  Scanner scan_;
  Source::Range range_;
};

/// Reads the entry FoamFile, if there is one. Throws InputError for binary files.
void read_foam_header(FoamScanner& scan) {
  if (scan.peek() != "FoamFile") return;
  scan.next();
  scan.expect("{");
  for (auto key = scan.next(); key != "}"; key = scan.next()) {
    if (key.empty()) scan.fail(key, "'}'");
    const auto value = scan.peek();
    if (key == "format" && value != "ascii")
      scan.fail(value, "ascii (foamFormatConvert writes it)");
    if (key == "class" && value == "faceCompactList") scan.fail(value, "faceList");
    for (auto word = scan.next(); word != ";"; word = scan.next()) {
      if (word.empty()) scan.fail(word, "';'");
    }
  }
}

namespace fs = std::filesystem;

struct PatchRange {
  std::string name;
  std::int64_t first = -1, count = -1;
  std::size_t place = 0;
};

class Reader {
 public:
  explicit Reader(Source& source) : source_(source) { mesh_.details = details_; }

  ParsedMesh read() {
    open();
    const std::vector<double> xyz = read_points();
    nodes_ = static_cast<Index>(xyz.size() / 3);
    read_faces();
    owner_ = read_labels(2);
    neighbour_ = read_labels(3);
    build_cells();
    if (mesh_.data.types.empty()) source_.fail(ranges_[2].begin, "no cells", "a mesh");
    set_space_nodes(source_, xyz, mesh_);
    read_patches();
    const fs::path folder = source_.name();
    read_cell_zones(source_, folder, mesh_);
    details_->markers = mesh_.data.markers;
    return std::move(mesh_);
  }

 private:
  /// Loads all files into one source.
  void open() {
    const fs::path folder = source_.name();
    std::error_code error;
    for (std::size_t k = 0; k < file_names.size(); ++k) {
      fs::path path = folder / file_names[k];
      if (!fs::exists(path, error)) {
        path += ".gz";
        if (!fs::exists(path, error)) {
          throw InputError(source_.name() + ": found no file " + file_names[k] +
                           ", expected points, faces, owner, neighbour and boundary");
        }
        details_->compressed = true;
      }
      ranges_[k] = source_.append(path);
    }
    for (std::size_t k = 1; k < file_names.size(); ++k)
      details_->texts[k] =
          source_.text().substr(ranges_[k].begin, ranges_[k].end - ranges_[k].begin);
    for (const char* zones : {"faceZones", "pointZones"}) {
      if (fs::exists(folder / zones, error) ||
          fs::exists(folder / (std::string(zones) + ".gz"), error))
        mesh_.warnings.push_back(std::string(zones) + " are not read; their file stays as it is");
    }
  }

  std::vector<double> read_points() {
    FoamScanner scan(source_, ranges_[0]);
    read_foam_header(scan);
    const std::size_t begin = scan.offset();
    const Index n = scan.count({"the number of points"}, 7);
    scan.expect("(");
    std::vector<double> xyz;
    xyz.reserve(3 * at(n));
    for (Index i = 0; i < n; ++i) {
      mesh_.where.nodes.push_back(scan.offset());
      scan.expect("(");
      for (int k = 0; k < 3; ++k) xyz.push_back(scan.number({"a coordinate of point", i, n}));
      scan.expect(")");
    }
    scan.expect(")");
    const std::size_t end = scan.position();
    details_->texts[0] = source_.text().substr(ranges_[0].begin, begin - ranges_[0].begin);
    details_->points_end = source_.text().substr(end, ranges_[0].end - end);
    return xyz;
  }

  void read_faces() {
    FoamScanner scan(source_, ranges_[1]);
    read_foam_header(scan);
    const Index n = scan.count({"the number of faces"}, 8);
    scan.expect("(");
    for (Index f = 0; f < n; ++f) {
      face_places_.push_back(scan.offset());
      const Index size = scan.count({"the number of points of face", f, n}, 2);
      scan.expect("(");
      std::array<Index, 4> corners{};
      for (Index k = 0; k < size; ++k) {
        const std::size_t place = scan.offset();
        const std::int64_t node = scan.integer({"a point of face", f, n});
        if (node < 0 || node >= nodes_)
          source_.fail(place, "point " + std::to_string(node),
                       "0 to " + std::to_string(nodes_ - 1));
        if (k < 4) corners[at(k)] = static_cast<Index>(node);
      }
      scan.expect(")");
      // Other faces belong to polyhedra and are reported with their cells.
      const bool usable = size == 3 || size == 4;
      faces_.push_back(usable ? Face(std::span<const Index>(corners.data(), at(size))) : Face());
      face_sizes_.push_back(size);
    }
    scan.expect(")");
  }

  /// Reads the list of cells in one of the files.
  std::vector<Index> read_labels(std::size_t file) {
    FoamScanner scan(source_, ranges_[file]);
    read_foam_header(scan);
    const Index n = scan.count({"the number of cells in the list"}, 2);
    if (n > static_cast<Index>(faces_.size()) ||
        (file == 2 && n != static_cast<Index>(faces_.size())))
      source_.fail(ranges_[file].begin, std::to_string(n) + " cells",
                   std::to_string(faces_.size()) + ", the number of faces");
    std::vector<Index> labels;
    scan.expect("(");
    for (Index f = 0; f < n; ++f) {
      const std::size_t place = scan.offset();
      const std::int64_t cell = scan.integer({"the cell of face", f, n});
      // A cell has at least four faces, so there are fewer cells than faces.
      if (cell < 0 || cell >= static_cast<std::int64_t>(faces_.size()))
        source_.fail(place, "cell " + std::to_string(cell),
                     "0 or more, fewer than there are faces");
      labels.push_back(static_cast<Index>(cell));
    }
    scan.expect(")");
    return labels;
  }

  void build_cells() {
    Index cells = 0;
    for (const Index cell : owner_) cells = std::max(cells, cell + 1);
    for (const Index cell : neighbour_) cells = std::max(cells, cell + 1);
    // Faces of each cell in ascending order: f for the owner, ~f for the neighbour.
    std::vector<std::vector<Index>> faces_of(at(cells));
    for (std::size_t f = 0; f < owner_.size(); ++f) {
      faces_of[at(owner_[f])].push_back(static_cast<Index>(f));
      if (f < neighbour_.size()) faces_of[at(neighbour_[f])].push_back(~static_cast<Index>(f));
    }
    for (Index c = 0; c < cells; ++c) add_cell(c, faces_of[at(c)]);
  }

  void add_cell(Index cell, const std::vector<Index>& coded) {
    std::vector<Face> faces;
    if (coded.empty())
      source_.fail(ranges_[2].begin, "no face of cell " + std::to_string(cell), "four or more");
    const std::size_t place = face_places_[at(coded[0] < 0 ? ~coded[0] : coded[0])];
    std::string shape;
    for (const Index f : coded) {
      const Index face = f < 0 ? ~f : f;
      if (faces_[at(face)].size() == 0) {
        refuse(face_places_[at(face)], cell,
               "with a face of " + std::to_string(face_sizes_[at(face)]) + " points");
      }
      faces.push_back(f < 0 ? faces_[at(face)].reversed() : faces_[at(face)]);
    }
    const auto built = cell_of_faces(faces);
    if (!built) refuse(place, cell, "of " + std::to_string(faces.size()) + " faces");
    mesh_.data.add_element(built->type, built->corners);
    mesh_.where.elements.push_back(place);
  }

  [[noreturn]] void refuse(std::size_t place, Index cell, const std::string& shape) const {
    source_.fail(place, "cell " + std::to_string(cell) + ", a polyhedron " + shape,
                 "tetrahedra, pyramids, prisms and hexahedra");
  }

  PatchRange read_patch(FoamScanner& scan) {
    PatchRange patch;
    patch.place = scan.offset();
    patch.name = scan.next();
    if (patch.name.empty()) scan.fail({}, "the name of a patch");
    scan.expect("{");
    int depth = 0;
    for (;;) {
      const auto key = scan.next();
      if (key.empty())
        source_.fail(patch.place, "patch " + in_quotes(patch.name) + " without end", "'}'");
      if (key == "}" && depth == 0) return patch;
      if (key == "{" || key == "}") depth += key == "{" ? 1 : -1;
      if (depth == 0 && key == "nFaces") patch.count = scan.integer({"a number of faces"});
      if (depth == 0 && key == "startFace") patch.first = scan.integer({"the first face"});
    }
  }

  void read_patches() {
    FoamScanner scan(source_, ranges_[4]);
    read_foam_header(scan);
    const Index n = scan.count({"the number of patches"}, 4);
    scan.expect("(");
    std::set<std::string> names;
    for (Index p = 0; p < n; ++p) {
      const PatchRange patch = read_patch(scan);
      const auto all = static_cast<std::int64_t>(faces_.size());
      const auto inner = static_cast<std::int64_t>(neighbour_.size());
      const bool fits =
          patch.count == 0 || (patch.first >= inner && patch.count > 0 && patch.count <= all &&
                               patch.first <= all - patch.count);
      if (!fits) {
        source_.fail(patch.place,
                     "patch " + in_quotes(patch.name) + " of " + std::to_string(patch.count) +
                         " faces from " + std::to_string(patch.first) + " on",
                     "faces from " + std::to_string(inner) + " to " + std::to_string(all - 1));
      }
      if (!names.insert(patch.name).second)
        source_.fail(patch.place, "a second patch " + in_quotes(patch.name), "one only");
      add_marker(patch);
    }
    scan.expect(")");
  }

  void add_marker(const PatchRange& patch) {
    Marker marker{patch.name, static_cast<int>(mesh_.data.markers.size()) + 1, {}};
    std::vector<std::size_t> places;
    for (std::int64_t f = patch.first; f < patch.first + patch.count; ++f) {
      marker.faces.push_back(faces_[static_cast<std::size_t>(f)]);
      places.push_back(face_places_[static_cast<std::size_t>(f)]);
    }
    mesh_.data.markers.push_back(std::move(marker));
    mesh_.where.marker_edges.push_back(std::move(places));
  }

  Source& source_;
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  std::array<Source::Range, 5> ranges_{};
  Index nodes_ = 0;
  std::vector<Face> faces_;
  std::vector<Index> face_sizes_;
  std::vector<std::size_t> face_places_;
  std::vector<Index> owner_, neighbour_;
};

}  // namespace

ParsedMesh read(Source& source) { return Reader(source).read(); }

}  // namespace winslow::io::openfoam
