#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "soak.h"

#if defined(__SANITIZE_ADDRESS__)
/// Freed memory held back for detection would look like growth, and so would the record of the call
/// stacks that have allocated: the system's libraries keep no frame pointers, so that most stacks
/// look new, 75 MB of them in six minutes. A report names the caller; to see more of the stack, run
/// the seed again with ASAN_OPTIONS=malloc_context_size=30.
extern "C" const char* __asan_default_options() {
  return "quarantine_size_mb=4:malloc_context_size=2";
}
#endif

namespace {

using namespace winslow::gui::test;

/// Growth of what is allocated while no studio is there, in bytes, that is none.
constexpr std::ptrdiff_t allowance = 1 << 20;

/// Growth of a running studio's resident memory that chance explains, bytes.
constexpr std::ptrdiff_t resident_allowance = 24 << 20;

double megabytes(auto bytes) { return static_cast<double>(bytes) / (1 << 20); }

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

void print_trail(const Soak& soak) {
  for (const auto& what : soak.trail()) std::fprintf(stderr, "  %s\n", what.c_str());
}

const Soak* running = nullptr;

/// A widget that a script expects and does not find, and the like.
void on_assert(const doctest::AssertData& data) {
  std::fprintf(stderr, "soak: %s:%d: %s failed\n", data.m_file, data.m_line, data.m_expr);
  if (running) print_trail(*running);
  std::exit(1);
}

int run(double seconds, std::uint64_t seed) {
  Soak soak(seed);
  running = &soak;
  const double start = now();
  double said = start;
  try {
    while (now() - start < seconds) {
      soak.step();
      if (now() - said < 60) continue;
      said = now();
      std::printf("soak: %4.0f s, %d operations, %.0f MB\n", said - start, soak.operations(),
                  megabytes(memory_now().resident));
      std::fflush(stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "soak: seed %llu, operation %d: %s\n",
                 static_cast<unsigned long long>(seed), soak.operations(), error.what());
    print_trail(soak);
    return 1;
  }
  const MemoryWatch& memory = soak.memory();
  const std::ptrdiff_t growth = memory.growth(&Memory::allocated);
  const std::ptrdiff_t resident = soak.running().growth(&Memory::resident);
  const bool good = growth <= allowance && resident <= resident_allowance;
  std::printf(
      "soak: seed %llu, %.0f s, %d operations, %d meshes opened, %d meshes compared bit by bit, %d "
      "crashes survived, %d ends\n"
      "soak: between studios %.2f MB allocated at first, %.2f MB at last, growth %+.2f MB over %zu "
      "samples; running, resident %.0f MB and %.0f MB, growth %+.1f MB over %zu samples: %s\n",
      static_cast<unsigned long long>(seed), now() - start, soak.operations(), soak.meshes(),
      soak.comparisons(), soak.restored(), soak.ended(), megabytes(memory.first().allocated),
      megabytes(memory.last().allocated), megabytes(growth), memory.count(),
      megabytes(soak.running().first().resident), megabytes(soak.running().last().resident),
      megabytes(resident), soak.running().count(), good ? "ok" : "MEMORY GROWS");
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 10;
  std::uint64_t seed = 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--seconds") == 0) {
      seconds = std::atof(argv[i + 1]);
    } else if (std::strcmp(argv[i], "--seed") == 0) {
      seed = std::strtoull(argv[i + 1], nullptr, 10);
    } else {
      std::fprintf(stderr, "usage: gui_soak [--seconds N] [--seed S]\n");
      return 2;
    }
  }
  doctest::Context context;
  context.setAsDefaultForAssertsOutOfTestCases();
  context.setAssertHandler(on_assert);
  return run(seconds, seed);
}
