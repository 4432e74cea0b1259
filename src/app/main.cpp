#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "app/program.h"

namespace {

/// Memory that is freed stays with the program, up to a limit, for the next who asks. Every
/// iteration takes arrays of megabytes and frees them; got anew from the system each time, as by
/// default, they cost a tenth to a quarter of a run on a surface of 100,000 triangles, most of it
/// while one thread works.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int most_of_one = 32 << 20, most_kept = 256 << 20;  // bytes
  mallopt(M_MMAP_THRESHOLD, most_of_one);
  mallopt(M_TRIM_THRESHOLD, most_kept);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  return static_cast<int>(winslow::app::run_program(argc, argv));
}
