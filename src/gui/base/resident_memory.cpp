#include "gui/base/resident_memory.h"

#include <cstdlib>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace winslow::gui {

void return_freed_memory() {
#if defined(__GLIBC__)
  // Saying a threshold also keeps glibc from raising it by itself, which it does to the size of
  // whatever is freed.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  mallopt(M_TRIM_THRESHOLD, 2 << 20);
#endif
}

}  // namespace winslow::gui
