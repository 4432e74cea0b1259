#include "core/error.h"
#include "io/format/parsed_mesh.h"
#include "io/text/numbers.h"
#include "io/ugrid/ugrid.h"

namespace winslow::io::ugrid {
namespace {

/// The boundary in the order of a file: triangles before quadrilaterals.
struct Sides {
  std::vector<Face> faces;
  std::vector<int> tags;
  std::size_t triangles = 0;
};

class ValueWriter {
 public:
  ValueWriter(TextWriter& out, const Encoding& encoding) : out_(out), encoding_(encoding) {}

  void integer(std::int64_t value) {
    if (!encoding_.binary) return text(value);
    if (encoding_.wide) return put(value);
    put(static_cast<std::int32_t>(value));
  }
  void real(double value) {
    if (!encoding_.binary) return text(value);
    if (!encoding_.single) return put(value);
    const auto rounded = static_cast<float>(value);
    exact_ = exact_ && static_cast<double>(rounded) == value;
    put(rounded);
  }
  /// Begins or ends a record of that many bytes, in files that have records.
  void record(std::uint64_t bytes) {
    if (encoding_.records) put(static_cast<std::int32_t>(bytes));
  }
  /// Ends a line of text.
  void end() {
    if (!encoding_.binary) out_ << '\n';
    first_ = true;
  }
  /// False if a coordinate did not fit in single precision.
  bool exact() const { return exact_; }

 private:
  template <class Number>
  void text(Number value) {
    if (!first_) out_ << ' ';
    out_ << value;
    first_ = false;
  }
  template <class Number>
  void put(Number value) {
    out_.raw(value, encoding_.big_endian);
  }

  TextWriter& out_;
  Encoding encoding_;
  bool first_ = true;
  bool exact_ = true;
};

/// Triangles of all markers, then their quadrilaterals.
Sides sides_of(const Markers& markers, const std::vector<int>& tags) {
  Sides sides;
  for (const std::size_t corners : {3U, 4U}) {
    for (std::size_t m = 0; m < tags.size(); ++m) {
      for (const Face& face : markers[m].faces) {
        if (face.size() != corners) continue;
        sides.faces.push_back(face);
        sides.tags.push_back(tags[m]);
      }
    }
    if (corners == 3) sides.triangles = sides.faces.size();
  }
  return sides;
}

/// Sides in the order of the source, with the surfaces that they had.
Sides sides_of(const Details& details) {
  Sides sides;
  sides.faces = details.sides;
  sides.tags = details.tags;
  sides.triangles = static_cast<std::size_t>(
      std::ranges::count_if(sides.faces, [](const Face& face) { return face.size() == 3; }));
  return sides;
}

void write_elements(ValueWriter& values, const Topology& topology, ElementType type) {
  for (Index e = 0; e < topology.element_count(); ++e) {
    if (topology.element_type(e) != type) continue;
    std::array<Index, 8> corners{};
    const auto own = topology.element(e);
    std::ranges::copy(own, corners.begin());
    // The quadrilateral of a pyramid is 1 4 5 2, its apex 3.
    if (type == ElementType::pyramid) corners = {own[0], own[3], own[4], own[1], own[2]};
    for (std::size_t k = 0; k < own.size(); ++k) values.integer(corners[k] + 1);
    values.end();
  }
}

/// The counts of the first line of a file.
std::array<std::int64_t, 7> counts_of(const Mesh& mesh, const Sides& sides) {
  std::array<std::int64_t, 7> counts{
      mesh.coordinates.size(), static_cast<std::int64_t>(sides.triangles),
      static_cast<std::int64_t>(sides.faces.size() - sides.triangles)};
  const Topology& topology = *mesh.topology;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const auto k = std::ranges::find(element_order, topology.element_type(e));
    ++counts[3 + static_cast<std::size_t>(k - element_order.begin())];
  }
  return counts;
}

/// Throws UsageError for more data than the length of a record can tell.
void check_record(const std::filesystem::path& path, const Mesh& mesh, const Sides& sides,
                  const Encoding& encoding) {
  if (!encoding.records) return;
  const std::uint64_t size = content_size(counts_of(mesh, sides), encoding);
  if (size <= std::numeric_limits<std::int32_t>::max()) return;
  throw UsageError(path.string() + ": " + std::to_string(size) +
                   " bytes do not fit in a record of Fortran; write .b8.ugrid or .lb8.ugrid");
}

/// Returns false if coordinates had to be rounded.
bool write(std::ostream& stream, const Mesh& mesh, const Sides& sides, const Encoding& encoding) {
  TextWriter out(stream);
  ValueWriter values(out, encoding);
  const Topology& topology = *mesh.topology;
  const auto counts = counts_of(mesh, sides);
  const std::uint64_t header = counts.size() * encoding.integer_bytes();
  const std::uint64_t rest = content_size(counts, encoding) - header;
  values.record(header);
  for (const std::int64_t count : counts) values.integer(count);
  values.record(header);
  values.end();
  values.record(rest);
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    const Vec3 p = mesh.coordinates.xyz(i);
    for (int k = 0; k < 3; ++k) values.real(p[k]);
    values.end();
  }
  for (const Face& face : sides.faces) {
    for (const Index node : face) values.integer(node + 1);
    values.end();
  }
  for (const int tag : sides.tags) {
    values.integer(tag);
    values.end();
  }
  for (const ElementType type : element_order) write_elements(values, topology, type);
  values.record(rest);
  return values.exact();
}

