#include <sstream>

#include "core/strategy/slide_options.h"
#include "io/support/samples.h"
#include "io/tables/slide_files.h"
#include "support/periodic_meshes.h"

namespace winslow::test {
namespace {

struct Passage {
  std::string head, markers, lists, transformations;
  std::string all(int count) const {
    return head + "NMARK= " + std::to_string(count) + "\n" + markers + lists + transformations;
  }
};

constexpr int columns = 4, rows = 3;
int node(int i, int j) { return j * (columns + 1) + i; }

/// As SU2_MSH wrote it: quadrilaterals from y = 0 to y = 3, where "upper" is, and one row of halo
/// elements above. "lower" is received from "upper", the outermost row from the one above "lower".
Passage passage() {
  std::ostringstream head, markers, lists;
  head << "NDIME= 2\nNELEM= " << columns * (rows + 1) << "\n";
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < columns; ++i)
      head << "9 " << node(i, j) << ' ' << node(i + 1, j) << ' ' << node(i + 1, j + 1) << ' '
           << node(i, j + 1) << '\n';
  head << "NPOIN= " << (columns + 1) * (rows + 2) << "\n";
  for (int j = 0; j <= rows + 1; ++j)
    for (int i = 0; i <= columns; ++i) head << i << ' ' << j << '\n';
  for (const auto& [name, j] : {std::pair{"lower", 0}, {"upper", rows}}) {
    markers << "MARKER_TAG= " << name << "\nMARKER_ELEMS= " << columns << "\n";
    for (int i = 0; i < columns; ++i)
      markers << "3 " << node(i, j) << ' ' << node(i + 1, j) << '\n';
  }
  for (const auto& [name, i] : {std::pair{"in", 0}, {"out", columns}}) {
    markers << "MARKER_TAG= " << name << "\nMARKER_ELEMS= " << rows + 1 << "\n";
    for (int j = 0; j <= rows; ++j) markers << "3 " << node(i, j) << ' ' << node(i, j + 1) << '\n';
  }
  for (const bool sends : {true, false}) {
    lists << "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= " << 2 * (columns + 1)
          << "\nSEND_TO= " << (sends ? 1 : -1) << "\n";
    for (int i = 0; i <= columns; ++i) lists << "1\t" << node(i, sends ? rows : 0) << "\t1\n";
    for (int i = 0; i <= columns; ++i) lists << "1\t" << node(i, sends ? 1 : rows + 1) << "\t2\n";
  }
  return {head.str(), markers.str(), lists.str(),
          "NPERIODIC= 3\nPERIODIC_INDEX= 0\n0 0 0\n0 0 0\n0 0 0\n"
          "PERIODIC_INDEX= 1\n0 0 0\n0 0 0\n0 3 0\n"
          "PERIODIC_INDEX= 2\n0 0 0\n0 0 0\n0 -3 0\n"};
}

const GivenPairs& pair_of(const io::MeshFile& file, std::size_t k) {
  REQUIRE(file.details->periodic->pairs.size() > k);
  return file.details->periodic->pairs[k];
}

PeriodicPairs found(const io::MeshFile& file, std::size_t k) {
  return PeriodicPairs::of(*file.mesh.topology, file.mesh.coordinates, pair_of(file, k));
}

}  // namespace

TEST_CASE("SU2: SEND_RECEIVE pairs two markers, and nodes of the interior with halo nodes") {
  const io::MeshFile file = read_from_text("a.su2", passage().all(6));
  REQUIRE(file.details->periodic->pairs.size() == 2);
  const PeriodicPairs sides = found(file, 0), halo = found(file, 1);
  CHECK(sides.first == "upper");
  CHECK(sides.second == "lower");
  CHECK_FALSE(sides.halo);
  CHECK(sides.description == "translation by (0, -3)");
  CHECK(sides.pairs == std::vector<PeriodicPair>{{16, 1}, {17, 2}, {18, 3}});
  CHECK(halo.halo);
  CHECK(halo.description == "translation by (0, 3)");
  CHECK(halo.pairs == std::vector<PeriodicPair>{{6, 21}, {7, 22}, {8, 23}});
  CHECK_FALSE(any_contains(file.warnings, "PERIODIC"));
}

TEST_CASE("SU2: nodes of the halo go where those of the interior go") {
  const io::MeshFile file = read_from_text("a.su2", passage().all(6));
  SlideOptions slide;
  slide.periodic_from_file = true;
  NodeClasses classes(file.mesh.topology);
  const MovingBoundary boundary = make_boundary_move(
      {slide, io::resolve_files(slide, file.details.get())}, file.mesh, {}, classes);
  REQUIRE(boundary.periodic.size() == 2);
  CHECK(classes[22] == NodeClass::image);
  CHECK(classes[7] == NodeClass::free);
  CHECK(classes[2] == NodeClass::image);
  CHECK(classes[20] == NodeClass::fixed);  // on the inlet
}

TEST_CASE("SU2: without lists the markers that a transformation takes to one another are pairs") {
  const Passage made = passage();
  const io::MeshFile file =
      read_from_text("a.su2", made.head + "NMARK= 4\n" + made.markers + made.transformations);
  REQUIRE(file.details->periodic->pairs.size() == 1);
  CHECK(found(file, 0).first == "lower");
  CHECK(found(file, 0).description == "translation by (0, 3)");
  const std::string elsewhere = replaced(made.transformations, "0 3 0", "0 2.5 0");
  CHECK(read_from_text("a.su2", made.head + "NMARK= 4\n" + made.markers +
                                    replaced(elsewhere, "0 -3 0", "0 -2.5 0"))
            .details->periodic->pairs.empty());
}

