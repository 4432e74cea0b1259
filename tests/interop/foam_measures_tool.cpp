// foam_measures CASE [TIME]: prints what checkMesh prints of a mesh of OpenFOAM with any cells, as
// JSON, for the script beside it. Patches of type empty tell the directions that are not solved.
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/quality/openfoam_measures.h"
#include "io/openfoam/poly_mesh.h"

namespace {

using namespace winslow;

/// A direction is not solved if the faces of empty patches are perpendicular to it.
SolvedDirections directions_of(const io::openfoam::PolyMesh& mesh, const FiniteVolumes& cells) {
  Vec3 empty(0, 0, 0);
  for (const io::openfoam::Patch& patch : mesh.patches) {
    if (patch.type != "empty") continue;
    for (std::int64_t f = patch.first; f < patch.first + patch.count; ++f)
      empty += cells.area_vector(static_cast<Index>(f)).cwiseAbs();
  }
  SolvedDirections solved{true, true, true};
  if (empty.norm() == 0) return solved;
  for (Index k = 0; k < 3; ++k) solved[at(k)] = empty[k] < 1e-6 * empty.norm();
  return solved;
}

nlohmann::json describe(const OpenFoamMeasures& measures) {
  nlohmann::json report;
  for (const CheckedMeasure& row : measures.rows)
    report[std::string(row.name)] = {{"min", row.values.min},
                                     {"avg", row.values.avg},
                                     {"max", row.values.max},
                                     {"beyond", row.beyond}};
  report["boundary_openness"] = measures.boundary_openness;
  report["total_volume"] = measures.total_volume;
  report["orthogonality_errors"] = measures.orthogonality_errors;
  report["pyramid_errors"] = measures.pyramid_errors;
  report["poor_divisions"] = measures.poor_divisions;
  report["concave_cells"] = measures.concave_cells;
  return report;
}

void print(const std::string& path, const std::string& time) {
  const auto place = io::openfoam::place_to_read(path, time);
  if (!place) throw std::runtime_error(path + ": found no mesh of OpenFOAM");
  io::Source source(path, {});
  const io::openfoam::PolyMesh mesh = io::openfoam::read_poly_mesh(source, *place);
  std::vector<Index> neighbour = mesh.neighbour;
  neighbour.resize(mesh.owner.size(), -1);
  const CellFaces faces = make_cell_faces({mesh.faces.offsets, mesh.faces.nodes}, mesh.owner,
                                          std::move(neighbour), mesh.cells);
  Coordinates x(3, mesh.point_count());
  std::ranges::copy(mesh.xyz, x.values().begin());
  const SolvedDirections directions = directions_of(mesh, FiniteVolumes(faces, x));
  std::cout << describe(openfoam_measures(faces, x, 0, directions)).dump(1) << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: foam_measures CASE [TIME]\n";
    return 2;
  }
  try {
    print(argv[1], argc > 2 ? argv[2] : "");
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
