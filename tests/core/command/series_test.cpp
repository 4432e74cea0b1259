#include "core/command/series.h"

#include <doctest/doctest.h>

#include <atomic>

#include "core/error.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState plane_state() { return make_state(make_mesh(square_with_hole(20, Cells::triangles))); }
MeshState space_state() { return make_state(box_with_body(5, Volumes::tetrahedra)); }
MeshState two_bodies() {
  return make_state(make_mesh(square_with_two_holes(20, Cells::triangles)));
}

std::vector<MovingBody> turned(const MeshState& state, double degrees,
                               const GivenVector& way = Vec2(0, 0)) {
  const bool space = state.mesh.topology->cell_dimension() == 3;
  MovingBody body{{space ? "body" : "hole"}, {.rotate = degrees, .translate = way}};
  if (space) body.motion.axis = Vec3(0.2, 0, 1);
  return {body};
}

Series series_of(std::vector<std::vector<MovingBody>> steps) {
  Series series;
  series.steps = std::move(steps);
  series.smooth.threads = 1;
  return series;
}

std::vector<SeriesResult> results_of(const Series& series, const MeshState& state) {
  std::vector<SeriesResult> results(series.steps.size());
  const auto status =
      run_series(series, state, [&](const SeriesResult& result) { results[result.step] = result; });
  REQUIRE(status.size() == results.size());
  for (std::size_t i = 0; i < status.size(); ++i) {
    CHECK(results[i].step == i);
    CHECK(results[i].status == status[i]);
  }
  return results;
}

CommandResult single(const Series& series, std::size_t step, const MeshState& state) {
  MoveCommand command;
  command.bodies = series.steps[step];
  command.how = series.how;
  command.smooth = series.smooth;
  command.smooth.tolerance = series.smooth.tolerance.value_or(1e-10);  // as steps of a series
  RunOptions options;
  options.all_or_nothing = true;
  return execute(command, state, options);
}

double difference(const MeshState& a, const MeshState& b) {
  return largest_difference(a.mesh.coordinates, b.mesh.coordinates);
}

int began_at_neighbours(const std::vector<SeriesResult>& results) {
  return static_cast<int>(std::ranges::count_if(
      results, [](const SeriesResult& result) { return result.begins.has_value(); }));
}

/// All steps are done, and equal to single runs. Returns the results.
std::vector<SeriesResult> check_equal(const Series& series, const MeshState& state,
                                      double nearly = 1e-9) {
  std::vector<SeriesResult> results = results_of(series, state);
  for (const SeriesResult& result : results) {
    CAPTURE(result.step);
    CAPTURE(result.message);
    CHECK(result.status == SeriesStatus::done);
    CHECK(result.message.empty());
    REQUIRE(result.run);
    CHECK(difference(result.run->state, single(series, result.step, state).state) < nearly);
  }
  return results;
}

}  // namespace

TEST_CASE("every step of a series is the mesh of its single run, in the plane and in space") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    Series series = series_of({});
    for (const double degrees : {-12.0, 6.0, 3.0, -4.0, 0.0, -8.0, 9.0, 12.0})
      series.steps.push_back(turned(state, degrees));
    const auto results = check_equal(series, state);
    CHECK(began_at_neighbours(results) == 5);  // all but 3, -4 and 0
    CHECK(results[0].begins == 5u);
    CHECK(results[4].run->smooth.nothing_moves);
    CHECK(results[4].run->state.mesh.coordinates == state.mesh.coordinates);
  }
}

TEST_CASE("a series needs fewer linear solves than its single runs") {
  const MeshState state = plane_state();
  Series series = series_of({});
  for (int degrees = 2; degrees <= 40; degrees += 2) series.steps.push_back(turned(state, degrees));
  int together = 0, alone = 0;
  for (const SeriesResult& result : results_of(series, state)) {
    together += result.run->smooth.linear_solves;
    alone += single(series, result.step, state).smooth.linear_solves;
  }
  CHECK(2 * together < alone);
  CHECK(together <= 4 * static_cast<int>(series.steps.size()));
}

TEST_CASE("the order of the steps does not matter") {
  const MeshState state = plane_state();
  Series forth = series_of({}), back = forth;
  for (const double degrees : {2.0, 4.0, 6.0, 8.0, 10.0}) {
    forth.steps.push_back(turned(state, degrees, Vec2(0.001 * degrees, 0)));
    back.steps.insert(back.steps.begin(), forth.steps.back());
  }
  const auto one = results_of(forth, state), other = results_of(back, state);
  for (std::size_t i = 0; i < one.size(); ++i)
    CHECK(one[i].run->state.mesh.coordinates ==
          other[one.size() - 1 - i].run->state.mesh.coordinates);
}

