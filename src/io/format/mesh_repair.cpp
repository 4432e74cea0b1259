#include "io/format/mesh_repair.h"

#include <Eigen/Geometry>
#include <set>

#include "io/format/cell_of_faces.h"

namespace winslow::io {
namespace {

/// The sorted nodes of a face.
using Key = Face;

struct Item {
  ElementType type;
  std::vector<Index> corners;
  Index region = -1;
  std::size_t place = 0;  // in the file
  bool gone = false;
  std::vector<Face> faces = {};  // of a polyhedron
};

/// Counts faults of one kind and knows where the first one is.
struct Tally {
  std::size_t count = 0;
  std::size_t first = 0;  // offset in the file

  void add(std::size_t place) {
    if (count++ == 0) first = place;
  }
};

std::vector<Index> without_repeats(std::span<const Index> corners) {
  std::vector<Index> kept;
  for (const Index corner : corners)
    if (std::ranges::find(kept, corner) == kept.end()) kept.push_back(corner);
  return kept;
}

class Mender {
 public:
  Mender(ParsedMesh& mesh, const Source& source)
      : mesh_(mesh),
        source_(source),
        dimension_(mesh.data.cell_dimension()),
        x_(mesh.data.coordinates),
        node_places_(mesh.where.nodes) {
    const MeshData& data = mesh.data;
    for (Index e = 0; e < data.element_count(); ++e) {
      const auto corners = data.element(e);
      const std::size_t k = at(e);
      items_.push_back({data.types[k],
                        {corners.begin(), corners.end()},
                        data.element_region.empty() ? -1 : data.element_region[k],
                        k < mesh.where.elements.size() ? mesh.where.elements[k] : 0});
      items_.back().faces.assign(data.polyhedron(e).begin(), data.polyhedron(e).end());
    }
    node_places_.resize(at(x_.size()), 0);
  }

  std::vector<std::string> repair() {
    // An element whose points are not in the file is damage: leaving it out would tear a hole.
    if (!std::ranges::all_of(items_, [&](const Item& item) { return is_known(item); })) return {};
    merge_points();
    mend_repeated_corners();
    drop_duplicates();
    cut_at_flat_triangles();
    if (dimension_ == 2 && x_.dimension() == 3) face_alike();
    drop_unused_points();
    return finish();
  }

  std::vector<std::string> leave_out() {
    drop_unknown_corners();
    mend_repeated_corners();
    drop_duplicates();
    drop_beyond_two();
    if (dimension_ == 2) part_touching();
    return finish();
  }

 private:
  Vec3 place(Index node) const {
    return x_.dimension() == 3 ? x_.xyz(node) : Vec3(x_.xy(node).x(), x_.xy(node).y(), 0);
  }

  /// "12 triangles ...": one of the sentences that are returned.
  void say(const Tally& tally, const char* one, const char* many) {
    if (tally.count == 0) return;
    said_.push_back(std::to_string(tally.count) + ' ' + (tally.count == 1 ? one : many) +
                    (tally.count == 1 ? ", at " : ", the first at ") + source_.place(tally.first));
  }

  template <class Visit>
  void for_each_side(const Item& item, Visit visit) const {
    if (item.type == ElementType::polygon) {
      for (std::size_t k = 0, n = item.corners.size(); k < n; ++k)
        visit(Face(item.corners[k], item.corners[(k + 1) % n]));
      return;
    }
    for (const Face& face : item.faces) visit(face);
    for (const Face& face : shape_of(item.type).faces)
      visit(by_nodes(face, std::span<const Index>(item.corners)));
  }

  /// The items at each side.
  std::map<Key, std::vector<std::size_t>> items_at_sides() const {
    std::map<Key, std::vector<std::size_t>> at_sides;
    for (std::size_t i = 0; i < items_.size(); ++i)
      if (!items_[i].gone)
        for_each_side(items_[i], [&](const Face& face) { at_sides[face.sorted()].push_back(i); });
    return at_sides;
  }

  /// True if an element has all its corners, and the mesh has their points.
  bool is_known(const Item& item) const {
    const auto has_points = [&](const auto& nodes) {
      return std::ranges::all_of(nodes, [&](Index node) { return node >= 0 && node < x_.size(); });
    };
    const bool complete = item.type == ElementType::polygon ? item.corners.size() >= 3
                          : item.type == ElementType::polyhedron
                              ? item.faces.size() >= 4
                              : item.corners.size() == at(corner_count(item.type));
    return complete && has_points(item.corners) && std::ranges::all_of(item.faces, has_points);
  }

