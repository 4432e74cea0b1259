#include "io/vtk/face_stream.h"

namespace winslow::io::vtk {

void append_face_stream(std::span<const Face> faces, std::vector<std::int64_t>& stream) {
  stream.push_back(static_cast<std::int64_t>(faces.size()));
  for (const Face& face : faces) {
    stream.push_back(static_cast<std::int64_t>(face.size()));
    stream.insert(stream.end(), face.begin(), face.end());
  }
}

void refuse_face_stream(const Source& source, std::size_t place, std::size_t cell,
                        std::size_t size) {
  source.fail(place,
              std::to_string(size) + " numbers for the faces of cell " + std::to_string(cell) +
                  ", a polyhedron, that do not fit each other",
              "the number of its faces, then of each the number of nodes and the nodes");
}

namespace {

/// The nodes of all faces, each once, in the order in which the faces name them.
std::vector<std::int64_t> nodes_of_stream(std::span<const std::int64_t> stream) {
  std::vector<std::pair<std::int64_t, std::size_t>> first;
  for_each_face(stream, [&](std::span<const std::int64_t> nodes) {
    for (const std::int64_t node : nodes) first.emplace_back(node, first.size());
  });
  std::ranges::sort(first);
  const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
  first.erase(std::unique(first.begin(), first.end(), same), first.end());
  std::ranges::sort(first, {}, &std::pair<std::int64_t, std::size_t>::second);
  std::vector<std::int64_t> nodes;
  for (const auto& [node, place] : first) nodes.push_back(node);
  return nodes;
}

}  // namespace

void split_face_streams(const Source& source, Grid& grid) {
  if (std::ranges::find(grid.types, polyhedron) == grid.types.end()) return;
  const std::vector<std::int64_t> lists = std::exchange(grid.connectivity, {});
  const std::vector<std::int64_t> ends = std::exchange(grid.offsets, {0});
  grid.face_offsets = {0};
  for (std::size_t c = 0; c < grid.cell_count(); ++c) {
    const auto list = std::span(lists).subspan(static_cast<std::size_t>(ends[c]),
                                               static_cast<std::size_t>(ends[c + 1] - ends[c]));
    if (grid.types[c] != polyhedron) {
      grid.connectivity.insert(grid.connectivity.end(), list.begin(), list.end());
    } else {
      if (!for_each_face(list, [](std::span<const std::int64_t>) {}))
        refuse_face_stream(source, grid.cell_places[c], c, list.size());
      const auto nodes = nodes_of_stream(list);
      grid.connectivity.insert(grid.connectivity.end(), nodes.begin(), nodes.end());
      grid.faces.insert(grid.faces.end(), list.begin(), list.end());
    }
    grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    grid.face_offsets.push_back(static_cast<std::int64_t>(grid.faces.size()));
  }
}

namespace {

/// An array of numbers, and where each of them is in the file.
struct Numbers {
  pugi::xml_node array;
  std::vector<std::int64_t> values;
  std::vector<std::size_t> places;
};

class FacesReader {
 public:
  FacesReader(const Source& source, const VtuArrays& arrays, const pugi::xml_node& cells,
              Grid& grid)
      : source_(source), arrays_(arrays), cells_(cells), grid_(grid) {}

  void read() {
    grid_.face_offsets = {0};
    grid_.face_places = grid_.cell_places;
    if (find("faces"))
      read_streams();
    else if (find("face_connectivity"))
      read_tables();
    else
      source_.fail(arrays_.place(cells_), "no array \"faces\" for the polyhedra (cell type 42)",
                   "\"faces\" and \"faceoffsets\", or \"face_connectivity\" and the other three "
                   "of VTK 9.4");
  }

 private:
  pugi::xml_node find(const char* name) const {
    return cells_.find_child_by_attribute("DataArray", "Name", name);
  }

  /// count: of the values, if it is known.
  Numbers numbers(const char* name, VtuArrays::Count count = {}) const {
    Numbers found{find(name), {}, {}};
    if (!found.array)
      source_.fail(arrays_.place(cells_), "no array \"" + std::string(name) + "\"", "one here");
    found.values = arrays_.integers(found.array, &found.places, count);
    if (count && found.values.size() != *count) {
      source_.fail(arrays_.place(found.array),
                   std::to_string(found.values.size()) + " numbers in array \"" + name + "\"",
                   std::to_string(*count) + ", one for each cell");
    }
    return found;
  }

  /// Checks that `end` lies between the end before and the size of the array that it counts.
  void check_end(const Numbers& ends, std::size_t k, std::int64_t begin, std::size_t size,
                 const char* what) const {
    const auto last = static_cast<std::int64_t>(size);
    if (ends.values[k] >= begin && ends.values[k] <= last) return;
    source_.fail(
        ends.places[k],
        std::to_string(ends.values[k]) + " as the end of the " + what + ' ' + std::to_string(k),
        std::to_string(begin) + " to " + std::to_string(last));
  }
  void check_whole(const Numbers& list, std::int64_t end) const {
    if (end == static_cast<std::int64_t>(list.values.size())) return;
    source_.fail(arrays_.place(list.array),
                 std::to_string(list.values.size()) + " numbers in array \"" +
                     list.array.attribute("Name").value() + '"',
                 std::to_string(end) + ", the last offset");
  }

