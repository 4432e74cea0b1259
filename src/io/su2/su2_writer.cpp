#include <iterator>

#include "core/error.h"
#include "io/format/mesh_in_space.h"
#include "io/format/periodicity.h"
#include "io/su2/su2.h"
#include "io/su2/su2_periodic.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io::su2 {
namespace {

/// Replaces white space, at which SU2 ends a name, and '%', at which it ends a line.
std::vector<std::string> safe_names(std::span<const Marker> markers,
                                    std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  for (const Marker& marker : markers) {
    std::string name = marker.name.empty() ? "unnamed" : as_word(marker.name, "%=");
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
  /// place: for a plane mesh written with NDIME= 3, details with its plane.
  Writer(std::ostream& out, const Mesh& mesh, const Details& details, const FormatDetails* place,
         std::vector<std::string> names)
      : out_(out),
        mesh_(mesh),
        details_(details),
        space_(mesh, details.dimension == 3 ? place : nullptr),
        names_(std::move(names)) {}

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
        out_ << "NDIME= " << details_.dimension << details_.line_end;
        break;
      case Details::Part::elements:
        write_elements();
        break;
      case Details::Part::points:
        write_points(item.text);
        break;
      case Details::Part::marker_count:
        out_ << "NMARK= "
             << details_.marker_parts.size() + static_cast<std::size_t>(details_.raw_markers)
             << details_.line_end;
        break;
      case Details::Part::marker:
        write_marker(details_.marker_parts[next_part_++]);
        break;
    }
  }

  void write_elements() {
    out_ << "NELEM= " << topology().element_count() << details_.line_end;
    for (Index e = 0; e < topology().element_count(); ++e) {
      const ElementType type = topology().element_type(e);
      out_ << element_number(type);
      if (type == ElementType::prism) {
        write_prism(e);
      } else {
        for (const Index node : space_.element(e)) out_ << ' ' << node;
      }
      end_line(details_.element_numbers, e);
    }
  }

  void write_prism(Index e) {
    std::array<Index, 6> corners{};
    std::ranges::copy(topology().element(e), corners.begin());
    mirror_prism(corners);
    for (const Index node : corners) out_ << ' ' << node;
  }

  void write_points(const std::string& after_count) {
    out_ << "NPOIN= " << mesh_.coordinates.size();
    if (!after_count.empty()) out_ << ' ' << after_count;
    out_ << details_.line_end;
    for (Index i = 0; i < mesh_.coordinates.size(); ++i) {
      const Vec3 p = space_.node(i);
      for (int k = 0; k < details_.dimension; ++k) out_ << (k > 0 ? " " : "") << p[k];
      end_point(i);
    }
  }

  void write_marker(const Details::MarkerPart& part) {
    const auto faces =
        std::span(topology().markers()[part.marker].faces).subspan(part.first, part.count);
    out_ << "MARKER_TAG= " << names_[part.marker] << details_.line_end;
    out_ << "MARKER_ELEMS= " << faces.size() << details_.line_end;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      out_ << face_number(faces[f].size());
      for (const Index node : faces[f]) out_ << ' ' << node;
      end_line(details_.face_numbers, static_cast<Index>(f));
    }
  }

  void end_point(Index i) {
    if (details_.point_tails.empty()) return end_line(details_.point_numbers, i);
    const std::string& tail = details_.point_tails[static_cast<std::size_t>(i)];
    if (!tail.empty()) out_ << ' ' << tail;
    out_ << details_.line_end;
  }

  void end_line(bool numbered, Index number) {
    if (numbered) out_ << ' ' << number;
    out_ << details_.line_end;
  }

  TextWriter out_;
  const Mesh& mesh_;
  const Details& details_;
  MeshInSpace space_;
  std::vector<std::string> names_;
  std::size_t next_part_ = 0;
};

/// True if the markers have as many faces as when they were read.
bool has_parts(std::span<const Marker> markers, const Details& details) {
  std::vector<std::size_t> faces(markers.size(), 0);
  for (const Details::MarkerPart& part : details.marker_parts) {
    if (part.marker >= markers.size()) return false;
    faces[part.marker] += part.count;
  }
  for (std::size_t m = 0; m < markers.size(); ++m)
    if (faces[m] != markers[m].faces.size()) return false;
  return true;
}

/// Details for a mesh without any, or with details that do not fit it.
Details default_details(const Topology& topology, std::span<const Marker> markers,
                        const Details* source) {
  using Part = Details::Part;
  Details details;
  details.dimension =
      std::max(topology.space_dimension(), source == nullptr ? 0 : source->dimension);
  details.items = {
      {Part::dimension, {}}, {Part::elements, {}}, {Part::points, {}}, {Part::marker_count, {}}};
  details.items.resize(details.items.size() + markers.size(), {Part::marker, {}});
  for (std::size_t m = 0; m < markers.size(); ++m)
    details.marker_parts.push_back({m, 0, markers[m].faces.size()});
  details.element_numbers = details.point_numbers = true;
  if (source == nullptr) return details;
  details.line_end = source->line_end;
  if (source->blocks) {
    const std::string head = "IZONE= " + std::to_string(source->zone) + source->line_end;
    details.items.insert(details.items.begin(), {Part::text, head});
  }
  return details;
}

