// What a check of the validator has to say: one statistic, its bound, and the place where it is
// worst.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// How `measured` is to be compared with `bound`.
enum class Kind {
  error,       ///< an error, which must not be larger
  probability  ///< the smallest p-value of `tests` independent tests, which must not be smaller
};

struct CheckResult {
  std::string check = {}, statistic = {};
  Kind kind = Kind::error;
  double measured = 0;
  double bound = 0;  ///< of a p-value: set for the whole run by the validator
  Place where = {};
  std::size_t tests = 0;  ///< of a p-value: how many were made
  std::string note = {};

  /// False for a measurement that is not a number.
  bool passed() const { return kind == Kind::error ? measured <= bound : measured >= bound; }
};

inline bool all_passed(const std::vector<CheckResult>& results) {
  return std::all_of(results.begin(), results.end(),
                     [](const CheckResult& f) { return f.passed(); });
}

/// The largest of several errors and where it was; what is not a number is larger than any.
struct Worst {
  double measured = 0;
  Place where = {};

  void see(double error, const Place& place) {
    if (!(error <= measured) && !std::isnan(measured)) {
      measured = error;
      where = place;
    }
  }
  void see(const Worst& other) { see(other.measured, other.where); }

  CheckResult result(std::string check, std::string statistic, double bound) const {
    return {std::move(check), std::move(statistic), Kind::error, measured, bound, where};
  }
};

}  // namespace vndf::validate
