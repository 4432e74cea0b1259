#include "core/motion/contact.h"

#include <Eigen/Geometry>
#include <cstdio>
#include <set>
#include <utility>

#include "core/mesh/mesh.h"
#include "core/motion/outline.h"
#include "core/motion/sheets.h"

namespace winslow {

namespace {

template <int D>
void set_place(EdgePair& pair, const Vec<D>& place) {
  pair.place.setZero();
  pair.place.template head<D>() = place;
}

template <int D>
class ContactSearch {
 public:
  ContactSearch(const Topology& topology, const Coordinates& rest, const Motion& motion,
                std::span<const Index> yielding)
      : topology_(topology),
        rest_(rest),
        motion_(motion),
        outline_(topology, rest, motion.nodes(), yielding),
        fixed_(tree_of(outline_.fixed.facets, rest)),
        rigid_(keeps_distances()),
        body_(bodies_of_facets()) {}

  std::optional<Contact> first() {
    if (outline_.moving.facets.empty() || !apart_at_rest()) return std::nullopt;
    const std::vector<std::size_t> all = all_moving();
    constexpr int intervals = 64;  // short enough to detect a body that crosses itself
    Positions from(*this, 0);
    for (int k = 0; k < intervals; ++k) {
      const double begin = static_cast<double>(k) / intervals;
      const double end = static_cast<double>(k + 1) / intervals;
      Positions to(*this, end);
      if (auto contact = within({begin, end}, from, to, all)) return contact;
      // Bodies that each keep their shape meet within().
      if (!rigid_ && !several_bodies() && meeting_among(to.x(), all)) return refined(begin, end);
      from.swap(to);
    }
    return std::nullopt;
  }

 private:
  struct Interval {
    double begin, end;
    double middle() const { return 0.5 * (begin + end); }
  };

  /// The node positions at a fraction, and a tree of the facets between moving and fixed nodes.
  /// Copies of all nodes are reused: a motion writes the same few nodes each time.
  class Positions {
   public:
    Positions(const ContactSearch& search, double fraction) : search_(&search) {
      auto& spare = search.spare_;
      if (!spare.empty()) {
        x_ = std::move(spare.back());
        spare.pop_back();
      } else {
        x_ = search.rest_;
      }
      search.motion_.apply(search.rest_, fraction, x_);
      std::vector<FacetNodes<D>> joints;
      for (const std::size_t j : search.outline_.joints)
        joints.push_back(search.outline_.moving.facets[j]);
      joints_ = tree_of(joints, x_);
    }
    Positions(const Positions&) = delete;
    Positions& operator=(const Positions&) = delete;
    ~Positions() { search_->spare_.push_back(std::move(x_)); }
    void swap(Positions& other) {
      std::swap(x_, other.x_);
      std::swap(joints_, other.joints_);
    }
    const Coordinates& x() const { return x_; }
    const BoxTree<D>& joints() const { return joints_; }

   private:
    const ContactSearch* search_;
    Coordinates x_;
    BoxTree<D> joints_;
  };

  /// Nodes that determine the position of a rigid body: two in the plane, three in space.
  std::vector<Index> reference_nodes() const {
    const auto nodes = motion_.nodes();
    std::vector<Index> references{nodes.front(), nodes.back()};
    if constexpr (D == 3) {
      const Vec3 from = rest_.xyz(nodes.front()), way = rest_.xyz(nodes.back()) - from;
      references.push_back(*std::ranges::max_element(
          nodes, {}, [&](Index node) { return way.cross(rest_.xyz(node) - from).squaredNorm(); }));
    }
    return references;
  }

  /// Whether the body keeps its shape: then it never meets itself.
  bool keeps_distances() const {
    const auto nodes = motion_.nodes();
    if (nodes.empty()) return true;
    const Positions end(*this, 1), middle(*this, 0.5);
    Box<D> body = Box<D>::empty();
    for (const Index node : nodes) body.add(rest_.get<D>(node));
    constexpr double relative = 1e-9;  // of round-off
    const double least = relative * body.size().norm();
    const auto between = [](const Coordinates& x, Index a, Index b) {
      return (x.get<D>(a) - x.get<D>(b)).norm();
    };
    const auto same = [&](Index a, Index b) {
      const double length = between(rest_, a, b);
      return std::abs(between(middle.x(), a, b) - length) <= least &&
             std::abs(between(end.x(), a, b) - length) <= least;
    };
    const std::vector<Index> references = reference_nodes();
    return std::ranges::all_of(nodes, [&](Index node) {
      return std::ranges::all_of(references, [&](Index other) { return same(node, other); });
    });
  }