  void drop_unknown_corners() {
    Tally dropped;
    for (Item& item : items_) {
      if (is_known(item)) continue;
      item.gone = true;
      dropped.add(item.place);
    }
    say(dropped, "element with a point that does not exist is left out",
        "elements with a point that does not exist are left out");
  }

  void merge_points() {
    std::vector<Index> order(at(x_.size()));
    std::iota(order.begin(), order.end(), 0);
    const auto values = [&](Index node) {
      const Vec3 p = place(node);
      return std::tuple(p.x(), p.y(), p.z());
    };
    std::ranges::sort(
        order, [&](Index a, Index b) { return std::pair(values(a), a) < std::pair(values(b), b); });
    node_of_.resize(order.size());
    Tally merged;
    std::vector<Index> gone;
    for (std::size_t k = 0, first = 0; k < order.size(); ++k) {
      if (values(order[k]) != values(order[first])) first = k;
      node_of_[at(order[k])] = order[first];
      if (k != first) gone.push_back(order[k]);
    }
    std::ranges::sort(gone);
    for (const Index node : gone) merged.add(node_places_[at(node)]);
    for (Item& item : items_) {
      if (item.gone) continue;
      for (Index& corner : item.corners) corner = node_of_[at(corner)];
      for (Face& face : item.faces) face = by_nodes(face, node_of_);
    }
    say(merged, "point lies where an earlier one does: they are one now",
        "points lie where earlier ones do: they are one now");
  }

  void mend_repeated_corners() {
    Tally smaller, dropped;
    for (Item& item : items_) {
      if (item.gone) continue;
      const std::vector<Index> distinct = without_repeats(item.corners);
      if (distinct.size() == item.corners.size()) continue;
      if (collapse(item, distinct)) {
        smaller.add(item.place);
      } else {
        item.gone = true;
        dropped.add(item.place);
      }
    }
    say(smaller, "element uses a point twice: a smaller one is left of it",
        "elements use a point twice: smaller ones are left of them");
    say(dropped, "element that uses a point twice is left out",
        "elements that use a point twice are left out");
  }

  /// Makes of an element what its distinct corners are. Returns false if that is nothing.
  bool collapse(Item& item, const std::vector<Index>& distinct) const {
    if (dimension_ == 2) {
      const bool polygon = item.type == ElementType::polygon && distinct.size() > 3;
      if (distinct.size() != 3 && !polygon) return false;
      if (!polygon) item.type = ElementType::triangle;
      item.corners = distinct;
      return true;
    }
    std::vector<Face> faces;
    for_each_side(item, [&](const Face& face) {
      const auto corners = without_repeats({face.begin(), face.end()});
      if (corners.size() > 2) faces.emplace_back(corners);
    });
    if (item.type == ElementType::polyhedron) return collapse_polyhedron(item, distinct, faces);
    const auto cell = cell_of_faces(faces);
    if (!cell) return false;
    item.type = cell->type;
    item.corners = cell->corners;
    return true;
  }

  /// Makes a polyhedron of faces that are left of one, unless they do not close.
  bool collapse_polyhedron(Item& item, const std::vector<Index>& distinct,
                           std::vector<Face>& faces) const {
    // Two faces that lie on each other now bound nothing.
    const std::vector<Face> all = faces;
    std::erase_if(faces, [&](const Face& face) {
      return std::ranges::count_if(
                 all, [&](const Face& other) { return other.sorted() == face.sorted(); }) > 1;
    });
    try {
      make_faces_alike(faces);
    } catch (const FacesFault&) {
      return false;
    }
    item.faces = faces;
    item.corners = distinct;
    std::erase_if(item.corners, [&](Index node) {
      return std::ranges::none_of(
          faces, [&](const Face& face) { return std::ranges::find(face, node) != face.end(); });
    });
    return true;
  }

  void drop_duplicates() {
    Tally dropped;
    std::set<std::vector<Index>> seen;
    for (Item& item : items_) {
      if (item.gone) continue;
      std::vector<Index> nodes = item.corners;
      std::ranges::sort(nodes);
      if (seen.insert(std::move(nodes)).second) continue;
      item.gone = true;
      dropped.add(item.place);
    }
    say(dropped, "element has the points of an earlier one: left out",
        "elements have the points of earlier ones: left out");
  }

  /// As make_mesh() has it.
  bool is_flat(const Item& item) const {
    const std::size_t n = item.corners.size();
    double longest2 = 0, largest2 = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 p = place(item.corners[k]);
      const Vec3 a = place(item.corners[(k + 1) % n]) - p;
      const Vec3 b = place(item.corners[(k + n - 1) % n]) - p;
      longest2 = std::max(longest2, a.squaredNorm());
      largest2 = std::max(largest2, a.cross(b).norm());
    }
    constexpr double flat = 1e-15;
    return !(largest2 > flat * longest2);
  }

