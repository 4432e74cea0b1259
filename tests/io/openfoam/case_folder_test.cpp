#include "io/openfoam/case_folder.h"

#include "io/support/files.h"
#include "io/support/openfoam_cases.h"

namespace winslow::test {
namespace {

namespace fs = std::filesystem;
namespace foam = io::openfoam;

std::string usage_error(const fs::path& path, const foam::MeshPlace* source) {
  try {
    foam::place_to_write(path, source);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

std::string folder_read(const fs::path& path, const std::string& time = {}) {
  const auto place = foam::place_to_read(path, time);
  return place ? place->folder().string() : "none";
}

}  // namespace

TEST_CASE("OpenFOAM: names of times are numbers") {
  CHECK(foam::time_of("0.5") == 0.5);
  CHECK(foam::time_of("1e-3") == 1e-3);
  CHECK(foam::time_of("0") == 0.0);
  for (const char* name : {"constant", "system", "", "0.orig", "nan", "inf", "processor0"})
    CHECK_FALSE(foam::time_of(name));
}

TEST_CASE("OpenFOAM: what a path names when it is read") {
  const TemporaryFolder folder;
  const fs::path root = folder / "case";
  write_cube_case(root);
  for (const char* time : {"0", "0.5", "10", "2"}) fs::create_directories(root / time / "polyMesh");
  for (const char* time : {"0.5", "2"}) write_text(root / time / "polyMesh/points", "moved");
  fs::create_directories(root / "0.7");
  const std::string constant = (root / "constant/polyMesh").string();
  const auto at = [&](const char* time) { return (root / time / "polyMesh").string(); };
  for (const char* name : {"", "constant", "constant/polyMesh", "x.foam", "constant/polyMesh/"})
    CHECK(folder_read(root / name) == constant);
  CHECK(folder_read(root / "0.5") == at("0.5"));
  CHECK(folder_read(root / "0.5/polyMesh") == at("0.5"));
  CHECK(folder_read(root, "0.5") == at("0.5"));
  CHECK(folder_read(root, "5e-1") == at("0.5"));
  CHECK(folder_read(root, "latest") == at("10"));
  CHECK(folder_read(root, "constant") == constant);
  CHECK(folder_read(root / "system") == "none");
  CHECK_THROWS_WITH_AS(foam::place_to_read(root, "3"),
                       doctest::Contains("has no time 3, expected one of 0, 0.5, 0.7, 2, 10"),
                       UsageError);
  CHECK_THROWS_WITH_AS(foam::place_to_read(root, "soon"), doctest::Contains("found 'soon'"),
                       UsageError);
  // Each file is that of the newest time up to the one that is read.
  const foam::MeshPlace late = *foam::place_to_read(root, "latest");
  CHECK(foam::find_file(late, "points") == root / "2/polyMesh/points");
  CHECK(foam::find_file(late, "faces") == root / "constant/polyMesh/faces");
  CHECK(foam::find_file(late.at("0.7"), "points") == root / "0.5/polyMesh/points");
  CHECK(foam::find_file(late.at("0"), "points") == root / "constant/polyMesh/points");
  CHECK(foam::find_file(late, "cellZones").empty());
  CHECK_CONTAINS(foam::about_times(root, *foam::place_to_read(root, {})),
                 "the case has moved points at 0.5, 2: --time latest, or the folder 2 in place of "
                 "the case, reads the last");
  CHECK(foam::about_times(root / "constant/polyMesh", late.at("constant")).empty());
}

TEST_CASE("OpenFOAM: a case whose name is a number, a region, and a folder in no case") {
  const TemporaryFolder folder;
  write_cube_case(folder / "20");
  CHECK(folder_read(folder / "20") == (folder / "20/constant/polyMesh").string());
  fs::create_directories(folder / "case/constant");
  fs::rename(folder / "20/constant", folder / "case/constant/fluid");
  const auto region = foam::place_to_read(folder / "case/constant/fluid", {});
  REQUIRE(region);
  CHECK(region->region == "fluid");
  CHECK(region->root == folder / "case");
  CHECK(region->at("0.5").folder() == folder / "case/0.5/fluid/polyMesh");
  fs::rename(folder / "case/constant/fluid/polyMesh", folder / "polyMesh");
  const auto alone = foam::place_to_read(folder / "polyMesh", {});
  REQUIRE(alone);
  CHECK(alone->instance.empty());
  CHECK(alone->folder() == folder / "polyMesh");
  CHECK_THROWS_WITH_AS(foam::place_to_read(folder / "polyMesh", "0.5"),
                       doctest::Contains("lies in no case"), UsageError);
}

TEST_CASE("OpenFOAM: where a mesh is written, and what is refused") {
  const TemporaryFolder folder;
  const fs::path root = folder / "case";
  write_cube_case(root);
  const foam::MeshPlace source = *foam::place_to_read(root, {});
  const auto written = [&](const std::string& name) {
    return foam::place_to_write(folder / name, &source).folder().string();
  };
  CHECK(written("case/0.5") == (root / "0.5/polyMesh").string());
  CHECK(written("case/0.5/polyMesh") == (root / "0.5/polyMesh").string());
  CHECK(written("case/constant/polyMesh") == (root / "constant/polyMesh").string());
  CHECK(written("other") == (folder / "other/constant/polyMesh").string());
  CHECK(written("other/") == (folder / "other/constant/polyMesh").string());
  CHECK(written("polyMesh") == (folder / "polyMesh").string());
  for (const char* name : {"case", "case/", "case/constant", "case/../case"}) {
    CAPTURE(name);
    CHECK_CONTAINS(usage_error(folder / name, &source), "which is read, would be replaced");
  }
  CHECK_CONTAINS(usage_error(root, &source), "expected -o " + (root / "0.5").string());
  CHECK_CONTAINS(usage_error(root / "x.foam", nullptr),
                 "expected a folder: " + (root / "constant/polyMesh").string());
  CHECK(foam::is_folder_to_write(root, false));
  CHECK(foam::is_folder_to_write(root / "0.5", false));
  CHECK_FALSE(foam::is_folder_to_write(folder / "new", false));
  CHECK(foam::is_folder_to_write(folder / "new", true));
  CHECK_FALSE(foam::is_folder_to_write(folder / "new.xyz", true));
}

}  // namespace winslow::test
