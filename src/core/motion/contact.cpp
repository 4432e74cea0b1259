#include "core/motion/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/motion/outline.h"

namespace winslow {

namespace {

class ContactSearch {
 public:
  ContactSearch(const Topology& topology, const Coordinates& rest, const Motion& motion)
      : topology_(topology),
        rest_(rest),
        motion_(motion),
        outline_(topology, motion.nodes()),
        fixed_(tree_of(outline_.fixed.edges, rest)),
        rigid_(keeps_distances()) {}

  std::optional<Contact> first() {
    if (outline_.moving.edges.empty() || !apart_at_rest()) return std::nullopt;
    const std::vector<std::size_t> all = all_moving();
    constexpr int intervals = 64;  // short enough to see a body cross itself
    Positions from(*this, 0);
    for (int k = 0; k < intervals; ++k) {
      const double begin = static_cast<double>(k) / intervals;
      const double end = static_cast<double>(k + 1) / intervals;
      Positions to(*this, end);
      if (auto contact = within({begin, end}, from, to, all)) return contact;
      if (!rigid_ && meeting_of_itself(to)) return refined(begin, end);
      from.swap(to);
    }
    return std::nullopt;
  }

 private:
  struct Interval {
    double begin, end;
    double middle() const { return 0.5 * (begin + end); }
  };

  /// The nodes at some fraction. Copies of all nodes are kept for the next one: a motion writes
  /// the same few each time.
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
    }
    Positions(const Positions&) = delete;
    Positions& operator=(const Positions&) = delete;
    ~Positions() { search_->spare_.push_back(std::move(x_)); }
    void swap(Positions& other) { std::swap(x_, other.x_); }
    operator const Coordinates&() const { return x_; }  // NOLINT: positions are coordinates

   private:
    const ContactSearch* search_;
    Coordinates x_;
  };

  /// A body that keeps its shape never meets itself.
  bool keeps_distances() const {
    const auto nodes = motion_.nodes();
    if (nodes.empty()) return true;
    const Positions ending(*this, 1), halfway(*this, 0.5);
    const Coordinates &end = ending, &middle = halfway;
    const double size = bounds(rest_, nodes).size().norm();
    constexpr double round_off = 1e-9;
    const auto same = [&](Index a, Index b) {
      const double length = (rest_.xy(a) - rest_.xy(b)).norm();
      const auto near = [&](const Coordinates& x) {
        return std::abs((x.xy(a) - x.xy(b)).norm() - length) <= round_off * size;
      };
      return near(middle) && near(end);
    };
    return std::ranges::all_of(
        nodes, [&](Index node) { return same(node, nodes.front()) && same(node, nodes.back()); });
  }

  std::vector<std::size_t> all_moving() const {
    std::vector<std::size_t> all(outline_.moving.edges.size());
    for (std::size_t e = 0; e < all.size(); ++e) all[e] = e;
    return all;
  }

  /// Remembers the edges that touch before the motion, as those of a crack do; they say nothing
  /// about it. False if edges cross.
  bool apart_at_rest() {
    bool apart = true;
    const auto judge = [&](const EdgeNodes& own, const EdgeNodes& other) {
      const Meeting found = meeting(segment(own, rest_), segment(other, rest_));
      if (found.kind == Meeting::Kind::touch) touching_.insert(ordered(own, other));
      if (found.kind == Meeting::Kind::crossing) apart = false;
      return false;
    };
    for (std::size_t e = 0; e < outline_.moving.edges.size(); ++e) {
      const EdgeNodes& own = outline_.moving.edges[e];
      any_near(e, box_of(segment(own, rest_)), rest_,
               [&](const EdgeNodes& other, Index) { return judge(own, other); });
    }
    if (!rigid_) {
      among_moving(rest_, [&](std::size_t e, std::size_t f) {
        return judge(outline_.moving.edges[e], outline_.moving.edges[f]);
      });
    }
    return apart;
  }