/// True if the details hold comments or unknown keywords. NZONE and IZONE do not count: they are
/// written anyway, or are redundant for a single zone.
bool says_more(const Details& details) {
  for (const auto& item : details.items) {
    if (item.part != Details::Part::text) continue;
    std::string_view rest = item.text;
    while (!rest.empty()) {
      const auto end = std::min(rest.find('\n'), rest.size() - 1) + 1;
      const auto line = trimmed(rest.substr(0, end));
      rest.remove_prefix(end);
      if (!line.empty() && !line.starts_with("NZONE") && !line.starts_with("IZONE")) return true;
    }
  }
  return false;
}

/// True if a node that a box lists has moved, so that the box is no longer valid.
bool box_is_stale(const std::vector<BoxPoint>& points, const Coordinates& x) {
  return std::any_of(points.begin(), points.end(), [&](const BoxPoint& point) {
    return point.node < x.size() && place_in_space(nullptr, x, point.node) != point.place;
  });
}

/// Warns about pairs of a source whose details are not written: current SU2 keeps them in its
/// configuration file.
void name_pairs(const FormatDetails* source, const Mesh& mesh, std::vector<std::string>& warnings) {
  if (source == nullptr || !source->periodic || source->periodic->pairs.empty()) return;
  const GivenPeriodicity& periodic = *source->periodic;
  std::string lines;
  for (const GivenPairs& given : periodic.pairs) {
    if (given.halo || given.first == given.second || !given.fault.empty()) continue;
    try {
      const Topology& topology = *mesh.topology;
      const PeriodicPairs pairs =
          periodic.fits(topology)
              ? PeriodicPairs::of(topology, mesh.coordinates, given)
              : PeriodicPairs::find(topology, mesh.coordinates, given.first, given.second);
      lines += (lines.empty() ? "" : "; ") + configuration_line(pairs);
    } catch (const UsageError&) {
      continue;  // they no longer match
    }
  }
  warnings.push_back(
      "the periodic pairs of the source (" + named_pairs(periodic) + ") are not written" +
      (lines.empty() ? "" : ": SU2 reads them from its configuration file, as " + lines));
}

void write_zone(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                std::vector<std::string>& warnings) {
  const auto* details = dynamic_cast<const Details*>(source);
  const Topology& topology = *mesh.topology;
  const std::span<const Marker> markers = topology.markers().from_file()
                                              ? std::span<const Marker>(topology.markers().list())
                                              : std::span<const Marker>();
  const bool fits = details != nullptr && details->same_size(topology) &&
                    details->markers == markers.size() && has_parts(markers, *details);
  // A name from an SU2 file is written back unchanged.
  std::vector<std::string> names;
  if (fits) {
    for (const Marker& marker : markers) names.push_back(marker.name);
  } else {
    names = safe_names(markers, warnings);
  }
  const Details plain = fits ? Details{} : default_details(topology, markers, details);
  if (source != nullptr && source->plane && (fits ? *details : plain).dimension == 2) {
    warnings.push_back("with NDIME= 2 an SU2 file has two coordinates: those in " +
                       source->plane->plane_text() + ", " + source->plane->axes_text() +
                       ", are written, and where the plane lies is lost");
  }
  if (details != nullptr && !fits && says_more(*details)) {
    warnings.emplace_back(
        "the mesh has changed: comments and unknown keywords of the source are not written");
  }
  if (fits && box_is_stale(details->box_points, mesh.coordinates)) {
    warnings.emplace_back(
        "the free-form deformation box (FFD_SURFACE_POINTS) still holds where its points lay "
        "before "
        "they moved: have SU2_DEF set it up anew (DV_KIND= FFD_SETTING)");
  }
  if (!fits) {
    name_pairs(source, mesh, warnings);
  } else {
    std::ranges::move(stale_pairs(*details, mesh), std::back_inserter(warnings));
  }
  if (!topology.regions().empty()) {
    warnings.emplace_back("SU2 has no regions: the names of element sets are not written");
  }
  Writer(out, mesh, fits ? *details : plain, source, std::move(names)).write();
}

/// The details of a zone for a file with only this zone.
Details without_zones(Details details) {
  using Part = Details::Part;
  std::string& first = details.items.front().text;  // begins with the line IZONE=
  first.erase(0, std::min(first.find('\n'), first.size() - 1) + 1);
  details.blocks = nullptr;
  const auto says_dimension = [](const auto& item) { return item.part == Part::dimension; };
  if (std::none_of(details.items.begin(), details.items.end(), says_dimension)) {
    details.items.insert(details.items.begin(), {Part::dimension, {}});
  }
  return details;
}

}  // namespace

std::vector<std::string> write_zones(std::ostream& out, std::span<const MeshZone> zones,
                                     const WriteOptions&) {
  std::vector<std::string> warnings;
  const auto details_of = [](const MeshZone& zone) {
    return dynamic_cast<const Details*>(zone.details);
  };
  const Details* first = details_of(zones.front());
  if (first == nullptr || !first->blocks) {
    write_zone(out, *zones.front().mesh, zones.front().details, warnings);
    return warnings;
  }
  const auto& blocks = *first->blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto changed = std::find_if(zones.begin(), zones.end(), [&](const MeshZone& zone) {
      return details_of(zone)->block == b;
    });
    if (changed == zones.end()) {
      out << blocks[b];
    } else {
      write_zone(out, *changed->mesh, details_of(*changed), warnings);
    }
  }
  return warnings;
}

std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                               const WriteOptions&) {
  std::vector<std::string> warnings;
  const auto* details = dynamic_cast<const Details*>(source);
  if (details == nullptr || !details->blocks) {
    write_zone(out, mesh, source, warnings);
    return warnings;
  }
  const Details alone = without_zones(*details);
  write_zone(out, mesh, &alone, warnings);
  return warnings;
}

}  // namespace winslow::io::su2
