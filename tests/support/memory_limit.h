// What a file from a stranger may cost until it is refused.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <fstream>

#include "support/catch.h"

namespace vndf::test {

inline constexpr double kMostRefusalSeconds = 1;
inline constexpr std::size_t kMostRefusalBytes = 200'000'000;

/// While it lives, this process can take only so many bytes more.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::size_t bytes) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before_);
    const rlimit limit{pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + bytes,
                       before_.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

/// Calls `read` with so much memory, and checks that it takes no more time than a refusal may.
template <class Read>
void within_limits(std::size_t bytes, const Read& read) {
  const MemoryLimit limit(bytes);
  const auto begin = std::chrono::steady_clock::now();
  read();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  CHECK(time.count() < kMostRefusalSeconds);
}

}  // namespace vndf::test
