#pragma once

#include "core/mesh/topology.h"

/// Faces and cells as finite volume solvers see them, and OpenFOAM's measures of their quality:
///
///     const winslow::CellFaces faces = winslow::cell_faces(*mesh.topology);
///     const winslow::FiniteVolumes cells(faces, mesh.coordinates);
///     std::printf("%g degrees\n", cells.non_orthogonality(0));
namespace winslow {

/// The faces of the cells of a volume mesh. A face may have any number of nodes, and a cell any
/// number of faces.
struct CellFaces {
  CompressedRows nodes;          ///< #faces: counter-clockwise seen from outside the owner
  std::vector<Index> owner;      ///< #faces
  std::vector<Index> neighbour;  ///< #faces: the cell beyond; -1 on the boundary
  /// #cells: the faces of a cell, first those that it owns, then the others, both ascending.
  CompressedRows of_cell;

  Index face_count() const { return static_cast<Index>(owner.size()); }
  Index cell_count() const { return of_cell.rows(); }
  bool internal(Index face) const { return neighbour[at(face)] >= 0; }
};

/// The faces of given cells. The arguments are as the members of CellFaces.
CellFaces make_cell_faces(CompressedRows nodes, std::vector<Index> owner,
                          std::vector<Index> neighbour, Index cell_count);

/// The faces of a volume mesh, in the order of Topology::face(). Throws UsageError for another
/// mesh.
CellFaces cell_faces(const Topology& topology);

/// All that the measures of one cell depend on.
struct CellSurroundings {
  CellFaces faces;  ///< of the cell, of its neighbours, and one cell for all others
  Index cell;       ///< number of the cell among them
};
/// The measures of that cell are the same as in cell_faces(), bit for bit.
CellSurroundings cell_surroundings(const Topology& topology, Index element);

/// Centre and area vector of a face; the triangles about the mean of its corners make both.
struct FaceGeometry {
  Vec3 centre, area;
};
/// corners: counter-clockwise seen from the side to which the area vector points.
FaceGeometry face_geometry(std::span<const Vec3> corners);

struct CellGeometry {
  Vec3 centre;
  double volume;
};
/// faces: with area vectors that point out of the cell.
CellGeometry cell_geometry(std::span<const FaceGeometry> faces);

/// Derivatives of a function of a face's geometry turned into derivatives by its corners: adds them
/// to `out` (#corners). slopes: the derivatives by the centre and by the area vector.
void add_face_slopes(std::span<const Vec3> corners, const FaceGeometry& slopes,
                     std::span<Vec3> out);
/// The same for a function of a cell's centre: adds to `out` (#faces) its derivatives by the
/// geometry of the faces. slope: the derivative by the centre.
void add_centre_slopes(std::span<const FaceGeometry> faces, const Vec3& slope,
                       std::span<FaceGeometry> out);

/// Directions in which the fields of a case vary; false for one across `empty` patches.
using SolvedDirections = std::array<bool, 3>;

/// Centres, area vectors and volumes of faces and cells, and what they say of quality.
///
/// Formulas are those of OpenFOAM v1912 (OpenCFD Ltd.): primitiveMesh, primitiveMeshTools and
/// polyMeshTools. Sums are taken in its order, so that numbers agree with those of its checkMesh,
/// even where they are round-off alone.
///
/// - A face is the fan of triangles about the mean m of its nodes. Its area vector S is the sum of
///   their area vectors, its centre F the mean of their centres, weighted by their areas.
/// - A cell is the pyramids of its faces with their apex at the mean of the face centres. Its
/// volume
///   V is the sum of theirs, its centre C the mean of their centres, weighted by volumes.
///
/// Measures that compare a cell with its neighbours have their best value for a cell without any.
/// Finite positions give no NaN, even where a face has no area or a cell no volume.
class FiniteVolumes {
 public:
  /// faces: kept by reference. x: positions in space. threads: 0 for all cores; the result does not
  /// depend on it.
  FiniteVolumes(const CellFaces& faces, const Coordinates& x, int threads = 0,
                SolvedDirections directions = {true, true, true});

  const CellFaces& faces() const { return faces_; }
  const Vec3& face_centre(Index face) const { return face_centres_[at(face)]; }
  const Vec3& area_vector(Index face) const { return areas_[at(face)]; }
  const Vec3& cell_centre(Index cell) const { return cell_centres_[at(cell)]; }
  double volume(Index cell) const { return volumes_[at(cell)]; }
  double area(Index face) const;  ///< |S|

  // Measures of faces. Those that compare two cells are for internal faces only.

  /// Cosine of the angle between S and d = C_neighbour - C_owner.
  double orthogonality(Index face) const;
  /// Distance from F to where d crosses the face, over the largest of 0.2 |d| and the reach of the
  /// face in that direction. On the boundary d is twice the way from C to the face.
  double face_skewness(Index face) const;
  /// Signed volume of the pyramid of the face and the centre of its owner, or of its neighbour.
  double owner_pyramid(Index face) const { return pyramid(face, faces_.owner[at(face)], 1); }
  double neighbour_pyramid(Index face) const {
    return pyramid(face, faces_.neighbour[at(face)], -1);
  }
  /// The smaller of the distances of the two cell centres from the face, over their sum: at most
  /// 0.5.
  double face_weight(Index face) const;
  /// The smaller of the two volumes over the larger.
  double face_volume_ratio(Index face) const;
  /// |S| over the sum of the areas of the triangles about F: 1 for a plane face.
  double flatness(Index face) const;
  /// Sine of the sharpest re-entrant corner, 0 without corners that turn by more than `angle`
  /// (radians).
  double concavity(Index face, double angle) const;
  /// How many of the divisions of the face into tetrahedra have one without volume: those about F,
  /// one for each of its cells, and those from any of its nodes.
  int poor_divisions(Index face) const;

  // Measures of cells.

  /// Largest component of the sum of the outward S over that of their magnitudes: round-off unless
  /// a face is missing.
  double openness(Index cell) const;
  /// With a the sums of |S_x|, |S_y| and |S_z|: the largest of max(a) / min(a) and, unless the case
  /// is plane, (a_x + a_y + a_z) / (6 V^(2/3)).
  double aspect_ratio(Index cell) const;
  /// Determinant of the sum of s s^T over the internal faces, over 8; s is S over their mean area.
  /// 1 for a cube, 0 for a cell without internal faces or with all of them parallel to one
  /// direction.
  double determinant(Index cell) const;
  /// Whether the centre of a face lies on or outside the plane of another face.
  bool concave(Index cell) const;

  // The worst of a cell's faces.

  double non_orthogonality(Index cell) const;  ///< degrees, of internal faces
  double skewness(Index cell) const;
  double volume_ratio(Index cell) const;  ///< of internal faces
  double weight(Index cell) const;        ///< of internal faces
  /// Smallest pyramid volume times the number of faces over |V|: 1 if all pyramids are alike,
  /// negative if a face is seen from its wrong side.
  double face_pyramid(Index cell) const;

 private:
  double pyramid(Index face, Index cell, int sign) const;
  void measure_face(Index face);
  void measure_cell(Index cell);
  Vec3 node(Index face, std::size_t k) const;
  double smallest_quality(Index face, Index cell, bool owner, std::size_t base) const;
  bool divides_from_a_node(Index face) const;

  const CellFaces& faces_;
  SpacePoints x_;
  SolvedDirections directions_;
  std::vector<Vec3> face_centres_, areas_, cell_centres_;
  std::vector<double> volumes_;
};

}  // namespace winslow
