#include "core/inspect/space/section_index.h"

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

Plane::Plane(const Vec3& point, const Vec3& normal) : point_(point), normal_(normal) {
  // The largest component first: its square may be more than a double holds.
  const double largest = normal.cwiseAbs().maxCoeff();
  if (!point.allFinite() || !normal.allFinite() || largest == 0)
    throw UsageError("a plane needs a point and a normal of finite numbers, the normal not 0 0 0");
  normal_ = (normal / largest).normalized();
}

std::array<Vec3, 2> directions_in(const Vec3& unit_normal) {
  Index smallest = 0;
  unit_normal.cwiseAbs().minCoeff(&smallest);
  const Vec3 first = unit_normal.cross(Vec3::Unit(smallest)).normalized();
  return {first, unit_normal.cross(first)};
}

namespace {

constexpr Index block_size = 32;

}  // namespace

SectionIndex::SectionIndex(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  if (topology.cell_dimension() != 3)
    throw UsageError("cuts by a plane: only for a volume mesh, and this is a " +
                     std::string(mesh_kind(topology)));
  order_ = std::make_shared<const CurveOrder>(SpacePoints(mesh.coordinates), topology.node_count(),
                                              space_bounds(mesh), topology.elements());
  measure(mesh);
}

SectionIndex::SectionIndex(const Mesh& mesh, const SectionIndex& before) : order_(before.order_) {
  if (order_->corners.values.size() != mesh.topology->elements().values.size() ||
      order_->nodes.size() != at(mesh.coordinates.size()))
    throw UsageError("cuts by a plane: the index is of another mesh");
  measure(mesh);
}

void SectionIndex::measure(const Mesh& mesh) {
  const SpacePoints x(mesh.coordinates);
  places_.resize(order_->nodes.size());
  parallel_for(0, static_cast<Index>(places_.size()), [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) places_[at(i)] = x[order_->nodes[at(i)]];
  });
  const Index count = order_->corners.rows();
  boxes_.resize(at((count + block_size - 1) / block_size));
  parallel_for(
      0, static_cast<Index>(boxes_.size()),
      [&](Index begin, Index end) {
        for (Index b = begin; b < end; ++b) {
          const Index last = std::min(count, (b + 1) * block_size);
          const auto first_value = at(order_->corners.offsets[at(b * block_size)]);
          const auto values =
              std::span(order_->corners.values)
                  .subspan(first_value, at(order_->corners.offsets[at(last)]) - first_value);
          Vec3 low = places_[at(values.front())], high = low;
          for (const Index node : values) {
            const Vec3& p = places_[at(node)];
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
          }
          boxes_[at(b)] = {low, high};
        }
      },
      256);
  extent_ = Box<3>::empty();
  for (const Box<3>& box : boxes_) extent_.add(box);
}

std::vector<Index> SectionIndex::near(const Plane& plane, double slack) const {
  std::vector<Index> near;
  const Vec3 across = plane.normal().cwiseAbs();
  const Index count = order_->corners.rows();
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    const double reach = 0.5 * across.dot(boxes_[b].size()) + slack;
    // Written so that what is no number is looked at.
    if (std::abs(plane.distance(boxes_[b].centre())) > reach) continue;
    const Index begin = static_cast<Index>(b) * block_size;
    for (Index e = begin; e < std::min(count, begin + block_size); ++e) near.push_back(e);
  }
  return near;
}

}  // namespace winslow
