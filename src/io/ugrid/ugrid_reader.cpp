#include <cstring>
#include <set>

#include "io/format/parsed_mesh.h"
#include "io/text/numbers.h"
#include "io/text/source.h"
#include "io/ugrid/ugrid.h"

namespace winslow::io::ugrid {
namespace {

/// Reads the numbers of a file from text or binary data.
class Numbers {
 public:
  Numbers(const Source& source, const Encoding& encoding)
      : source_(source), scan_(source), encoding_(encoding) {
    if (!encoding.records) return;
    records_ = find_records(source.text(), encoding.big_endian);
    if (records_.empty())
      source.fail(0, "no records of Fortran", "a file as its name says, or another name");
    scan_.seek(records_.front().begin);
  }

  std::size_t offset() {
    if (!encoding_.binary) scan_.skip_space();
    enter_record();
    return scan_.offset();
  }
  std::size_t bytes_left() const { return scan_.bytes_left(); }
  /// True behind the last number.
  bool at_end() {
    const std::size_t here = offset();
    return records_.empty() ? here >= source_.text().size() : here >= records_.back().end;
  }

  std::int64_t integer(const Expected& expected) {
    if (encoding_.binary)
      return binary<std::int64_t>({false, true, encoding_.integer_bytes()}, expected);
    scan_.skip_space();
    return scan_.integer(expected);
  }
  double real(const Expected& expected) {
    if (encoding_.binary) return binary<double>({true, true, encoding_.real_bytes()}, expected);
    scan_.skip_space();
    return scan_.number(expected);
  }
  /// Reads a count of items of `numbers_each` numbers; at most what the rest of the file can hold.
  std::int64_t count(const Expected& expected, std::size_t numbers_each) {
    const std::size_t start = offset();
    const std::int64_t n = integer(expected);
    return checked_count(source_, start, n, numbers_each * (encoding_.binary ? 4 : 2), bytes_left(),
                         expected);
  }

 private:
  /// Leaves a record that has been read to its end.
  void enter_record() {
    while (record_ + 1 < records_.size() && scan_.offset() == records_[record_].end)
      scan_.seek(records_[++record_].begin);
  }

  template <class Number>
  Number binary(const BinaryNumber& kind, const Expected& expected) {
    if (records_.empty()) return scan_.bytes<Number>(kind, encoding_.big_endian, expected);
    enter_record();
    const std::size_t left = records_[record_].end - scan_.offset();
    if (left >= kind.bytes) return scan_.bytes<Number>(kind, encoding_.big_endian, expected);
    // Parts of long records may end within a number.
    std::array<char, 8> bytes{};
    for (std::size_t k = 0; k < kind.bytes; ++k) {
      enter_record();
      if (scan_.offset() >= records_[record_].end)
        source_.fail(scan_.offset(), "the end of the records", expected.text());
      bytes[k] = source_.text()[scan_.offset()];
      scan_.seek(scan_.offset() + 1);
    }
    return number_at<Number>(bytes.data(), kind, encoding_.big_endian);
  }

  const Source& source_;
  Scanner scan_;
  Encoding encoding_;
  std::vector<Record> records_;
  std::size_t record_ = 0;  // of records_, being read
};

class Reader {
 public:
  Reader(Source& source, const Encoding& encoding) : source_(source), numbers_(source, encoding) {
    mesh_.details = details_;
    details_->encoding = encoding;
    details_->binary = encoding.binary;
  }

  ParsedMesh read() {
    const Counts counts = read_counts();
    const std::vector<double> xyz = read_points(counts.nodes);
    read_sides(counts);
    for (std::size_t k = 0; k < element_order.size(); ++k)
      read_elements(element_order[k], counts.elements[k]);
    if (mesh_.data.types.empty()) source_.fail(0, "no element with a volume", "a volume mesh");
    set_space_nodes(source_, xyz, mesh_);
    // Mesh generators append data about layers and about the volumes of elements.
    if (!numbers_.at_end()) mesh_.warnings.emplace_back("data behind the elements are not kept");
    return std::move(mesh_);
  }
  Details& details() { return *details_; }
  const std::vector<int>& tags() const { return tags_; }
  const std::vector<std::size_t>& tag_places() const { return tag_places_; }

 private:
  Counts read_counts() {
    Counts counts;
    counts.nodes = numbers_.count({"the number of nodes"}, 3);
    counts.triangles = numbers_.count({"the number of boundary triangles"}, 4);
    counts.quadrilaterals = numbers_.count({"the number of boundary quadrilaterals"}, 5);
    counts.elements[0] = numbers_.count({"the number of tetrahedra"}, 4);
    counts.elements[1] = numbers_.count({"the number of pyramids"}, 5);
    counts.elements[2] = numbers_.count({"the number of prisms"}, 6);
    counts.elements[3] = numbers_.count({"the number of hexahedra"}, 8);
    return counts;
  }