  void cut_at_flat_triangles() {
    if (dimension_ != 2) return;
    Tally cut, dropped;
    // A cut may make a flat triangle of a neighbour that is flat itself.
    constexpr int most_rounds = 20;
    for (int round = 0; round < most_rounds; ++round) {
      std::vector<std::size_t> flat;
      for (std::size_t i = 0; i < items_.size(); ++i)
        if (!items_[i].gone && items_[i].corners.size() == 3 && is_flat(items_[i]))
          flat.push_back(i);
      if (flat.empty()) break;
      const auto at_sides = items_at_sides();
      std::vector<bool> changed(items_.size(), false);
      for (const std::size_t i : flat)
        if (!changed[i]) cut_at(i, at_sides, changed, cut, dropped);
    }
    say(cut, "triangle has no area: its neighbour is cut at its middle point instead",
        "triangles have no area: their neighbours are cut at their middle points instead");
    say(dropped, "triangle without area at the border is left out",
        "triangles without area at the border are left out");
  }

  /// Cuts the element beyond the longest edge of a flat triangle at the triangle's third point.
  void cut_at(std::size_t flat, const std::map<Key, std::vector<std::size_t>>& at_sides,
              std::vector<bool>& changed, Tally& cut, Tally& dropped) {
    const std::vector<Index> own = items_[flat].corners;
    std::size_t longest = 0;
    const auto length = [&](std::size_t k) {
      return (place(own[(k + 1) % 3]) - place(own[k])).squaredNorm();
    };
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
      if (length(k) > length(longest)) longest = k;
    const Index middle = own[(longest + 2) % 3];
    const Key edge = Face(own[longest], own[(longest + 1) % 3]).sorted();
    const auto& beside = at_sides.at(edge);
    const auto other = std::ranges::find_if(beside, [&](std::size_t i) { return i != flat; });
    if (other == beside.end()) {
      items_[flat].gone = true;
      dropped.add(items_[flat].place);
      return;
    }
    if (changed[*other]) return;  // in the next round
    changed[flat] = changed[*other] = true;
    const Item old = items_[*other];
    const std::size_t n = old.corners.size();
    std::size_t k = 0;
    while (Face(old.corners[k], old.corners[(k + 1) % n]).sorted() != edge) ++k;
    const auto corner = [&](std::size_t step) { return old.corners[(k + step) % n]; };
    if (old.type == ElementType::polygon) {  // it gets a flat corner
      items_[*other].corners.insert(
          items_[*other].corners.begin() + static_cast<std::ptrdiff_t>(k) + 1, middle);
      items_[flat].gone = true;
      cut.add(old.place);
      return;
    }
    const auto triangle = [&](Index a, Index b, Index c) {
      return Item{ElementType::triangle, {a, b, c}, old.region, old.place};
    };
    // The corners of the neighbour are 0 1 2 (3), the edge to cut is from 0 to 1.
    items_[*other] = triangle(corner(0), middle, corner(n - 1));
    items_[flat] = triangle(middle, corner(1), corner(2));
    if (n == 4) items_.push_back(triangle(middle, corner(2), corner(3)));
    changed.resize(items_.size(), true);
    cut.add(old.place);
  }

  /// Turns elements so that those of a part face alike.
  void face_alike() {
    const auto at_sides = items_at_sides();
    std::vector<signed char> turn(items_.size(), -1);
    Tally turned;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (items_[i].gone || turn[i] >= 0) continue;
      const std::vector<std::size_t> part = part_of(i, at_sides, turn);
      const auto turns = std::ranges::count_if(part, [&](std::size_t k) { return turn[k] == 1; });
      const bool most = 2 * turns > std::ssize(part);
      const bool others = is_closed(part, at_sides) ? volume(part, turn) < 0 : most;
      for (const std::size_t k : part) {
        if ((turn[k] == 1) == others) continue;
        std::reverse(items_[k].corners.begin() + 1, items_[k].corners.end());
        turned.add(items_[k].place);
      }
    }
    say(turned, "element faces the other way than its neighbours, or inwards: turned",
        "elements face the other way than their neighbours, or inwards: turned");
  }

