// What the builder must be told of a slope distribution: its radial density p22(r) at unit
// roughness (Heitz and d'Eon 2014, equation 8: shape-invariant, so every other roughness is a
// stretch of it).
#pragma once

#include <string>

namespace vndf::precompute {

class SlopeDistribution {
 public:
  virtual ~SlopeDistribution() = default;

  /// A short name for people and files.
  virtual std::string name() const = 0;

  /// Density of slopes per unit of slope plane at radius r >= 0: finite, >= 0, smooth for r > 0.
  /// Any scale: the builder normalises it. It must be safe to call from several threads, and cheap:
  /// a build calls it some 1e7 times.
  virtual double p22(double r) const = 0;
};

}  // namespace vndf::precompute