Encoding encoding_for(const std::filesystem::path& path, const Details* details,
                      const WriteOptions& options) {
  if (const auto named = encoding_of_name(path)) return *named;
  if (!options.binary) return {};
  return details != nullptr && details->encoding.binary ? details->encoding
                                                        : Encoding{true, true, false};
}

/// True if the elements are in the order of a file.
bool ordered_by_type(const Topology& topology) {
  const auto rank = [](ElementType type) { return std::ranges::find(element_order, type); };
  for (Index e = 1; e < topology.element_count(); ++e) {
    if (rank(topology.element_type(e)) < rank(topology.element_type(e - 1))) return false;
  }
  return true;
}

/// The surfaces of the source, followed by those of markers that the source lacks.
std::vector<Surface> surfaces_of(const Markers& markers, const std::vector<int>& tags,
                                 const Details* details, std::vector<std::string>& warnings) {
  std::vector<Surface> surfaces;
  if (details != nullptr) surfaces = details->mapbc.surfaces;
  for (std::size_t m = 0; m < tags.size(); ++m) {
    const auto has_tag = [&](const Surface& surface) { return surface.tag == tags[m]; };
    if (std::ranges::any_of(surfaces, has_tag)) continue;
    const std::string& name = markers[m].name;
    surfaces.push_back({tags[m], 0, within_line(name, "!")});
    if (surfaces.back().name != name) {
      warnings.push_back("marker \"" + name + "\" is written as \"" + surfaces.back().name +
                         "\": a .mapbc file allows no such name");
    }
  }
  return surfaces;
}

void add_losses(const Topology& topology, std::vector<std::string>& warnings) {
  if (topology.markers().unmarked_faces() > 0 || !topology.markers().from_file()) {
    warnings.emplace_back(
        "boundary faces in no marker are not written; solvers want every face in one");
  }
  if (!topology.regions().empty())
    warnings.emplace_back("UGRID has no regions: the names of element sets are not written");
  if (!ordered_by_type(topology)) {
    warnings.emplace_back(
        "UGRID holds elements by type: tetrahedra, pyramids, prisms, hexahedra; their order has "
        "changed");
  }
}

}  // namespace

std::vector<OutputFile> files(const std::filesystem::path& path, const Mesh& mesh,
                              const FormatDetails* source, const WriteOptions& options,
                              std::vector<std::string>& warnings) {
  const auto* details = dynamic_cast<const Details*>(source);
  if (details != nullptr && !details->fits(mesh)) details = nullptr;
  const Markers& markers = mesh.topology->markers();
  std::vector<int> tags;
  if (markers.from_file()) {
    // Tags read from a file need not be positive.
    tags = details != nullptr ? tags_of(markers.list())
                              : usable_tags(tags_of(markers.list()), "markers", warnings);
  }
  add_losses(*mesh.topology, warnings);
  const Encoding encoding = encoding_for(path, details, options);
  const Sides sides = details != nullptr ? sides_of(*details) : sides_of(markers, tags);
  check_record(path, mesh, sides, encoding);
  std::vector<OutputFile> files{{path, [&mesh, &warnings, sides, encoding](std::ostream& out) {
                                   if (write(out, mesh, sides, encoding)) return;
                                   warnings.emplace_back(
                                       "this file holds single precision: the coordinates are "
                                       "rounded");
                                 }}};
  auto surfaces = surfaces_of(markers, tags, details, warnings);
  if (surfaces.empty()) return files;
  if (details != nullptr && surfaces.size() == details->mapbc.surfaces.size()) {
    files.push_back({mapbc_path(path), [text = details->mapbc.text](std::ostream& out) {
                       out.write(text.data(), static_cast<std::streamsize>(text.size()));
                     }});
    return files;
  }
  files.push_back({mapbc_path(path), [surfaces = std::move(surfaces)](std::ostream& out) {
                     write_mapbc(out, surfaces);
                   }});
  return files;
}

}  // namespace winslow::io::ugrid
