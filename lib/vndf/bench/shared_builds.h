// Tables that several cases stand on: each is built when the first of them asks, and only then.
#pragma once

#include <any>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <type_traits>

namespace vndf::bench {

/// Something that took a while to make.
template <class T>
struct Built {
  T value;
  double seconds = 0;  ///< of wall-clock time
};

/// What `make` returns, timed.
template <class Make>
auto timed(const Make& make) {
  const auto start = std::chrono::steady_clock::now();
  Built<std::invoke_result_t<const Make&>> built{make()};
  built.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return built;
}

/// Keeps what it made until it is destroyed. Not for two threads at a time.
class SharedBuilds {
 public:
  /// What `make` returned when `key` was asked for first. A key names all that the result depends
  /// on; it stands for one type.
  template <class Make>
  auto get(const std::string& key, const Make& make) {
    using Result = Built<std::invoke_result_t<const Make&>>;
    std::any& made = made_[key];
    if (!made.has_value()) made = std::make_shared<const Result>(timed(make));
    return std::any_cast<std::shared_ptr<const Result>>(made);
  }

 private:
  std::map<std::string, std::any> made_;
};

}  // namespace vndf::bench