TEST_CASE("results do not depend on the number of jobs, to the bit") {
  const MeshState state = two_bodies();
  Series series = series_of({});
  for (const double first : {-6.0, 0.0, 6.0})
    for (const double second : {-5.0, 5.0})
      series.steps.push_back({{{"hole_a"}, {.rotate = first}}, {{"hole_b"}, {.rotate = second}}});
  const auto alone = results_of(series, state);
  for (const int jobs : {2, 3}) {
    series.jobs = jobs;
    const auto together = results_of(series, state);
    for (std::size_t i = 0; i < alone.size(); ++i) {
      CHECK(together[i].run->state.mesh.coordinates == alone[i].run->state.mesh.coordinates);
      CHECK(together[i].begins == alone[i].begins);
    }
  }
}

TEST_CASE("bodies that move together, and others that rest, are equal to single runs") {
  const MeshState state = two_bodies();
  Series series = series_of({});
  series.steps.push_back({{{"hole_a"}, {.rotate = 5}}});
  series.steps.push_back({{{"hole_a"}, {.rotate = 8}}, {{"hole_b"}, {.rotate = -4}}});
  series.steps.push_back({{{"hole_b"}, {.rotate = -6, .translate = Vec2(0.02, 0.01)}}});
  series.steps.push_back({{{"hole_a", "hole_b"}, {.rotate = 3}}});
  series.steps.push_back({{{"hole_a"}, {.rotate = 8}}, {{"hole_b"}, {.rotate = -5}}});
  check_equal(series, state);
}

TEST_CASE("full turns of a body wind the mesh up as in a single run") {
  const MeshState state = make_state(make_mesh(annulus(24, 14, 1.4, Cells::triangles)));
  Series series = series_of({});
  for (const double degrees : {360.0, 60.0, 120.0, 0.0, 180.0, -180.0})
    series.steps.push_back({{{"inner"}, {.rotate = degrees}}});
  const auto results = check_equal(series, state, 1e-10 * 222);
  CHECK(results[4].begins == 2u);
  CHECK_FALSE(results[0].begins);
  CHECK_FALSE(results[5].begins);
  CHECK(difference(results[4].run->state, results[5].run->state) > 1);
  CHECK(difference(results[0].run->state, results[3].run->state) > 1);
}

TEST_CASE("steps with slivers, of which there may be several solutions, are those of single runs") {
  const MeshState state = plane_state();
  Series series = series_of({});
  for (const double degrees : {80.0, 160.0, 240.0, 280.0})
    series.steps.push_back(turned(state, degrees));
  const auto results = check_equal(series, state);
  CHECK_FALSE(results[0].begins);
  CHECK_FALSE(results[3].begins);
}

TEST_CASE("a step that fails says why and does not end the others") {
  const MeshState state = plane_state();
  const Series series = series_of({turned(state, 0, Vec2(0.05, 0)), turned(state, 0, Vec2(0.9, 0)),
                                   turned(state, 0, Vec2(0.1, 0)), turned(state, 0, Vec2(1.2, 0))});
  const auto results = results_of(series, state);
  CHECK(results[0].status == SeriesStatus::done);
  CHECK(results[2].status == SeriesStatus::done);
  for (const std::size_t blocked : {1u, 3u}) {
    CHECK(results[blocked].status == SeriesStatus::incomplete);
    CHECK(results[blocked].message.find("hole would touch outer at") == 0);
    CHECK(results[blocked].message == why_incomplete(single(series, blocked, state).smooth));
    CHECK_FALSE(results[blocked].begins);
  }
}

TEST_CASE("a step behind an obstacle fails as its single run does") {
  const MeshState state = two_bodies();
  const auto shifted = [](double x, double y) {
    return std::vector<MovingBody>{{{"hole_a"}, {.translate = Vec2(x, y)}}};
  };
  // Past hole_b there is a way for single steps only.
  const Series series = series_of({shifted(0.1, 0), shifted(0.25, 0), shifted(0.05, 0.05)});
  const auto results = results_of(series, state);
  CHECK(results[0].status == SeriesStatus::done);
  CHECK(results[1].status == SeriesStatus::incomplete);
  CHECK(results[1].message == why_incomplete(single(series, 1, state).smooth));
  CHECK(results[2].status == SeriesStatus::done);
}

