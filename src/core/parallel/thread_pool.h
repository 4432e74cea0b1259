#pragma once

#include "core/index.h"

namespace winslow {

/// Calls work(0), ..., work(count - 1), each once, on this thread and on threads that the process
/// keeps for this, and returns when all have returned. Any number of threads may call it at once,
/// also from within work. work must not throw. Where no thread is free or to be had, the calling
/// one does the work of all.
void run_on_threads(Index count, void (*work)(void* data, Index share), void* data);

/// The same for anything that can be called.
template <typename Work>
void run_on_threads(Index count, const Work& work) {
  run_on_threads(
      count, [](void* data, Index share) { (*static_cast<const Work*>(data))(share); },
      const_cast<Work*>(&work));
}

}  // namespace winslow
