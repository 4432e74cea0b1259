#include <doctest/doctest.h>

#include "support/sanitizers.h"

#ifdef WINSLOW_ADDRESS_SANITIZER
// HDF5 and libcgns do not give back all memory of files that turn out to be damaged.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\nleak:libcgns\n"; }
#endif
