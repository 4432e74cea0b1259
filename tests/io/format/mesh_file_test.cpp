#include "io/format/mesh_file.h"

#include "io/format/mesh_format.h"
#include "io/support/samples.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

std::string reading_error(const std::filesystem::path& path) {
  try {
    io::read_mesh(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("what is no readable file gets a clear error") {
  const TemporaryFolder folder;
  CHECK_CONTAINS(reading_error(folder / "none.su2"), "none.su2: cannot be read: No such file");
  CHECK_CONTAINS(reading_error(folder.path()), "it is a directory, expected a mesh file");
  write_text(folder / "empty.su2", "");
  CHECK_CONTAINS(reading_error(folder / "empty.su2"), "empty.su2:1: found an empty file");
  CHECK_CONTAINS(reading_error("/dev/zero"), "it is neither a file nor a pipe");
  write_text(folder / "a.xyz", "hello\n");
  CHECK_CONTAINS(reading_error(folder / "a.xyz"),
                 "a.xyz:1: found a file of unknown format, expected a mesh (.su2, .msh, .vtk, "
                 ".vtu, .cgns, .ugrid, .mesh, .foam, .obj, .off, .ply, .stl)");
}

TEST_CASE("the content decides the format, whatever the name") {
  for (const char* name :
       {"square.su2", "square_22.msh", "square_41b.msh", "square.vtk", "square_b.vtk", "square.vtu",
        "square_b.vtu", "square.obj", "square.off", "square_b.ply", "square.stl", "square_b.stl"}) {
    CAPTURE(name);
    const std::string original = test::test_data(name);
    const io::MeshFile expected = io::read_mesh(original);
    CHECK_FALSE(any_contains(expected.warnings, "the content is that of"));
    const TemporaryFolder folder;
    for (const char* other : {"a.xyz", "a", "a.su2", "a.OBJ"}) {
      CAPTURE(other);
      write_text(folder / other, read_text(original));
      const io::MeshFile file = io::read_mesh(folder / other);
      CHECK(file.format == expected.format);
      check_same_mesh(file.mesh, expected.mesh);
      const bool mismatch = (std::string(other) == "a.su2" && file.format->name != "su2") ||
                            (std::string(other) == "a.OBJ" && file.format->name != "obj");
      CHECK(any_contains(file.warnings, "the content is that of") == mismatch);
    }
  }
}

TEST_CASE("a byte order mark is left out in every text format; UTF-16 is refused") {
  for (const char* name : {"square.su2", "square_22.msh", "square_41.msh", "square.vtk",
                           "square.vtu", "square.obj", "square.off", "square.ply", "square.stl"}) {
    CAPTURE(name);
    const std::string original = test::test_data(name);
    const io::MeshFile file = read_from_text(name, "\xEF\xBB\xBF" + read_text(original));
    check_same_mesh(file.mesh, io::read_mesh(original).mesh);
  }
  const TemporaryFolder folder;
  write_text(folder / "a.su2", std::string("\xFF\xFEN\0D\0", 6));
  CHECK_CONTAINS(reading_error(folder / "a.su2"), "a.su2:1: found UTF-16 text");
}

TEST_CASE("coordinates may have Fortran's exponents") {
  const std::string text = read_text(test::test_data("square.su2"));
  const io::MeshFile file =
      read_from_text("a.su2", replaced(text, "0.5 0.5 4", "5.0D-01 .05d+1 4"));
  CHECK(file.mesh.coordinates.xy(4) == Vec2(0.5, 0.5));
}

TEST_CASE("lines that end in CR LF are accepted in every text format") {
  for (const char* name : {"square.su2", "square_22.msh", "square_41.msh", "square.vtk",
                           "square.vtu", "square.obj", "square.off", "square.ply", "square.stl"}) {
    CAPTURE(name);
    const std::string original = test::test_data(name);
    std::string crlf;
    for (const char c : read_text(original)) crlf += c == '\n' ? "\r\n" : std::string(1, c);
    const io::MeshFile file = read_from_text(name, crlf);
    const io::MeshFile expected = io::read_mesh(original);
    check_same_mesh(file.mesh, expected.mesh);
    CHECK(file.warnings.size() == expected.warnings.size());
  }
}

TEST_CASE("errors that only the mesh shows name the line all the same") {
  const std::string square = read_text(test::test_data("square.su2"));
  const auto error = [&](const std::string& part, const std::string& by) {
    return input_error("a.su2", replaced(square, part, by));
  };
  // Three elements at one edge.
  std::string three = replaced(square, "NELEM= 6", "NELEM= 7");
  three = replaced(three, "5 5 8 7 5\n", "5 5 8 7 5\n5 3 4 8 6\n");
  CHECK_CONTAINS(input_error("a.su2", three), "a.su2:10: ");
  CHECK_CONTAINS(input_error("a.su2", three), "non-manifold");
  // An element that shares no edge with the rest, and one that shares only a node.
  std::string island = replaced(square, "NELEM= 6", "NELEM= 7");
  island = replaced(island, "5 5 8 7 5\n", "5 5 8 7 5\n5 9 10 11 6\n");
  island = replaced(island, "NPOIN= 9", "NPOIN= 12");
  island = replaced(island, "1 1 8\n", "1 1 8\n5 5 9\n6 5 10\n5 6 11\n");
  CHECK_CONTAINS(input_error("a.su2", island), "a.su2:10: element 6");
  CHECK_CONTAINS(input_error("a.su2", island), "isolated");
  CHECK_CONTAINS(input_error("a.su2", replaced(island, "5 9 10 11 6", "5 8 10 11 6")), "a.su2:");
  // No area: three corners on one line.
  CHECK_CONTAINS(error("1 0.5 5", "1 1.5 5"), "a.su2:");
  CHECK_CONTAINS(error("0.5 1 7", "0.25 0.75 7"), "a.su2:");
  CHECK_CONTAINS(error("0.5 1 7", "0.25 0.75 7"), "no area");
  // A hanging node: the edge from 6 to 8 has node 7 in the middle.
  std::string hanging =
      replaced(square, "5 4 7 6 3\n5 4 5 7 4\n5 5 8 7 5\n", "5 4 8 6 3\n5 4 5 8 4\n5 9 8 7 5\n");
  hanging = replaced(hanging, "NPOIN= 9", "NPOIN= 10");
  hanging = replaced(hanging, "1 1 8\n", "1 1 8\n0.8 1.5 9\n");
  hanging = replaced(hanging, "3 8 7\n3 7 6\n", "3 6 8\n3 7 8\n");
  CHECK_CONTAINS(input_error("a.su2", hanging), "a.su2:");
  // Unused nodes are harmless.
  std::string unused = replaced(square, "NPOIN= 9", "NPOIN= 10");
  unused = replaced(unused, "1 1 8\n", "1 1 8\n7 7 9\n");
  CHECK(any_contains(read_from_text("a.su2", unused).warnings,
                     "a.su2: 1 nodes belong to no element"));
}

TEST_CASE("writing: unknown extensions are refused, targets are replaced whole") {
  const io::MeshFile square = io::read_mesh(test::test_data("square.su2"));
  const TemporaryFolder folder;
  CHECK_THROWS_AS(io::write_mesh(folder / "a.xyz", square.mesh, nullptr), UsageError);
  CHECK_THROWS_AS(io::write_mesh(folder / "no/such/a.su2", square.mesh, nullptr), OutputError);
  CHECK_THROWS_AS(io::write_mesh("/dev/full", square.mesh, nullptr,
                                 {.format = io::format_of_extension("a.su2"), .gmsh_version = ""}),
                  OutputError);
  io::write_mesh(folder / "a.su2", square.mesh, square.details.get());
  CHECK(read_text(folder / "a.su2") == read_text(test::test_data("square.su2")));
}

}  // namespace winslow::test
