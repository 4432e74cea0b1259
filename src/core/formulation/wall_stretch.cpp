#include "core/formulation/wall_stretch.h"

#include <Eigen/Eigenvalues>
#include <queue>

#include "core/quality/metric.h"

namespace winslow {

namespace {

/// A face of a wall.
struct WallFace {
  Face nodes;
  Eigen::Matrix3d squares;  ///< F^T F + n n^T
  Eigen::Matrix3d normals;  ///< n n^T
};

/// Two edges of a face, and its unit normal, as columns. The edges of a quadrilateral are its
/// diagonals.
Eigen::Matrix3d frame_of(const Face& nodes, const Coordinates& x) {
  const auto place = [&](std::size_t k) { return place_of(x, nodes[k]); };
  Eigen::Matrix3d frame;
  if (nodes.size() == 2) {  // in the plane
    frame.col(0) = place(1) - place(0);
    frame.col(1) = Vec3::UnitZ();
  } else if (nodes.size() == 3) {
    frame.col(0) = place(1) - place(0);
    frame.col(1) = place(2) - place(0);
  } else {
    frame.col(0) = place(2) - place(0);
    frame.col(1) = place(3) - place(1);
  }
  frame.col(2) = frame.col(0).cross(frame.col(1)).normalized();
  return frame;
}

bool is_degenerate(const Eigen::Matrix3d& frame) {
  constexpr double least = 1e-12;  // times the lengths of the edges
  return !(std::abs(frame.determinant()) > least * frame.col(0).norm() * frame.col(1).norm());
}

/// The face deformation F^T F + n n^T from a frame in the reference mesh to one after a motion.
Eigen::Matrix3d squares_of(const Eigen::Matrix3d& inverse, const Eigen::Matrix3d& after) {
  constexpr double round_off = 1e-9;
  const Eigen::Matrix3d gradient = after * inverse;
  const Eigen::Matrix3d squares = gradient.transpose() * gradient;
  const bool is_identity =
      (squares - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < round_off;
  return is_identity ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : squares;
}

/// The wall faces of a mesh.
class Walls {
 public:
  Walls(const NodeClasses& classes, const Coordinates& reference, const Coordinates& moved)
      : classes_(classes), topology_(classes.topology()), reference_(reference), moved_(moved) {
    std::vector<bool> marked(at(topology_.face_count()), false);
    for (const Marker& marker : topology_.markers())
      for (const Face& face : marker.faces)
        if (const auto f = topology_.find_face(face)) marked[at(*f)] = true;
    for (Index f = 0; f < topology_.face_count(); ++f) {
      const auto face = topology_.face(f);
      if (is_wall(face, marked[at(f)])) add(face.nodes);
    }
  }

  bool stretched() const { return stretched_; }
  std::span<const WallFace> faces() const { return faces_; }

 private:
  bool is_wall(const Topology::SharedFace& face, bool marked) const {
    const Face& nodes = face.nodes;
    if (std::ranges::any_of(nodes, [&](Index node) { return classes_.moves(node); })) return false;
    return marked || face.elements[1] < 0 || is_solid(face.elements[0]) ||
           is_solid(face.elements[1]);
  }
  /// Whether an element is inside a solid: none of its nodes moves, and one is not on a boundary.
  bool is_solid(Index e) const {
    const auto nodes = topology_.element(e);
    return std::ranges::none_of(nodes, [&](Index node) { return classes_.moves(node); }) &&
           std::ranges::any_of(nodes, [&](Index node) { return !topology_.on_boundary(node); });
  }
  void add(const Face& nodes) {
    const Eigen::Matrix3d before = frame_of(nodes, reference_);
    const Eigen::Matrix3d after = frame_of(nodes, moved_);
    if (is_degenerate(before) || is_degenerate(after)) return;
    const Eigen::Matrix3d squares = squares_of(before.inverse(), after);
    stretched_ = stretched_ || !squares.isIdentity(0);
    const Vec3 normal = before.col(2);
    faces_.push_back({nodes, squares, normal * normal.transpose()});
  }

  const NodeClasses& classes_;
  const Topology& topology_;
  const Coordinates& reference_;
  const Coordinates& moved_;
  std::vector<WallFace> faces_;
  bool stretched_ = false;
};

/// The shortest ways along edges from all nodes to the walls.
struct WaysToWalls {
  std::vector<Index> wall;  ///< #nodes: the wall node to which the way leads; -1: there is none
  std::vector<Index> next;  ///< #nodes: the next node on the way; -1 for wall nodes and without one
};

WaysToWalls shortest_ways(const Topology& topology, const Coordinates& x,
                          std::span<const WallFace> faces) {
  using Way = std::pair<double, Index>;  // length from the wall, node
  std::priority_queue<Way, std::vector<Way>, std::greater<>> waiting;
  std::vector<double> length(at(topology.node_count()), std::numeric_limits<double>::infinity());
  WaysToWalls ways{std::vector<Index>(length.size(), -1), std::vector<Index>(length.size(), -1)};
  for (const WallFace& face : faces)
    for (const Index node : face.nodes) {
      if (std::exchange(ways.wall[at(node)], node) >= 0) continue;
      length[at(node)] = 0;
      waiting.push({0, node});
    }
  while (!waiting.empty()) {
    const auto [so_far, node] = waiting.top();
    waiting.pop();
    if (so_far > length[at(node)]) continue;
    const Vec3 place = place_of(x, node);
    for (const Index other : topology.neighbours(node)) {
      const double longer = so_far + (place_of(x, other) - place).norm();
      if (!(longer < length[at(other)])) continue;
      length[at(other)] = longer;
      ways.wall[at(other)] = ways.wall[at(node)];
      ways.next[at(other)] = node;
      waiting.push({longer, other});
    }
  }
  return ways;
}

/// Projection onto the direction of a vector.
Eigen::Matrix3d projection_onto(const Vec3& vector) {
  return vector * vector.transpose() / vector.squaredNorm();
}

/// The wall under an element.
struct WallBelow {
  Eigen::Matrix3d squares;  ///< F^T F + n n^T, the mean over its faces
  /// Projection onto the directions along the wall. Under an element that stands on an edge or a
  /// node of the wall, as in a fan, these are the edge, or none.
  Eigen::Matrix3d along;
  int directions;            ///< number of them
  std::vector<Index> faces;  ///< under it
};

/// Finds the walls under elements.
class WallsBelow {
 public:
  WallsBelow(const Topology& topology, const Coordinates& reference,
             std::span<const WallFace> faces)
      : topology_(topology),
        reference_(reference),
        faces_(faces),
        ways_(shortest_ways(topology, reference, faces)),
        faces_at_(rows_of(topology.node_count(), [&](const auto& add) {
          for (std::size_t f = 0; f < faces.size(); ++f)
            for (const Index node : faces[f].nodes) add(node, static_cast<Index>(f));
        })) {}

  /// None: no wall, or a sharp corner of it.
  std::optional<WallBelow> of(Index e) const {
    std::vector<Index> below;
    for (const Index node : topology_.element(e))
      if (ways_.wall[at(node)] >= 0) below.push_back(ways_.wall[at(node)]);
    std::ranges::sort(below);
    below.erase(std::unique(below.begin(), below.end()), below.end());
    if (below.empty()) return std::nullopt;
    auto [squares, normals, under] = means_over_faces(below);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of_normals(normals);
    const int dimension = reference_.dimension();
    // Over a sharp edge or corner an element may stand on that alone, as in a fan.
    constexpr double sharp =
        0.1;  // square of the sine of half the angle by which faces turn: 37 deg
    if (of_normals.eigenvalues()[1] > sharp) {
      if (below.size() == 1) return std::nullopt;
      if (below.size() == 2 && dimension == 3) {
        const Vec3 edge = place_of(reference_, below[1]) - place_of(reference_, below[0]);
        return WallBelow{squares, projection_onto(edge), 1, std::move(under)};
      }
    }
    const Vec3 normal = of_normals.eigenvectors().col(2);
    Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - projection_onto(normal);
    if (dimension == 2) along -= projection_onto(Vec3::UnitZ());
    return WallBelow{squares, along, dimension - 1, std::move(under)};
  }

  const WaysToWalls& ways() const { return ways_; }

 private:
  struct Means {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero(), normals = Eigen::Matrix3d::Zero();
    std::vector<Index> faces;
  };

  /// Means over the faces with most of these wall nodes.
  Means means_over_faces(std::span<const Index> below) const {
    std::map<Index, int> shared;  // by face: how many of the nodes it has
    int most = 0;
    for (const Index node : below)
      for (const Index f : faces_at_[node]) most = std::max(most, ++shared[f]);
    std::erase_if(shared, [&](const auto& face) { return face.second < most; });
    Means means;
    for (const auto& [f, nodes] : shared) {
      means.squares += faces_[at(f)].squares;
      means.normals += faces_[at(f)].normals;
      means.faces.push_back(f);
    }
    const auto count = static_cast<double>(shared.size());
    means.squares /= count;
    means.normals /= count;
    return means;
  }

  const Topology& topology_;
  const Coordinates& reference_;
  std::span<const WallFace> faces_;
  WaysToWalls ways_;
  CompressedRows faces_at_;  // #nodes: indices of wall faces
};

/// How long an element is along a wall, over its height.
double length_over_height(std::span<const Index> nodes, const Coordinates& x,
                          const WallBelow& wall) {
  Vec3 mean = Vec3::Zero();
  for (const Index node : nodes) mean += place_of(x, node) / static_cast<double>(nodes.size());
  double along = 0, across = 0;
  for (const Index node : nodes) {
    const Vec3 from_mean = place_of(x, node) - mean, on_wall = wall.along * from_mean;
    along += on_wall.squaredNorm();
    across += (from_mean - on_wall).squaredNorm();
  }
  along /= wall.directions;
  across /= x.dimension() - wall.directions;
  return std::sqrt(along / std::max(across, std::numeric_limits<double>::min()));
}

double share_at(double length_over_height) {
  constexpr double low = 0.3, high = 0.7;
  const double t = std::clamp((std::log(length_over_height) - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// U^s, times the factor of the height across the wall.
Eigen::Matrix3d map_of(const Eigen::Matrix3d& squares, const Eigen::Matrix3d& along, double share,
                       double height) {
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(along * squares * along + across);
  const Vec3 powers = (0.5 * share * eigen.eigenvalues().array().log()).exp();
  return eigen.eigenvectors() * powers.asDiagonal() * eigen.eigenvectors().transpose() +
         (height - 1) * across;
}

/// The factor of an element's height: the geometric mean over its held edges; none: it has none.
std::optional<double> height_factor(std::span<const Index> nodes, const WaysToWalls& ways,
                                    std::span<const double> factors) {
  double sum = 0;
  int count = 0;
  for (const Index node : nodes) {
    if (factors.empty() || factors[at(node)] == 0) continue;
    if (std::ranges::find(nodes, ways.next[at(node)]) == nodes.end()) continue;
    sum += std::log(factors[at(node)]);
    ++count;
  }
  return count > 0 ? std::optional(std::exp(sum / count)) : std::nullopt;
}

/// Calls visit(element, wall under it, share) for the elements in layers over walls.
template <typename Visit>
void for_each_in_layers(const Topology& topology, const Coordinates& reference,
                        const WallsBelow& walls_below, const Visit& visit) {
  for (Index e = 0; e < topology.element_count(); ++e) {
    auto wall = walls_below.of(e);
    if (!wall) continue;
    const double share = share_at(length_over_height(topology.element(e), reference, *wall));
    if (share > 0) visit(e, std::move(*wall), share);
  }
}

}  // namespace

/// The faces of walls, and the elements in layers over them, in the reference mesh.
class WallLayers::Elements {
 public:
  /// walls: from the reference mesh to any other one.
  Elements(const NodeClasses& classes, const Coordinates& reference, const Walls& walls)
      : topology_(classes.topology()) {
    for (const WallFace& face : walls.faces())
      faces_.push_back({face.nodes, frame_of(face.nodes, reference).inverse()});
    const WallsBelow walls_below(topology_, reference, walls.faces());
    for_each_in_layers(topology_, reference, walls_below,
                       [&](Index e, const WallBelow& wall, double share) {
                         elements_.push_back({e, share, wall.along, below_.size()});
                         below_.insert(below_.end(), wall.faces.begin(), wall.faces.end());
                       });
    ways_ = walls_below.ways();
  }

  std::size_t bytes() const { return bytes_of(faces_, elements_, below_, ways_.wall, ways_.next); }

  /// Whether no face is degenerate in a mesh.
  bool has_all_faces(const Coordinates& moved) const {
    return std::ranges::none_of(
        faces_, [&](const Face& face) { return is_degenerate(frame_of(face.nodes, moved)); });
  }
  /// Of each face.
  std::vector<Eigen::Matrix3d> squares(const Coordinates& moved) const {
    std::vector<Eigen::Matrix3d> out;
    out.reserve(faces_.size());
    for (const auto& [nodes, inverse] : faces_)
      out.push_back(squares_of(inverse, frame_of(nodes, moved)));
    return out;
  }

  std::shared_ptr<const WallStretch> stretched(std::span<const Eigen::Matrix3d> of_faces,
                                               std::span<const double> factors) const {
    auto result = std::make_shared<WallStretch>();
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      const auto& [e, share, along, first] = elements_[k];
      const Eigen::Matrix3d squares = mean(of_faces, k);
      const auto factor = height_factor(topology_.element(e), ways_, factors);
      if (squares.isIdentity(0) && !factor) continue;
      result->add(e, {map_of(squares, along, share, std::pow(factor.value_or(1), share)),
                      factor.has_value()});
    }
    return result;
  }

  void differentiate(const Coordinates& moved, std::span<const double> factors,
                     WallStretchDerivative& out) const;

 private:
  struct Face {
    winslow::Face nodes;
    Eigen::Matrix3d inverse;  // of its frame
  };
  struct Element {
    Index element;
    double share;
    Eigen::Matrix3d along;
    std::size_t first;  // of the faces under it, in below_
  };

  /// The faces under an element.
  std::span<const Index> faces_below(std::size_t k) const {
    const std::size_t first = elements_[k].first;
    const std::size_t end = k + 1 < elements_.size() ? elements_[k + 1].first : below_.size();
    return std::span(below_).subspan(first, end - first);
  }
  Eigen::Matrix3d mean(std::span<const Eigen::Matrix3d> of_faces, std::size_t k) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    const auto faces = faces_below(k);
    for (const Index f : faces) sum += of_faces[at(f)];
    return sum / static_cast<double>(faces.size());
  }

  const Topology& topology_;
  std::vector<Face> faces_;
  std::vector<Element> elements_;
  std::vector<Index> below_;
  WaysToWalls ways_;
};

std::shared_ptr<const WallStretch> WallStretch::find(const NodeClasses& classes,
                                                     const Coordinates& reference,
                                                     const Coordinates& moved,
                                                     std::span<const double> factors) {
  const Walls walls(classes, reference, moved);
  if (!walls.stretched() && factors.empty()) return nullptr;
  const WallLayers::Elements elements(classes, reference, walls);
  return elements.stretched(elements.squares(moved), factors);
}

WallLayers::WallLayers(std::shared_ptr<const NodeClasses> classes,
                       std::shared_ptr<const Coordinates> reference)
    : classes_(std::move(classes)), reference_(std::move(reference)) {}

std::size_t WallLayers::bytes() const { return elements_ ? elements_->bytes() : 0; }

std::shared_ptr<const WallLayers::Elements> WallLayers::elements(const Coordinates& moved) const {
  if (!elements_)
    elements_ = std::make_shared<const Elements>(*classes_, *reference_,
                                                 Walls(*classes_, *reference_, *reference_));
  // Other elements stand on other faces where one has vanished.
  if (elements_->has_all_faces(moved)) return elements_;
  return std::make_shared<const Elements>(*classes_, *reference_,
                                          Walls(*classes_, *reference_, moved));
}

std::shared_ptr<const WallStretch> WallLayers::stretched(const Coordinates& moved,
                                                         std::span<const double> factors) const {
  if (!elements_ && factors.empty() && !Walls(*classes_, *reference_, moved).stretched())
    return nullptr;
  const auto elements = this->elements(moved);
  const std::vector<Eigen::Matrix3d> squares = elements->squares(moved);
  const bool stretched =
      std::ranges::any_of(squares, [](const Eigen::Matrix3d& m) { return !m.isIdentity(0); });
  if (!stretched && factors.empty()) return nullptr;
  return elements->stretched(squares, factors);
}

namespace {

/// Unit vectors that span the directions of a projection.
std::vector<Vec3> tangents_of(const Eigen::Matrix3d& along) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(along);
  std::vector<Vec3> tangents;
  for (int k = 0; k < 3; ++k)
    if (eigen.eigenvalues()[k] > 0.5) tangents.emplace_back(eigen.eigenvectors().col(k));
  return tangents;
}

/// The tangents of a parameter.
std::array<std::size_t, 2> pair_of(int parameter) {
  return parameter == 2 ? std::array<std::size_t, 2>{0, 1}
                        : std::array<std::size_t, 2>{at(parameter), at(parameter)};
}

}  // namespace

void WallLayers::Elements::differentiate(const Coordinates& moved, std::span<const double> factors,
                                         WallStretchDerivative& out) const {
  const std::vector<Eigen::Matrix3d> of_faces = squares(moved);
  for (const auto& [nodes, inverse] : faces_)
    out.faces_.push_back({nodes, inverse, frame_of(nodes, moved)});
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const auto& [e, share, along, first] = elements_[k];
    const auto factor = height_factor(topology_.element(e), ways_, factors);
    const auto below = faces_below(k);
    out.elements_.push_back(e);
    out.below_.push_back({mean(of_faces, k), along, tangents_of(along),
                          std::vector<Index>(below.begin(), below.end()), share,
                          std::pow(factor.value_or(1), share), factor.has_value()});
  }
}

WallStretchDerivative::WallStretchDerivative(const WallLayers& layers, const Coordinates& moved,
                                             std::span<const double> factors)
    : dimension_(layers.reference().dimension()) {
  layers.elements(moved)->differentiate(moved, factors, *this);
}

std::shared_ptr<const WallStretch> WallStretchDerivative::changed(int parameter,
                                                                  double change) const {
  const auto result = std::make_shared<WallStretch>();
  const auto [i, j] = pair_of(parameter);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Below& wall = below_[k];
    Eigen::Matrix3d squares = wall.squares;
    if (const auto& t = wall.tangents; j < t.size()) {
      const Eigen::Matrix3d product = t[i] * t[j].transpose();
      squares += i == j ? Eigen::Matrix3d(change * product)
                        : Eigen::Matrix3d(change * (product + product.transpose()));
    }
    if (squares.isIdentity(0) && !wall.held) continue;
    result->add(elements_[k], {map_of(squares, wall.along, wall.share, wall.height), wall.held});
  }
  return result->elements().empty() ? nullptr : result;
}

