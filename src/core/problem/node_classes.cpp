#include "core/problem/node_classes.h"

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

void SlidingNodes::set(Index node, const TangentFrame& frame) { frames_[node] = frame; }

std::vector<TangentFrame> SlidingNodes::set(std::span<const Index> nodes,
                                            std::shared_ptr<const SlidingGeometry> geometry,
                                            const Coordinates& x) {
  if (geometry_.empty()) geometry_.resize(at(x.size()));
  constexpr Index block = 512;  // finding a foot may need a search
  std::vector<TangentFrame> frames(nodes.size());
  const auto find = [&](Index begin, Index end) {
    for (std::size_t i = at(begin); i < at(end); ++i)
      frames[i] = geometry->foot(nodes[i], place_of(x, nodes[i])).frame;
  };
  parallel_for(0, static_cast<Index>(nodes.size()), find, block);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    frames_[nodes[i]] = frames[i];
    geometry_[at(nodes[i])] = geometry;
  }
  return frames;
}

void SlidingNodes::erase(Index node) {
  frames_.erase(node);
  if (!geometry_.empty()) geometry_[at(node)] = nullptr;
}

const TangentFrame* SlidingNodes::frame(Index node) const {
  const auto found = frames_.find(node);
  return found != frames_.end() ? &found->second : nullptr;
}

const SlidingGeometry* SlidingNodes::geometry(Index node) const {
  return geometry_.empty() ? nullptr : geometry_[at(node)].get();
}

void TiedNodes::add(const NodeImage& image) {
  for (const Index either : {image.node, image.image})
    if (partner(either))
      throw UsageError("node " + std::to_string(either) + " is in two periodic pairs");
  images_[image.image] = image;
  image_of_[image.node] = image.image;
}

std::optional<Index> TiedNodes::partner(Index node) const {
  if (const auto found = images_.find(node); found != images_.end()) return found->second.node;
  if (const auto found = image_of_.find(node); found != image_of_.end()) return found->second;
  return std::nullopt;
}

std::optional<Index> TiedNodes::separate(Index node) {
  const std::optional<Index> other = partner(node);
  if (!other) return other;
  for (const Index either : {node, *other}) {
    images_.erase(either);
    image_of_.erase(either);
  }
  return other;
}

std::vector<NodeImage> TiedNodes::images() const {
  std::vector<NodeImage> list;
  for (const auto& [node, image] : images_) list.push_back(image);
  return list;
}

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
  const TangentFrame* frame = sliding_.frame(node);
  return frame ? *frame : TangentFrame::axes(unknowns(node));
}

Foot NodeClasses::foot(Index node, const Vec3& point) const {
  if (const SlidingGeometry* geometry = sliding_.geometry(node)) return geometry->foot(node, point);
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
  TangentFrame frame;
  frame.add(direction);
  sliding_.set(node, frame);
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
  sliding_.set(node, frame);
}

void NodeClasses::set_sliding(std::span<const Index> nodes,
                              std::shared_ptr<const SlidingGeometry> geometry,
                              const Coordinates& x) {
  for (const Index node : nodes) require(node);
  const std::vector<TangentFrame> frames = sliding_.set(nodes, std::move(geometry), x);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    classes_[at(nodes[i])] = frames[i].count() == 1 ? NodeClass::on_curve : NodeClass::on_surface;
}

void NodeClasses::set_periodic(const PeriodicPairs& pairs) {
  const auto transform = std::make_shared<const RigidImage>(pairs.image);
  const auto join = [&](const PeriodicPair& pair) {
    for (const Index either : {pair.node, pair.image}) require(either);
    tied_.add(NodeImage{pair.image, pair.node, transform});
    classes_[at(pair.image)] = NodeClass::image;
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
  tied_.add(std::move(row));
}

bool NodeClasses::same_unknowns(const NodeClasses& other) const {
  if (topology_ != other.topology_) return false;
  if (this == &other) return true;
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    const NodeClass a = classes_[i], b = other.classes_[i];
    if (a != b && !(held(a) && held(b))) return false;
  }
  return sliding_.same_ways(other.sliding_) && tied_ == other.tied_;
}

void NodeClasses::require(Index node) const {
  if (node >= 0 && node < topology_->node_count()) return;
  throw UsageError("there is no node " + std::to_string(node) + ": the mesh has " +
                   std::to_string(topology_->node_count()));
}

void NodeClasses::set(std::span<const Index> nodes, NodeClass value) {
  for (const Index node : nodes) {
    require(node);
    if (held(value))
      if (const auto partner = tied_.separate(node)) set_one(*partner, value);
    set_one(node, value);
  }
}

void NodeClasses::set_one(Index node, NodeClass value) {
  sliding_.erase(node);
  classes_[static_cast<std::size_t>(node)] = value;
}

}  // namespace winslow
