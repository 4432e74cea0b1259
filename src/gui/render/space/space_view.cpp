#include "gui/render/space/space_view.h"

#include "core/error.h"

namespace winslow::gui {

Vec3 SpaceCamera::at_depth_of(const Vec3& point, const ScreenPoint& at) const {
  const auto [origin, direction] = unproject(at);
  return origin + back_.dot(point - origin) / back_.dot(direction) * direction;
}

LookedAt SpaceCamera::looked_at() const { return {centre_, units_per_pixel_, direction_}; }

void SpaceCamera::look_at(const LookedAt& place) {
  if (place.direction) look_from(*place.direction);
  look_at(place.centre, place.units_per_pixel);
}

void SpaceCamera::pan_at(const Vec3& point, const ScreenVector& by) {
  look_at(centre_ - pixel_size(point) * (by.x() * right_ - by.y() * up_), units_per_pixel_);
}

/// Equivalent to moving the viewer nearer to the point by the factor.
void SpaceCamera::zoom_about(const Vec3& point, double factor) {
  look_at(point + (centre_ - point) / factor, units_per_pixel_ / factor);
}

void SpaceCamera::look_from(const ViewDirection& direction, const Vec3& pivot) {
  const Vec3 from = centre_ - pivot;
  const double right = right_.dot(from), up = up_.dot(from), back = back_.dot(from);
  look_from(direction);
  look_at(pivot + right * right_ + up * up_ + back * back_, units_per_pixel_);
}

void SpaceCamera::turn(const Vec3& pivot, const ScreenVector& by, bool freely) {
  const double height = std::max(height_, 1.0);
  if (!freely) {
    const double degrees_per_pixel = 180 / height;
    ViewDirection direction = direction_;
    direction.roll = 0;
    direction.azimuth = std::remainder(direction.azimuth - degrees_per_pixel * by.x(), 360);
    direction.elevation = std::clamp(direction.elevation + degrees_per_pixel * by.y(), -90.0, 90.0);
    return look_from(direction, pivot);
  }
  const double per_pixel = pi / height;
  // The viewer turns, opposite to the apparent turn of the mesh.
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(-per_pixel * by.x(), up_) * Eigen::AngleAxisd(-per_pixel * by.y(), right_))
          .toRotationMatrix();
  look_from(direction_of(turn * right_, turn * back_, direction_.up), pivot);
}

namespace {

/// Near limit of drawing, as a share of the centre's distance from the viewer.
constexpr double nearest = 1e-3;

/// Vector from its components along the two axes that follow the up axis, and along that axis.
Vec3 from_upright(const Vec3& v, int up) {
  Vec3 turned;
  for (int k = 0; k < 3; ++k) turned[(up + 1 + k) % 3] = v[k];
  return turned;
}

}  // namespace

Vec3 to_viewer(const ViewDirection& direction) {
  const double a = radians(direction.azimuth), e = radians(direction.elevation);
  return from_upright({std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)},
                      direction.up);
}

ViewDirection direction_towards(const Vec3& viewer, int up) {
  const Vec3 v = viewer.normalized();
  const double x = v[(up + 1) % 3], y = v[(up + 2) % 3], z = v[up];
  const double level = std::hypot(x, y);
  return {level < 1e-9 ? -90 : degrees(std::atan2(y, x)), degrees(std::atan2(z, level)), up};
}

ViewDirection direction_of(const Vec3& right, const Vec3& back, int up) {
  ViewDirection direction = direction_towards(back, up);
  SpaceCamera upright;
  upright.look_from(direction);
  direction.roll = degrees(std::atan2(right.dot(upright.up()), right.dot(upright.right())));
  return direction;
}

void SpaceCamera::set_viewport(double x, double y, double width, double height) {
  x_ = x;
  y_ = y;
  width_ = std::max(width, 1.0);
  height_ = std::max(height, 1.0);
}

