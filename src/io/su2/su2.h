#pragma once

#include "core/mesh/element_type.h"
#include "core/mesh/mesh.h"
#include "io/format/mesh_format.h"

/// SU2 native format, https://su2code.github.io/docs_v7/Mesh-File/, of two and of three
/// dimensions; and, what SU2 itself has no use for, surfaces: NDIME= 3 with triangles,
/// quadrilaterals and markers of lines.
namespace winslow::io::su2 {

/// A node that a free-form deformation box lists, and where it lay in the file.
struct BoxPoint {
  Index node;
  Vec3 place;  ///< z is 0 in the plane
};

/// What an SU2 file says beyond a mesh: the order of its sections, comments, what we do not know,
/// and its other zones.
struct Details : FormatDetails {
  enum class Part { text, dimension, elements, points, marker_count, marker };
  struct Item {
    Part part;
    std::string text;  ///< Part::text: bytes as they are. Part::points: what follows the count.
  };
  std::vector<Item> items;
  int dimension = 2;            ///< NDIME=
  std::string line_end = "\n";  ///< or "\r\n", as in the source
  bool element_numbers = false;
  bool point_numbers = false;
  bool face_numbers = false;
  /// What follows the coordinates in the line of each point, where that is more than the
  /// point's number (a third coordinate of a plane mesh, two numbers); else empty.
  std::vector<std::string> point_tails;
  int raw_markers = 0;      ///< markers kept as text (SEND_RECEIVE)
  std::size_t markers = 0;  ///< of the mesh that was read
  /// Of a file of several zones: what stands before the first one, then each zone as it is.
  std::shared_ptr<const std::vector<std::string>> blocks;
  std::size_t block = 0;             ///< the zone's place in `blocks`
  std::vector<BoxPoint> box_points;  ///< of boxes anywhere in the file
};

extern const MeshFormat format;

/// zone: as IZONE= says; 0: the first one. Throws UsageError if the file has no such zone.
ParsedMesh read_zone(Source& source, int zone);

/// Points are written as they were read. What follows their coordinates goes back as it came; only
/// numbers that count from 0 are written anew. A plane mesh has NDIME= 2, unless it came from an
/// SU2 file with NDIME= 3. Of a file of several zones, that of the details becomes a file of its
/// own. source: details of the file that the mesh came from, of this format or of another; may be
/// null.
std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                               const WriteOptions& options);
/// Zones of one file; those that are not among them are written as they were.
std::vector<std::string> write_zones(std::ostream& out, std::span<const MeshZone> zones,
                                     const WriteOptions& options);

/// Of a zone: 2 and 2 of a plane mesh, 3 and 3 of a volume mesh, space 3 and cells 2 of a surface
/// mesh.
struct Dimensions {
  int space = 2;  ///< NDIME=
  int cells = 2;  ///< of the elements
};

/// The element that a number of SU2 (which are VTK's) stands for: triangles and quadrilaterals of
/// dimension 2, tetrahedra (10), hexahedra (12), prisms (13) and pyramids (14) of dimension 3.
std::optional<ElementType> element_of(std::int64_t number, int dimension);
std::int64_t element_number(ElementType type);
/// Number of the element that a face of a mesh is: 3 (line), 5 (triangle) or 9 (quadrilateral).
std::int64_t face_number(std::size_t corners);
/// Number of corners of such a face of elements of that dimension; 0: it cannot be one.
std::size_t face_corners(std::int64_t number, int dimension);

/// "5 (triangle) or 9 (quadrilateral)": what elements of that dimension, from 1 on, are.
std::string element_list(int dimension);
/// " (second order)" and the like: why an element type is none of the elements, or of the elements
/// of markers, of a mesh of those dimensions; may be empty.
std::string type_hint(std::int64_t number, const Dimensions& of, bool of_marker);

}  // namespace winslow::io::su2
