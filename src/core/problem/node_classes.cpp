#include "core/problem/node_classes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

bool held(NodeClass c) { return c == NodeClass::fixed || c == NodeClass::prescribed; }

Vec3 unit(const Vec3& direction, const char* what, Index node) {
  const double length = direction.norm();
  if (!(length > 0) || !direction.allFinite()) {
    throw UsageError(std::string("the ") + what + " at node " + std::to_string(node) +
                     " has no direction");
  }
  return direction / length;
}

}  // namespace

NodeClasses::NodeClasses(std::shared_ptr<const Topology> topology)
    : topology_(std::move(topology)),
      classes_(static_cast<std::size_t>(topology_->node_count()), NodeClass::fixed) {
  set(topology_->interior_nodes(), NodeClass::free);
}

int NodeClasses::unknowns(Index node) const {
  switch ((*this)[node]) {
    case NodeClass::fixed:
    case NodeClass::prescribed:
    case NodeClass::image:
    case NodeClass::follows:
      return 0;
    case NodeClass::on_curve:
      return 1;
    case NodeClass::on_surface:
      return 2;
    case NodeClass::free:
      break;
  }
  return topology_->space_dimension();
}

TangentFrame NodeClasses::frame(Index node) const {
  const auto found = frames_.find(node);
  return found != frames_.end() ? found->second : TangentFrame::axes(unknowns(node));
}

Foot NodeClasses::foot(Index node, const Vec3& point) const {
  if (!geometry_.empty() && geometry_[at(node)]) return geometry_[at(node)]->foot(node, point);
  Foot foot;
  foot.point = point;
  foot.frame = frame(node);
  return foot;
}

void NodeClasses::set_free(std::span<const Index> nodes) {
  for (const Index node : nodes) {
    require(node);
    if (!topology_->used(node)) {
      throw UsageError("no element uses node " + std::to_string(node) + ": it cannot be free");
    }
  }
  set(nodes, NodeClass::free);
}

void NodeClasses::set_on_curve(Index node, const Vec3& tangent) {
  require(node);
  if (topology_->space_dimension() == 2 && tangent.z() != 0) {
    throw UsageError("the tangent at node " + std::to_string(node) + " leaves the plane");
  }
  const Vec3 direction = unit(tangent, "tangent", node);
  classes_[static_cast<std::size_t>(node)] = NodeClass::on_curve;
  frames_[node] = TangentFrame();
  frames_[node].add(direction);
}

void NodeClasses::set_on_surface(Index node, const Vec3& normal) {
  require(node);
  if (topology_->space_dimension() == 2) {
    throw UsageError("node " + std::to_string(node) + " lies in the plane: there is no surface");
  }
  const Vec3 direction = unit(normal, "normal", node);
  const Vec3 first = direction.unitOrthogonal();
  TangentFrame frame;
  frame.add(first);
  frame.add(direction.cross(first));
  classes_[static_cast<std::size_t>(node)] = NodeClass::on_surface;
  frames_[node] = frame;
}

void NodeClasses::set_sliding(std::span<const Index> nodes,
                              std::shared_ptr<const SlidingGeometry> geometry,
                              const Coordinates& x) {
  if (geometry_.empty()) geometry_.resize(classes_.size());
  for (const Index node : nodes) require(node);
  constexpr Index block = 512;  // a foot may take a search
  std::vector<TangentFrame> frames(nodes.size());
  const auto find = [&](Index begin, Index end) {
    for (std::size_t i = at(begin); i < at(end); ++i) {
      Vec3 point(0, 0, 0);
      if (x.dimension() == 2)
        point.head<2>() = x.xy(nodes[i]);
      else
        point = x.xyz(nodes[i]);
      frames[i] = geometry->foot(nodes[i], point).frame;
    }
  };
  parallel_for(0, static_cast<Index>(nodes.size()), find, block);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Index node = nodes[i];
    const TangentFrame& frame = frames[i];
    classes_[static_cast<std::size_t>(node)] =
        frame.count() == 1 ? NodeClass::on_curve : NodeClass::on_surface;
    frames_[node] = frame;
    geometry_[at(node)] = geometry;
  }
}

void NodeClasses::set_periodic(const PeriodicPairs& pairs) {
  const auto transform = std::make_shared<const RigidImage>(pairs.image);
  const auto join = [&](const PeriodicPair& pair) {
    const auto [node, image] = pair;
    for (const Index either : {node, image}) {
      require(either);
      if (images_.contains(either) || masters_.contains(either))
        throw UsageError("node " + std::to_string(either) + " is in two periodic pairs");
    }
    classes_[static_cast<std::size_t>(image)] = NodeClass::image;
    images_[image] = {image, node, transform};
    masters_[node] = image;
  };
  for (const PeriodicPair& pair : pairs.pairs) {
    join(pair);
    classes_[static_cast<std::size_t>(pair.node)] = NodeClass::free;
  }
  for (const PeriodicPair& pair : pairs.corners)
    if (slides(pair.node)) join(pair);
}

void NodeClasses::set_following(std::shared_ptr<const CurveRow> row) {
  set(row->between(), NodeClass::follows);
  rows_.push_back(std::move(row));
}

std::vector<NodeClasses::Image> NodeClasses::images() const {
  std::vector<Image> list;
  for (const auto& [node, image] : images_) list.push_back(image);
  return list;
}

std::vector<Index> NodeClasses::yielding_nodes() const {
  std::vector<Index> nodes = yielding_;
  for (const auto& [node, image] : masters_) nodes.insert(nodes.end(), {node, image});
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void NodeClasses::set_yielding(std::span<const Index> nodes) {
  for (const Index node : nodes) require(node);
  yielding_.insert(yielding_.end(), nodes.begin(), nodes.end());
}

bool NodeClasses::same_unknowns(const NodeClasses& other) const {
  if (topology_ != other.topology_) return false;
  if (this == &other) return true;
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    const NodeClass a = classes_[i], b = other.classes_[i];
    if (a != b && !(held(a) && held(b))) return false;
  }
  return frames_ == other.frames_ && geometry_ == other.geometry_ && images_ == other.images_ &&
         rows_ == other.rows_;
}

void NodeClasses::require(Index node) const {
  if (node >= 0 && node < topology_->node_count()) return;
  throw UsageError("there is no node " + std::to_string(node) + ": the mesh has " +
                   std::to_string(topology_->node_count()));
}

void NodeClasses::set(std::span<const Index> nodes, NodeClass value) {
  for (const Index node : nodes) {
    require(node);
    const auto as_image = images_.find(node);
    const auto as_master = masters_.find(node);
    const Index partner = as_image != images_.end()     ? as_image->second.node
                          : as_master != masters_.end() ? as_master->second
                                                        : -1;
    if (held(value) && partner >= 0) {
      images_.erase(as_image != images_.end() ? node : partner);
      masters_.erase(as_image != images_.end() ? partner : node);
      set_one(partner, value);
    }
    set_one(node, value);
  }
}

void NodeClasses::set_one(Index node, NodeClass value) {
  if (slides(node)) frames_.erase(node);
  if (!geometry_.empty()) geometry_[at(node)] = nullptr;
  classes_[static_cast<std::size_t>(node)] = value;
}

}  // namespace winslow
