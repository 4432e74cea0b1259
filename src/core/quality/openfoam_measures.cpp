#include "core/quality/openfoam_measures.h"

#include <utility>

#include "core/error.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

// OpenFOAM's numbers that are as good as zero.
constexpr double no_volume = 1e-15, no_size = 1e-300;
constexpr double largest_openness = 1e-6;
constexpr double has_none = std::numeric_limits<double>::quiet_NaN();
constexpr double concave_angle = 10;  // degrees

double angle_of_cosine(double cosine) { return degrees(std::acos(std::clamp(cosine, -1.0, 1.0))); }
double angle_of_sine(double sine) { return degrees(std::asin(std::min(1.0, sine))); }
double as_it_is(double value) { return value; }

/// A measure of checkMesh and how it is found.
struct MeasureSource {
  CheckedMeasure head;
  bool of_cells;
  /// NaN: the face has no such value.
  double (*value)(const FiniteVolumes&, Index);
  /// Values beyond this one are beyond the limit; they are compared and averaged before they are
  /// shown.
  double limit;
  bool beyond_is_larger;
  double (*shown)(double) = as_it_is;

  bool beyond(double value) const { return beyond_is_larger ? value > limit : value < limit; }
};

/// In the order of checkMesh.
const std::array measure_sources{
    MeasureSource{{.name = "cell_openness",
                   .label = "Cell openness",
                   .of = "cells",
                   .limit = largest_openness},
                  true,
                  [](const FiniteVolumes& all, Index c) { return all.openness(c); },
                  largest_openness,
                  true},
    MeasureSource{{.name = "aspect_ratio", .label = "Aspect ratio", .of = "cells", .limit = 1000},
                  true,
                  [](const FiniteVolumes& all, Index c) { return all.aspect_ratio(c); },
                  1000,
                  true},
    MeasureSource{{.name = "face_area",
                   .label = "Face area",
                   .unit = "squared units of the mesh",
                   .of = "faces",
                   .larger_is_better = true,
                   .limit = no_size},
                  false,
                  [](const FiniteVolumes& all, Index f) { return all.area(f); },
                  no_size,
                  false},
    MeasureSource{{.name = "volume",
                   .label = "Cell volume",
                   .unit = "cubed units of the mesh",
                   .of = "cells",
                   .larger_is_better = true,
                   .limit = no_size},
                  true,
                  [](const FiniteVolumes& all, Index c) { return all.volume(c); },
                  no_size,
                  false},
    MeasureSource{{.name = "non_orthogonality",
                   .label = "Non-orthogonality",
                   .unit = "degrees",
                   .of = "internal faces",
                   .limit = largest_non_orthogonality,
                   .fails = false},
                  false,
                  [](const FiniteVolumes& all, Index f) {
                    return all.faces().internal(f) ? all.orthogonality(f) : has_none;
                  },
                  std::cos(radians(largest_non_orthogonality)),
                  false,
                  angle_of_cosine},
    MeasureSource{{.name = "skewness", .label = "Skewness", .of = "faces", .limit = 4},
                  false,
                  [](const FiniteVolumes& all, Index f) { return all.face_skewness(f); },
                  4,
                  true},
    MeasureSource{{.name = "concave_angle",
                   .label = "Concave angle",
                   .unit = "degrees",
                   .of = "faces",
                   .limit = concave_angle,
                   .fails = false,
                   .all_geometry = true},
                  false,
                  [](const FiniteVolumes& all, Index f) {
                    return all.concavity(f, concave_angle * (pi / 180));
                  },
                  no_volume,
                  true,
                  angle_of_sine},
    MeasureSource{{.name = "flatness",
                   .label = "Face flatness",
                   .of = "faces with more than three nodes",
                   .larger_is_better = true,
                   .limit = 0.8,
                   .fails = false,
                   .all_geometry = true},
                  false,
                  [](const FiniteVolumes& all, Index f) {
                    return all.faces().nodes[f].size() > 3 && all.area(f) > no_size
                               ? all.flatness(f)
                               : has_none;
                  },
                  0.8,
                  false},
    MeasureSource{{.name = "determinant",
                   .label = "Cell determinant",
                   .of = "cells",
                   .larger_is_better = true,
                   .limit = 0.001,
                   .all_geometry = true},
                  true,
                  [](const FiniteVolumes& all, Index c) { return all.determinant(c); },
                  0.001,
                  false},
    MeasureSource{{.name = "face_weight",
                   .label = "Face weight",
                   .of = "internal faces",
                   .larger_is_better = true,
                   .limit = 0.05,
                   .all_geometry = true},
                  false,
                  [](const FiniteVolumes& all, Index f) {
                    return all.faces().internal(f) ? all.face_weight(f) : has_none;
                  },
                  0.05,
                  false},
    MeasureSource{{.name = "volume_ratio",
                   .label = "Volume ratio",
                   .of = "internal faces",
                   .larger_is_better = true,
                   .limit = 0.01,
                   .all_geometry = true},
                  false,
                  [](const FiniteVolumes& all, Index f) {
                    return all.faces().internal(f) ? all.face_volume_ratio(f) : has_none;
                  },
                  0.01,
                  false},
};

