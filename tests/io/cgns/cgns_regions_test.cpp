#ifdef WINSLOW_HAS_CGNS

#include "io/cgns/library_file.h"
#include "io/support/samples.h"

namespace winslow::test {
namespace {

/// A part of the zone that lists cells, of a family or of none.
void write_part(LibraryFile& file, const char* name, const CgnsNumbers& cells,
                const char* family = nullptr) {
  int number = 0;
  require_cgns(cg_subreg_ptset_write(file.file, file.base, file.zone, name, 2, CellCenter,
                                     PointList, static_cast<cgsize_t>(cells.size()), cells.data(),
                                     &number));
  if (family == nullptr) return;
  require_cgns(
      cg_goto(file.file, file.base, "Zone_t", file.zone, "ZoneSubRegion_t", number, "end"));
  require_cgns(cg_famname_write(family));
}

}  // namespace

TEST_CASE("CGNS: parts of a zone are regions by their family, those of one family one region") {
  const MeshData data = square(2, Cells::quads);
  const TemporaryFolder folder;
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5);
    file.start_zone("z", data.node_count(), data.element_count());
    file.coordinates(data.coordinates);
    write_mixed(file, data);
    write_part(file, "part 1", {1}, "rock");
    write_part(file, "part 2", {2}, "sand");
    write_part(file, "part 3", {3}, "rock");
    write_part(file, "alone", {4});
  }
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  const Topology& topology = *file.mesh.topology;
  REQUIRE(topology.regions().size() == 3);
  CHECK(topology.regions()[0].name == "rock");
  CHECK(topology.regions()[1].name == "sand");
  CHECK(topology.regions()[2].name == "alone");
  const auto of = topology.element_regions();
  CHECK(std::vector<Index>(of.begin(), of.end()) == std::vector<Index>{0, 1, 0, 2});
  io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
  const auto written = tree_of(folder / "b.cgns");
  CHECK(io::cgns::text_of(node_at(written.root, "/Base/z/part 3/FamilyName")) == "rock");
}

}  // namespace winslow::test

#endif
