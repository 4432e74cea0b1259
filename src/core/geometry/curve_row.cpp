#include "core/geometry/curve_row.h"

#include <cmath>
#include <utility>

namespace winslow {

namespace {

template <int D>
class LiftedCurve final : public ArcCurve {
 public:
  explicit LiftedCurve(std::shared_ptr<const Curve<D>> curve) : curve_(std::move(curve)) {}
  double arc_of(const Vec3& point) const override {
    return curve_->arc_of(point.template head<D>());
  }
  CurvePoint<3> at_arc(double arc) const override {
    const CurvePoint<D> place = curve_->at_arc(arc);
    return {lifted(place.point), lifted(place.tangent), lifted(place.curvature)};
  }
  double period() const override { return curve_->period(); }

 private:
  static Vec3 lifted(const Vec<D>& v) {
    Vec3 out(0, 0, 0);
    out.template head<D>() = v;
    return out;
  }

  std::shared_ptr<const Curve<D>> curve_;
};

}  // namespace

std::shared_ptr<const ArcCurve> by_arc(std::shared_ptr<const PlaneCurve> curve) {
  return std::make_shared<LiftedCurve<2>>(std::move(curve));
}
std::shared_ptr<const ArcCurve> by_arc(std::shared_ptr<const SpaceCurve> curve) {
  return std::make_shared<LiftedCurve<3>>(std::move(curve));
}

CurveRow::CurveRow(std::vector<Index> nodes, bool closed, std::shared_ptr<const ArcCurve> curve,
                   std::span<const Vec3> places)
    : nodes_(std::move(nodes)), closed_(closed), curve_(std::move(curve)) {
  const bool round_a_corner = !closed_ && nodes_.front() == nodes_.back();
  if (round_a_corner && curve_->period() == 0) return;
  const std::vector<double> lengths = edge_lengths(places);
  for (const double length : lengths) length_ += length;
  double along = 0;
  for (std::size_t k = 0; k + 1 < lengths.size(); ++k) {
    along += lengths[k];
    shares_.push_back(along / length_);
  }
}

/// The shorter way on a closed curve.
double CurveRow::arc_between(double from, double to) const {
  const double period = curve_->period();
  return period > 0 ? std::remainder(to - from, period) : to - from;
}

std::vector<double> CurveRow::edge_lengths(std::span<const Vec3> places) const {
  std::vector<double> lengths;
  double before = curve_->arc_of(places.front());
  const double start = before;
  for (std::size_t k = 1; k < places.size(); ++k) {
    const double arc = curve_->arc_of(places[k]);
    lengths.push_back(arc_between(before, arc));
    before = arc;
  }
  if (closed_) lengths.push_back(arc_between(before, start));
  return lengths;
}

CurveRow::Places CurveRow::places(const Vec3& first, const Vec3& last) const {
  const double from = curve_->arc_of(first), to = curve_->arc_of(last);
  const double period = curve_->period();
  double length = closed_ ? length_ : to - from;
  if (!closed_ && period > 0) {
    // The row goes the way round that it went as given, and once at most.
    const double way = length_ < 0 ? -1 : 1;
    double round = std::fmod(way * length, period);
    if (round <= 0) round += period;
    length = way * round;
  }
  Places out{curve_->at_arc(from), curve_->at_arc(to), {}};
  for (const double share : shares_) out.between.push_back(curve_->at_arc(from + share * length));
  return out;
}

}  // namespace winslow
