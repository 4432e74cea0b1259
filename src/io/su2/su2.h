#pragma once

#include "core/mesh/element_type.h"
#include "core/mesh/mesh.h"
#include "io/format/mesh_format.h"

/// SU2 native format, https://su2code.github.io/docs_v7/Mesh-File/, in two and three dimensions. As
/// an extension that SU2 itself does not use, surfaces: NDIME= 3 with triangles, quadrilaterals and
/// markers of lines.
namespace winslow::io::su2 {

/// A node that a free-form deformation box lists, and its position in the file.
struct BoxPoint {
  Index node;
  Vec3 place;  ///< z is 0 in the plane
};

/// Content of an SU2 file beyond a Mesh: the order of its sections, comments, unknown sections and
/// its other zones.
struct Details : FormatDetails {
  enum class Part { text, dimension, elements, points, marker_count, marker };
  struct Item {
    Part part;
    std::string text;  ///< Part::text: unchanged bytes. Part::points: what follows the count.
  };
  std::vector<Item> items;
  int dimension = 2;            ///< NDIME=
  std::string line_end = "\n";  ///< or "\r\n", as in the source
  bool element_numbers = false;
  bool point_numbers = false;
  bool face_numbers = false;
  /// Text after the coordinates of each point, if it is more than the point's number (a third
  /// coordinate of a plane mesh, two numbers); else empty.
  std::vector<std::string> point_tails;
  int raw_markers = 0;      ///< markers kept as text (SEND_RECEIVE)
  std::size_t markers = 0;  ///< number of markers of the mesh that was read
  /// The faces of a marker below one MARKER_TAG=. Several of one name are one marker.
  struct MarkerPart {
    std::size_t marker = 0, first = 0, count = 0;
  };
  std::vector<MarkerPart> marker_parts;  ///< in the order of the file
  /// For a file of several zones: the text before the first one, then the unchanged text of each.
  std::shared_ptr<const std::vector<std::string>> blocks;
  std::size_t block = 0;             ///< the zone's place in `blocks`
  std::vector<BoxPoint> box_points;  ///< of boxes anywhere in the file
};

extern const MeshFormat format;

/// zone: number after IZONE=; 0: the first one. Throws UsageError if the file has no such zone.
ParsedMesh read_zone(Source& source, int zone);
/// Reads all zones, in the order of the file.
void read_zones(Source& source, const TakeZone& take);

/// Writes points in the order of the file. Text after their coordinates is kept; only point numbers
/// that count from 0 are written anew. A plane mesh has NDIME= 2, unless it came from an SU2 file
/// with NDIME= 3. From a file of several zones, only the zone of the details is written. source:
/// details of the file that the mesh came from, of this format or of another; may be null.
std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                               const WriteOptions& options);
/// Writes zones of one file; its other zones are written unchanged.
std::vector<std::string> write_zones(std::ostream& out, std::span<const MeshZone> zones,
                                     const WriteOptions& options);

/// Dimensions of a zone: 2 and 2 for a plane mesh, 3 and 3 for a volume mesh, space 3 and cells 2
/// for a surface mesh.
struct Dimensions {
  int space = 2;  ///< NDIME=
  int cells = 2;  ///< of the elements
};

/// The element type for a number of SU2 (the same as VTK's): triangles and quadrilaterals of
/// dimension 2, tetrahedra (10), hexahedra (12), prisms (13) and pyramids (14) of dimension 3.
std::optional<ElementType> element_of(std::int64_t number, int dimension);
std::int64_t element_number(ElementType type);
/// SU2's element number of a face: 3 (line), 5 (triangle) or 9 (quadrilateral).
std::int64_t face_number(std::size_t corners);
/// Number of corners of a face with that number, for elements of that dimension; 0: no such face.
std::size_t face_corners(std::int64_t number, int dimension);

/// "5 (triangle) or 9 (quadrilateral)": SU2's element types of a dimension (at least 1).
std::string element_list(int dimension);
/// Why a mesh of those dimensions, or its markers if of_marker, cannot have an element type. An
/// example is " (second order)"; may be empty.
std::string type_hint(std::int64_t number, const Dimensions& of, bool of_marker);

/// Reads what a configuration file of SU2 says of the markers of its mesh: planes of symmetry
/// (MARKER_SYM) and periodic sides (MARKER_PERIODIC: two markers, then centre, angles and
/// translation, which the mesh itself tells). Other options mean nothing here. Throws InputError:
/// a list without brackets, a periodic side that is not two names and nine numbers.
MarkerRoles read_config(const std::filesystem::path& path);

}  // namespace winslow::io::su2
