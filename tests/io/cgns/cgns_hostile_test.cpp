#ifdef WINSLOW_HAS_CGNS

#include <ctime>

#include "io/cgns/cgns.h"
#include "io/cgns/library_file.h"
#include "support/paths.h"
#include "support/sanitizers.h"

namespace winslow::test {
namespace {

std::string refusal_of(const std::filesystem::path& path) {
  try {
    io::read_mesh(path);
  } catch (const InputError& error) {
    const std::string what = error.what();
    const std::string name = path.string();
    REQUIRE(what.starts_with(name));
    return what.substr(name.size());
  }
  FAIL("no InputError for ", path.string());
  return {};
}

io::cgns::NodePtr square_zone(const std::string& name, double x) {
  auto zone = io::cgns::make_integers(name, "Zone_t", {4, 2, 0}, {1, 3});
  zone->children.push_back(io::cgns::make_text("ZoneType", "ZoneType_t", "Unstructured"));
  auto grid = io::cgns::make_node("GridCoordinates", "GridCoordinates_t");
  grid->children.push_back(
      io::cgns::make_reals("CoordinateX", "DataArray_t", {x, x + 1, x + 1, x}));
  grid->children.push_back(io::cgns::make_reals("CoordinateY", "DataArray_t", {0, 0, 1, 1}));
  zone->children.push_back(grid);
  auto section = io::cgns::make_integers("cells", "Elements_t", {5, 0});  // TRI_3
  section->children.push_back(io::cgns::make_integers("ElementRange", "IndexRange_t", {1, 2}));
  section->children.push_back(
      io::cgns::make_integers("ElementConnectivity", "DataArray_t", {1, 2, 3, 1, 3, 4}));
  zone->children.push_back(section);
  return zone;
}

/// A file of so many squares in a row, each a zone.
void write_squares(const std::filesystem::path& path, int count, io::cgns::Container container) {
  auto base = io::cgns::make_integers("Base", "CGNSBase_t", {2, 2});
  for (int k = 0; k < count; ++k) {
    std::string number = std::to_string(k);
    number.insert(0, 6 - number.size(), '0');
    base->children.push_back(square_zone("zone" + number, 2.0 * k));
  }
  auto root = io::cgns::make_node("", "");
  root->children.push_back(
      io::cgns::make_single_reals("CGNSLibraryVersion", "CGNSLibraryVersion_t", {3.3F}));
  root->children.push_back(base);
  write_text(path, io::cgns::write_tree(*root, container));
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

#ifdef WINSLOW_ADDRESS_SANITIZER
constexpr double slower = 10;
#else
constexpr double slower = 1;
#endif

}  // namespace

TEST_CASE("CGNS: attributes of HDF5 that libcgns would copy without a look are refused") {
  CHECK(
      refusal_of(test_data("int_type.h5")) ==
      ": /: found the attribute \"type\" as a whole number, expected a string of fixed length, as "
      "libcgns has it");
  CHECK_CONTAINS(refusal_of(test_data("vlen_type.h5")),
                 "the attribute \"type\" as a string of variable length");
  CHECK_CONTAINS(refusal_of(test_data("long_label.cgns")),
                 "found the attribute \"label\" with 60 characters, expected at most 32");
}

TEST_CASE("CGNS: a name or a label of 32 characters is read and written as it is") {
  const std::string longest(32, 'n');
  for (const auto container : {io::cgns::Container::hdf5, io::cgns::Container::adf}) {
    auto root = io::cgns::make_node("", "");
    root->children.push_back(io::cgns::make_node(longest, longest));
    io::Source source("a.cgns", io::cgns::write_tree(*root, container));
    const io::cgns::TreeFile again = io::cgns::read_tree(source);
    REQUIRE(again.root->children.size() == 1);
    CHECK(again.root->children[0]->name == longest);
    CHECK(again.root->children[0]->label == longest);
  }
}

TEST_CASE("CGNS: the header of an ADF file is checked before libcgns sees it") {
  const TemporaryFolder folder;
  write_squares(folder / "a.cgns", 1, io::cgns::Container::adf);
  const std::string sound = read_text(folder / "a.cgns");
  for (const std::size_t place : {std::size_t{100}, std::size_t{101}}) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string text = sound;
      text[place] = static_cast<char>(byte);
      write_text(folder / "b.cgns", text);
      try {
        io::read_mesh(folder / "b.cgns");
      } catch (const InputError& error) {
        if (byte == 0)
          CHECK_CONTAINS(error.what(),
                         "byte " + std::to_string(place) + ": found no letter for the");
      }
    }
  }
}

TEST_CASE("CGNS: reading a file needs no folder for temporary files") {
  const TemporaryFolder folder;
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  for (const auto container : {io::cgns::Container::hdf5, io::cgns::Container::adf}) {
    write_squares(folder / "a.cgns", 2, container);
    ::setenv("TMPDIR", (folder / "none").c_str(), 1);
    CHECK(io::read_mesh(folder / "a.cgns").mesh.topology->element_count() == 2);
    if (before == nullptr)
      ::unsetenv("TMPDIR");
    else
      ::setenv("TMPDIR", kept.c_str(), 1);
  }
}

TEST_CASE("CGNS: all zones of a file at once are those that are read one by one") {
  const TemporaryFolder folder;
  for (const auto container : {io::cgns::Container::hdf5, io::cgns::Container::adf}) {
    write_squares(folder / "a.cgns", 12, container);
    const std::vector<io::MeshFile> zones = io::read_mesh_zones(folder / "a.cgns");
    REQUIRE(zones.size() == 12);
    for (int k = 0; k < 12; ++k) {
      const io::MeshFile one = io::read_mesh(folder / "a.cgns", {.zone = k + 1});
      CHECK(zones[at(k)].details->zone == k + 1);
      CHECK(zones[at(k)].details->zones == one.details->zones);
      CHECK(zones[at(k)].mesh.coordinates == one.mesh.coordinates);
    }
  }
}

TEST_CASE("CGNS: thousands of zones take seconds") {
  const TemporaryFolder folder;
  write_squares(folder / "a.cgns", 3000, io::cgns::Container::hdf5);
  const double start = cpu_seconds();
  const std::vector<io::MeshFile> zones = io::read_mesh_zones(folder / "a.cgns");
  const double took = cpu_seconds() - start;
  REQUIRE(zones.size() == 3000);
  CHECK(zones[2999].mesh.coordinates.xy(0) == Vec2(5998, 0));
  MESSAGE("3,000 zones of CGNS read in ", took, " s");
  CHECK(took < 5 * slower);
}

}  // namespace winslow::test

#endif
