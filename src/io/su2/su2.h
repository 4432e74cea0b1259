#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "io/format/mesh_format.h"

/// SU2 native format, https://su2code.github.io/docs_v7/Mesh-File/ (NDIME= 2).
namespace winslow::io::su2 {

/// What an SU2 file says beyond a mesh: the order of its sections, comments, what we do not know.
struct Details : FormatDetails {
  enum class Part { text, dimension, elements, points, marker_count, marker };
  struct Item {
    Part part;
    std::string text;  ///< Part::text: lines as they are. Part::points: what follows the count.
  };
  std::vector<Item> items;
  bool element_numbers = false;
  bool point_numbers = false;
  bool edge_numbers = false;
  int raw_markers = 0;  ///< markers kept as text (SEND_RECEIVE)
  Index nodes = 0;      ///< sizes of the mesh that the details belong to
  Index elements = 0;
  std::size_t markers = 0;
};

extern const MeshFormat format;

ParsedMesh read(Source& source);
std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const Details* details);

}  // namespace winslow::io::su2
