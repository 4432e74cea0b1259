#include "io/openfoam/poly_mesh.h"

#include <set>
#include <system_error>

#include "core/error.h"
#include "io/openfoam/openfoam.h"

namespace winslow::io::openfoam {
namespace {

namespace fs = std::filesystem;

class Reader {
 public:
  Reader(Source& source, const MeshPlace& place) : source_(source), place_(place) {}

  PolyMesh read() {
    open();
    keep_others();
    read_points();
    read_faces();
    mesh_.owner_place = ranges_[2].begin;
    mesh_.owner = read_cells(2);
    mesh_.neighbour = read_cells(3);
    for (const auto* cells : {&mesh_.owner, &mesh_.neighbour})
      for (const Index cell : *cells) mesh_.cells = std::max(mesh_.cells, cell + 1);
    read_patches();
    return std::move(mesh_);
  }

 private:
  /// Loads the files of the mesh into one source.
  void open() {
    for (std::size_t k = 0; k < file_names.size(); ++k) {
      const fs::path path = find_file(place_, file_names[k]);
      if (path.empty()) refuse_without(file_names[k]);
      ranges_[k] = source_.append(path);
      if (k == 0) {
        mesh_.points_file = path;
        mesh_.points_compressed = path.extension() == ".gz";
      } else {
        mesh_.kept.push_back(
            {file_names[k], path, std::string(text_of(k)), path.extension() == ".gz"});
      }
    }
  }

  [[noreturn]] void refuse_without(const std::string& file) const {
    const bool in_time = time_of(place_.instance).has_value();
    throw InputError(
        place_.folder().string() + ": found no file " + file +
        (in_time ? " here, at an earlier time or in " + place_.at("constant").folder().string()
                 : std::string()) +
        ", expected points, faces, owner, neighbour and boundary");
  }

  std::string_view text_of(std::size_t file) const {
    return source_.text().substr(ranges_[file].begin, ranges_[file].end - ranges_[file].begin);
  }

  /// Keeps zones, sets and what else stands beside the mesh.
  void keep_others() {
    std::vector<fs::path> folders{mesh_.kept.front().path.parent_path()};
    if (const fs::path own = mesh_.points_file.parent_path(); own != folders.front())
      folders.push_back(own);
    for (const fs::path& folder : folders)
      for (const char* part : {"", "sets"}) keep_files(folder / part, part);
  }

  void keep_files(const fs::path& folder, const std::string& part) {
    std::error_code error;
    std::vector<fs::path> found;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
      if (it->is_regular_file(error) && !it->path().filename().string().starts_with('.'))
        found.push_back(it->path());
    std::ranges::sort(found);
    for (const fs::path& path : found) {
      const bool compressed = path.extension() == ".gz";
      const fs::path plain = compressed ? path.parent_path() / path.stem() : path;
      const std::string name = (part.empty() ? "" : part + "/") + plain.filename().string();
      if (part.empty() && std::ranges::find(file_names, name) != file_names.end()) continue;
      if (fs::file_size(path, error) == 0) continue;
      std::erase_if(mesh_.kept, [&](const KeptFile& kept) { return kept.name == name; });
      mesh_.kept.push_back({name, path, std::string(Source::load(path).text()), compressed});
    }
  }

  void read_points() {
    FoamScanner scan(source_, ranges_[0]);
    mesh_.points_form = scan.header();
    const std::size_t begin = scan.offset();
    FoamList<double> list = scan.points(mesh_.points_form);
    mesh_.xyz = std::move(list.values);
    mesh_.point_places = std::move(list.places);
    const std::size_t end = scan.position();
    mesh_.points_head = source_.text().substr(ranges_[0].begin, begin - ranges_[0].begin);
    mesh_.points_end = source_.text().substr(end, ranges_[0].end - end);
  }

  void read_faces() {
    FoamScanner scan(source_, ranges_[1]);
    const FoamForm form = scan.header();
    mesh_.faces = scan.faces(form, mesh_.point_count());
  }

  /// Reads the list of cells in one of the files.
  std::vector<Index> read_cells(std::size_t file) {
    FoamScanner scan(source_, ranges_[file]);
    const FoamForm form = scan.header();
    const std::size_t faces = at(mesh_.faces.size());
    const bool of_neighbours = file == 3;
    FoamList<Index> list = scan.labels(form, {"the cell of face"}, of_neighbours ? -1 : 0);
    // Older files list the faces of the boundary, too, with -1 for the cell that is not there.
    while (of_neighbours && !list.values.empty() && list.values.back() == -1)
      list.values.pop_back();
    const std::size_t n = list.values.size();
    if (n > faces || (file == 2 && n != faces))
      source_.fail(ranges_[file].begin, std::to_string(n) + " cells",
                   std::to_string(faces) + ", the number of faces");
    // A cell has at least four faces, so there are fewer cells than faces.
    for (std::size_t f = 0; f < n; ++f) {
      if (list.values[f] == -1)
        source_.fail(list.places[f],
                     "no neighbour of face " + std::to_string(f) + " and one of a later face",
                     "the faces of the boundary last");
      if (at(list.values[f]) >= faces)
        source_.fail(list.places[f], "cell " + std::to_string(list.values[f]),
                     "0 or more, fewer than there are faces");
    }
    return list.values;
  }

