#pragma once

#include <filesystem>

#include "core/mesh/mesh.h"

namespace winslow::gui::test {

/// Triangles between an ellipse (half axes 0.5 and 0.15; marker "flap") and a circle of radius 3
/// (marker "farfield"): `around` points by `layers` + 1 rings.
Mesh ring_mesh(Index around = 24, Index layers = 6);

/// Quadrilaterals of side 0.5 in a box of 8 by 4 around the origin with two square holes of side 1
/// at (-2, 0) and (2, 0): markers "left", "right" and "outer". fine: sides are as many times
/// shorter.
Mesh two_body_mesh(Index fine = 1);

/// A triangle of the ring turned inside out by moving one interior node across it.
Mesh tangled_mesh();

/// A folder of its own for one test, removed with what is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes a mesh as SU2 and returns where.
std::filesystem::path write(const TemporaryFolder& folder, const Mesh& mesh,
                            const std::string& name = "mesh.su2");

}  // namespace winslow::gui::test
