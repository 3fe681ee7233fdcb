// Threads take the next piece until none is left. The calling thread works too.
#include "vndf/support/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace vndf::support {

Workers part_of(const Workers& workers, std::size_t index, std::size_t parts) {
  if (!workers.progress) return workers;
  return {workers.threads,
          [progress = workers.progress, index, parts](std::size_t done, std::size_t count) {
            progress(index * count + done, parts * count);
          }};
}

void parallel_for(std::size_t count, const Workers& workers,
                  const std::function<void(std::size_t)>& piece) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;  // of done, failure and the calls of progress
  std::size_t done = 0;
  std::exception_ptr failure;

  const auto work = [&] {
    for (std::size_t i; (i = next.fetch_add(1)) < count;) {
      try {
        piece(i);
        const std::lock_guard lock(mutex);
        ++done;
        if (workers.progress) workers.progress(done, count);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };

  const unsigned wanted =
      workers.threads > 0 ? workers.threads : std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> threads;
  for (std::size_t t = 1; t < std::min<std::size_t>(wanted, count); ++t) threads.emplace_back(work);
  work();
  threads.clear();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace vndf::support
