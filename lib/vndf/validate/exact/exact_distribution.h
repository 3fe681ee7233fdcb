// The exact distribution of sampled normals, as a transform to independent uniform numbers
// (Rosenblatt 1952) in polar coordinates of the stretched slopes:
//
//   w_r    the CDF of the radius r; 0 at the pole of the stretched hemisphere, 1 at its horizon
//   w_phi  the CDF of the azimuth given r, closed: with psi = pi - |phi|,
//          1/2 (cos t psi + r sin t sin psi) / (cos t psi0 + r sin t sin psi0) on the side phi > 0,
//          1 minus that on the other; the edge of visibility is in the middle
//
// Equal cells of the unit square are cells of equal probability on the hemisphere. Any sampler of
// the distribution must fill them evenly, whatever its map from random numbers. The table builder's
// own variable, w_x, the CDF of the Cartesian slope x, is checked beside them.
#pragma once

#include <memory>

#include "vndf/precompute/marginal_distribution.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/validate/exact/configuration.h"
#include "vndf/validate/exact/radial_distribution.h"

namespace vndf::validate {

/// Which normals a sampler claims to draw.
enum class SampledNormals {
  visible_smith,     ///< D_wi of Smith's surface (Heitz and d'Eon 2014, equation 2)
  visible_v_cavity,  ///< D_wi of V-cavities: weight min(dot(wi, wm)+, 2 wi.z wm.z) / wi.z
  all                ///< D(wm) wm.z, whatever wi (Algorithm 1)
};

/// A slope distribution with everything that its distributions at all configurations share.
class ExactSlopes {
 public:
  /// Integrates `distribution` (some 0.1 s). Throws std::domain_error as UnitSlopes does.
  explicit ExactSlopes(std::unique_ptr<const distributions::SlopeDistribution> distribution);

  const precompute::UnitSlopes& unit_slopes() const { return slopes_; }
  /// The distribution of the radius of all slopes.
  const RadialDistribution& all_radii() const { return all_radii_; }

  /// D(wm), Smith's Lambda(w) and G1(w), straight from their definitions.
  double d(const Vec3<double>& wm, const Alpha<double>& alpha) const;
  double lambda(const Vec3<double>& w, const Alpha<double>& alpha) const;
  double g1(const Vec3<double>& w, const Alpha<double>& alpha) const;
  /// w.z / G1(w): the projected area of the facets that face w, positive at the horizon too.
  double visible_area(const Vec3<double>& w, const Alpha<double>& alpha) const;

 private:
  std::unique_ptr<const distributions::SlopeDistribution> distribution_;
  precompute::UnitSlopes slopes_;
  RadialDistribution all_radii_;
};

/// A normal as a slope (x / w, y / w) in the frame of the stretched incident direction, in units of
/// the mean slope.
struct StretchedSlope {
  double x, y, w;
  double horizontal() const { return std::hypot(x, y); }
};

/// The frame of the stretched incident direction.
class StretchedFrame {
 public:
  StretchedFrame(const ExactSlopes& exact, const Configuration& configuration);

  /// Cotangent of the stretched incident direction.
  const BoundedSlope<double>& cotangent() const { return cotangent_; }
  StretchedSlope slope_of(const Vec3<double>& wm) const;
  /// Unit normal of a slope; inverse of slope_of().
  Vec3<double> normal_of(const StretchedSlope& slope) const;
  /// Density of slopes per density of normals: d(solid angle) / d(slope) at `wm`.
  double jacobian(const Vec3<double>& wm) const;

 private:
  double ax_, ay_, cos_, sin_;
  BoundedSlope<double> cotangent_;
};

/// The uniform numbers of one normal.
struct Uniforms {
  double r, phi, x;
};

/// Below this height wm.z of a single-precision normal has lost its relative precision or is 0:
/// where beyond it a slope lies cannot be carried. The twofold of the smallest normal number.
inline constexpr double kSmallestHeight = 2 * 0x1p-126;

/// For how many normals of one configuration a distribution is made.
enum class Use {
  many,  ///< the exact of the radius is tabulated first, some milliseconds
  few    ///< each radius is an integral of its own, some 10 microseconds
};

class ExactDistribution {
 public:
  /// `distribution` must outlive this object.
  ExactDistribution(const ExactSlopes& exact, SampledNormals kind,
                    const Configuration& configuration, Use use = Use::many);

  const StretchedFrame& frame() const { return frame_; }

  /// The transform of a unit normal, wm.z >= 0. A normal lower than kSmallestHeight is known to lie
  /// beyond a slope and no more: `v`, a uniform random number, places it in the mass that the
  /// distribution has there, so that this mass is checked and nothing is hidden (the randomised
  /// transform for distributions with atoms). Maximum error kRadialError, and the rounding of the
  /// normal.
  Uniforms uniforms(const Vec3<double>& wm, double v) const;

  /// Density per solid angle.
  double pdf(const Vec3<double>& wm) const;
  /// The density that `wm` would have if it faced wi: what the rounding of dot(wi, wm) is relative
  /// to.
  double facing_pdf(const Vec3<double>& wm) const;

 private:
  Probability<double> radius_cdf(const StretchedSlope& s) const;
  double azimuth_cdf(const StretchedSlope& s) const;
  double marginal_cdf(const StretchedSlope& s) const;
  /// Density of `wm` were it seen under `cosine`.
  double pdf_if_seen(const Vec3<double>& wm, double cosine) const;

  const ExactSlopes& exact_;
  SampledNormals kind_;
  Configuration configuration_;
  StretchedFrame frame_;
  double cosine_, sine_, area_;
  std::unique_ptr<const RadialDistribution> own_radii_;
  precompute::MarginalDistribution visible_;
};

}  // namespace vndf::validate
