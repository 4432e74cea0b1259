// libFuzzer target for the mesh readers. Build it with Clang:
//   cmake -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++-14 -DWINSLOW_BUILD_FUZZER=ON
//     -DWINSLOW_SANITIZE=address,undefined -DCMAKE_CXX_FLAGS=-fsanitize=fuzzer-no-link
//     -DWINSLOW_BUILD_GUI=OFF -DWINSLOW_BUILD_APP=OFF
//   cmake --build build/fuzz --target read_mesh_fuzzer
//   build/fuzz/tests/fuzz/read_mesh_fuzzer CORPUS_FOLDER tests/data
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/error.h"
#include "io/format/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A file in memory without an extension: its content alone decides the format.
  const int file = ::memfd_create("mesh", MFD_CLOEXEC);
  if (file < 0) return 0;
  const bool written = ::write(file, data, size) == static_cast<ssize_t>(size);
  try {
    if (written) winslow::io::read_mesh("/proc/self/fd/" + std::to_string(file));
  } catch (const winslow::InputError&) {
    // The only thing that a bad file may lead to.
  }
  ::close(file);
  return 0;
}