/// Without roll, the axis to the right is level, and is defined from above, too.
void SpaceCamera::look_from(const ViewDirection& direction) {
  direction_ = direction;
  const double a = radians(direction.azimuth);
  right_ = from_upright({-std::sin(a), std::cos(a), 0}, direction.up);
  back_ = to_viewer(direction);
  up_ = back_.cross(right_);
  if (direction.roll == 0) return;
  const double r = radians(direction.roll);
  right_ = (std::cos(r) * right_ + std::sin(r) * up_).eval();
  up_ = back_.cross(right_);
}

void SpaceCamera::look_at(const Vec3& centre, double units_per_pixel) {
  if (!centre.allFinite() || !std::isfinite(units_per_pixel) || !(units_per_pixel > 0)) return;
  centre_ = centre;
  units_per_pixel_ = units_per_pixel;
}

void SpaceCamera::fit(std::span<const Vec3> points, double margin) {
  if (points.empty()) return;
  Box<3> seen = Box<3>::empty();  // in the axes of the screen
  for (const Vec3& p : points) seen.add(Vec3(right_.dot(p), up_.dot(p), back_.dot(p)));
  const Vec3 middle = seen.centre();
  const double share = 1 - 2 * margin;
  // Required size of a pixel at the centre, in a parallel view.
  double size = std::max(seen.size().x() / width_, seen.size().y() / height_) / share;
  if (angle_ > 0) {
    const double tangent = std::tan(radians(0.5 * angle_)) * share;
    double distance = 0;
    for (const Vec3& p : points) {
      const double x = std::abs(right_.dot(p) - middle.x()) * height_ / width_;
      const double y = std::abs(up_.dot(p) - middle.y());
      distance = std::max(distance, back_.dot(p) - middle.z() + std::max(x, y) / tangent);
    }
    size = 2 * distance * std::tan(radians(0.5 * angle_)) / height_;
  }
  look_at(middle.x() * right_ + middle.y() * up_ + middle.z() * back_,
          size > 0 ? size : 1.0 / std::max(width_, height_));
}

double SpaceCamera::distance() const {
  if (angle_ <= 0) return std::numeric_limits<double>::infinity();
  return 0.5 * height_ * units_per_pixel_ / std::tan(radians(0.5 * angle_));
}

View::Projection SpaceCamera::project(const Vec3& point) const {
  const Vec3 p = point - centre_;
  const double towards = back_.dot(p);
  const double pixels = 1 / ((1 - towards / distance()) * units_per_pixel_);
  return {{x_ + 0.5 * width_ + right_.dot(p) * pixels, y_ + 0.5 * height_ - up_.dot(p) * pixels},
          -towards};
}

Ray<3> SpaceCamera::unproject(const ScreenPoint& at) const {
  const Vec3 place = centre_ + units_per_pixel_ * ((at.x() - x_ - 0.5 * width_) * right_ -
                                                   (at.y() - y_ - 0.5 * height_) * up_);
  if (angle_ > 0) {
    return {viewer(), (place - viewer()).normalized()};
  }
  return {place + depth_range()[1] * back_, -back_};
}

double SpaceCamera::pixel_size(const Vec3& point) const {
  return (1 - back_.dot(point - centre_) / distance()) * units_per_pixel_;
}

std::array<double, 2> SpaceCamera::depth_range() const {
  const double middle = back_.dot(content_.centre() - centre_);
  const double reach = 0.5 * content_.size().norm() * 1.01;
  const double low = middle - reach, high = middle + reach;
  const double least = 1e-9 * (std::abs(middle) + units_per_pixel_ * height_);
  if (angle_ <= 0) return {low - least, high + least};
  return {std::min(low, -least), std::min(high, (1 - nearest) * distance())};
}

/// Depth z / w is 1 at the furthest height and -1 at the nearest, w = 1 - height / distance.
std::array<double, 2> SpaceCamera::depth_row() const {
  const auto [low, high] = depth_range();
  const double w_low = 1 - low / distance(), w_high = 1 - high / distance();
  const double k = -(w_low + w_high) / (high - low);
  return {k, w_low - k * low};
}

/// The derivative of z / w by the height, times the size of a pixel there, units_per_pixel w.
std::array<double, 2> SpaceCamera::pixel_depth() const {
  return {units_per_pixel_ * depth_row()[0], units_per_pixel_ / distance()};
}

