#pragma once

#include "core/quality/wall_measures.h"

/// The part of wall_measures.h for volume meshes:
///
///     for (const winslow::Wall& wall : winslow::find_space_walls(mesh))
///       for (const double height : winslow::space_first_heights(mesh, wall))
///         std::printf("%g\n", height);
namespace winslow {

/// find_walls() of a volume mesh.
std::vector<Wall> find_space_walls(const Mesh& mesh);
/// first_heights() at a wall of a volume mesh (#nodes of the wall).
std::vector<double> space_first_heights(const Mesh& mesh, const Wall& wall);
/// wall_spacings() of a wall of a volume mesh (#nodes of the wall).
std::vector<double> space_wall_spacings(const Mesh& mesh, const Wall& wall);
/// first_edge_tilts() at a wall of a volume mesh (#nodes of the wall).
std::vector<double> space_first_edge_tilts(const Mesh& mesh, const Wall& wall);

/// The faces of each element of a volume mesh (#elements), as in Topology::face(), ascending.
CompressedRows faces_of_elements(const Topology& topology);
/// column_growth() over a wall of a volume mesh. faces: faces_of_elements().
std::vector<NeighbourRatio> space_column_growth(const Mesh& mesh, const Wall& wall,
                                                const CompressedRows& faces);
/// size_ratios() of a volume mesh. threads: 0 for all cores; the result does not depend on it.
std::vector<NeighbourRatio> space_size_ratios(const Mesh& mesh, int threads = 0);

/// The number of a node among the nodes of a wall of a volume mesh; -1: it is not on the wall.
Index number_on_wall(const Wall& wall, Index node);

}  // namespace winslow
