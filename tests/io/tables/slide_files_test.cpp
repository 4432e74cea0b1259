#include "io/tables/slide_files.h"

#include "core/error.h"
#include "io/support/files.h"
#include "support/surface_meshes.h"

namespace winslow::test {
namespace {

constexpr const char* tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

SmoothCommand smooth_on(const std::filesystem::path& file) {
  SmoothCommand command;
  command.smooth.slide.reference = file.string();
  return command;
}

SmoothCommand smooth_with_file_pairs() {
  SmoothCommand command;
  command.smooth.slide.periodic_from_file = true;
  return command;
}

/// What a file says that names one pair, or none.
io::FormatDetails details_with(std::size_t pairs) {
  auto periodic = std::make_shared<GivenPeriodicity>();
  periodic->source = "passage.msh";
  periodic->pairs.resize(pairs);
  io::FormatDetails details;
  details.periodic = periodic;
  return details;
}

}  // namespace

TEST_CASE("a command gets the reference surface that it names and the pairs of the mesh's file") {
  const TemporaryFolder folder;
  write_text(folder / "surface.obj", tetrahedron);
  const io::FormatDetails details = details_with(1);
  const SlideFiles pairs = io::resolve_files(smooth_with_file_pairs(), &details).files();
  CHECK_FALSE(pairs.reference);
  CHECK(pairs.periodic == details.periodic);

  const ResolvedCommand on_surface = io::resolve_files(smooth_on(folder / "surface.obj"), &details);
  const SlideFiles& files = on_surface.files();
  REQUIRE(files.reference);
  CHECK(files.reference->source == "surface.obj");
  CHECK(files.reference->points.size() == 4);
  CHECK(files.reference->faces.size() == 4);
  CHECK_FALSE(files.periodic);  // they are not asked for
  CHECK(smooth_options(on_surface.command())->slide.reference == (folder / "surface.obj").string());

  const SlideFiles none = io::resolve_files(SmoothCommand{}, &details).files();
  CHECK_FALSE(none.reference);
  CHECK_FALSE(none.periodic);
  CHECK_FALSE(io::resolve_files(ScrambleCommand{}, &details).files().periodic);
}

TEST_CASE("who keeps surfaces is asked for them") {
  auto kept = std::make_shared<const ReferenceSurface>();
  std::filesystem::path asked;
  const auto reader = [&](const std::filesystem::path& file) {
    asked = file;
    return kept;
  };
  CHECK(io::resolve_files(smooth_on("cad.stl"), nullptr, reader).files().reference == kept);
  CHECK(asked == "cad.stl");
}

TEST_CASE("no command comes of a request whose file is missing, or wrong") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(io::resolve_files(smooth_on(folder / "none.obj"), nullptr),
                       doctest::Contains("none.obj"), InputError);
  write_text(folder / "wrong.obj", "v 0 0 0\nv 1 0\n");
  CHECK_THROWS_WITH_AS(io::resolve_files(smooth_on(folder / "wrong.obj"), nullptr),
                       doctest::Contains("wrong.obj:2"), InputError);
  CHECK_THROWS_WITH_AS(io::resolve_files(smooth_with_file_pairs(), nullptr),
                       "slide.periodic_from_file: the file of the mesh was not read", UsageError);
}

TEST_CASE(
    "a command that asks for nothing runs as it is, one that does only with what it asks for") {
  const MeshState state = make_state(make_mesh(octasphere(4)));
  CHECK(execute(SmoothCommand{}, state).smooth.converged);
  CHECK_THROWS_WITH_AS(execute(smooth_on("cad.stl"), state),
                       "cad.stl: this reference surface was not read", UsageError);
  CHECK_THROWS_WITH_AS(execute(smooth_with_file_pairs(), state),
                       "slide.periodic_from_file: the file of the mesh was not read", UsageError);

  const io::FormatDetails without = details_with(0);
  const ResolvedCommand empty = io::resolve_files(smooth_with_file_pairs(), &without);
  CHECK_THROWS_WITH_AS(
      execute(empty, make_state(make_mesh(square(4, Cells::triangles)))),
      doctest::Contains("passage.msh: found no periodic pairs in the file, expected $Periodic"),
      UsageError);
  CHECK_THROWS_WITH_AS(execute(empty, state), doctest::Contains("not for a surface mesh"),
                       UsageError);

  // A surface of one's own, from no file: under any name, but under one.
  const MeshData larger = octasphere(12);
  auto own = std::make_shared<ReferenceSurface>();
  for (Index i = 0; i < larger.node_count(); ++i)
    own->points.emplace_back(1.1 * larger.coordinates.xyz(i));
  for (Index e = 0; e < larger.element_count(); ++e) own->faces.emplace_back(larger.element(e));
  const ResolvedCommand on_own(smooth_on("own"), {.reference = own});
  const Coordinates x = execute(on_own, state).state.mesh.coordinates;
  for (Index i = 0; i < x.size(); ++i) CHECK(x.xyz(i).norm() == doctest::Approx(1.1));
  CHECK_THROWS_WITH_AS(ResolvedCommand(SmoothCommand{}, {.reference = own}),
                       doctest::Contains("expected a name in slide.reference"), UsageError);
}

}  // namespace winslow::test
