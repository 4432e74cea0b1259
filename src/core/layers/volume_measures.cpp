#include "core/layers/volume_measures.h"

#include <map>

namespace winslow {

namespace {

/// The sums over the faces at each column of normals times angles; zero inside a fan.
std::vector<Vec3> sums_of_normals(const LayerStack& stack, const Coordinates& x) {
  std::vector<Vec3> sums(stack.columns.size(), Vec3(0, 0, 0));
  for (const ColumnFace& face : stack.faces) {
    const auto corners = face.corners();
    const std::size_t n = corners.size();
    const auto place = [&](std::size_t k) {
      return x.xyz(stack.columns[corners[k % n]].wall_node);
    };
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 next = place(k + 1) - place(k), previous = place(k + n - 1) - place(k);
      const Vec3 area = next.cross(previous);
      const double twice = area.norm();
      if (twice > 0) sums[corners[k]] += std::atan2(twice, next.dot(previous)) / twice * area;
    }
  }
  return sums;
}

std::vector<Vec3> normals_of(const LayerStack& stack, std::vector<Vec3> sums) {
  for (std::size_t c = 0; c < sums.size(); ++c)
    sums[c] = sums[c].squaredNorm() > 0 ? sums[c].normalized() : stack.columns[c].direction;
  return sums;
}

/// How the wall lies at one of its nodes.
struct WallFrame {
  Vec3 normals{0, 0, 0};  // sum of the faces' area vectors
  Vec3 edge{0, 0, 0};     // to another node of the first face

  Eigen::Matrix3d axes() const {
    const Vec3 normal = normals.normalized();
    const Vec3 along = (edge - normal.dot(edge) * normal).normalized();
    Eigen::Matrix3d axes;
    axes << normal, along, normal.cross(along);
    return axes;
  }
};

/// By wall node.
std::map<Index, WallFrame> frames_of(const LayerStack& stack, const Coordinates& x) {
  std::map<Index, WallFrame> frames;
  for (const ColumnFace& face : stack.faces) {
    std::vector<Index> nodes;
    for (const std::size_t c : face.corners()) nodes.push_back(stack.columns[c].wall_node);
    Vec3 area(0, 0, 0);
    for (std::size_t k = 2; k < nodes.size(); ++k)
      area += (x.xyz(nodes[k - 1]) - x.xyz(nodes[0])).cross(x.xyz(nodes[k]) - x.xyz(nodes[0]));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      WallFrame& frame = frames[nodes[k]];
      if (frame.edge.isZero(0)) frame.edge = x.xyz(nodes[(k + 1) % nodes.size()]) - x.xyz(nodes[k]);
      frame.normals += area;
    }
  }
  return frames;
}

/// normal: zero inside a fan.
double tilt_of(const LayerColumn& column, const Vec3& normal, const Coordinates& x) {
  if (column.count() == 0 || column.along_boundary || !(normal.squaredNorm() > 0)) return -1;
  const Vec3 first = x.xyz(column.nodes[1]) - x.xyz(column.nodes[0]);
  return degrees(std::atan2(first.cross(normal).norm(), first.dot(normal)));
}

ColumnMeasure measure(const LayerColumn& column, const Vec3& normal, const Coordinates& x) {
  ColumnMeasure m;
  const std::vector<double> heights = column_heights(column, normal, x);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double error = std::abs(heights[k] / column.heights[k] - 1);
    m.spacing_error = std::max(m.spacing_error, error);
    m.thickness += heights[k];
    if (k > 0) continue;
    m.first_error = error;
    m.first_height = heights[k];
  }
  return m;
}

}  // namespace

std::vector<Vec3> column_normals(const LayerStack& stack, const Coordinates& x) {
  return normals_of(stack, sums_of_normals(stack, x));
}

std::vector<double> column_heights(const LayerColumn& column, const Vec3& normal,
                                   const Coordinates& x) {
  const double scale = column.slant * normal.dot(column.direction);
  std::vector<double> heights;
  for (std::size_t k = 0; k < column.count(); ++k)
    heights.push_back(normal.dot(x.xyz(column.nodes[k + 1]) - x.xyz(column.nodes[k])) / scale);
  return heights;
}

LayerMeasures measure_volume_layers(const LayerStack& stack, const Coordinates& x) {
  const std::vector<Vec3> sums = sums_of_normals(stack, x), normals = normals_of(stack, sums);
  std::vector<ColumnMeasure> columns;
  for (std::size_t c = 0; c < stack.columns.size(); ++c) {
    columns.push_back(measure(stack.columns[c], normals[c], x));
    columns.back().tilt = tilt_of(stack.columns[c], sums[c], x);
  }
  return measures_of(stack, std::move(columns));
}

LayerStack carried_by_walls(LayerStack stack, const Coordinates& before, const Coordinates& after) {
  const auto from = frames_of(stack, before), to = frames_of(stack, after);
  for (LayerColumn& column : stack.columns) {
    const auto frame = from.find(column.wall_node);
    if (frame == from.end()) continue;
    const Eigen::Matrix3d turn = to.at(column.wall_node).axes() * frame->second.axes().transpose();
    if (turn.allFinite()) column.direction = (turn * column.direction).normalized();
  }
  return stack;
}

void correct_volume_layers(LayerStack& stack, const Coordinates& x) {
  constexpr double most = 2;
  const std::vector<Vec3> normals = column_normals(stack, x);
  for (std::size_t c = 0; c < stack.columns.size(); ++c) {
    LayerColumn& column = stack.columns[c];
    column.corrections.resize(column.count(), 1.0);
    const std::vector<double> heights = column_heights(column, normals[c], x);
    for (std::size_t k = 0; k < heights.size(); ++k)
      column.corrections[k] *= std::clamp(column.heights[k] / heights[k], 1 / most, most);
  }
}

}  // namespace winslow