  /// For each moving facet the index of its body, or `any` if it belongs to two. Empty for a single
  /// body.
  std::vector<int> bodies_of_facets() const {
    const auto bodies = motion_.bodies();
    std::vector<int> of_facet;
    if (bodies.empty()) return of_facet;
    std::vector<int> of_node(at(rest_.size()), any);
    std::vector<unsigned char> shared(at(rest_.size()), 0);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      for (const Index node : bodies[b]->nodes()) {
        shared[at(node)] = of_node[at(node)] != any;
        of_node[at(node)] = static_cast<int>(b);
      }
    }
    for (const FacetNodes<D>& nodes : outline_.moving.facets) {
      int body = any;
      bool mixed = false;
      for (const Index node : nodes) {
        // A node of two bodies moves with both.
        if (of_node[at(node)] == any || shared[at(node)]) continue;
        mixed = mixed || (body != any && body != of_node[at(node)]);
        body = of_node[at(node)];
      }
      of_facet.push_back(mixed ? any : body);
    }
    return of_facet;
  }

  bool several_bodies() const { return !body_.empty(); }
  /// Whether two moving facets can approach each other: two facets of one rigid body cannot.
  bool move_apart(std::size_t e, std::size_t f) const {
    return !several_bodies() || body_[e] == any || body_[e] != body_[f];
  }

  std::vector<std::size_t> all_moving() const {
    std::vector<std::size_t> all(outline_.moving.facets.size());
    for (std::size_t e = 0; e < all.size(); ++e) all[e] = e;
    return all;
  }

  /// Stores the pairs of facets that touch before the motion, e.g. at a crack; they are ignored.
  /// Returns false if facets cross.
  bool apart_at_rest() {
    bool apart = true;
    const auto judge = [&](const FacetNodes<D>& own, const FacetNodes<D>& other) {
      const Meeting<D> found = meeting(facet(own, rest_), facet(other, rest_));
      if (found.kind == Meeting<D>::Kind::touch) touching_.insert(ordered(own, other));
      if (found.kind == Meeting<D>::Kind::crossing) apart = false;
      return false;
    };
    const Positions start(*this, 0);
    for (std::size_t e = 0; e < outline_.moving.facets.size(); ++e) {
      const FacetNodes<D>& own = outline_.moving.facets[e];
      any_near(e, box_of<D>(facet(own, rest_)), start,
               [&](const FacetNodes<D>& other, Index) { return judge(own, other); });
    }
    if (!rigid_) {
      among_moving(rest_, all_moving(), [&](std::size_t e, std::size_t f) {
        return judge(outline_.moving.facets[e], outline_.moving.facets[f]);
      });
    }
    return apart;
  }

  static std::pair<FacetNodes<D>, FacetNodes<D>> ordered(const FacetNodes<D>& a,
                                                         const FacetNodes<D>& b) {
    return std::minmax(a, b);
  }

  /// Whether two facets are tested for contact: without a common node, and not touching at rest.
  bool eligible(const FacetNodes<D>& a, const FacetNodes<D>& b) const {
    return !share_node(a, b) && (touching_.empty() || !touching_.contains(ordered(a, b)));
  }

  /// Calls `visit(nodes, marker)` with the facets that a moving facet inside the box may meet,
  /// until it returns true.
  template <class Visit>
  bool any_near(std::size_t e, const Box<D>& box, const Positions& positions,
                const Visit& visit) const {
    const FacetNodes<D>& own = outline_.moving.facets[e];
    bool found = false;
    fixed_.overlapping(box, [&](Index f) {
      const auto k = static_cast<std::size_t>(f);
      const FacetNodes<D>& other = outline_.fixed.facets[k];
      if (!found && eligible(own, other)) found = visit(other, outline_.fixed.markers[k]);
    });
    positions.joints().overlapping(box, [&](Index k) {
      const std::size_t j = outline_.joints[static_cast<std::size_t>(k)];
      const FacetNodes<D>& other = outline_.moving.facets[j];
      if (!found && eligible(own, other)) found = visit(other, outline_.moving.markers[j]);
    });
    return found;
  }

