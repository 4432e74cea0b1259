#include "io/tables/file_defaults.h"

#include "io/su2/su2.h"
#include "io/support/files.h"
#include "io/tables/slide_files.h"
#include "support/paths.h"
#include "support/periodic_meshes.h"

namespace winslow::test {
namespace {

using Names = std::vector<std::string>;

MoveCommand move_of(const Names& markers) {
  MoveCommand move;
  move.bodies[0].markers = markers;
  move.bodies[0].motion.translate = {0.05, 0, 0};
  return move;
}

}  // namespace

TEST_CASE("what a file says of its boundary becomes options, unless markers are held or taken") {
  const io::MeshFile file = io::read_mesh(test_data("openfoam/cyclic"));
  Command command = move_of({"bafM", "bafS"});
  const std::string said = io::add_file_defaults(command, file);
  CHECK(said ==
        "As the file says, top (symmetryPlane) slides, cycA and cycB move together; --fixed NAME "
        "holds a marker");
  CHECK(smooth_options(command)->slide.markers == Names{"top"});
  CHECK(smooth_options(command)->slide.periodic_from_file);
  SUBCASE("fixed") {
    MoveCommand held = move_of({"bafM", "bafS"});
    held.smooth.slide.fixed = {"top", "cycB"};
    command = held;
    CHECK(io::add_file_defaults(command, file).empty());
    CHECK(smooth_options(command)->slide == held.smooth.slide);
  }
  SUBCASE("sliding already, and moving") {
    MoveCommand move = move_of({"top"});
    command = move;
    CHECK_CONTAINS(io::add_file_defaults(command, file), "As the file says, cycA and cycB");
    CHECK(smooth_options(command)->slide.markers.empty());
  }
  SUBCASE("equations that know no boundary") {
    MoveCommand move = move_of({"bafM"});
    move.smooth.formulation = Formulation::pointwise;
    command = move;
    CHECK(io::add_file_defaults(command, file).empty());
  }
  SUBCASE("a pair that cannot be used") {
    io::MeshFile faulty = file;
    auto details = std::make_shared<io::FormatDetails>();
    details->roles = file.details->roles;
    details->periodic = std::make_shared<GivenPeriodicity>(*file.details->periodic);
    details->periodic->pairs[0].fault = "boundary:9: no match";
    faulty.details = details;
    command = move_of({"bafM"});
    CHECK_CONTAINS(io::add_file_defaults(command, faulty),
                   "cycA and cycB stay: boundary:9: no match");
    CHECK_FALSE(smooth_options(command)->slide.periodic_from_file);
    CHECK(smooth_options(command)->slide.fixed == Names{"cycA", "cycB"});
  }
}

TEST_CASE("names of groups become those of their markers, but for a marker of that name") {
  const io::MeshFile file = io::read_mesh(test_data("openfoam/cyclic"));
  MoveCommand move = move_of({"b", "bafM"});
  move.smooth.slide.fixed = {"wall", "inlet"};
  Command command = move;
  io::expand_groups(command, file.details->roles, *file.mesh.topology);
  CHECK(std::get<MoveCommand>(command).bodies[0].markers == Names{"bafM", "bafS", "bafM"});
  CHECK(smooth_options(command)->slide.fixed == Names{"walls.low", "bafM", "bafS", "inlet"});
  io::MarkerRoles roles;
  roles.groups["inlet"] = {"top"};
  command = move_of({"inlet"});
  io::expand_groups(command, roles, *file.mesh.topology);
  CHECK(std::get<MoveCommand>(command).bodies[0].markers == Names{"inlet"});
}

TEST_CASE("a name with a * stands for all markers that it matches") {
  const io::MeshFile file = io::read_mesh(test_data("openfoam/cyclic"));
  const auto expanded = [&](const Names& names) {
    const std::vector<Command> commands =
        io::with_names_expanded({move_of(names)}, file.details.get(), *file.mesh.topology);
    return std::get<MoveCommand>(commands[0]).bodies[0].markers;
  };
  Names all;
  for (const Marker& marker : file.mesh.topology->markers()) all.push_back(marker.name);
  CHECK(expanded({"*"}) == all);
  CHECK(expanded({".*"}) == all);
  CHECK(expanded({"cyc*"}) == Names{"cycA", "cycB"});
  CHECK(expanded({"cyc.*", "baf*", "bafM"}) == Names{"cycA", "cycB", "bafM", "bafS", "bafM"});
  CHECK(expanded({"*A"}) == Names{"cycA"});
  CHECK(expanded({"c*c*B", "w*l*.*l*w"}) == Names{"cycB", "walls.low"});
  CHECK(expanded({"cycAA*", "x*", "b"}) == Names{"cycAA*", "x*", "bafM", "bafS"});
}

TEST_CASE("a body that ends on a cyclic patch takes the images of its nodes along") {
  const io::MeshFile file = io::read_mesh(test_data("openfoam/cyclic"));
  Command command = move_of({"bafM", "bafS"});
  io::add_file_defaults(command, file);
  const MeshState state = make_state(file.mesh);
  const MeshState moved = execute(io::resolve_files(command, file.details.get()), state).state;
  const GivenPairs& sides = file.details->periodic->pairs[0];
  int apart = 0;
  for (const auto& [node, image] : sides.pairs) {
    const Vec3 way = moved.mesh.coordinates.xyz(node) - state.mesh.coordinates.xyz(node);
    const Vec3 other = moved.mesh.coordinates.xyz(image) - state.mesh.coordinates.xyz(image);
    CHECK((way - other).norm() < 1e-13);
    apart += way.norm() > 0.04 ? 1 : 0;
  }
  CHECK(apart >= 3);
}

TEST_CASE("SU2: a configuration file names planes of symmetry and periodic sides") {
  const TemporaryFolder folder;
  write_text(
      folder / "a.cfg",
      "% MARKER_SYM= ( commented )\nSOLVER= RANS\nMARKER_SYM= ( sym, mid ) % two\n"
      "MARKER_PERIODIC= ( left, right, 0,0,0, 0,0,0, \\\n  1.0,0,0 )\nMARKER_MONITORING= NONE\n");
  const io::MarkerRoles roles = io::su2::read_config(folder / "a.cfg");
  REQUIRE(roles.symmetry.size() == 2);
  CHECK(roles.symmetry[1].first == "mid");
  CHECK(roles.pairs == std::vector<std::pair<std::string, std::string>>{{"left", "right"}});
  const io::MeshFile file{
      make_mesh(square_with_periodic_sides(8)), nullptr, std::make_shared<io::FormatDetails>(), {}};
  Command command = move_of({"hole"});
  CHECK_CONTAINS(io::add_file_defaults(command, file, roles), "left and right move together");
  CHECK(smooth_options(command)->slide.periodic == Names{"left", "right"});
  write_text(folder / "b.cfg", "MARKER_SYM= ( none )\nMARKER_PERIODIC= ( left, right, 0 )\n");
  CHECK_THROWS_WITH_AS(io::su2::read_config(folder / "b.cfg"),
                       doctest::Contains("b.cfg:2: found MARKER_PERIODIC= with 3 words"),
                       InputError);
  write_text(folder / "c.cfg", "MARKER_SYM= sym\n");
  CHECK_THROWS_WITH_AS(io::su2::read_config(folder / "c.cfg"),
                       doctest::Contains("c.cfg:1: found MARKER_SYM= 'sym', expected a list"),
                       InputError);
}

}  // namespace winslow::test
