#include "io/cgns/cgns.h"
#include "io/format/mesh_format.h"
#include "io/gmsh/gmsh.h"
#include "io/medit/medit.h"
#include "io/openfoam/openfoam.h"
#include "io/su2/su2.h"
#include "io/surface/surface.h"
#include "io/ugrid/ugrid.h"
#include "io/vtk/grid.h"

namespace winslow::io {

std::span<const MeshFormat* const> mesh_formats() {
  static constexpr std::array all{&su2::format,         &gmsh::format,        &vtk::legacy_format,
                                  &vtk::vtu_format,     &cgns::format,        &ugrid::format,
                                  &medit::format,       &openfoam::format,    &surface::obj_format,
                                  &surface::off_format, &surface::ply_format, &surface::stl_format};
  return all;
}

}  // namespace winslow::io