  /// Calls `visit(e, f)` with pairs of these moving facets near each other until it returns true.
  template <class Visit>
  void among_moving(const Coordinates& x, std::span<const std::size_t> moving,
                    const Visit& visit) const {
    std::vector<FacetNodes<D>> facets;
    facets.reserve(moving.size());
    for (const std::size_t e : moving) facets.push_back(outline_.moving.facets[e]);
    const BoxTree<D> tree = tree_of(facets, x);
    bool found = false;
    for (std::size_t i = 0; i < facets.size() && !found; ++i) {
      tree.overlapping(box_of<D>(facet(facets[i], x)), [&](Index item) {
        const std::size_t j = at(item);
        if (!found && j > i && move_apart(moving[i], moving[j]) && eligible(facets[i], facets[j]))
          found = visit(moving[i], moving[j]);
      });
    }
  }

  std::optional<EdgePair> pair_if_meeting(const Coordinates& x, std::size_t e,
                                          const FacetNodes<D>& other, Index marker) const {
    const Meeting<D> found = meeting(facet(outline_.moving.facets[e], x), facet(other, x));
    if (found.kind == Meeting<D>::Kind::none) return std::nullopt;
    EdgePair pair{name(outline_.moving.markers[e]), name(marker), {}};
    set_place<D>(pair, found.place);
    return pair;
  }

  /// The first of the given moving facets that meets another facet.
  std::optional<EdgePair> meeting_of(const Positions& positions,
                                     std::span<const std::size_t> facets) const {
    const Coordinates& x = positions.x();
    std::optional<EdgePair> pair;
    for (const std::size_t e : facets) {
      const Box<D> box = box_of<D>(facet(outline_.moving.facets[e], x));
      any_near(e, box, positions, [&](const FacetNodes<D>& other, Index marker) {
        pair = pair_if_meeting(x, e, other, marker);
        return pair.has_value();
      });
      if (pair) break;
    }
    return pair;
  }

  /// The first two of the given moving facets that meet.
  std::optional<EdgePair> meeting_among(const Coordinates& x,
                                        std::span<const std::size_t> moving) const {
    std::optional<EdgePair> pair;
    among_moving(x, moving, [&](std::size_t e, std::size_t f) {
      pair = pair_if_meeting(x, e, outline_.moving.facets[f], outline_.moving.markers[f]);
      return pair.has_value();
    });
    return pair;
  }

  std::optional<EdgePair> meeting_at(double fraction) const {
    const Positions positions(*this, fraction);
    if (auto pair = meeting_of(positions, all_moving())) return pair;
    return rigid_ ? std::nullopt : meeting_among(positions.x(), all_moving());
  }

  /// The swept box of a facet, from three positions: the arc extends beyond them by at most the
  /// distance of the middle position from the chord.
  Box<D> swept(std::size_t e, const Coordinates& from, const Coordinates& middle,
               const Coordinates& to) const {
    const FacetNodes<D>& nodes = outline_.moving.facets[e];
    Box<D> box = box_of<D>(facet(nodes, from));
    box.add(box_of<D>(facet(nodes, middle)));
    box.add(box_of<D>(facet(nodes, to)));
    double sagitta = 0;
    for (const Index node : nodes) {
      const Vec<D> chord = 0.5 * (from.get<D>(node) + to.get<D>(node));
      sagitta = std::max(sagitta, (middle.get<D>(node) - chord).norm());
    }
    box.min.array() -= sagitta;
    box.max.array() += sagitta;
    return box;
  }

  /// sweeps: the boxes of `facets`.
  bool near_other_body(std::size_t e, const Box<D>& box, const BoxTree<D>& sweeps,
                       std::span<const std::size_t> facets) const {
    if (!several_bodies()) return false;
    bool near = false;
    sweeps.overlapping(box, [&](Index item) {
      const std::size_t f = facets[at(item)];
      near = near || (f != e && move_apart(e, f) &&
                      eligible(outline_.moving.facets[e], outline_.moving.facets[f]));
    });
    return near;
  }