TEST_CASE("steps begin from the mesh as given where their results might depend on the beginning") {
  const MeshState state = plane_state();
  Series series = series_of({turned(state, 3), turned(state, 6)});
  CHECK(starts_at_neighbours(series, state));
  Series limited = series;
  limited.how.floor.set(Metric::normalized_jacobian, 0.1);
  Series direct = series;
  direct.how.increments = 1;
  Series regular = series;
  regular.smooth.targets = TargetBlend::regular();
  Series raised = series;
  raised.smooth.raise_worst = true;
  Series pointwise = series;
  pointwise.smooth.formulation = Formulation::pointwise;
  for (const Series& other : {limited, direct, regular, raised, pointwise}) {
    CHECK_FALSE(starts_at_neighbours(other, state));
    for (const SeriesResult& result : results_of(other, state)) {
      CHECK_FALSE(result.begins);
      CHECK(difference(result.run->state, single(other, result.step, state).state) < 1e-9);
    }
  }
}

TEST_CASE("a boundary that slides is the same as in single runs") {
  const MeshState state = plane_state();
  Series series = series_of({});
  for (const double degrees : {4.0, 8.0, 12.0, 16.0})
    series.steps.push_back(turned(state, degrees, Vec2(0.002 * degrees, 0)));
  series.smooth.slide.markers = {"outer"};
  CHECK(began_at_neighbours(check_equal(series, state)) == 3);
}

TEST_CASE("the reference mesh of a series is that of the state") {
  MeshState state = plane_state();
  MoveCommand move;
  move.bodies = turned(state, 20);
  state = execute(move, state).state;  // keeps the mesh before as its reference
  Series series = series_of({turned(state, -20), turned(state, -10), turned(state, -15)});
  const auto results = check_equal(series, state);
  CHECK(difference(results[0].run->state, plane_state()) < 1e-9);
  CHECK(results[0].run->state.reference == state.reference);
}

TEST_CASE("a series of a mesh far from the origin is that of the mesh near to it") {
  const MeshState near = plane_state();
  MeshState far = near;
  const Vec2 origin(4e5, 5e6);
  for (Index node = 0; node < far.mesh.coordinates.size(); ++node)
    far.mesh.coordinates.set_xy(node, near.mesh.coordinates.xy(node) + origin);
  const auto turn = [](const Vec2& pivot, double degrees) {
    return std::vector<MovingBody>{{{"hole"}, {.rotate = degrees, .pivot = pivot}}};
  };
  Series here = series_of({}), there = here;
  for (const double degrees : {5.0, 10.0, 15.0}) {
    here.steps.push_back(turn(Vec2(0.5, 0.4), degrees));
    there.steps.push_back(turn(Vec2(0.5, 0.4) + origin, degrees));
  }
  const auto one = results_of(here, near), other = results_of(there, far);
  CHECK(began_at_neighbours(other) == 2);
  for (std::size_t i = 0; i < one.size(); ++i)
    for (Index node = 0; node < near.mesh.coordinates.size(); ++node)
      CHECK((one[i].run->state.mesh.coordinates.xy(node) + origin -
             other[i].run->state.mesh.coordinates.xy(node))
                .norm() < 1e-8);
}

TEST_CASE("what is no motion of the mesh is refused before anything is solved") {
  const MeshState state = plane_state();
  Series series = series_of({turned(state, 5), {{{"nowhere"}, {.rotate = 3}}}});
  bool solved = false;
  const auto run = [&] { run_series(series, state, [&](const SeriesResult&) { solved = true; }); };
  CHECK_THROWS_WITH_AS(run(), doctest::Contains("step 2: "), UsageError);
  series.steps.clear();
  CHECK_THROWS_AS(run(), UsageError);
  series.steps.push_back(turned(state, 5));
  series.smooth.tolerance = -1;
  CHECK_THROWS_AS(run(), UsageError);
  CHECK_FALSE(solved);
}

TEST_CASE("a series that is cancelled ends, and so does one whose results cannot be taken") {
  class Monitor final : public SeriesMonitor {
   public:
    bool on_iteration(std::size_t step, const IterationRecord&, const Coordinates&) override {
      return step != 1;
    }
    void on_result(const SeriesResult&) override { ++results; }
    std::atomic<int> results = 0;
  };
  const MeshState state = plane_state();
  for (const int jobs : {1, 2}) {
    Series series = series_of({turned(state, 5), turned(state, 10), turned(state, 15)});
    series.jobs = jobs;
    Monitor monitor;
    CHECK_THROWS_AS(run_series(series, state, monitor), Cancelled);
    CHECK(monitor.results <= 1);
    CHECK_THROWS_AS(
        run_series(series, state, [](const SeriesResult&) { throw OutputError("no space left"); }),
        OutputError);
  }
}
