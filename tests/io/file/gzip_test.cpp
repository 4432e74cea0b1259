#include "io/file/gzip.h"

#include <sstream>

#include "core/error.h"
#include "io/file/atomic_file.h"
#include "io/support/samples.h"
#include "io/tables/table_files.h"

namespace winslow::test {
namespace {

std::string compressed(const std::string& text) {
  const TemporaryFolder folder;
  io::write_atomically(folder / "a.gz", [&](std::ostream& out) { out << text; });
  return read_text(folder / "a.gz");
}

}  // namespace

TEST_CASE("gzip: what is compressed comes back, also of several parts") {
  std::string text;
  for (long i = 0; i < 200000; ++i) text += std::to_string(i * i % 977) + "\n";
  const std::string packed = compressed(text);
  CHECK(io::is_gzip(packed));
  CHECK(packed.size() < text.size() / 2);
  CHECK(io::gunzip(packed, "a.gz") == text);
  CHECK(io::gunzip(packed + compressed("more"), "a.gz") == text + "more");
  CHECK(io::gunzip(compressed(""), "a.gz").empty());
}

TEST_CASE("gzip: damaged data and data made to fill the memory are refused") {
  const std::string packed = compressed(std::string(100000, 'x') + "end");
  CHECK_THROWS_WITH_AS(io::gunzip(packed.substr(0, packed.size() / 2), "a.gz"),
                       "a.gz: found the end of the compressed data, expected more of it",
                       InputError);
  std::string damaged = packed;
  damaged[12] = static_cast<char>(damaged[12] ^ 0x55);
  CHECK_THROWS_AS(io::gunzip(damaged, "a.gz"), InputError);
  const std::string bomb = compressed(std::string(std::size_t{70} << 20, '0'));
  CHECK_THROWS_WITH_AS(io::gunzip(bomb, "a.gz"), doctest::Contains("200 times its size"),
                       InputError);
}

TEST_CASE("gzip: every format is read and written compressed") {
  Random random(5);
  const Mesh mesh = make_mesh(shuffled_mesh(random, false));
  const TemporaryFolder folder;
  for (const Kind& kind : kinds()) {
    CAPTURE(text_of(kind));
    const std::string name = std::string("m.") + kind.extension;
    io::write_mesh(folder / name, mesh, nullptr, options_of(kind));
    io::write_mesh(folder / (name + ".gz"), mesh, nullptr, options_of(kind));
    const std::string packed = read_text(folder / (name + ".gz"));
    REQUIRE(io::is_gzip(packed));
    CHECK(io::gunzip(packed, name) == read_text(folder / name));
    const io::MeshFile file = io::read_mesh(folder / (name + ".gz"));
    CHECK_FALSE(any_contains(file.warnings, "the content is that of"));
    check_same_mesh(file.mesh, io::read_mesh(folder / name).mesh);
  }
}

TEST_CASE("gzip: tables, too") {
  const TemporaryFolder folder;
  io::write_atomically(folder / "d.csv.gz", [](std::ostream& out) { out << "3,0.5,0\n"; });
  CHECK(io::read_displacements(folder / "d.csv.gz").entries.size() == 1);
}

}  // namespace winslow::test
