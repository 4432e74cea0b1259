#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "soak.h"
#include "support/sanitizers.h"

#ifdef WINSLOW_ADDRESS_SANITIZER
/// Freed memory held back for detection would look like growth, and so would the record of the call
/// stacks that have allocated: the system's libraries keep no frame pointers, so that most stacks
/// look new, 75 MB of them in six minutes. A report names the caller; to see more of the stack, run
/// the seed again with ASAN_OPTIONS=malloc_context_size=30.
/// What else is there: cmake/sanitizer_options.cpp.
extern "C" const char* __asan_default_options() {
  return "quarantine_size_mb=4:malloc_context_size=2:intercept_tls_get_addr=0";
}
#endif

namespace {

using namespace winslow::gui::test;

/// Growth of what is allocated, without a studio or in one that shows a certain mesh, in bytes,
/// that is none.
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

void write_samples(const Soak& soak, const std::string& file) {
  std::ofstream out(file);
  out << "where,allocated,resident\n";
  for (const auto& [where, watch] :
       {std::pair{"between studios", &soak.memory()}, std::pair{"running", &soak.running()}})
    for (const Memory& m : watch->samples())
      out << where << ',' << m.allocated << ',' << m.resident << '\n';
}

/// Says how a memory went; false if it grew by more than `allowed` bytes.
bool judge(const char* what, const MemoryWatch& watch, std::size_t Memory::*of,
           std::ptrdiff_t allowed) {
  const std::ptrdiff_t growth = watch.growth(of);
  std::printf(
      "soak: %s: %.2f MB at first, %.2f MB at last, growth %+.2f MB (at most %.0f) over %zu "
      "samples: %s\n",
      what, megabytes(watch.first().*of), megabytes(watch.last().*of), megabytes(growth),
      megabytes(allowed), watch.count(), growth <= allowed ? "ok" : "GROWS");
  return growth <= allowed;
}

int run(double seconds, std::uint64_t seed, const std::string& samples) {
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
  if (!samples.empty()) write_samples(soak, samples);
  std::printf(
      "soak: seed %llu, %.0f s, %d operations, %d meshes opened, %d meshes compared bit by bit, %d "
      "crashes survived, %d ends\n",
      static_cast<unsigned long long>(seed), now() - start, soak.operations(), soak.meshes(),
      soak.comparisons(), soak.restored(), soak.ended());
  bool good = judge("allocated between studios", soak.memory(), &Memory::allocated, allowance);
  good &= judge("allocated in a studio", soak.running(), &Memory::allocated, allowance);
  good &= judge("resident in a studio", soak.running(), &Memory::resident, resident_allowance);
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 10;
  std::uint64_t seed = 1;
  std::string samples;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--seconds") == 0) {
      seconds = std::atof(argv[i + 1]);
    } else if (std::strcmp(argv[i], "--seed") == 0) {
      seed = std::strtoull(argv[i + 1], nullptr, 10);
    } else if (std::strcmp(argv[i], "--samples") == 0) {
      samples = std::filesystem::absolute(argv[i + 1]);  // the soak works in a folder of its own
    } else {
      std::fprintf(stderr, "usage: gui_soak [--seconds N] [--seed S] [--samples FILE.csv]\n");
      return 2;
    }
  }
  doctest::Context context;
  context.setAsDefaultForAssertsOutOfTestCases();
  context.setAssertHandler(on_assert);
  return run(seconds, seed, samples);
}
