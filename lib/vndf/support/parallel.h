// Runs independent pieces of work on several threads. Each piece writes its own results only, so
// that tables do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace vndf::support {

/// How much of the machine to use and whom to tell about progress.
struct Workers {
  /// Threads to run; 0 means one for each processor.
  unsigned threads = 0;
  /// Called with the numbers of finished and of all pieces after each piece, from one thread at a
  /// time; may be empty.
  std::function<void(std::size_t done, std::size_t count)> progress = {};
};

/// Returns workers that report their pieces as those of part `index` of `parts`, which take equally
/// long. So work that is done part by part has one progress.
Workers part_of(const Workers& workers, std::size_t index, std::size_t parts);

/// Calls `piece(i)` once for every i in [0, count). If pieces throw, the first exception caught is
/// rethrown after all threads have stopped; pieces not yet begun are skipped.
void parallel_for(std::size_t count, const Workers& workers,
                  const std::function<void(std::size_t)>& piece);

}  // namespace vndf::support
