#pragma once
#include <string>

// Where the files are that tests read:
//
//   read_mesh(test_data("square.su2"));      // tests/data/square.su2 of the sources
//   read_mesh(assets("coarse/circle.su2"));  // assets/coarse/circle.su2
//
// Only a source that CMake writes has the path: what is compiled from the tests is the same in
// every clone, so that ccache finds it.
namespace winslow::test {

/// The folder of the sources.
const char* sources();

inline std::string test_data(const std::string& name) {
  return std::string(sources()) + "/tests/data/" + name;
}

/// Without a name: the folder.
inline std::string assets(const std::string& name = "") {
  return std::string(sources()) + "/assets" + (name.empty() ? "" : "/" + name);
}

}  // namespace winslow::test