  bool is_polyhedron(std::size_t cell) const { return grid_.types[cell] == polyhedron; }

  /// "faceoffsets" has the end of the stream of each polyhedron, and -1 for other cells.
  void read_streams() {
    Numbers faces = numbers("faces");
    const Numbers ends = numbers("faceoffsets", grid_.cell_count());
    grid_.list_types.faces = arrays_.value_type(faces.array);
    grid_.list_types.face_offsets = arrays_.value_type(ends.array);
    std::int64_t end = 0;
    for (std::size_t c = 0; c < grid_.cell_count(); ++c) {
      if (is_polyhedron(c)) {
        check_end(ends, c, end, faces.values.size(), "faces of cell");
        const auto first = static_cast<std::size_t>(end);
        grid_.face_places[c] = first < faces.places.size() ? faces.places[first] : ends.places[c];
        end = ends.values[c];
      }
      grid_.face_offsets.push_back(end);
    }
    check_whole(faces, end);
    grid_.faces = std::move(faces.values);
  }

  void read_tables() {
    const Numbers nodes = numbers("face_connectivity"), face_ends = numbers("face_offsets");
    const Numbers numbers_of_faces = numbers("polyhedron_to_faces");
    const Numbers cell_ends = numbers("polyhedron_offsets", grid_.cell_count());
    std::int64_t end = 0;
    for (std::size_t f = 0; f < face_ends.values.size(); ++f) {
      check_end(face_ends, f, end, nodes.values.size(), "nodes of face");
      end = face_ends.values[f];
    }
    check_whole(nodes, end);
    std::vector<unsigned char> uses(face_ends.values.size(), 0);
    end = 0;
    for (std::size_t c = 0; c < grid_.cell_count(); ++c) {
      check_end(cell_ends, c, end, numbers_of_faces.values.size(), "faces of cell");
      if (!is_polyhedron(c) && cell_ends.values[c] != end) {
        source_.fail(cell_ends.places[c],
                     "faces of cell " + std::to_string(c) + ", which is no polyhedron", "none");
      }
      if (is_polyhedron(c)) {
        const auto first = static_cast<std::size_t>(end);
        grid_.face_places[c] = first < numbers_of_faces.places.size()
                                   ? numbers_of_faces.places[first]
                                   : cell_ends.places[c];
        grid_.faces.push_back(cell_ends.values[c] - end);
        for (; end < cell_ends.values[c]; ++end)
          append_face(c, numbers_of_faces, static_cast<std::size_t>(end), nodes, face_ends, uses);
      }
      grid_.face_offsets.push_back(static_cast<std::int64_t>(grid_.faces.size()));
    }
    check_whole(numbers_of_faces, end);
    for (const Numbers* table : {&nodes, &face_ends, &numbers_of_faces, &cell_ends})
      grid_.face_tables.push_back(arrays_.data_array(table->array, {}));
  }

  /// Appends the face that entry k of "polyhedron_to_faces" names to the streams.
  void append_face(std::size_t cell, const Numbers& of_cells, std::size_t k, const Numbers& nodes,
                   const Numbers& face_ends, std::vector<unsigned char>& uses) {
    const std::int64_t face = of_cells.values[k];
    const std::string name = "face " + std::to_string(face) + " in cell " + std::to_string(cell);
    if (face < 0 || face >= static_cast<std::int64_t>(uses.size()))
      source_.fail(of_cells.places[k], name,
                   "0 to " + std::to_string(static_cast<std::int64_t>(uses.size()) - 1));
    const auto f = static_cast<std::size_t>(face);
    if (++uses[f] > 2)
      source_.fail(of_cells.places[k], name + ", which two cells have already",
                   "at most two cells at a face");
    const std::int64_t begin = f == 0 ? 0 : face_ends.values[f - 1], end = face_ends.values[f];
    grid_.faces.push_back(end - begin);
    grid_.faces.insert(grid_.faces.end(), nodes.values.begin() + begin, nodes.values.begin() + end);
  }

  const Source& source_;
  const VtuArrays& arrays_;
  pugi::xml_node cells_;
  Grid& grid_;
};

}  // namespace

void read_faces(const Source& source, const VtuArrays& arrays, const pugi::xml_node& cells,
                Grid& grid) {
  if (std::ranges::find(grid.types, polyhedron) == grid.types.end()) return;
  FacesReader(source, arrays, cells, grid).read();
}

}  // namespace winslow::io::vtk