std::array<float, 16> SpaceCamera::matrix(const Vec3& origin) const {
  const Vec3 shift = origin - centre_;
  const double kx = 2 / (width_ * units_per_pixel_), ky = 2 / (height_ * units_per_pixel_);
  const auto [kz, cz] = depth_row();
  std::array<float, 16> m{};
  const auto row = [&](std::size_t r, const Vec3& axis, double scale, double constant) {
    for (std::size_t c = 0; c < 3; ++c)
      m[4 * c + r] = static_cast<float>(scale * axis[static_cast<Index>(c)]);
    m[12 + r] = static_cast<float>(scale * axis.dot(shift) + constant);
  };
  row(0, right_, kx, 0);
  row(1, up_, ky, 0);
  row(2, back_, kz, cz);
  row(3, back_, -1 / distance(), 1);
  return m;
}

namespace {

/// Three-quarter view from ahead, x to the right.
ViewDirection three_quarters(int up) { return {up == 1 ? 24.0 : -66.0, 22, up}; }

/// Rounds to a power of ten that is at most `most`, for legible numbers.
double rounded(double value, double most) {
  if (!(most > 0)) return value;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return power * std::round(value / power);
}

constexpr double aside = 24;  // degrees between the direction of view and a cut's normal

}  // namespace

const std::vector<std::string>& view_names() {
  static const std::vector<std::string> names{"iso", "+x", "-x", "+y", "-y", "+z", "-z"};
  return names;
}

ViewDirection named_view(const std::string& name, int up) {
  if (name == "iso") return {up == 1 ? 45.0 : -45.0, degrees(std::atan(std::sqrt(0.5))), up};
  const auto found = std::ranges::find(view_names(), name);
  if (found == view_names().end()) {
    std::string list;
    for (const std::string& known : view_names()) list += (list.empty() ? "" : ", ") + known;
    throw UsageError("found \"" + name + "\", expected one of " + list);
  }
  return direction_towards((name[0] == '-' ? -1 : 1) * Vec3::Unit(name[1] - 'x'), up);
}

ViewDirection automatic_view(const std::vector<Plane>& cuts, int up) {
  if (cuts.empty()) return three_quarters(up);
  Vec3 normal = Vec3::Zero();
  for (const Plane& cut : cuts) normal += cut.normal();
  if (normal.norm() < 1e-6) normal = cuts.front().normal();
  ViewDirection view = direction_towards(normal, up);
  // Between their normals, several cuts are seen best.
  if (cuts.size() > 1) return {view.azimuth, std::clamp(view.elevation, -80.0, 80.0), up};
  constexpr double steep = 40;  // degrees; steeper views turn towards the horizon, not away from it
  view.azimuth += aside;
  if (std::abs(view.elevation) > steep)
    view.elevation -= std::copysign(35.0, view.elevation);
  else
    view.elevation += three_quarters(up).elevation;
  return view;
}

std::vector<Vec3> corners_of(const Box<3>& box) {
  std::vector<Vec3> corners;
  for (const double x : {box.min.x(), box.max.x()})
    for (const double y : {box.min.y(), box.max.y()})
      for (const double z : {box.min.z(), box.max.z()}) corners.emplace_back(x, y, z);
  return corners;
}

std::vector<Plane> automatic_cuts(const Mesh& mesh, const VolumeBoundary& boundary,
                                  const ViewDirection& view) {
  if (!boundary.encloses) return {};
  const SpacePoints x(mesh.coordinates);
  Box<3> bodies = Box<3>::empty();
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    if (boundary.enclosing[f] != 0) continue;
    for (const Index node : boundary.faces[f].nodes) bodies.add(x[node]);
  }
  const Vec3 to = to_viewer(view);
  Index axis = 0;
  to.cwiseAbs().maxCoeff(&axis);
  Vec3 normal = Vec3::Zero();
  normal[axis] = to[axis] < 0 ? -1 : 1;
  Vec3 middle = bodies.centre();
  middle[axis] = rounded(middle[axis], 0.02 * bodies.size()[axis]);
  return {Plane(middle, normal)};
}

}  // namespace winslow::gui
