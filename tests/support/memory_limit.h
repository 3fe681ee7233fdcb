// How much memory a file from a stranger may cost until it is refused.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>

namespace vndf::test {

inline constexpr std::size_t kMostRefusalBytes = 200'000'000;

/// Whether memory can be limited. A sanitizer takes memory of its own.
#ifdef VNDF_SANITIZED
inline constexpr bool kMemoryIsLimited = false;
#else
inline constexpr bool kMemoryIsLimited = true;
#endif

/// While it lives, this process can take only so many bytes more.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::size_t bytes) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before_);
    const rlimit limit{pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + bytes,
                       before_.rlim_max};
    if (kMemoryIsLimited) setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit() {
    if (kMemoryIsLimited) setrlimit(RLIMIT_AS, &before_);
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

/// Calls `read` with so much memory.
template <class Read>
void within_limits(std::size_t bytes, const Read& read) {
  const MemoryLimit limit(bytes);
  read();
}

}  // namespace vndf::test