  /// Whether some facet that does not move lies in the box around all that moving nodes sweep;
  /// always true where facets join moving and fixed nodes. Most motions are far from anything most
  /// of the way.
  bool may_meet_fixed(const Coordinates& from, const Coordinates& middle,
                      const Coordinates& to) const {
    if (!outline_.joints.empty()) return true;
    Box<D> all = Box<D>::empty();
    double sagitta = 0;  // as in swept()
    for (const Index node : motion_.nodes()) {
      const Vec<D> a = from.get<D>(node), b = middle.get<D>(node), c = to.get<D>(node);
      all.add(a);
      all.add(b);
      all.add(c);
      sagitta = std::max(sagitta, (b - 0.5 * (a + c)).squaredNorm());
    }
    sagitta = std::sqrt(sagitta);
    // A little more, for round-off.
    const Vec<D> more = Vec<D>::Constant(sagitta + 1e-9 * (all.size().norm() + sagitta));
    bool found = false;
    fixed_.overlapping({all.min - more, all.max + more}, [&](Index) { found = true; });
    return found;
  }

  std::optional<Contact> within(const Interval& interval, const Positions& from,
                                const Positions& to, std::span<const std::size_t> facets) const {
    const Positions middle(*this, interval.middle());
    if (!several_bodies() && !may_meet_fixed(from.x(), middle.x(), to.x())) return std::nullopt;
    std::vector<Box<D>> boxes;
    boxes.reserve(facets.size());
    for (const std::size_t e : facets) boxes.push_back(swept(e, from.x(), middle.x(), to.x()));
    const BoxTree<D> sweeps = several_bodies() ? BoxTree<D>(boxes) : BoxTree<D>();
    std::vector<std::size_t> close;
    for (std::size_t k = 0; k < facets.size(); ++k) {
      const std::size_t e = facets[k];
      if (any_near(e, boxes[k], middle, [](const FacetNodes<D>&, Index) { return true; }) ||
          near_other_body(e, boxes[k], sweeps, facets))
        close.push_back(e);
    }
    if (close.empty()) return std::nullopt;
    constexpr double shortest = 1.0 / 1024;
    if (interval.end - interval.begin <= shortest) {
      if (!meeting_of(to, close) && !(several_bodies() && meeting_among(to.x(), close)))
        return std::nullopt;
      return refined(interval.begin, interval.end);
    }
    if (auto contact = within({interval.begin, interval.middle()}, from, middle, close))
      return contact;
    return within({interval.middle(), interval.end}, middle, to, close);
  }

  /// Bisects between a fraction without contact and one with contact.
  Contact refined(double free, double blocked) const {
    Contact contact{free, *meeting_at(blocked)};
    constexpr int halvings = 12;
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (contact.fraction + blocked);
      if (auto pair = meeting_at(middle)) {
        blocked = middle;
        contact.edges = *pair;
      } else {
        contact.fraction = middle;
      }
    }
    return contact;
  }

  std::string name(Index marker) const { return Outline<D>::marker_name(topology_, marker); }

  const Topology& topology_;
  const Coordinates& rest_;
  const Motion& motion_;
  mutable std::vector<Coordinates> spare_;
  Outline<D> outline_;
  BoxTree<D> fixed_;  // of outline_.fixed, at rest
  bool rigid_;
  static constexpr int any = -1;
  std::vector<int> body_;                                       // of each moving facet
  std::set<std::pair<FacetNodes<D>, FacetNodes<D>>> touching_;  // at rest
};

std::string named(const std::string& marker) {
  return marker.empty() ? "a boundary without a name" : marker;
}