TEST_CASE("SU2: rotations of a file are angles in radians about a centre") {
  const TemporaryFolder folder;
  io::write_mesh(folder / "a.su2", make_mesh(sector(40, 4, 3, {3, -2})), nullptr);
  std::ostringstream turn;
  turn.precision(17);
  turn << "NPERIODIC= 2\nPERIODIC_INDEX= 0\n0 0 0\n0 0 0\n0 0 0\nPERIODIC_INDEX= 1\n"
       << "PERIODIC_CENTER= 3 -2 0\nPERIODIC_ROTATION= 0 0 " << radians(40)
       << "\nPERIODIC_TRANSLATION= 0 0 0\n";
  const io::MeshFile file = read_from_text("b.su2", read_text(folder / "a.su2") + turn.str());
  CHECK(pair_of(file, 0).first == "begin");
  CHECK(found(file, 0).second == "end");
  CHECK(found(file, 0).description == "rotation by 40 degrees");
  CHECK(found(file, 0).pairs.size() == 2);
}

TEST_CASE("SU2: periodic sections come back byte by byte, and what no longer matches is told") {
  const TemporaryFolder folder;
  const std::string text = passage().all(6);
  write_text(folder / "a.su2", text);
  io::MeshFile file = io::read_mesh(folder / "a.su2");
  CHECK(io::write_mesh(folder / "b.su2", file.mesh, file.details.get()).empty());
  CHECK(read_text(folder / "b.su2") == text);
  file.mesh.coordinates.set_xy(7, {2.001, 1});
  const auto warnings = io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  CHECK(any_contains(warnings, "the halo nodes beyond \"upper\" and \"lower\" no longer match"));
  CHECK_FALSE(any_contains(warnings, "the periodic nodes of"));
  file.mesh.coordinates.set_xy(22, {2.001, 4});
  CHECK(io::write_mesh(folder / "b.su2", file.mesh, file.details.get()).empty());
}

TEST_CASE("SU2: a mesh that is not the file's any more names its pairs as SU2 wants them") {
  const TemporaryFolder folder;
  const io::MeshFile file = read_from_text("a.su2", passage().all(6));
  MeshData other;  // the mesh without its halo
  for (Index i = 0; i < (columns + 1) * (rows + 1); ++i)
    other.coordinates.push_xy(file.mesh.coordinates.xy(i));
  for (Index e = 0; e < columns * rows; ++e)
    other.add_element(ElementType::quadrilateral, file.mesh.topology->element(e));
  for (const Marker& marker : file.mesh.topology->markers())
    if (marker.name == "lower" || marker.name == "upper") other.markers.push_back(marker);
  const auto warnings = io::write_mesh(folder / "b.su2", make_mesh(other), file.details.get());
  CHECK(any_contains(warnings, "as MARKER_PERIODIC= ( upper, lower, 0, 0, 0, 0, 0, 0, 0, -3, 0 )"));
  CHECK_FALSE(contains(read_text(folder / "b.su2"), "PERIODIC"));
}

TEST_CASE("SU2: bad periodic sections are refused with file and line") {
  const Passage made = passage();
  const std::string text = made.all(6);
  struct Bad {
    const char *part, *by, *error;
  };
  for (const Bad& bad : std::vector<Bad>{
           {"NPERIODIC= 3", "NPERIODIC= many",
            "a.su2:96: found 'many', expected the number of periodic transformations"},
           {"NPERIODIC= 3", "NPERIODIC= -1", "a.su2:96: found NPERIODIC= -1, expected 0 or more"},
           {"NPERIODIC= 3", "NPERIODIC= 4", "expected PERIODIC_INDEX="},
           {"PERIODIC_INDEX= 2\n0", "PERIODIC_INDEX= 1\n0",
            "a.su2:105: found a second PERIODIC_INDEX= 1, expected one only"},
           {"0 3 0\nPER", "0 3\nPER",
            "a.su2:104: found the end of the line, expected a translation, x y z"},
           {"0 3 0\nPER", "0 up 0\nPER", "a.su2:104: found 'up', expected a translation, x y z"},
           {"0 3 0\nPER", "0 inf 0\nPER", "a.su2:104: found 'inf', expected a translation"},
           {"SEND_TO= 1", "SEND= 1",
            "a.su2:72: found 'SEND= 1', expected SEND_TO= of marker SEND_RECEIVE"},
           {"1\t15\t1\n", "5\t15\t1\n", "a.su2:73: found '5', expected 1 (vertex), point of"},
           {"1\t15\t1\n", "1\t75\t1\n", "a.su2:73: found point 75, expected 0 to 24"},
           {"1\t15\t1\n", "1\t15\t2\n",
            "a.su2:74: found 4 points sent by transformation 1 and 5 received, expected as many"},
           {"MARKER_ELEMS= 10\nSEND_TO= 1", "MARKER_ELEMS= 9\nSEND_TO= 1", "a.su2:82: found '1"},
       }) {
    CAPTURE(bad.by);
    CHECK_CONTAINS(input_error("a.su2", replaced(text, bad.part, bad.by)), bad.error);
  }
}

}  // namespace winslow::test
