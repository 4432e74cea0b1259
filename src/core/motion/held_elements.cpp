#include "core/motion/held_elements.h"

#include <cstdio>

#include "core/problem/node_classes.h"
#include "core/quality/quality.h"

namespace winslow {

namespace {

/// The elements that a motion moves and that have no free node, but for inverted ones.
std::vector<Index> held_elements(const NodeClasses& classes, const Coordinates& rest,
                                 const Motion& motion) {
  const Topology& topology = classes.topology();
  std::vector<unsigned char> taken(at(topology.node_count()), 0);
  for (const Index node : motion.nodes()) taken[at(node)] = 1;
  std::vector<Index> held;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const auto nodes = topology.element(e);
    if (std::ranges::none_of(nodes, [&](Index node) { return classes.moves(node); }) &&
        std::ranges::any_of(nodes, [&](Index node) { return taken[at(node)] != 0; }) &&
        !is_inverted(topology, rest, e))
      held.push_back(e);
  }
  return held;
}

/// The first inverted element at a fraction of a motion.
class Inversions {
 public:
  Inversions(const Topology& topology, const Coordinates& rest, const Motion& motion,
             std::vector<Index> elements)
      : topology_(topology),
        rest_(rest),
        motion_(motion),
        elements_(std::move(elements)),
        x_(rest) {}

  std::optional<Index> at(double fraction) {
    motion_.apply(rest_, fraction, x_);
    for (const Index e : elements_)
      if (is_inverted(topology_, x_, e)) return e;
    return std::nullopt;
  }

 private:
  const Topology& topology_;
  const Coordinates& rest_;
  const Motion& motion_;
  std::vector<Index> elements_;
  Coordinates x_;
};

}  // namespace

std::optional<HeldInversion> find_held_inversion(const NodeClasses& classes,
                                                 const Coordinates& rest, const Motion& motion,
                                                 MotionPart part) {
  std::vector<Index> elements = held_elements(classes, rest, motion);
  if (elements.empty()) return std::nullopt;
  Inversions inversions(classes.topology(), rest, motion, std::move(elements));
  const std::optional<Index> last = inversions.at(1);
  if (part == MotionPart::end)
    return last ? std::optional(HeldInversion{*last, 0, true}) : std::nullopt;
  constexpr int steps = 32, halvings = 12;
  for (int k = 1; k <= steps; ++k) {
    double blocked = static_cast<double>(k) / steps;
    std::optional<Index> element = inversions.at(blocked);
    if (!element) continue;
    HeldInversion found{*element, static_cast<double>(k - 1) / steps, last.has_value()};
    for (int halving = 0; halving < halvings; ++halving) {
      const double middle = 0.5 * (found.fraction + blocked);
      if (element = inversions.at(middle); element) {
        blocked = middle;
        found.element = *element;
      } else {
        found.fraction = middle;
      }
    }
    return found;
  }
  return std::nullopt;
}

std::string describe(const HeldInversion& inversion) {
  std::array<char, 32> share{};
  std::snprintf(share.data(), share.size(), "%.3g", 100 * inversion.fraction);
  const std::string text =
      "the prescribed nodes invert element " + std::to_string(inversion.element);
  const std::string reason = "no node of it is free, so smoothing cannot mend it";
  if (inversion.at_end) return text + " at " + share.data() + " % of the way: " + reason;
  return text + " at " + share.data() + " % of the way, though not at its end: " + reason +
         "; move them in one step (increments 1), or bit by bit from one mesh to the next";
}

}  // namespace winslow