std::string number(const char* format, double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// "the two sides of sail would pass through each other at (0, 0.5)".
std::string describe_passage(const EdgePair& edges) {
  const std::string place = " at (" + number("%.4g", edges.place.x()) + ", " +
                            number("%.4g", edges.place.y()) +
                            (edges.in_space ? ", " + number("%.4g", edges.place.z()) : "") + ")";
  if (edges.moving == edges.other)
    return "the two sides of " + named(edges.moving) + " would pass through each other" + place;
  return named(edges.moving) + " would pass through " + named(edges.other) + ", on which it lies," +
         place;
}

/// The smallest distance between facets that move and facets that stay.
template <int D>
std::optional<Gap> gap_of(const Topology& topology, const Coordinates& x,
                          std::span<const Index> moving, std::span<const Index> yielding) {
  const Outline<D> outline(topology, x, moving, yielding);
  const BoxTree<D> fixed = tree_of(outline.fixed.facets, x);
  const auto name = [&](Index m) { return Outline<D>::marker_name(topology, m); };
  std::optional<Gap> gap;
  Box<D> all = Box<D>::empty();
  for (const auto* part : {&outline.moving, &outline.fixed})
    for (const FacetNodes<D>& nodes : part->facets) all.add(box_of<D>(facet(nodes, x)));
  double width = all.size().norm();
  for (std::size_t e = 0; e < outline.moving.facets.size(); ++e) {
    const FacetNodes<D>& own = outline.moving.facets[e];
    const Facet<D> piece = facet(own, x);
    Vec<D> centre = Vec<D>::Zero();
    for (const Vec<D>& corner : piece) centre += corner / D;
    double reach = 0;  // extent of the facet from its centre
    for (const Vec<D>& corner : piece) reach = std::max(reach, (corner - centre).norm());
    const auto separation = [&](Index f) {
      const FacetNodes<D>& other = outline.fixed.facets[static_cast<std::size_t>(f)];
      // Farther than any distance of interest.
      if (share_node(own, other)) return 2 * (width + reach);
      return reach + distance(piece, facet(other, x));
    };
    const auto nearest = fixed.nearest(centre, width + reach, separation);
    if (!nearest || nearest->distance - reach >= width) continue;
    width = nearest->distance - reach;
    gap =
        Gap{width,
            {name(outline.moving.markers[e]),
             name(outline.fixed.markers[static_cast<std::size_t>(nearest->item)]), Vec3(0, 0, 0)}};
    set_place<D>(gap->edges, centre);
  }
  return gap;
}

}  // namespace

std::optional<Contact> find_contact(const Topology& topology, const Coordinates& rest,
                                    const Motion& motion, std::span<const Index> yielding) {
  return in_dimension(topology, "motions", [&](auto dim) {
    auto contact = ContactSearch<dim()>(topology, rest, motion, yielding).first();
    auto passage = find_passage<dim()>(topology, rest, motion, yielding);
    const bool passes_first = passage && (!contact || passage->fraction <= contact->fraction);
    return passes_first ? passage : contact;
  });
}

std::optional<Gap> smallest_gap(const Topology& topology, const Coordinates& x,
                                std::span<const Index> moving, std::span<const Index> yielding) {
  return in_dimension(topology, "motions",
                      [&](auto dim) { return gap_of<dim()>(topology, x, moving, yielding); });
}

std::optional<Gap> smallest_gap(const Topology& topology, const Coordinates& x,
                                const Motion& motion, std::span<const Index> yielding) {
  if (motion.bodies().empty()) return smallest_gap(topology, x, motion.nodes(), yielding);
  std::vector<Gap> gaps;
  for (const auto& body : motion.bodies()) {
    if (const auto gap = smallest_gap(topology, x, body->nodes(), yielding)) gaps.push_back(*gap);
  }
  const auto smallest = std::ranges::min_element(gaps, {}, &Gap::width);
  return smallest == gaps.end() ? std::nullopt : std::optional(*smallest);
}

void put_in_mesh(EdgePair& edges, const LocalFrame& frame) {
  edges.place = frame.to_mesh(edges.place);
}

std::string describe_touch(const EdgePair& edges) {
  if (edges.one_sheet) return describe_passage(edges);
  return named(edges.moving) + " would touch " +
         (edges.other == edges.moving ? "itself" : named(edges.other));
}

std::string describe(const Contact& contact) {
  return describe_touch(contact.edges) + " at " + number("%.3g", 100 * contact.fraction) +
         " % of the way";
}

std::string describe(const Gap& gap) {
  return named(gap.edges.moving) + " is " + number("%.3g", gap.width) + " from " +
         named(gap.edges.other) + " there";
}

}  // namespace winslow