  /// Reads the words of a value up to its semicolon.
  std::vector<std::string> read_value(FoamScanner& scan) {
    std::vector<std::string> words;
    for (auto word = scan.next(); word != ";"; word = scan.next()) {
      if (word.empty()) scan.fail(word, "';'");
      words.emplace_back(word);
    }
    return words;
  }

  void set_groups(const std::vector<std::string>& words, Patch& patch) const {
    // "2(wall body)", "(wall)", "wall"
    const bool list = std::ranges::find(words, "(") != words.end();
    for (std::size_t k = 0; k < words.size(); ++k)
      if (words[k] != "(" && words[k] != ")" && !(list && k == 0 && parse_integer(words[k])))
        patch.groups.push_back(words[k]);
  }

  void read_entry(FoamScanner& scan, std::string_view key, Patch& patch) {
    if (key == "nFaces") {
      patch.count = scan.integer({"a number of faces"});
    } else if (key == "startFace") {
      patch.first = scan.integer({"the first face"});
    } else if (key == "matchTolerance") {
      patch.match_tolerance = scan.number({"a tolerance"});
    } else if (key == "inGroups") {
      set_groups(read_value(scan), patch);
    } else if (key == "type" || key == "neighbourPatch" || key == "transform") {
      const std::string word(scan.next());
      (key == "type" ? patch.type : key == "transform" ? patch.transform : patch.neighbour) = word;
    }
  }

  Patch read_patch(FoamScanner& scan) {
    Patch patch;
    patch.place = scan.offset();
    patch.name = scan.next();
    if (patch.name.empty()) scan.fail({}, "the name of a patch");
    scan.expect("{");
    const std::size_t begin = scan.position();
    int depth = 0;
    for (;;) {
      const auto key = scan.next();
      if (key.empty())
        source_.fail(patch.place, "patch " + in_quotes(patch.name) + " without end", "'}'");
      if (key == "}" && depth == 0) break;
      if (key == "{" || key == "}") depth += key == "{" ? 1 : -1;
      if (depth == 0) read_entry(scan, key, patch);
    }
    patch.entry = source_.text().substr(begin, scan.position() - 1 - begin);
    return patch;
  }

  void require_fitting(const Patch& patch) const {
    const auto all = static_cast<std::int64_t>(mesh_.faces.size());
    const auto inner = static_cast<std::int64_t>(mesh_.neighbour.size());
    const bool fits = patch.count == 0 || (patch.first >= inner && patch.count > 0 &&
                                           patch.count <= all && patch.first <= all - patch.count);
    if (fits) return;
    source_.fail(patch.place,
                 "patch " + in_quotes(patch.name) + " of " + std::to_string(patch.count) +
                     " faces from " + std::to_string(patch.first) + " on",
                 "faces from " + std::to_string(inner) + " to " + std::to_string(all - 1));
  }

  void read_patches() {
    FoamScanner scan(source_, ranges_[4]);
    scan.header();
    // Lists written by hand have no number before them.
    const bool counted = scan.peek() != "(";
    const Index n = counted ? scan.count({"the number of patches"}, 4) : 0;
    scan.expect("(");
    std::set<std::string> names;
    for (Index p = 0; counted ? p < n : scan.peek() != ")"; ++p) {
      Patch patch = read_patch(scan);
      require_fitting(patch);
      if (!names.insert(patch.name).second)
        source_.fail(patch.place, "a second patch " + in_quotes(patch.name), "one only");
      mesh_.patches.push_back(std::move(patch));
    }
    scan.expect(")");
  }

  Source& source_;
  const MeshPlace& place_;
  PolyMesh mesh_;
  std::array<Source::Range, 5> ranges_{};
};

}  // namespace

std::vector<std::vector<Index>> PolyMesh::faces_of_cells() const {
  std::vector<std::vector<Index>> faces_of(at(cells));
  for (std::size_t f = 0; f < owner.size(); ++f) {
    faces_of[at(owner[f])].push_back(static_cast<Index>(f));
    if (f < neighbour.size()) faces_of[at(neighbour[f])].push_back(~static_cast<Index>(f));
  }
  return faces_of;
}

PolyMesh read_poly_mesh(Source& source, const MeshPlace& place) {
  return Reader(source, place).read();
}

}  // namespace winslow::io::openfoam
