#include "core/strategy/keep_outside.h"

#include <iterator>
#include <utility>

#include "core/error.h"
#include "core/motion/rigid_motion.h"

namespace winslow {

namespace {

/// Words that differ between the plane and space.
struct Words {
  const char *region, *wrong_count;
};
const Words& words_of(int dimension) {
  static constexpr std::array<Words, 2> words{
      {{"circle", ": found three numbers, expected two for a plane mesh"},
       {"sphere", ": found two numbers, expected three for a volume mesh"}}};
  return words[static_cast<std::size_t>(dimension - 2)];
}

Option place_row(std::string_view key, std::optional<GivenVector>& place, std::string_view label,
                 std::string_view help) {
  return {.key = key,
          .value = OptionalVectorOption{&place},
          .label = label,
          .help = help,
          .unit = "units of the mesh",
          .object = "keep_outside",
          .applies = place.has_value()};
}

}  // namespace

OptionTable option_table(KeepOutside& keep) {
  return {
      {.key = "radius",
       .value = OptionalRealOption{&keep.radius, above(0)},
       .label = "Free radius",
       .help = "Nodes farther than this from the centre stay where they are",
       .advice = "For a change near a body in a large mesh.",
       .unit = "units of the mesh",
       .object = "keep_outside",
       .applies = keep.radius.has_value()},
      place_row("centre", keep.centre, "Free centre",
                "Of the circle, in space the sphere, outside which nodes stay; not given: the "
                "centre of the bounding box "
                "of all that moves, or of the walls that get layers"),
      place_row("corner", keep.corner, "Free box",
                "Nodes outside the box with this corner and the one opposite stay where they are"),
      place_row("opposite", keep.opposite, "Opposite corner",
                "Of the box outside which nodes stay"),
  };
}

void validate(const KeepOutside& keep) {
  if (keep.corner.has_value() != keep.opposite.has_value())
    throw UsageError(
        "keep-outside: found one corner of the box, expected both (keep-outside "
        "corner and opposite)");
  if (keep.centre && !keep.radius)
    throw UsageError("keep-outside: found a centre without a radius, expected both");
}

void validate(const KeepOutside& keep, int dimension) {
  validate(keep);
  const std::array<std::pair<const char*, const std::optional<GivenVector>*>, 3> places{
      {{"centre", &keep.centre}, {"corner", &keep.corner}, {"opposite", &keep.opposite}}};
  for (const auto& [name, place] : places)
    if (*place && (*place)->numbers(dimension) != dimension)
      throw UsageError("keep-outside " + std::string(name) + words_of(dimension).wrong_count);
}

KeepOutside to_local(KeepOutside keep, const LocalFrame& frame) {
  for (std::optional<GivenVector>* place : {&keep.centre, &keep.corner, &keep.opposite})
    if (*place) **place -= frame.origin();
  return keep;
}

FreeRegion::FreeRegion(const KeepOutside& keep, const Coordinates& x,
                       std::span<const Index> about) {
  validate(keep, x.dimension());
  if (keep.radius) {
    if (!keep.centre && about.empty())
      throw UsageError(
          "keep-outside radius: nothing moves whose centre could be meant; give the centre of "
          "the " +
          std::string(words_of(x.dimension()).region) + " (keep-outside centre)");
    centre_ = keep.centre ? Vec3(*keep.centre) : body_centre(body_box(x, about));
    radius_ = keep.radius;
  }
  if (keep.corner) {
    low_ = keep.corner->cwiseMin(*keep.opposite);
    high_ = keep.corner->cwiseMax(*keep.opposite);
    box_ = true;
  }
}

bool FreeRegion::holds(const Vec3& point) const {
  if (radius_ && (point - centre_).norm() > *radius_) return false;
  return !box_ || ((point.array() >= low_.array()).all() && (point.array() <= high_.array()).all());
}

std::vector<Index> nodes_outside(const FreeRegion& region, const Topology& topology,
                                 const Coordinates& x) {
  std::vector<Index> outside;
  const auto interior = topology.interior_nodes();
  std::ranges::copy_if(interior, std::back_inserter(outside),
                       [&](Index node) { return !region.holds(place_of(x, node)); });
  if (outside.size() == interior.size())
    throw UsageError("keep-outside: no interior node lies inside the region");
  std::ranges::sort(outside);
  return outside;
}

std::vector<Index> nodes_kept_outside(const KeepOutside& keep, const Topology& topology,
                                      const Coordinates& x, std::span<const Index> moving) {
  if (!keep.given()) return {};
  const FreeRegion region(keep, x, moving);
  const auto left =
      std::ranges::count_if(moving, [&](Index node) { return !region.holds(place_of(x, node)); });
  if (left > 0)
    throw UsageError("keep-outside: " + std::to_string(left) + " of " +
                     std::to_string(moving.size()) +
                     " nodes that are to move lie outside the region in which nodes may move");
  return nodes_outside(region, topology, x);
}

}  // namespace winslow
