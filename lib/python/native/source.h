// The distribution that tables are built from. A function of Python's is one that no specification
// names, so only the process that built the tables can make it again.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/provenance.h"

namespace vndf::python {

struct Source {
  Specification specification = {};
  /// What was found on the way, for people.
  std::string notes = {};
  /// That of the map that it is from.
  std::optional<SurfaceSlopes> surface = {};
  /// p22(r) as a Python function, if it is one, with its breaks and the name for people.
  std::shared_ptr<const pybind11::function> function = {};
  std::vector<double> breaks = {};
  std::string name = {};

  /// Makes the distribution. Throws std::invalid_argument and std::domain_error as
  /// distributions::make_distribution() does, and what the function throws.
  std::unique_ptr<distributions::SlopeDistribution> distribution() const;
  /// Threads for work that evaluates the distribution. A function of Python's holds the
  /// interpreter, so that more than one would only wait for each other.
  unsigned threads(unsigned wanted) const { return function ? 1 : wanted; }
};

/// Lets other threads of Python run, unless `source` is one of its functions and all work is done
/// on this thread: then each of some 1e7 calls would wait until they let go. They run while the
/// function does.
class ReleaseUnlessFunction {
 public:
  explicit ReleaseUnlessFunction(const Source& source);
  ~ReleaseUnlessFunction();
  ReleaseUnlessFunction(const ReleaseUnlessFunction&) = delete;
  ReleaseUnlessFunction& operator=(const ReleaseUnlessFunction&) = delete;

 private:
  std::unique_ptr<pybind11::gil_scoped_release> release_;
};

void add_sources(pybind11::module_& module);

}  // namespace vndf::python