/// Calls visit(place of the rate, node, vector) for each term of the rates: the product of the
/// node's velocity and the vector.
template <typename Visit>
void WallStretchDerivative::for_each_part(const Visit& visit) const {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Below& wall = below_[k];
    for (int parameter = 0; parameter < parameters(); ++parameter) {
      const auto [i, j] = pair_of(parameter);
      if (j >= wall.tangents.size()) continue;
      const std::size_t place = k * at(parameters()) + at(parameter);
      for (const Index f : wall.faces) {
        const StretchedFace& face = faces_[at(f)];
        const Vec3 a = face.inverse * wall.tangents[i], b = face.inverse * wall.tangents[j];
        const auto stretched = [&](const Vec3& c) {
          return Vec3(face.moved.col(0) * c[0] + face.moved.col(1) * c[1]);
        };
        const Vec3 to_a = stretched(a), to_b = stretched(b);
        const double part = 1 / static_cast<double>(wall.faces.size());
        // The edges of frame_of(): from their first to their second nodes.
        const auto edge = [&](int column, std::size_t from, std::size_t to) {
          const Vec3 slope = part * (a[column] * to_b + b[column] * to_a);
          visit(place, face.nodes[to], slope);
          visit(place, face.nodes[from], Vec3(-slope));
        };
        const bool four = face.nodes.size() > 3;
        edge(0, 0, four ? 2 : 1);
        if (face.nodes.size() > 2) edge(1, four ? 1 : 0, four ? 3 : 2);
      }
    }
  }
}