/// Calls value(i) for 0 to n - 1.
template <class Value>
std::vector<double> values_for(Index n, int threads, const Value& value) {
  std::vector<double> values(at(n));
  parallel_for(threads, n, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) values[at(i)] = value(i);
  });
  return values;
}

CheckedMeasure check_measure(const FiniteVolumes& all, const MeasureSource& source, int threads) {
  const Index n = source.of_cells ? all.faces().cell_count() : all.faces().face_count();
  std::vector<double> values =
      values_for(n, threads, [&](Index i) { return source.value(all, i); });
  std::erase_if(values, [](double value) { return std::isnan(value); });
  CheckedMeasure row = source.head;
  row.count = static_cast<Index>(values.size());
  if (values.empty()) return row;
  row.beyond = static_cast<Index>(
      std::ranges::count_if(values, [&](double value) { return source.beyond(value); }));
  const Statistics raw = statistics_of(values);
  const double low = source.shown(raw.min), high = source.shown(raw.max);
  row.values = {std::min(low, high), source.shown(raw.avg), std::max(low, high)};
  return row;
}

/// Lengths of the edges of all faces. Those shorter than a millionth of the mesh's extent are too
/// short.
CheckedMeasure check_edges(const CellFaces& faces, const Coordinates& x, int threads) {
  const SpacePoints points(x);
  CheckedMeasure row{.name = "edge_length",
                     .label = "Edge length",
                     .unit = "units of the mesh",
                     .of = "edges of faces",
                     .larger_is_better = true,
                     .fails = false,
                     .all_geometry = true};
  std::vector<double> lengths(faces.nodes.values.size());
  parallel_for(threads, faces.face_count(), [&](Index begin, Index end) {
    for (Index f = begin; f < end; ++f) {
      const auto nodes = faces.nodes[f];
      const auto first = at(faces.nodes.offsets[at(f)]);
      for (std::size_t k = 0; k < nodes.size(); ++k)
        lengths[first + k] = (points[nodes[(k + 1) % nodes.size()]] - points[nodes[k]]).norm();
    }
  });
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Index i = 0; i < x.size(); ++i) {
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  row.limit = 1e-6 * (high - low).norm();
  row.count = static_cast<Index>(lengths.size());
  row.values = statistics_of(lengths);
  row.beyond = static_cast<Index>(
      std::ranges::count_if(lengths, [&](double length) { return length < row.limit; }));
  return row;
}

/// Sums up whole numbers, whatever the number of threads.
template <class Count>
Index add_counts(Index n, int threads, const Count& count) {
  std::vector<Index> sums(block_count(n), 0);
  parallel_for(threads, n, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) sums[at(begin / parallel_block)] += count(i);
  });
  return std::accumulate(sums.begin(), sums.end(), Index{0});
}

Vec3 boundary_openness(const FiniteVolumes& all) {
  Vec3 sum(0, 0, 0);
  double size = 0;
  for (Index f = 0; f < all.faces().face_count(); ++f) {
    if (all.faces().internal(f)) continue;
    sum += all.area_vector(f);
    size += all.area(f);
  }
  return sum / (size + no_size);
}

std::string with_count(Index count, const std::string& what) {
  return std::to_string(count) + ' ' + what;
}