  std::vector<double> read_points(std::int64_t count) {
    std::vector<double> xyz;
    const auto n = static_cast<Index>(count);
    xyz.reserve(3 * static_cast<std::size_t>(n));
    mesh_.where.nodes.reserve(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) {
      mesh_.where.nodes.push_back(numbers_.offset());
      for (int k = 0; k < 3; ++k) xyz.push_back(numbers_.real({"a coordinate of node", i, n}));
    }
    nodes_ = count;
    return xyz;
  }

  /// Reads corners; nodes are numbered from 1 in the file.
  void read_corners(std::span<Index> corners, const Expected& expected) {
    for (Index& corner : corners) {
      const std::size_t start = numbers_.offset();
      const std::int64_t node = numbers_.integer(expected);
      if (node < 1 || node > nodes_) {
        source_.fail(start, "node " + std::to_string(node),
                     "1 to " + std::to_string(nodes_) + " as a node of " + expected.text());
      }
      corner = static_cast<Index>(node - 1);
    }
  }

  void read_sides(const Counts& counts) {
    std::vector<std::size_t> places;
    const auto n = static_cast<Index>(counts.triangles + counts.quadrilaterals);
    for (Index s = 0; s < n; ++s) {
      std::array<Index, 4> corners{};
      const std::span<Index> used(corners.data(), s < counts.triangles ? 3 : 4);
      places.push_back(numbers_.offset());
      read_corners(used, {"boundary face", s, n});
      details_->sides.emplace_back(used);
    }
    for (Index s = 0; s < n; ++s) {
      tag_places_.push_back(places[static_cast<std::size_t>(s)]);
      const std::size_t start = numbers_.offset();
      const std::int64_t tag = numbers_.integer({"the surface of boundary face", s, n});
      if (tag != static_cast<int>(tag))
        source_.fail(start, std::to_string(tag) + " as the number of a surface", "a smaller one");
      tags_.push_back(static_cast<int>(tag));
    }
  }

  void read_elements(ElementType type, std::int64_t count) {
    const auto n = static_cast<Index>(count);
    const auto size = static_cast<std::size_t>(corner_count(type));
    std::array<Index, 8> corners{};
    for (Index e = 0; e < n; ++e) {
      mesh_.where.elements.push_back(numbers_.offset());
      read_corners({corners.data(), size}, {shape_of(type).name.data(), e, n});
      if (type == ElementType::pyramid) {
        // Its quadrilateral is 1 4 5 2, its apex 3.
        const auto f = corners;
        corners = {f[0], f[3], f[4], f[1], f[2]};
      }
      mesh_.data.add_element(type, {corners.data(), size});
    }
  }

  Source& source_;
  Numbers numbers_;
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  std::int64_t nodes_ = 0;
  std::vector<int> tags_;
  std::vector<std::size_t> tag_places_;
};

}  // namespace

ParsedMesh read(Source& source) {
  const auto found = encoding_of_content(source.text());
  const Encoding encoding = found ? *found : encoding_of_name(source.name()).value_or(Encoding{});
  if (encoding.binary) source.set_binary_from(0);
  Reader reader(source, encoding);
  ParsedMesh mesh = reader.read();
  Details& details = reader.details();
  details.mapbc = read_mapbc(source, mapbc_path(source.name()));
  details.tags = reader.tags();
  GroupIndex markers("surface_");
  const std::set<int> used(reader.tags().begin(), reader.tags().end());
  std::map<std::string, std::size_t> by_name;  // surfaces of one name are one marker
  for (const Surface& surface : details.mapbc.surfaces) {
    if (!used.contains(surface.tag) || surface.name.empty()) continue;
    const auto known = by_name.find(surface.name);
    if (known != by_name.end())
      markers.add_tag(surface.tag, known->second);
    else
      by_name[surface.name] = markers.add(surface.tag, surface.name);
  }
  for (std::size_t s = 0; s < details.sides.size(); ++s) {
    add_marker_side(markers.find(reader.tags()[s]), static_cast<Index>(s), reader.tag_places()[s],
                    details, mesh);
  }
  make_markers(markers.all(), details, mesh);
  for (const Surface& surface : details.mapbc.surfaces) {
    // Strong symmetry about x, y or z = constant, in FUN3D's numbers.
    const bool symmetry = surface.boundary_condition >= 6661 && surface.boundary_condition <= 6663;
    if (symmetry && used.contains(surface.tag))
      details.roles.symmetry.emplace_back(markers.all()[markers.find(surface.tag)].name,
                                          std::to_string(surface.boundary_condition));
  }
  return mesh;
}

}  // namespace winslow::io::ugrid
