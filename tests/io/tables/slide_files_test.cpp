#include "io/tables/slide_files.h"

#include "io/support/files.h"

namespace winslow::test {
namespace {

constexpr const char* tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

SlideOptions& slide_of(Command& command) { return smooth_options(command)->slide; }

}  // namespace

TEST_CASE("a command gets the reference surface that it names and the pairs of the mesh's file") {
  const TemporaryFolder folder;
  write_text(folder / "surface.obj", tetrahedron);
  io::FormatDetails details;
  details.periodic = std::make_shared<GivenPeriodicity>();
  Command command = SmoothCommand{};
  io::resolve_files(command, &details);
  CHECK_FALSE(slide_of(command).reference.surface);
  CHECK(slide_of(command).file_pairs.found == details.periodic);

  slide_of(command).reference.name = (folder / "surface.obj").string();
  io::resolve_files(command, nullptr);
  REQUIRE(slide_of(command).reference.surface);
  CHECK(slide_of(command).reference.surface->source == "surface.obj");
  CHECK(slide_of(command).reference.surface->points.size() == 4);
  CHECK(slide_of(command).reference.surface->faces.size() == 4);
  CHECK_FALSE(slide_of(command).file_pairs.found);

  slide_of(command).reference.name.clear();
  io::resolve_files(command, nullptr);
  CHECK_FALSE(slide_of(command).reference.surface);
}

TEST_CASE("who keeps surfaces is asked for them; what cannot be read is an error") {
  auto kept = std::make_shared<const ReferenceSurface>();
  std::filesystem::path asked;
  const auto reader = [&](const std::filesystem::path& file) {
    asked = file;
    return kept;
  };
  Command command = MoveCommand{};
  slide_of(command).reference.name = "cad.stl";
  io::resolve_files(command, nullptr, reader);
  CHECK(asked == "cad.stl");
  CHECK(slide_of(command).reference.surface == kept);

  const TemporaryFolder folder;
  slide_of(command).reference.name = (folder / "none.obj").string();
  CHECK_THROWS_AS(io::resolve_files(command, nullptr), InputError);

  Command scramble = ScrambleCommand{};
  io::resolve_files(scramble, nullptr);  // it slides on nothing
}

}  // namespace winslow::test
