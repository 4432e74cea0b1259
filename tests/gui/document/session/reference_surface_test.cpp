#include <doctest/doctest.h>

#include "gui/support/surface_rig.h"
#include "io/format/mesh_file.h"

/// Surfaces from files, which the studio's solver has to read.
namespace winslow::gui::test {
namespace {

SmoothCommand smooth_on(const std::filesystem::path& file) {
  SmoothCommand command;
  command.smooth.slide.reference.name = file.string();
  return command;
}

}  // namespace

TEST_CASE("A command that names a reference surface has it read, and the mesh is put on it") {
  SurfaceRig rig;
  // The ball, larger by a tenth.
  Mesh fine = make_mesh(winslow::test::octasphere(12));
  for (double& value : fine.coordinates.values()) value *= 1.1;
  const std::filesystem::path file = rig.folder / "fine.obj";
  io::write_mesh(file, fine, nullptr);
  rig.bench->apply(action::RunCommand{smooth_on(file), false});
  REQUIRE(rig.wait([&] { return !rig.session().job().active(); }));
  REQUIRE(rig.document().history().position() == 1);
  const SpacePoints x(rig.mesh().coordinates);
  for (Index node = 0; node < rig.mesh().coordinates.size(); ++node)
    CHECK(x[node].norm() == doctest::Approx(1.1).epsilon(1e-9));
}

TEST_CASE("A reference surface that cannot be read ends the command with its name") {
  SurfaceRig rig;
  rig.bench->apply(action::RunCommand{smooth_on(rig.folder / "none.stl"), false});
  REQUIRE(rig.wait([&] { return !rig.session().job().active(); }));
  rig.frames();
  CHECK(rig.document().history().position() == 0);
  const MessageBoard& messages = rig.session().messages();
  std::string told;
  if (messages.banner()) told += messages.banner()->text;
  if (messages.notice()) told += messages.notice()->text;
  if (messages.prompt()) told += messages.prompt()->text;
  CHECK(told.find("none.stl") != std::string::npos);
}

}  // namespace winslow::gui::test