  /// The items of a part, and which of them are to be turned to face as the first one does.
  std::vector<std::size_t> part_of(std::size_t first,
                                   const std::map<Key, std::vector<std::size_t>>& at_sides,
                                   std::vector<signed char>& turn) const {
    std::vector<std::size_t> part{first};
    turn[first] = 0;
    for (std::size_t p = 0; p < part.size(); ++p) {
      const std::size_t i = part[p];
      for_each_side(items_[i], [&](const Face& face) {
        const auto& beside = at_sides.at(face.sorted());
        if (beside.size() != 2) return;
        const std::size_t other = beside[0] == i ? beside[1] : beside[0];
        if (turn[other] >= 0) return;
        // Neighbours that face alike go along their edge in opposite directions.
        bool same = false;
        for_each_side(items_[other], [&](const Face& edge) { same = same || edge == face; });
        turn[other] = static_cast<signed char>(same ? 1 - turn[i] : turn[i]);
        part.push_back(other);
      });
    }
    return part;
  }

  bool is_closed(const std::vector<std::size_t>& part,
                 const std::map<Key, std::vector<std::size_t>>& at_sides) const {
    bool closed = true;
    for (const std::size_t i : part)
      for_each_side(items_[i], [&](const Face& face) {
        closed = closed && at_sides.at(face.sorted()).size() == 2;
      });
    return closed;
  }