/// "3 faces with skewness above 4".
std::string failure_of(const CheckedMeasure& row) {
  std::string label(row.label);
  label.front() = static_cast<char>(std::tolower(label.front()));
  char limit[40];
  std::snprintf(limit, sizeof limit, "%g", row.limit);
  return with_count(row.beyond, std::string(row.of) + " with " + label +
                                    (row.larger_is_better ? " below " : " above ") + limit);
}

std::vector<std::string> failures_of(const OpenFoamMeasures& measures, bool all_geometry) {
  std::vector<std::string> list;
  for (const CheckedMeasure& row : measures.rows)
    if (row.fails && row.beyond > 0 && row.all_geometry == all_geometry)
      list.push_back(failure_of(row));
  return list;
}

void add_count(std::vector<std::string>& list, Index count, const std::string& what) {
  if (count > 0) list.push_back(with_count(count, what));
}

}  // namespace

const CheckedMeasure& OpenFoamMeasures::of(std::string_view name) const& {
  const auto found = std::ranges::find(rows, name, &CheckedMeasure::name);
  if (found == rows.end())
    throw UsageError("checkMesh has no measure '" + std::string(name) + "', expected one of: " +
                     listed(rows, [](const CheckedMeasure& row) { return row.name; }));
  return *found;
}

CheckedMeasure OpenFoamMeasures::of(std::string_view name) && {
  return std::as_const(*this).of(name);
}

std::vector<std::string> OpenFoamMeasures::failures() const {
  std::vector<std::string> list = failures_of(*this, false);
  if (boundary_openness.cwiseAbs().maxCoeff() > largest_openness)
    list.emplace_back("an open boundary");
  add_count(list, orthogonality_errors,
            "internal faces with non-orthogonality of 90 degrees or more");
  add_count(list, pyramid_errors, "pyramids of faces with negative volume");
  return list;
}

std::vector<std::string> OpenFoamMeasures::further_failures() const {
  std::vector<std::string> list = failures_of(*this, true);
  add_count(list, poor_divisions, "divisions of faces into tetrahedra without volume");
  add_count(list, concave_cells, "concave cells");
  return list;
}

OpenFoamMeasures openfoam_measures(const CellFaces& faces, const Coordinates& x, int threads,
                                   SolvedDirections directions) {
  const FiniteVolumes all(faces, x, threads, directions);
  OpenFoamMeasures measures;
  for (const MeasureSource& source : measure_sources)
    measures.rows.push_back(check_measure(all, source, threads));
  measures.rows.push_back(check_edges(faces, x, threads));
  measures.boundary_openness = boundary_openness(all);
  for (Index c = 0; c < faces.cell_count(); ++c) measures.total_volume += all.volume(c);
  const auto of_faces = [&](const auto& count) {
    return add_counts(faces.face_count(), threads, count);
  };
  measures.orthogonality_errors = of_faces(
      [&](Index f) { return faces.internal(f) && !(all.orthogonality(f) > no_volume) ? 1 : 0; });
  measures.pyramid_errors = of_faces([&](Index f) {
    return (all.owner_pyramid(f) < -no_volume ? 1 : 0) +
           (faces.internal(f) && all.neighbour_pyramid(f) < -no_volume ? 1 : 0);
  });
  measures.poor_divisions = of_faces([&](Index f) { return all.poor_divisions(f); });
  measures.concave_cells =
      add_counts(faces.cell_count(), threads, [&](Index c) { return all.concave(c) ? 1 : 0; });
  return measures;
}

OpenFoamMeasures openfoam_measures(const Mesh& mesh, int threads) {
  return openfoam_measures(cell_faces(*mesh.topology), mesh.coordinates, threads);
}

LeaningFaces newly_leaning_faces(const FiniteVolumes& mesh, const FiniteVolumes& reference) {
  const CellFaces& faces = mesh.faces();
  const double cosine = std::cos(radians(largest_non_orthogonality));
  LeaningFaces found;
  double least = 1;
  for (Index f = 0; f < faces.face_count(); ++f) {
    if (!faces.internal(f)) continue;
    const double here = mesh.orthogonality(f);
    if (here >= cosine || reference.orthogonality(f) < cosine) continue;
    found.faces.push_back(f);
    if (here >= least) continue;
    least = here;
    found.worst = f;
  }
  if (found.worst >= 0) found.angle = angle_of_cosine(least);
  return found;
}

}  // namespace winslow