  static std::pair<EdgeNodes, EdgeNodes> ordered(const EdgeNodes& a, const EdgeNodes& b) {
    return std::minmax(a, b);
  }

  /// Edges that can tell something by where they are to one another.
  bool eligible(const EdgeNodes& a, const EdgeNodes& b) const {
    return !share_node(a, b) && (touching_.empty() || !touching_.contains(ordered(a, b)));
  }

  /// Calls `visit(nodes, marker)` with the edges that a moving edge within that box may meet, until
  /// it returns true.
  template <class Visit>
  bool any_near(std::size_t e, const Box<2>& box, const Coordinates& x, const Visit& visit) const {
    const EdgeNodes& own = outline_.moving.edges[e];
    bool found = false;
    fixed_.overlapping(box, [&](Index f) {
      const auto k = static_cast<std::size_t>(f);
      const EdgeNodes& other = outline_.fixed.edges[k];
      if (!found && eligible(own, other)) found = visit(other, outline_.fixed.markers[k]);
    });
    // Edges between a node that moves and one that stays are few.
    for (const std::size_t j : outline_.joints) {
      if (found) break;
      const EdgeNodes& other = outline_.moving.edges[j];
      if (!eligible(own, other) || !box.overlaps(box_of(segment(other, x)))) continue;
      found = visit(other, outline_.moving.markers[j]);
    }
    return found;
  }

  /// Calls `visit(e, f)` with pairs of moving edges near each other until it returns true.
  template <class Visit>
  void among_moving(const Coordinates& x, const Visit& visit) const {
    const auto& edges = outline_.moving.edges;
    const BoxTree<2> tree = tree_of(edges, x);
    bool found = false;
    for (std::size_t e = 0; e < edges.size() && !found; ++e) {
      tree.overlapping(box_of(segment(edges[e], x)), [&](Index f) {
        const auto k = static_cast<std::size_t>(f);
        if (!found && k > e && eligible(edges[e], edges[k])) found = visit(e, k);
      });
    }
  }

  std::optional<EdgePair> pair_if_meeting(const Coordinates& x, std::size_t e,
                                          const EdgeNodes& other, Index marker) const {
    const Meeting found = meeting(segment(outline_.moving.edges[e], x), segment(other, x));
    if (found.kind == Meeting::Kind::none) return std::nullopt;
    return EdgePair{name(outline_.moving.markers[e]), name(marker), found.place};
  }

  /// The first of some of the moving edges that meets another edge.
  std::optional<EdgePair> meeting_of(const Coordinates& x,
                                     std::span<const std::size_t> edges) const {
    std::optional<EdgePair> pair;
    for (const std::size_t e : edges) {
      const Box<2> box = box_of(segment(outline_.moving.edges[e], x));
      any_near(e, box, x, [&](const EdgeNodes& other, Index marker) {
        pair = pair_if_meeting(x, e, other, marker);
        return pair.has_value();
      });
      if (pair) break;
    }
    return pair;
  }

  std::optional<EdgePair> meeting_of_itself(const Coordinates& x) const {
    std::optional<EdgePair> pair;
    among_moving(x, [&](std::size_t e, std::size_t f) {
      pair = pair_if_meeting(x, e, outline_.moving.edges[f], outline_.moving.markers[f]);
      return pair.has_value();
    });
    return pair;
  }

  std::optional<EdgePair> meeting_at(double fraction) const {
    const Positions x(*this, fraction);
    if (auto pair = meeting_of(x, all_moving())) return pair;
    return rigid_ ? std::nullopt : meeting_of_itself(x);
  }

  /// The box that an edge sweeps, from three positions: the arc between them is no farther out than
  /// the middle one is from the chord.
  Box<2> swept(std::size_t e, const Coordinates& from, const Coordinates& middle,
               const Coordinates& to) const {
    const EdgeNodes& edge = outline_.moving.edges[e];
    Box<2> box = box_of(segment(edge, from));
    box.add(box_of(segment(edge, middle)));
    box.add(box_of(segment(edge, to)));
    double sagitta = 0;
    for (const Index node : edge) {
      const Vec2 chord = 0.5 * (from.xy(node) + to.xy(node));
      sagitta = std::max(sagitta, (middle.xy(node) - chord).norm());
    }
    box.min.array() -= sagitta;
    box.max.array() += sagitta;
    return box;
  }