  /// Six times the volume that a part encloses.
  double volume(const std::vector<std::size_t>& part, const std::vector<signed char>& turn) const {
    const Vec3 origin = place(items_[part.front()].corners[0]);
    double sum = 0;
    for (const std::size_t i : part) {
      const auto& corners = items_[i].corners;
      for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const Vec3 a = place(corners[0]) - origin, b = place(corners[k]) - origin,
                   c = place(corners[k + 1]) - origin;
        sum += (turn[i] == 1 ? -1 : 1) * a.dot(b.cross(c));
      }
    }
    return sum;
  }

  void drop_beyond_two() {
    Tally dropped;
    for (const auto& [key, beside] : items_at_sides()) {
      std::size_t kept = 0;
      for (const std::size_t i : beside) {
        if (items_[i].gone) continue;
        if (++kept <= 2) continue;
        items_[i].gone = true;
        dropped.add(items_[i].place);
      }
    }
    say(dropped, "element at an edge or face that has two already is left out",
        "elements at edges or faces that have two already are left out");
  }

  /// Gives each part that only touches others in a point a point of its own.
  void part_touching() {
    std::vector<std::vector<std::size_t>> around(at(x_.size()));
    for (std::size_t i = 0; i < items_.size(); ++i)
      if (!items_[i].gone)
        for (const Index node : items_[i].corners) around[at(node)].push_back(i);
    Tally parted;
    for (Index node = 0; node < static_cast<Index>(around.size()); ++node) {
      const auto parts = parts_around(node, around[at(node)]);
      for (std::size_t p = 1; p < parts.size(); ++p) {
        const Index copy = add_copy(node);
        for (const std::size_t i : parts[p]) std::ranges::replace(items_[i].corners, node, copy);
      }
      if (parts.size() > 1) parted.add(node_places_[at(node)]);
    }
    say(parted, "point in which parts only touch is shown as several",
        "points in which parts only touch are shown as several");
  }

  /// The items around a node, those joined by edges at it together.
  std::vector<std::vector<std::size_t>> parts_around(Index node,
                                                     std::vector<std::size_t> left) const {
    const auto neighbours = [&](std::size_t i) {
      const auto& corners = items_[i].corners;
      const std::size_t n = corners.size();
      const auto k = static_cast<std::size_t>(std::ranges::find(corners, node) - corners.begin());
      return std::array{corners[(k + 1) % n], corners[(k + n - 1) % n]};
    };
    std::vector<std::vector<std::size_t>> parts;
    while (!left.empty()) {
      std::vector<std::size_t> part{left.back()};
      left.pop_back();
      for (std::size_t p = 0; p < part.size(); ++p) {
        const auto own = neighbours(part[p]);
        std::erase_if(left, [&](std::size_t i) {
          const auto others = neighbours(i);
          const bool joined = std::ranges::find_first_of(own, others) != own.end();
          if (joined) part.push_back(i);
          return joined;
        });
      }
      parts.push_back(std::move(part));
    }
    return parts;
  }

  Index add_copy(Index node) {
    if (x_.dimension() == 3)
      x_.push_xyz(x_.xyz(node));
    else
      x_.push_xy(x_.xy(node));
    node_places_.push_back(node_places_[at(node)]);
    return x_.size() - 1;
  }

  void drop_unused_points() {
    std::vector<bool> used(at(x_.size()), false);
    for (const Item& item : items_)
      if (!item.gone)
        for (const Index node : item.corners) used[at(node)] = true;
    // Merged points are counted already.
    Tally dropped;
    for (Index node = 0; node < x_.size(); ++node)
      if (!used[at(node)] && (node_of_.empty() || node_of_[at(node)] == node))
        dropped.add(node_places_[at(node)]);
    say(dropped, "point that no element uses is left out",
        "points that no element uses are left out");
    number_.assign(used.size(), -1);
    Index next = 0;
    for (std::size_t node = 0; node < used.size(); ++node)
      if (used[node]) number_[node] = next++;
  }

  Index new_number(Index node) const {
    if (node < 0 || node >= x_.size()) return -1;
    const Index merged = node_of_.empty() ? node : node_of_[at(node)];
    return number_.empty() ? merged : number_[at(merged)];
  }

  std::vector<std::string> finish() {
    Tally lost;
    MeshData data;
    SourceMap where;
    data.coordinates = Coordinates(x_.dimension(), 0);
    for (Index node = 0; node < x_.size(); ++node) {
      if (!number_.empty() && number_[at(node)] < 0) continue;
      if (x_.dimension() == 3)
        data.coordinates.push_xyz(x_.xyz(node));
      else
        data.coordinates.push_xy(x_.xy(node));
      where.nodes.push_back(node_places_[at(node)]);
    }
    std::set<Key> sides;
    for (const Item& item : items_) {
      if (item.gone) continue;
      std::vector<Index> corners;
      for (const Index node : item.corners)
        corners.push_back(number_.empty() ? node : number_[at(node)]);
      Item renumbered = item;
      for (Face& face : renumbered.faces)
        if (!number_.empty()) face = by_nodes(face, number_);
      if (item.type == ElementType::polyhedron)
        data.add_polyhedron(corners, renumbered.faces);
      else
        data.add_element(item.type, corners);
      where.elements.push_back(item.place);
      if (!mesh_.data.element_region.empty()) data.element_region.push_back(item.region);
      renumbered.corners = std::move(corners);
      for_each_side(renumbered, [&](const Face& face) { sides.insert(face.sorted()); });
    }
    take_markers(sides, data, where, lost);
    say(lost, "face of a marker is no side of an element any more: left out",
        "faces of markers are no sides of elements any more: left out");
    if (said_.empty()) return said_;
    data.regions = mesh_.data.regions;
    mesh_.data = std::move(data);
    mesh_.where = std::move(where);
    forget_details();
    return said_;
  }

  void take_markers(const std::set<Key>& sides, MeshData& data, SourceMap& where,
                    Tally& lost) const {
    for (std::size_t m = 0; m < mesh_.data.markers.size(); ++m) {
      const Marker& old = mesh_.data.markers[m];
      Marker marker{old.name, old.tag, {}};
      where.marker_edges.emplace_back();
      for (std::size_t f = 0; f < old.faces.size(); ++f) {
        const std::size_t place =
            m < mesh_.where.marker_edges.size() && f < mesh_.where.marker_edges[m].size()
                ? mesh_.where.marker_edges[m][f]
                : 0;
        std::vector<Index> nodes;
        for (const Index node : old.faces[f]) nodes.push_back(new_number(node));
        const auto distinct = without_repeats(nodes);
        const bool whole = std::ranges::find(distinct, -1) == distinct.end() &&
                           distinct.size() >= (dimension_ == 2 ? 2U : 3U);
        if (!whole || !sides.contains(Face(distinct).sorted())) {
          lost.add(place);
          continue;
        }
        marker.faces.emplace_back(distinct);
        where.marker_edges.back().push_back(place);
      }
      data.markers.push_back(std::move(marker));
    }
  }

  /// What the file says of its own nodes and elements is true no more.
  void forget_details() {
    auto details = std::make_shared<FormatDetails>();
    const FormatDetails& old = *mesh_.details;
    details->binary = old.binary;
    if (old.plane_z.size() == 1) details->plane_z = old.plane_z;
    details->plane = old.plane;
    details->roles = old.roles;
    details->zones = old.zones;
    details->zone = old.zone;
    details->changed = true;
    mesh_.details = std::move(details);
  }

  ParsedMesh& mesh_;
  const Source& source_;
  int dimension_;  // of the elements
  Coordinates x_;
  std::vector<std::size_t> node_places_;
  std::vector<Item> items_;
  std::vector<Index> node_of_;  // the point that each is merged into; empty: none
  std::vector<Index> number_;   // of each point in the result, -1: left out; empty: as before
  std::vector<std::string> said_;
};

}  // namespace

std::vector<std::string> repair(ParsedMesh& mesh, const Source& source) {
  return Mender(mesh, source).repair();
}

std::vector<std::string> leave_out_defects(ParsedMesh& mesh, const Source& source) {
  return Mender(mesh, source).leave_out();
}

}  // namespace winslow::io
