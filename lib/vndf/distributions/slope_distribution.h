// What the builder must know of a slope distribution: its radial density p22(r) at unit roughness.
// The distribution is shape-invariant (Heitz and d'Eon 2014, equation 8), so every other roughness
// is a stretch of this one. A name and p22 are enough. The other functions are for densities that
// are not smooth everywhere, and for those whose integrals are known.
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

  /// The density per unit area of the slope plane at radius r >= 0, in any scale, because the
  /// builder normalises it. It must be >= 0, finite for r > 0, and smooth between breaks(). A build
  /// calls it some 1e7 times from several threads.
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
