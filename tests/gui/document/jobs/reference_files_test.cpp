#include "gui/document/jobs/reference_files.h"

#include <doctest/doctest.h>

#include <chrono>
#include <fstream>

#include "core/error.h"
#include "gui/support/space_rig.h"
#include "io/format/mesh_file.h"

namespace winslow::gui::test {
namespace {

namespace fs = std::filesystem;

void write_tetrahedron(const fs::path& file, int height) {
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 " << height
                      << "\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
}

void write_sphere(const fs::path& file, double radius) {
  Mesh ball = make_mesh(winslow::test::octasphere(12));
  for (double& value : ball.coordinates.values()) value *= radius;
  io::write_mesh(file, ball, nullptr);
}

}  // namespace

TEST_CASE("a reference surface is read once, and again when its file has changed") {
  const TemporaryFolder folder;
  const fs::path file = folder / "surface.obj";
  ReferenceFiles files;
  CHECK_THROWS_AS(files.read(file), InputError);
  write_tetrahedron(file, 1);
  const auto first = files.read(file);
  CHECK(first->points[3].z() == 1);
  CHECK(files.read(file) == first);
  // Of the same size, with another time.
  write_tetrahedron(file, 2);
  fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(2));
  const auto second = files.read(file);
  CHECK(second != first);
  CHECK(second->points[3].z() == 2);
  // Of the same time, with another size.
  const auto time = fs::last_write_time(file);
  write_tetrahedron(file, 10);
  fs::last_write_time(file, time);
  CHECK(files.read(file)->points[3].z() == 10);
  // Another file in its place, of the same size and time.
  write_tetrahedron(folder / "other.obj", 20);
  fs::last_write_time(folder / "other.obj", time);
  fs::rename(folder / "other.obj", file);
  CHECK(files.read(file)->points[3].z() == 20);
  fs::remove(file);
  CHECK_THROWS_AS(files.read(file), InputError);
}

TEST_CASE("a command that is run again slides on its reference surface as it is then") {
  SurfaceRig rig;
  const fs::path file = rig.folder / "fine.obj";
  const auto smooth = [&](double radius) {
    write_sphere(file, radius);
    SmoothCommand command;
    command.smooth.slide.reference = file.string();
    rig.bench->apply(action::RunCommand{command, false});
    REQUIRE(rig.settle());
    const SpacePoints x(rig.mesh().coordinates);
    for (Index node = 0; node < rig.mesh().coordinates.size(); ++node)
      REQUIRE(x[node].norm() == doctest::Approx(radius).epsilon(1e-9));
  };
  smooth(1.1);
  // The mesh stays on the shape that it was given by then: that is not what is in the file now.
  smooth(1.25);
  CHECK(rig.document().history().position() == 2);
}

/// Surfaces from files, which the studio's solver has to read.
namespace {

SmoothCommand smooth_on(const std::filesystem::path& file) {
  SmoothCommand command;
  command.smooth.slide.reference = file.string();
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
