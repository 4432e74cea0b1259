#pragma once

#include <string>
#include <vector>

#include "core/motion/rigid_motion.h"
#include "elasticity/linear_elasticity.h"

/// Reads and carries out what the command lines of volume_elasticity_bench and elastic_move say:
///
///     ElasticityCase wanted = read_case(arguments, "usage: elastic_move MESH --marker NAME ...");
///     Mesh mesh = io::read_mesh(wanted.mesh).mesh;
///     const ElasticityResult result = move_elastically(wanted, mesh);
namespace winslow::bench {

/// Markers of a mesh that move together as a rigid body, and the solid that the mesh is.
struct ElasticityCase {
  std::string mesh;                  ///< name of its file
  std::vector<std::string> markers;  ///< of the body
  RigidMotion motion;                ///< see for_mesh()
  ElasticityOptions elasticity{.modulus = Modulus::volume, .increments = 50};
  std::string output;  ///< name of the file of the moved mesh; empty: none
};

/// The arguments of a command line without the program's name:
///
///     MESH --marker NAME... [--rotate DEG] [--axis X Y Z] [--pivot X Y [Z]] [--translate X Y [Z]]
///     [--increments N] [--modulus volume|distance] [--tolerance RELATIVE_RESIDUAL] [-o OUT]
///
/// Throws UsageError, with `usage` where the mesh or the marker is missing.
ElasticityCase read_case(const std::vector<std::string>& arguments, const std::string& usage);

/// The case's motion for a mesh: about the origin unless a pivot was given, in space about the z
/// axis unless another was given.
RigidMotion for_mesh(const ElasticityCase& wanted, const Mesh& mesh);

struct ElasticityResult {
  int linear_iterations = 0;  ///< of the iterative solver, in space
  /// Why it ended before the last increment; empty: it did not. The mesh is then as it was left.
  std::string fault;
};

/// Moves the mesh (plane, or of tetrahedra) in increments; see deform_in_increments(). Throws
/// UsageError for other meshes and for motions that do not fit the mesh.
ElasticityResult move_elastically(const ElasticityCase& wanted, Mesh& mesh);

}  // namespace winslow::bench