void WallStretchDerivative::add_rates(const Coordinates& velocities,
                                      std::span<double> rates) const {
  for_each_part([&](std::size_t place, Index node, const Vec3& slope) {
    rates[place] += slope.dot(place_of(velocities, node));
  });
}

void WallStretchDerivative::add_transpose(std::span<const double> multipliers,
                                          Coordinates& out) const {
  for_each_part([&](std::size_t place, Index node, const Vec3& slope) {
    set_place(out, node, place_of(out, node) + multipliers[place] * slope);
  });
}

std::vector<LayerEdge> layer_edges(const Mesh& mesh, std::span<const Index> wall_nodes) {
  const Topology& topology = *mesh.topology;
  const NodeClasses classes(mesh.topology);
  const Walls walls(classes, mesh.coordinates, mesh.coordinates);
  const WallsBelow walls_below(topology, mesh.coordinates, walls.faces());
  const WaysToWalls& ways = walls_below.ways();
  std::vector<bool> chosen(at(topology.node_count()), false), found(chosen);
  for (const Index node : wall_nodes) chosen[at(node)] = true;
  constexpr double mostly = 0.5;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const auto nodes = topology.element(e);
    const auto stands = [&](Index node) {
      return ways.wall[at(node)] >= 0 && chosen[at(ways.wall[at(node)])];
    };
    if (!std::ranges::all_of(nodes, stands)) continue;
    const auto wall = walls_below.of(e);
    if (!wall || share_at(length_over_height(nodes, mesh.coordinates, *wall)) < mostly) continue;
    for (const Index node : nodes)
      if (std::ranges::find(nodes, ways.next[at(node)]) != nodes.end()) found[at(node)] = true;
  }
  std::vector<LayerEdge> edges;
  for (Index node = 0; node < topology.node_count(); ++node)
    if (found[at(node)]) edges.push_back({ways.next[at(node)], node});
  return edges;
}

}  // namespace winslow
