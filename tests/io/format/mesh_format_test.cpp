#include "io/format/mesh_format.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "io/support/samples.h"

namespace winslow::test {

TEST_CASE("every format has a name and a title of its own, and is found by its extension") {
  std::set<std::string_view> names, titles;
  for (const io::MeshFormat* format : io::mesh_formats()) {
    CAPTURE(format->name);
    CHECK(names.insert(format->name).second);
    CHECK(titles.insert(format->title).second);
    CHECK(io::format_of_extension("folder.x/mesh." + std::string(format->name)) == format);
    CHECK(io::supported_extensions().find('.' + std::string(format->name)) != std::string::npos);
    CHECK((io::binary_formats().find(format->title) != std::string::npos) == format->has_binary);
  }
  CHECK(io::format_of_extension("mesh.SU2")->name == "su2");
  CHECK(io::format_of_extension("mesh") == nullptr);
  CHECK(io::format_of_extension("mesh.xyz") == nullptr);
}

TEST_CASE("a content is that of the format with the strongest evidence") {
  const auto name_of = [](const std::string& content) {
    const io::MeshFormat* format = io::format_of_content(content);
    return format ? std::string(format->name) : "none";
  };
  CHECK(name_of("hello\n") == "none");
  CHECK(name_of("\xEF\xBB\xBF \r\n$MeshFormat\n") == "msh");
  CHECK(name_of("solid ring\n") == "stl");
  // A signature on the first line counts more than keywords further down.
  CHECK(name_of("OFF\nv 1 2 3\n") == "off");
  // Of two keywords the first.
  CHECK(name_of("# made by hand\nv 0 0 0\nNDIME= 2\n") == "obj");
  CHECK(name_of("% made by hand\nNDIME= 2\nv 0 0 0\n") == "su2");
  // The size of a binary STL counts more than what its header says.
  std::string stl = "solid OFF\n" + std::string(84 - 10, ' ');
  stl[80] = 1;
  stl[81] = stl[82] = stl[83] = 0;
  CHECK(name_of(stl + std::string(50, '\0')) == "stl");
  CHECK(name_of("OFF\n" + stl.substr(4) + std::string(50, '\0')) == "stl");
}

}  // namespace winslow::test
