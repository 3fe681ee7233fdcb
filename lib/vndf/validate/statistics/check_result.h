// What a stage of the judge has to say: one statistic, its bound, and the place where it is worst.
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

struct Finding {
  std::string stage = {}, statistic = {};
  Kind kind = Kind::error;
  double measured = 0;
  double bound = 0;  ///< of a p-value: set for the whole run by the judge
  Place where = {};
  std::size_t tests = 0;  ///< of a p-value: how many were made
  std::string note = {};

  /// False for a measurement that is not a number.
  bool passed() const { return kind == Kind::error ? measured <= bound : measured >= bound; }
};

inline bool all_passed(const std::vector<Finding>& findings) {
  return std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.passed(); });
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

  Finding finding(std::string stage, std::string statistic, double bound) const {
    return {std::move(stage), std::move(statistic), Kind::error, measured, bound, where};
  }
};

}  // namespace vndf::validate
