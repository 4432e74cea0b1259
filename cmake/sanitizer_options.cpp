// Options of AddressSanitizer that every program of a sanitized build starts with.

// In GCC up to 13 and Clang 14, LeakSanitizer takes a block of thread-local storage that happens to
// begin 16 bytes into a page for one of glibc before 2.25, reads a size in front of it that is none,
// and dies ("Tracer caught signal 11") instead of looking for leaks: now and then, after a program
// whose libraries (Mesa's) were loaded late. Without the interceptor it leaves such blocks alone; see
// https://github.com/Mudlet/Mudlet/pull/9930.
#ifndef WINSLOW_OWN_SANITIZER_OPTIONS  // of a program that names this one among its own
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "intercept_tls_get_addr=0"; }
#endif
