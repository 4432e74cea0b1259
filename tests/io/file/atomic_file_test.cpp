#include "io/file/atomic_file.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iterator>
#include <stdexcept>

#include "io/support/files.h"

namespace winslow::test {
namespace {

namespace fs = std::filesystem;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

void write_hello(const fs::path& path) {
  io::write_atomically(path, [](std::ostream& out) { out << "hello"; });
}

}  // namespace

TEST_CASE("a file is written whole, and no other is left in the folder") {
  const TemporaryFolder folder;
  write_hello(folder / "a");
  CHECK(read_text(folder / "a") == "hello");
  const std::string large(1000000, 'x');
  io::write_atomically(folder / "a", [&](std::ostream& out) { out << large; });
  CHECK(read_text(folder / "a") == large);
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("when writing fails the target is as it was") {
  const TemporaryFolder folder;
  write_text(folder / "a", "before");
  CHECK_THROWS_AS(io::write_atomically(folder / "a",
                                       [](std::ostream& out) {
                                         out << "half";
                                         throw std::runtime_error("no");
                                       }),
                  std::runtime_error);
  CHECK(read_text(folder / "a") == "before");
  CHECK_THROWS_AS(
      io::write_atomically(folder / "a", [](std::ostream& out) { out.setstate(std::ios::badbit); }),
      OutputError);
  CHECK(read_text(folder / "a") == "before");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a name may be as long as names can be") {
  const TemporaryFolder folder;
  const std::string longest(255, 'n');
  write_hello(folder / longest);
  CHECK(read_text(folder / longest) == "hello");
  CHECK_THROWS_AS(write_hello(folder / (longest + "n")), OutputError);
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("what a killed program left is removed by the next write of that name, by no other") {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    io::write_atomically(folder / "a", [](std::ostream&) { ::_exit(0); });
    ::_exit(1);
  }
  int status = 1;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(status == 0);
  CHECK(files_in(folder.path()) == 1);
  write_hello(folder / "b");
  CHECK(files_in(folder.path()) == 2);
  write_hello(folder / "a");
  CHECK(files_in(folder.path()) == 2);
  CHECK(read_text(folder / "a") == "hello");
}

TEST_CASE("a file that is being written is no orphan") {
  const TemporaryFolder folder;
  io::write_atomically(folder / "a", [&](std::ostream& out) {
    out << "outer";
    write_hello(folder / "a");
    CHECK(read_text(folder / "a") == "hello");
  });
  CHECK(read_text(folder / "a") == "outer");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("writers of one file at the same time all succeed, and one of them wins") {
  const TemporaryFolder folder;
  constexpr int writers = 8, files_each = 200;
  std::vector<pid_t> children;
  for (int k = 0; k < writers; ++k) {
    const pid_t child = ::fork();
    if (child == 0) {
      const std::string text(1000, static_cast<char>('a' + k));
      try {
        for (int i = 0; i < files_each; ++i)
          io::write_atomically(folder / "a", [&](std::ostream& out) { out << text; });
      } catch (const std::exception&) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
  }
  const std::string text = read_text(folder / "a");
  CHECK(text == std::string(1000, text.empty() ? ' ' : text[0]));
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("of files that belong together none is replaced unless all are written") {
  const TemporaryFolder folder;
  write_text(folder / "a", "old a");
  write_text(folder / "b", "old b");
  write_text(folder / "b.gz", "to go");
  std::vector<io::OutputFile> files{
      {folder / "a", [](std::ostream& out) { out << "new a"; }},
      {folder / "b", [](std::ostream&) { throw OutputError("no"); }, {folder / "b.gz"}}};
  CHECK_THROWS_AS(io::write_atomically(files), OutputError);
  CHECK(read_text(folder / "a") == "old a");
  CHECK(read_text(folder / "b") == "old b");
  CHECK(files_in(folder.path()) == 3);
  files[1].write = [](std::ostream& out) { out << "new b"; };
  io::write_atomically(files);
  CHECK(read_text(folder / "a") == "new a");
  CHECK(read_text(folder / "b") == "new b");
  CHECK(files_in(folder.path()) == 2);
}

TEST_CASE("a full disk is an error that says so") {
  try {
    io::write_atomically("/dev/full", [](std::ostream& out) { out << "hello"; });
    FAIL("no error");
  } catch (const OutputError& error) {
    CHECK_CONTAINS(error.what(), "No space left on device");
  }
}

TEST_CASE("permissions are kept, links are followed, folders and bad places refused") {
  const TemporaryFolder folder;
  write_text(folder / "a", "before");
  REQUIRE(::chmod((folder / "a").c_str(), 0640) == 0);
  fs::create_symlink("a", folder / "link");
  write_hello(folder / "link");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(read_text(folder / "a") == "hello");
  CHECK((fs::status(folder / "a").permissions() & fs::perms::mask) == fs::perms(0640));
  CHECK_THROWS_AS(write_hello(folder.path()), OutputError);
  CHECK_THROWS_AS(write_hello(folder / "none/a"), OutputError);
  if (::geteuid() != 0) {  // root may write everywhere
    REQUIRE(::chmod((folder / "a").c_str(), 0440) == 0);
    CHECK_THROWS_AS(write_hello(folder / "a"), OutputError);
  }
}

TEST_CASE("a new file has the permissions that any program would give it") {
  const TemporaryFolder folder;
  write_hello(folder / "a");
  write_text(folder / "b", "");
  CHECK(fs::status(folder / "a").permissions() == fs::status(folder / "b").permissions());
}

}  // namespace winslow::test
