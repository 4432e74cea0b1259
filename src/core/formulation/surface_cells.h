#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/simplex_kernel.h"
#include "core/linear/sparse_system.h"
#include "core/problem/node_unknowns.h"

/// Maps the triangles of a surface mesh into the plane, for the loops over plane triangles.
namespace winslow {

/// Memory for the sums of an assembly, kept for the next one: allocating it takes about as long as
/// computing the sums.
class KeptMemory {
 public:
  explicit KeptMemory(std::size_t numbers) : numbers_(numbers) {}

  /// Not initialised.
  std::unique_ptr<double[]> borrow();
  /// Of the memory while it is kept.
  std::size_t bytes() const { return kept_ ? numbers_ * sizeof(double) : 0; }
  void give_back(std::unique_ptr<double[]> memory);

 private:
  std::size_t numbers_;
  std::mutex mutex_;
  std::unique_ptr<double[]> kept_;
};

/// Data that depend only on the connectivity and the moving nodes.
struct SurfaceStructure {
  SurfaceStructure(const NodeUnknowns& nodes, const std::vector<std::array<Index, 3>>& cells);

  std::size_t bytes() const {
    return bytes_of(pattern) +
           bytes_of(cells, element, row_of_node, corners, entries, loose, numbers) +
           (memory ? memory->bytes() : 0);
  }

  std::vector<std::array<Index, 3>> cells;  ///< nodes
  std::vector<Index> element;               ///< element of each cell
  std::vector<Index> row_of_node;           ///< -1 for nodes without unknowns
  CompressedRows corners;                   ///< for each row: 3 * cell + corner, ascending
  std::shared_ptr<const SparsityPattern> pattern;
  /// For each corner (3 * cell + corner) and each node of the cell: the index of that node's entry
  /// in the row of the corner; -1 if there is none.
  std::vector<std::array<Index, 3>> entries;
  /// Rows of parts of the surface without a fixed node, e.g. a sphere, which may rotate as a whole.
  std::vector<bool> loose;
  std::vector<Index> numbers;          ///< 0, 1, ...: three for each cell, one per corner
  std::shared_ptr<KeptMemory> memory;  ///< for the sums of all cells: see SurfaceWinslow::CellSums
};

/// The plane into which a triangle is mapped: two directions and the normal.
struct CellPlane {
  Vec3 e1{1, 0, 0}, e2{0, 1, 0}, normal{0, 0, 1};

  Vec2 of(const Vec3& v) const { return {e1.dot(v), e2.dot(v)}; }
};

/// The plane of a triangle with these edges from its first corner, on the side of a reference
/// normal.
CellPlane own_plane(const Vec3& u, const Vec3& v, const Vec3& reference);
/// Twice the area of the triangle projected to a plane: negative if it is inverted there.
double determinant_in(const CellPlane& plane, const Vec3& u, const Vec3& v);

/// All cells of a mesh mapped into planes.
struct FlatCells {
  /// Each in its own plane, on the side of the reference normal (#elements) of its element.
  static FlatCells in_own_planes(const SurfaceStructure& structure, const Coordinates& x,
                                 std::span<const Vec3> normals, int threads);
  /// Each projected along the reference normal of its element.
  static FlatCells against(const SurfaceStructure& structure, const Coordinates& x,
                           std::span<const Vec3> normals, int threads);

  double determinant(std::size_t cell) const;

  std::vector<double> x;  ///< for each cell 3 points of the plane, the first at the origin
  std::vector<CellPlane> planes;
};

}  // namespace winslow
