#ifdef WINSLOW_HAS_CGNS

#include <dlfcn.h>

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

/// Replaces attributes by means of HDF5, whose headers need not be there.
class Hdf5Editor {
 public:
  enum class Kind { integer, variable, several, longer, none };

  void replace(const std::filesystem::path& file, const char* group, const char* name, Kind kind) {
    const Id open = call<Id>("H5Fopen", file.c_str(), 1U /* to write */, Id{0});
    const Id place = call<Id>("H5Gopen2", open, group, Id{0});
    REQUIRE(call<int>("H5Adelete", place, name) >= 0);
    if (kind != Kind::none) add(place, name, kind);
    call<int>("H5Gclose", place);
    REQUIRE(call<int>("H5Fclose", open) >= 0);
  }

 private:
  using Id = std::int64_t;

  void add(Id place, const char* name, Kind kind) {
    const Id text = call<Id>("H5Tcopy", *symbol<Id*>("H5T_C_S1_g"));
    const std::size_t size = kind == Kind::variable ? ~std::size_t{0} : 60;
    call<int>("H5Tset_size", text, size);
    const Id type = kind == Kind::integer ? *symbol<Id*>("H5T_NATIVE_INT32_g") : text;
    const unsigned long long two = 2;
    const Id space = kind == Kind::several
                         ? call<Id>("H5Screate_simple", 1, &two, static_cast<void*>(nullptr))
                         : call<Id>("H5Screate", 0);
    const Id attribute = call<Id>("H5Acreate2", place, name, type, space, Id{0}, Id{0});
    const std::string letters(120, 'x');
    const char* pointer = letters.c_str();
    const int number = 7;
    const void* value = letters.c_str();
    if (kind == Kind::variable) value = &pointer;
    if (kind == Kind::integer) value = &number;
    REQUIRE(call<int>("H5Awrite", attribute, type, value) >= 0);
    call<int>("H5Aclose", attribute);
    call<int>("H5Sclose", space);
    call<int>("H5Tclose", text);
  }

  template <class Symbol>
  static Symbol symbol(const char* name) {
    void* address = ::dlsym(RTLD_DEFAULT, name);
    REQUIRE_MESSAGE(address != nullptr, name);
    return reinterpret_cast<Symbol>(address);
  }
  template <class Result, class... Values>
  static Result call(const char* name, Values... values) {
    return symbol<Result (*)(Values...)>(name)(values...);
  }
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

#ifdef WINSLOW_ADDRESS_SANITIZER
constexpr double slower = 10;
#else
constexpr double slower = 1;
#endif

}  // namespace

TEST_CASE("CGNS: attributes of HDF5 that libcgns would copy without a look are refused") {
  // The first two are no files of CGNS in any case.
  CHECK(refusal_of(test_data("int_type.h5")) ==
        ": found an HDF5 file without the nodes of CGNS, expected a CGNS file");
  CHECK(refusal_of(test_data("vlen_type.h5")) ==
        ": found an HDF5 file without the nodes of CGNS, expected a CGNS file");
  CHECK_CONTAINS(refusal_of(test_data("long_label.cgns")),
                 "found the attribute \"label\" with 60 characters, expected at most 32");
}

TEST_CASE("CGNS: attributes of every other kind are refused at every node") {
  const TemporaryFolder folder;
  const auto refusal = [&](const char* group, const char* name, Hdf5Editor::Kind kind) {
    write_squares(folder / "a.cgns", 1, io::cgns::Container::hdf5);
    Hdf5Editor().replace(folder / "a.cgns", group, name, kind);
    return refusal_of(folder / "a.cgns");
  };
  using Kind = Hdf5Editor::Kind;
  for (const char* name : {"name", "label", "type"}) {
    const std::string attribute = std::string("the attribute \"") + name + '"';
    CHECK(refusal("/Base", name, Kind::integer) ==
          ": /Base: found " + attribute +
              " as a whole number, expected a string of fixed length, as libcgns has it");
    CHECK_CONTAINS(refusal("/Base", name, Kind::variable), "as a string of variable length");
    CHECK_CONTAINS(refusal("/Base/zone000000", name, Kind::several),
                   ": /Base/zone000000: found " + attribute + " with several values");
    CHECK_CONTAINS(refusal("/Base/zone000000/cells", name, Kind::longer),
                   attribute + " with 60 characters, expected at most");
    CHECK_CONTAINS(refusal("/Base/zone000000/cells", name, Kind::none),
                   "found no attribute \"" + std::string(name) + "\", expected one");
  }
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
