#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/simplex_kernel.h"
#include "core/linear/sparse_system.h"
#include "core/problem/node_unknowns.h"

/// The triangles of a surface mesh laid flat, for the loops over triangles of the plane.
namespace winslow {

/// Memory for what an assembly sums up, kept from one to the next: to get it anew takes about as
/// long as the sums.
class KeptMemory {
 public:
  explicit KeptMemory(std::size_t numbers) : numbers_(numbers) {}

  /// Not initialised.
  std::unique_ptr<double[]> borrow();
  void give_back(std::unique_ptr<double[]> memory);

 private:
  std::size_t numbers_;
  std::mutex mutex_;
  std::unique_ptr<double[]> kept_;
};

/// What depends on the connectivity alone, and on which nodes move.
struct SurfaceStructure {
  SurfaceStructure(const NodeUnknowns& nodes, const std::vector<std::array<Index, 3>>& cells);

  std::vector<std::array<Index, 3>> cells;  ///< nodes
  std::vector<Index> element;               ///< that each cell is of
  std::vector<Index> row_of_node;           ///< -1 for nodes without unknowns
  CompressedRows corners;                   ///< of each row: 3 * cell + corner, ascending
  std::shared_ptr<const SparsityPattern> pattern;
  /// Of each corner (3 * cell + corner) and each of the cell's nodes, where the row of the corner
  /// has its entry for that node; -1 where there is none.
  std::vector<std::array<Index, 3>> entries;
  /// Rows of parts of the surface no node of which is held: of a sphere, say, which may turn as a
  /// whole.
  std::vector<bool> loose;
  std::vector<Index> numbers;          ///< 0, 1, ...: all cells; three for each, its corners
  std::shared_ptr<KeptMemory> memory;  ///< for the sums of all cells: see SurfaceWinslow::CellSums
};

/// Two directions of the plane that a triangle is laid into, and the normal.
struct CellPlane {
  Vec3 e1{1, 0, 0}, e2{0, 1, 0}, normal{0, 0, 1};

  Vec2 of(const Vec3& v) const { return {e1.dot(v), e2.dot(v)}; }
};

/// The plane of a triangle with these edges from its first corner, on the side of a reference
/// normal.
CellPlane own_plane(const Vec3& u, const Vec3& v, const Vec3& reference);
/// Twice the area of the triangle, as it lies in a plane: negative if it shows the other side.
double determinant_in(const CellPlane& plane, const Vec3& u, const Vec3& v);

/// All cells of a mesh laid flat.
struct FlatCells {
  /// Each into its own plane, on the side of the reference normal (#elements) of its element.
  static FlatCells in_own_planes(const SurfaceStructure& structure, const Coordinates& x,
                                 std::span<const Vec3> normals, int threads);
  /// Each seen against the reference normal of its element.
  static FlatCells against(const SurfaceStructure& structure, const Coordinates& x,
                           std::span<const Vec3> normals, int threads);

  double determinant(std::size_t cell) const;

  std::vector<double> x;  ///< of each cell 3 points of the plane, the first at the origin
  std::vector<CellPlane> planes;
};

}  // namespace winslow