  std::optional<Contact> within(const Interval& interval, const Coordinates& from,
                                const Coordinates& to, std::span<const std::size_t> edges) const {
    const Positions middle(*this, interval.middle());
    std::vector<std::size_t> close;
    for (const std::size_t e : edges) {
      const Box<2> box = swept(e, from, middle, to);
      if (any_near(e, box, middle, [](const EdgeNodes&, Index) { return true; }))
        close.push_back(e);
    }
    if (close.empty()) return std::nullopt;
    constexpr double shortest = 1.0 / 1024;
    if (interval.end - interval.begin <= shortest) {
      if (!meeting_of(to, close)) return std::nullopt;
      return refined(interval.begin, interval.end);
    }
    if (auto contact = within({interval.begin, interval.middle()}, from, middle, close))
      return contact;
    return within({interval.middle(), interval.end}, middle, to, close);
  }

  /// Between a fraction at which all are apart and one at which edges meet.
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

  std::string name(Index marker) const {
    return marker < 0 ? "" : topology_.markers()[static_cast<std::size_t>(marker)].name;
  }

  const Topology& topology_;
  const Coordinates& rest_;
  const Motion& motion_;
  mutable std::vector<Coordinates> spare_;
  Outline outline_;
  BoxTree<2> fixed_;  // of outline_.fixed, at rest
  bool rigid_;
  std::set<std::pair<EdgeNodes, EdgeNodes>> touching_;  // at rest
};

std::string named(const std::string& marker) {
  return marker.empty() ? "a boundary without a name" : marker;
}

std::string number(const char* format, double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

std::optional<Contact> find_contact(const Topology& topology, const Coordinates& rest,
                                    const Motion& motion) {
  if (topology.cell_dimension() == 3) return std::nullopt;
  require_plane(topology, "motions");
  return ContactSearch(topology, rest, motion).first();
}

std::optional<Gap> smallest_gap(const Topology& topology, const Coordinates& x,
                                std::span<const Index> moving) {
  if (topology.cell_dimension() == 3) return std::nullopt;
  require_plane(topology, "motions");
  const Outline outline(topology, moving);
  const BoxTree<2> fixed = tree_of(outline.fixed.edges, x);
  const auto name = [&](Index m) {
    return m < 0 ? "" : topology.markers()[static_cast<std::size_t>(m)].name;
  };
  std::optional<Gap> gap;
  Box<2> all = Box<2>::empty();
  for (const auto* part : {&outline.moving, &outline.fixed})
    for (const EdgeNodes& edge : part->edges) all.add(box_of(segment(edge, x)));
  double width = all.size().norm();
  for (std::size_t e = 0; e < outline.moving.edges.size(); ++e) {
    const EdgeNodes& own = outline.moving.edges[e];
    const Segment edge = segment(own, x);
    const Vec2 centre = 0.5 * (edge.a + edge.b);
    const double half = 0.5 * (edge.b - edge.a).norm();
    const auto separation = [&](Index f) {
      const EdgeNodes& other = outline.fixed.edges[static_cast<std::size_t>(f)];
      // As far away as anything that is not asked for.
      if (share_node(own, other)) return 2 * (width + half);
      return half + distance(edge, segment(other, x));
    };
    const auto nearest = fixed.nearest(centre, width + half, separation);
    if (!nearest || nearest->distance - half >= width) continue;
    width = nearest->distance - half;
    gap = Gap{width,
              {name(outline.moving.markers[e]),
               name(outline.fixed.markers[static_cast<std::size_t>(nearest->item)]), centre}};
  }
  return gap;
}

std::string describe_touch(const EdgePair& edges) {
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
