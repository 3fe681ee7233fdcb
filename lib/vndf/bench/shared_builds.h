// Builds tables that several cases need once, when the first case asks for them.
#pragma once

#include <any>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <type_traits>

namespace vndf::bench {

/// A value, and how long it took to make.
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

/// Owns everything that it made. Only one thread may use it at a time.
class SharedBuilds {
 public:
  /// The result of the first `make` for `key`. A key must name everything that the result depends
  /// on, and always come with the same type of result.
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
