#include "core/problem/node_unknowns.h"

#include <type_traits>

#include "core/error.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/quality.h"

namespace winslow {

std::vector<Vec3> element_normals(const NodeClasses& classes, const Coordinates& x, int threads) {
  const auto& normals = classes.sliding().element_normals();
  return normals ? normals->of_elements(x, threads) : std::vector<Vec3>();
}

Validity check_validity(const NodeClasses& classes, const Coordinates& x, int threads) {
  return check_validity(classes.topology(), x, threads, element_normals(classes, x, threads));
}

namespace {

template <int D>
double mean_edge_at(const Topology& topology, const Points<D>& x, Index node) {
  double sum = 0;
  const auto neighbours = topology.neighbours(node);
  for (const Index k : neighbours) sum += (x[k] - x[node]).norm();
  return sum / static_cast<double>(neighbours.size());
}

Vec3 lifted(const Vec3& p) { return p; }

}  // namespace

NodeUnknowns::NodeUnknowns(std::shared_ptr<const NodeClasses> classes, int threads, Layout numbers)
    : classes_(std::move(classes)), threads_(threads) {
  auto layout = std::make_shared<Numbers>();
  std::size_t next = 0;
  for (Index node = 0; node < topology().node_count(); ++node) {
    int count = classes_->unknowns(node);
    if (count == 0) continue;
    if (numbers == Layout::blocks) count = topology().cell_dimension();
    layout->nodes.push_back(node);
    layout->first.push_back(next);
    next += static_cast<std::size_t>(count);
  }
  layout->first.push_back(next);
  layout->images = classes_->tied().images();
  layout_ = std::move(layout);
}

void NodeUnknowns::require_free_interior(const char* what) const {
  for (const Index node : nodes()) {
    if ((*classes_)[node] == NodeClass::free && !topology().on_boundary(node)) continue;
    const char* where = topology().on_boundary(node) ? " of the boundary" : ", where regions meet,";
    throw UsageError(std::string(what) + ": node " + std::to_string(node) + where +
                     " is to slide, and only free nodes can move");
  }
}

void NodeUnknowns::require_held_boundary(const char* what) const {
  for (const Index node : nodes()) {
    if ((*classes_)[node] != NodeClass::free || !topology().on_boundary(node)) continue;
    if (classes_->tied().has_image(node)) continue;
    throw UsageError(std::string(what) + ": node " + std::to_string(node) +
                     " of the boundary is to be free, and the boundary has no equations");
  }
}

void NodeUnknowns::require_sliding(const char* what) const {
  for (const Index node : nodes()) {
    if (classes_->slides(node)) continue;
    throw UsageError(std::string(what) + ": node " + std::to_string(node) +
                     " of a surface mesh has nothing to slide on");
  }
}

/// Velocity of nodes()[i] at position `from` if its unknowns change at the given rates (#unknowns
/// of all nodes).
template <int D>
Vec<D> NodeUnknowns::move_of(std::size_t i, const Vec<D>& from,
                             std::span<const double> rates) const {
  const double* own = rates.data() + first(i);
  if (!classes_->slides(nodes()[i])) return Vec<D>(own);
  Vec<D> move = Vec<D>::Zero();
  for (const Vec3& direction : classes_->foot(nodes()[i], lifted(from)).frame)
    move += *own++ * direction.head<D>();
  return move;
}

double NodeUnknowns::mean_edge(const Coordinates& x, Index node) const {
  return in_dimension(x,
                      [&](const auto& points) { return mean_edge_at(topology(), points, node); });
}

void NodeUnknowns::values(const Coordinates& x, std::span<double> out) const {
  in_dimension(x, [&]<int D>(const Points<D>& points) {
    for (std::size_t i = 0; i < nodes().size(); ++i) {
      const Vec<D> p = points[nodes()[i]];
      double* own = out.data() + first(i);
      if (!classes_->slides(nodes()[i])) {
        std::copy(p.data(), p.data() + D, own);
        continue;
      }
      std::fill_n(own, count(i), 0.0);
      for (const Vec3& direction : classes_->frame(nodes()[i])) {
        *own++ = direction.head<D>().dot(p);
      }
    }
  });
}

void NodeUnknowns::lengths(const Coordinates& x, std::span<double> out) const {
  in_dimension(x, [&](const auto& points) {
    for (std::size_t i = 0; i < nodes().size(); ++i) {
      std::fill_n(out.data() + first(i), count(i), mean_edge_at(topology(), points, nodes()[i]));
    }
  });
}

void NodeUnknowns::place_others(Coordinates& x) const {
  for (const auto& [image, node, transform] : images())
    set_place(x, image, transform->of(place_of(x, node)));
  for (const auto& row : rows()) {
    const auto places = row->places(place_of(x, row->first()), place_of(x, row->last()));
    for (std::size_t k = 0; k < places.between.size(); ++k)
      set_place(x, row->between()[k], places.between[k].point);
  }
}

double NodeUnknowns::advance(std::span<const double> direction, double step, Coordinates& x) const {
  constexpr Index block = 512;  // returning to a curved surface needs a search
  const auto count = static_cast<Index>(nodes().size());
  std::vector<double> largest2(block_count(count, block), 0.0);
  in_dimension(x, [&]<int D>(const Points<D>&) {
    const auto move_nodes = [&](Index begin, Index end) {
      double& largest = largest2[at(begin / block)];
      for (Index i = begin; i < end; ++i) {
        const Index node = nodes()[at(i)];
        const Vec<D> from = x.template get<D>(node);
        Vec<D> to = from + step * move_of<D>(at(i), from, direction);
        // A move along the tangent leaves a curved boundary: project back.
        if (classes_->slides(node)) to = classes_->foot(node, lifted(to)).point.template head<D>();
        x.template set<D>(node, to);
        largest = std::max(largest, (to - from).squaredNorm());
      }
    };
    parallel_for(threads_, count, move_nodes, block);
  });
  place_others(x);
  return std::sqrt(largest2.empty() ? 0 : *std::ranges::max_element(largest2));
}

void NodeUnknowns::velocities(const Coordinates& x, std::span<const double> rates,
                              Coordinates& out) const {
  in_dimension(x, [&]<int D>(const Points<D>& points) {
    for (std::size_t i = 0; i < nodes().size(); ++i) {
      out.template set<D>(nodes()[i], move_of<D>(i, points[nodes()[i]], rates));
    }
  });
  for (const auto& [image, node, transform] : images())
    set_place(out, image, transform->rotation * place_of(out, node));
  for (const auto& row : rows()) {
    const auto places = row->places(place_of(x, row->first()), place_of(x, row->last()));
    const auto speed = [&](Index node, const CurvePoint<3>& place) {
      return classes_->moves(node) ? place.tangent.dot(place_of(out, node)) : 0;
    };
    const double first = speed(row->first(), places.first);
    const double last = speed(row->last(), places.last);
    for (std::size_t k = 0; k < places.between.size(); ++k) {
      const double along = first + row->part_of_last(k) * (last - first);
      set_place(out, row->between()[k], along * places.between[k].tangent);
    }
  }
}

double NodeUnknowns::largest_valid_step(const Coordinates& from, const Coordinates& to,
                                        double most) const {
  if (!is_surface(topology()))
    return winslow::largest_valid_step(topology(), from, to, most, threads_);
  return largest_valid_step_on_surface(topology(), from, to,
                                       element_normals(*classes_, from, threads_), most, threads_);
}

Validity NodeUnknowns::validity(const Coordinates& x) const {
  return check_validity(*classes_, x, threads_);
}

double NodeUnknowns::residual_round_off(const Coordinates& x) const {
  constexpr double safety = 16;
  const auto count = static_cast<Index>(nodes().size());
  std::vector<double> of_blocks(block_count(count), 0.0);
  in_dimension(x, [&](const auto& points) {
    parallel_for(threads(), count, [&](Index begin, Index end) {
      double& worst = of_blocks[at(begin / parallel_block)];
      for (Index k = begin; k < end; ++k) {
        const Index node = nodes()[at(k)];
        const double edge = mean_edge_at(topology(), points, node);
        if (edge > 0)
          worst = std::max(worst, points[node].template lpNorm<Eigen::Infinity>() / edge);
      }
    });
  });
  const double worst = of_blocks.empty() ? 0 : *std::ranges::max_element(of_blocks);
  // A tangled start can have edges of almost zero length; it must not count as converged.
  return std::min(safety * std::numeric_limits<double>::epsilon() * worst, 1e-7);
}

namespace {

/// Whether the surface direction changes between two feet by at least the angle of a fold.
bool turns(const Foot& from, const Foot& to) {
  const double cos_fold = std::cos(10 * M_PI / 180);
  const int count = std::min(from.frame.count(), to.frame.count());
  if (count == 0) return false;
  if (count == 1) return std::abs(from.frame[0].dot(to.frame[0])) < cos_fold;
  const Vec3 before = from.frame[0].cross(from.frame[1]);
  return std::abs(before.dot(to.frame[0].cross(to.frame[1]))) < cos_fold;
}

/// Whether a step crosses a jump or a fold. way: length of the step in the tangent plane.
bool leads_astray(const NodeClasses& classes, Index node, const Foot& from, const Foot& to,
                  double way) {
  constexpr double far = 4;
  constexpr int halvings = 6;
  if ((to.point - from.point).norm() > far * way) return true;
  Foot first = from, last = to;
  for (int i = 0; i < halvings && turns(first, last); ++i) {
    const Foot middle = classes.foot(node, 0.5 * (first.point + last.point));
    (turns(first, middle) ? last : first) = middle;
  }
  return turns(first, last);
}

}  // namespace

Index add_nodes_led_astray(const NodeUnknowns& nodes, const Coordinates& x,
                           const Coordinates& there, std::span<const double> direction,
                           std::size_t stride, double step, std::vector<bool>& stuck) {
  const NodeClasses& classes = nodes.classes();
  const SpacePoints before(x), after(there);
  std::vector<unsigned char> astray(stuck.size(), 0);
  constexpr Index block = 512;  // finding a foot may need a search
  const auto find = [&](Index begin, Index end) {
    for (std::size_t row = at(begin); row < at(end); ++row) {
      const Index node = nodes.nodes()[row];
      if (stuck[row] || !classes.slides(node)) continue;
      const auto of_node = direction.subspan(stride * row, stride);
      const double way = step * std::hypot(of_node[0], of_node[1]);
      if (!(way > 0)) continue;
      const Foot from = classes.foot(node, before[node]), to = classes.foot(node, after[node]);
      astray[row] = leads_astray(classes, node, from, to, way) ? 1 : 0;
    }
  };
  parallel_for(nodes.threads(), static_cast<Index>(stuck.size()), find, block);
  Index count = 0;
  for (std::size_t row = 0; row < stuck.size(); ++row) {
    if (astray[row] == 0) continue;
    stuck[row] = true;
    ++count;
  }
  return count;
}

}  // namespace winslow
