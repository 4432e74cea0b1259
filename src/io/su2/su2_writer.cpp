#include <algorithm>
#include <span>

#include "io/su2/su2.h"
#include "io/text/text_writer.h"

namespace winslow::io::su2 {
namespace {

/// SU2 ends a name at white space and a line at '%'.
std::string safe_name(const std::string& name) {
  std::string safe = name.empty() ? "unnamed" : name;
  for (char& c : safe) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '%' || c == '=') c = '_';
  }
  return safe;
}

std::vector<std::string> safe_names(std::span<const Marker> markers,
                                    std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  for (const Marker& marker : markers) {
    std::string name = safe_name(marker.name);
    while (std::find(names.begin(), names.end(), name) != names.end()) name += '_';
    if (name != marker.name) {
      warnings.push_back("marker \"" + marker.name + "\" is written as \"" + name +
                         "\": SU2 allows no such name");
    }
    names.push_back(std::move(name));
  }
  return names;
}

class Writer {
 public:
  Writer(std::ostream& out, const Mesh& mesh, const Details& details,
         std::vector<std::string> names)
      : out_(out), mesh_(mesh), details_(details), names_(std::move(names)) {}

  void write() {
    for (const auto& item : details_.items) write(item);
  }

 private:
  const Topology& topology() const { return *mesh_.topology; }

  void write(const Details::Item& item) {
    switch (item.part) {
      case Details::Part::text:
        out_ << item.text;
        break;
      case Details::Part::dimension:
        out_ << "NDIME= 2\n";
        break;
      case Details::Part::elements:
        write_elements();
        break;
      case Details::Part::points:
        write_points(item.text);
        break;
      case Details::Part::marker_count:
        out_ << "NMARK= " << names_.size() + static_cast<std::size_t>(details_.raw_markers) << '\n';
        break;
      case Details::Part::marker:
        write_marker(next_marker_++);
        break;
    }
  }

  void write_elements() {
    out_ << "NELEM= " << topology().element_count() << '\n';
    for (Index e = 0; e < topology().element_count(); ++e) {
      out_ << (topology().element_type(e) == ElementType::triangle ? 5 : 9);
      for (const Index node : topology().element(e)) out_ << ' ' << node;
      end_line(details_.element_numbers, e);
    }
  }

  void write_points(const std::string& after_count) {
    out_ << "NPOIN= " << mesh_.coordinates.size();
    if (!after_count.empty()) out_ << ' ' << after_count;
    out_ << '\n';
    for (Index i = 0; i < mesh_.coordinates.size(); ++i) {
      const Vec2 p = mesh_.coordinates.xy(i);
      out_ << p.x() << ' ' << p.y();
      end_line(details_.point_numbers, i);
    }
  }

  void write_marker(std::size_t m) {
    const auto& edges = topology().markers()[m].faces;
    out_ << "MARKER_TAG= " << names_[m] << "\nMARKER_ELEMS= " << edges.size() << '\n';
    for (std::size_t e = 0; e < edges.size(); ++e) {
      out_ << "3 " << edges[e][0] << ' ' << edges[e][1];
      end_line(details_.edge_numbers, static_cast<Index>(e));
    }
  }

  void end_line(bool numbered, Index number) {
    if (numbered) out_ << ' ' << number;
    out_ << '\n';
  }

  TextWriter out_;
  const Mesh& mesh_;
  const Details& details_;
  std::vector<std::string> names_;
  std::size_t next_marker_ = 0;
};

Details default_details(std::size_t markers) {
  using Part = Details::Part;
  Details details;
  details.items = {
      {Part::dimension, {}}, {Part::elements, {}}, {Part::points, {}}, {Part::marker_count, {}}};
  details.items.resize(details.items.size() + markers, {Part::marker, {}});
  details.element_numbers = details.point_numbers = true;
  return details;
}

}  // namespace

std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const Details* details) {
  std::vector<std::string> warnings;
  const Topology& topology = *mesh.topology;
  const std::span<const Marker> markers = topology.markers().from_file()
                                              ? std::span<const Marker>(topology.markers().list())
                                              : std::span<const Marker>();
  const bool fits = details != nullptr && details->nodes == topology.node_count() &&
                    details->elements == topology.element_count() &&
                    details->markers == markers.size();
  // A name that came from an SU2 file goes back as it came.
  std::vector<std::string> names;
  if (fits) {
    for (const Marker& marker : markers) names.push_back(marker.name);
  } else {
    names = safe_names(markers, warnings);
  }
  const Details plain = fits ? Details{} : default_details(markers.size());
  if (details != nullptr && !fits) {
    warnings.emplace_back(
        "the mesh has changed: comments and unknown keywords of the source are not written");
  }
  if (!topology.regions().empty()) {
    warnings.emplace_back("SU2 has no regions: the names of element sets are not written");
  }
  Writer(out, mesh, fits ? *details : plain, std::move(names)).write();
  return warnings;
}

}  // namespace winslow::io::su2
