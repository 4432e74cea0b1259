#include "io/tables/displacement_file.h"

#include "io/support/files.h"

namespace winslow::test {
namespace {

DisplacementTable read(const std::string& text) {
  const TemporaryFolder folder;
  write_text(folder / "d.csv", text);
  return io::read_displacements(folder / "d.csv");
}

std::string error(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(what.find("d.csv"));
  }
  return "no error";
}

}  // namespace

TEST_CASE("displacements: a byte order mark is no part of the first name; Fortran's exponents") {
  const DisplacementTable table = read("\xEF\xBB\xBFnode,dx,dy\r\n7,0.5D0,-1.0D-03\r\n");
  REQUIRE(table.entries.size() == 1);
  CHECK(table.entries[0].node == 7);
  CHECK(table.entries[0].displacement == Vec2(0.5, -1e-3));
}

TEST_CASE("displacements: columns by name, by number, with any separator") {
  const DisplacementTable a = read("# moved\nnode,dx,dy\n7,0.5,-1e-3\n\n8,+1,2\n");
  REQUIRE(a.entries.size() == 2);
  CHECK(a.entries[0].node == 7);
  CHECK(a.entries[0].displacement == Vec2(0.5, -1e-3));
  CHECK(a.entries[0].line == 3);
  CHECK(a.entries[1].line == 5);
  CHECK_CONTAINS(a.source, "d.csv");

  const DisplacementTable b = read("\"dy\";\"X\";\"y\";\"dz\";\"dx\"\r\n4;1;2;0;3\r\n");
  REQUIRE(b.entries.size() == 1);
  CHECK_FALSE(b.entries[0].node.has_value());
  CHECK(b.entries[0].position == Vec2(1, 2));
  CHECK(b.entries[0].displacement == Vec2(3, 4));

  CHECK(read("3 0.1 0.2").entries[0].node == 3);
  CHECK(read("1\t2\t 0.1  0.2 # wall\n").entries[0].position == Vec2(1, 2));
  CHECK(read("1 , 2, 0.1 ,0.2\n").entries[0].displacement == Vec2(0.1, 0.2));
}

TEST_CASE("displacements: z and dz by name, and six columns without names") {
  const DisplacementTable named = read("dz,node,dx,dy\n3,7,1,2\n");
  CHECK(named.entries[0].displacement == Vec3(1, 2, 3));
  CHECK(named.entries[0].displacement.numbers(0) == 3);
  CHECK(named.entries[0].position.numbers(0) == 2);
  for (const char* text : {"x,y,z,dx,dy,dz\n1,2,3,4,5,6\n", "1 2 3 4 5 6\n"}) {
    const DisplacementEntry entry = read(text).entries[0];
    CHECK(entry.position == Vec3(1, 2, 3));
    CHECK(entry.position.numbers(0) == 3);
    CHECK(entry.displacement == Vec3(4, 5, 6));
    CHECK(entry.displacement.numbers(0) == 3);
  }
  CHECK(read("1,2,0.1,0.2\n").entries[0].displacement.numbers(0) == 2);
  CHECK_CONTAINS(error("node,dx,dy,dz\n1,2,3,far\n"), "d.csv:2: found 'far'");
  CHECK_CONTAINS(error("node,dx,dy,dz,dz\n1,2,3,4,5\n"), "d.csv:1: found other columns");
  CHECK_CONTAINS(error("1,2,3,4,5\n"), "d.csv:1: found 5 columns");
}

TEST_CASE("displacements: bad files are refused with the line") {
  CHECK_CONTAINS(error("node,dx,dy\n1,2\n"), "d.csv:2: found 2 columns, expected 3");
  CHECK_CONTAINS(error("node,dx,dy\n1,2,x\n"), "d.csv:2: found 'x', expected a finite number");
  CHECK_CONTAINS(error("node,dx,dy\n1,2,nan\n"), "d.csv:2: found 'nan'");
  CHECK_CONTAINS(error("node,dx,dy\n1,,2\n"), "d.csv:2: found an empty field");
  CHECK_CONTAINS(error("node,dx,dy\n1,2,\n"), "d.csv:2: found an empty field");
  CHECK_CONTAINS(error("node,dx,dy\n-1,2,3\n"), "d.csv:2: found '-1'");
  CHECK_CONTAINS(error("1.5,2,3\n"), "d.csv:1: found '1.5', expected the number of a node");
  CHECK_CONTAINS(error("1,2\n"),
                 "d.csv:1: found 2 columns, expected 3 (node,dx,dy), 4 (x,y,dx,dy) or 6");
  CHECK_CONTAINS(error("a,b,c\n1,2,3\n"), "d.csv:1: found other columns");
  CHECK_CONTAINS(error("node,x,dx,dy\n"), "d.csv:1: found other columns");
  CHECK_CONTAINS(error("node,dx,dy\n"), "found no displacement");
  CHECK_CONTAINS(error(""), "found an empty file");
}

}  // namespace winslow::test
