// What the builder must be told of a slope distribution: its radial density p22(r) at unit
// roughness (Heitz and d'Eon 2014, equation 8: shape-invariant, so every other roughness is a
// stretch of it). The name and p22 are enough; the rest is for densities that are not smooth
// everywhere and for those whose integrals are known.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace vndf::distributions {

/// Density P, upper tail Q and partial first moment M of one slope component (slope_integrals.h).
struct Marginals {
  double p, q, m;
};

class SlopeDistribution {
 public:
  virtual ~SlopeDistribution() = default;

  /// A short name for people and files.
  virtual std::string name() const = 0;

  /// Density of slopes per unit of slope plane at radius r >= 0: >= 0, finite for r > 0, smooth
  /// between breaks(). Any scale: the builder normalises it. It must be safe to call from several
  /// threads: a build calls it some 1e7 times.
  virtual double p22(double r) const = 0;

  /// Whether p22 takes more than some 50 ns. If so the builder interpolates it, to 1e-11.
  virtual bool costly() const { return false; }

  /// Radii > 0, increasing, at which p22 jumps or has a kink, support() among them if finite.
  virtual std::vector<double> breaks() const { return {}; }

  /// Radius beyond which p22 is 0.
  virtual double support() const { return std::numeric_limits<double>::infinity(); }

  /// P, Q and M at a slope x >= 0 where they are known in closed form, of p22 as it is.
  virtual std::optional<Marginals> marginals(double /*x*/) const { return {}; }
};

}  // namespace vndf::distributions
