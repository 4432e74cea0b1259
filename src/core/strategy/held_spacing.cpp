#include "core/strategy/held_spacing.h"

#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/mesh/surface_faces.h"
#include "core/quality/wall_measures.h"

namespace winslow {

namespace {

/// The length of an element along a face of it over its height there.
double flatness(const Mesh& mesh, const Face& face, Index element) {
  const Topology& topology = *mesh.topology;
  const Coordinates& x = mesh.coordinates;
  const bool plane = x.dimension() == 2;
  const ElementType type = topology.element_type(element);
  const auto corners = topology.element(element);
  const double measure = plane ? std::abs(signed_area2(x, corners)) / 2
                               : std::abs(signed_volume6(x, type, corners, x.xyz(face[0]))) / 6;
  const double area =
      plane ? (x.xy(face[1]) - x.xy(face[0])).norm() : area_vector(SpacePoints(x), face).norm();
  const bool pointed = plane ? type == ElementType::triangle
                             : type == ElementType::tetrahedron || type == ElementType::pyramid;
  const double height = (pointed ? x.dimension() : 1) * measure / area;
  return (plane ? area : std::sqrt(area)) / height;
}

bool is_flat(const Mesh& mesh, const Marker& marker) {
  constexpr double least = 3;
  std::vector<double> ratios;
  for (const Face& face : marker.faces) {
    const auto found = mesh.topology->find_face(face);
    if (!found) continue;
    const auto shared = mesh.topology->face(*found);
    ratios.push_back(flatness(mesh, face, shared.elements[0]));
  }
  if (ratios.empty()) return false;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::ranges::nth_element(ratios, middle);
  return *middle >= least;
}

class RowMotion final : public Motion {
 public:
  RowMotion(const Motion& motion, CurveRows rows) : motion_(motion), rows_(std::move(rows)) {
    nodes_.assign(motion.nodes().begin(), motion.nodes().end());
    for (const auto& row : rows_)
      nodes_.insert(nodes_.end(), row->between().begin(), row->between().end());
    std::ranges::sort(nodes_);
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  }

  std::span<const Index> nodes() const override { return nodes_; }
  const Motion& of_bodies() const override { return motion_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    motion_.apply(rest, fraction, out);
    for (const auto& row : rows_) {
      const auto places = row->places(place_of(out, row->first()), place_of(out, row->last()));
      for (std::size_t k = 0; k < places.between.size(); ++k) {
        const Vec3& p = places.between[k].point;
        if (out.dimension() == 3)
          out.set_xyz(row->between()[k], p);
        else
          out.set_xy(row->between()[k], p.head<2>());
      }
    }
  }

 private:
  const Motion& motion_;
  CurveRows rows_;
  std::vector<Index> nodes_;
};

/// Which parts are held.
std::vector<SlidingPart*> held_parts(const SlideOptions& slide, const Mesh& mesh,
                                     std::vector<SlidingPart>& parts) {
  std::vector<SlidingPart*> held;
  std::map<std::string, bool> walls;
  for (SlidingPart& part : parts) {
    // A stretch with a node that is held by name slides on both sides of it.
    if (!part.row || std::ranges::any_of(slide.hold_nodes, [&](Index node) {
          return std::ranges::find(part.row->nodes(), node) != part.row->nodes().end();
        }))
      continue;
    bool holds = slide.spacing == SlideSpacing::held ||
                 std::ranges::find(slide.held_markers, part.marker) != slide.held_markers.end();
    if (!holds && slide.spacing == SlideSpacing::automatic) {
      const auto [place, is_new] = walls.try_emplace(part.marker, false);
      if (is_new) place->second = is_wall(mesh, part.marker);
      holds = place->second;
    }
    if (holds) held.push_back(&part);
  }
  return held;
}

/// A row of which a node is held otherwise stays, and so do its ends where they slide; so does such
/// an end where a body moves the other.
void hold_ends(const CurveRow& row, NodeClasses& classes) {
  const bool whole = std::ranges::all_of(
      row.between(), [&](Index node) { return classes[node] == NodeClass::on_curve; });
  for (const Index end : {row.first(), row.last()}) {
    const Index other = end == row.first() ? row.last() : row.first();
    if (classes.moves(end) && (!whole || classes[other] == NodeClass::prescribed))
      classes.set_fixed({&end, 1});
  }
}

/// Ends that slide do so on the curve of the row: a closed row, or one between periodic corners.
Spacing spacing_of(const CurveRow& row, const NodeClasses& classes) {
  const bool moves = classes.moves(row.first()) || classes.moves(row.last());
  const bool taken =
      classes[row.first()] == NodeClass::prescribed || classes[row.last()] == NodeClass::prescribed;
  if (!row.can_move() || !(moves || taken)) return Spacing::stays;
  return row.closed() ? Spacing::turns : Spacing::ends;
}

}  // namespace

bool is_wall(const Mesh& mesh, const std::string& marker) {
  const auto& markers = mesh.topology->markers();
  const std::vector<std::string> names{marker};
  markers.nodes_of(names);  // names the markers that there are, if it is not known
  if (mesh.coordinates.dimension() == 2)
    for (const Wall& wall : find_walls(mesh))
      if (std::ranges::find(wall.markers, marker) != wall.markers.end()) return true;
  return is_flat(mesh, markers[at(*markers.find(marker))]);
}

CurveRows hold_spacing(const SlideOptions& slide, const Mesh& mesh, MovingBoundary& boundary,
                       NodeClasses& classes) {
  CurveRows with_motion;
  const std::vector<SlidingPart*> held = held_parts(slide, mesh, boundary.sliding);
  for (const SlidingPart* part : held) hold_ends(*part->row, classes);
  for (SlidingPart* part : held) {
    const auto& row = part->row;
    part->spacing = spacing_of(*row, classes);
    const bool taken = !classes.moves(row->first()) && !classes.moves(row->last());
    if (part->spacing == Spacing::stays) {
      classes.set_fixed(row->between());
    } else if (taken) {
      classes.set_prescribed(row->between());
      with_motion.push_back(row);
    } else {
      classes.set_following(row);
    }
  }
  return with_motion;
}

std::unique_ptr<const Motion> with_rows(const Motion& motion, const CurveRows& rows) {
  return std::make_unique<RowMotion>(motion, rows);
}

}  // namespace winslow
