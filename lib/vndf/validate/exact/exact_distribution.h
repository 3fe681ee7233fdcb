// The exact distribution of sampled normals, as a transform of each normal to independent uniform
// numbers (Rosenblatt 1952) in polar coordinates of the stretched slopes:
//
//   w_r    the CDF of the radius r: 0 at the pole of the stretched hemisphere, 1 at its horizon
//   w_phi  the CDF of the azimuth given r, in closed form: with psi = pi - |phi|,
//          1/2 (cos t psi + r sin t sin psi) / (cos t psi0 + r sin t sin psi0) on the side phi > 0
//          and 1 minus that on the other, so that the edge of visibility is in the middle
//
// Equal cells of the unit square are then cells of equal probability on the hemisphere. Any sampler
// of the distribution must fill them equally, whatever its map from random numbers is. A third
// number, w_x, is the CDF of the Cartesian slope x, in which the tables are built.
//
// The validator must not repeat a mistake of the table builder, so w_r and w_phi are its own:
// neither the builder's CDFs nor its root finding occur in them. Three things are shared.
//
//   distributions::SlopeDistribution   p22(r), which defines what is right. A wrong formula there
//                                      is a right sampler of another distribution.
//   precompute::UnitSlopes             the mean slope, by which both scale; Q, M and the projected
//                                      area of backfacing slopes, in Lambda and in radial_cdf().
//                                      Tests compare them with closed forms and with reference
//                                      values of another program, and the area with the polar one
//                                      (RadialDistribution::visible_area()), to 1e-9.
//   precompute::MarginalDistribution   w_x, because the u-error is stated for the slope x. Tests
//                                      compare it with reference values and with integrals of the
//                                      density over cells. A sampler that agrees with a wrong w_x
//                                      has a wrong distribution of (r, phi) too, which determines
//                                      that of x, and fails the counts of w_r and w_phi.
#pragma once

#include <memory>

#include "vndf/precompute/marginal_distribution.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/validate/exact/configuration.h"
#include "vndf/validate/exact/radial_distribution.h"

namespace vndf::validate {

/// The normals that a sampler claims to draw.
enum class SampledNormals {
  visible_smith,     ///< D_wi of Smith's surface (Heitz and d'Eon 2014, equation 2)
  visible_v_cavity,  ///< D_wi of V-cavities: weight min(dot(wi, wm)+, 2 wi.z wm.z) / wi.z, where
                     ///< wi.z stands for Configuration::height()
  all                ///< D(wm) wm.z, whatever wi (Algorithm 1)
};

/// A slope distribution with what its normals have in common at all configurations. It is made once
/// and shared by all samplers of one distribution.
class ExactSlopes {
 public:
  /// Integrates `distribution`, which takes some 0.1 s. Throws std::domain_error, as
  /// precompute::UnitSlopes does, where its slopes have no finite mass or mean.
  explicit ExactSlopes(std::unique_ptr<const distributions::SlopeDistribution> distribution);

  /// The slopes in units of their mean.
  const precompute::UnitSlopes& unit_slopes() const { return slopes_; }
  /// The distribution of the radius of all slopes, visible or not.
  const RadialDistribution& all_radii() const { return all_radii_; }

  /// D(wm) per solid angle of a surface; 0 for wm.z <= 0. `wm` is a unit vector.
  double d(const Vec3<double>& wm, const ExactSurface& surface) const;
  /// Smith's Lambda(w) and G1(w) of the unit vector w, or of its mirror where w is below the
  /// surface, from their definitions. They are relative to the mean facet: w.z is
  /// ExactSurface::height(w). Along the surface Lambda is infinite and G1 is 0.
  double lambda(const Vec3<double>& w, const ExactSurface& surface) const;
  double g1(const Vec3<double>& w, const ExactSurface& surface) const;
  /// The projected area of the facets that face w, a unit vector on either side of the surface:
  /// w.z / G1(w) above it.
  double visible_area(const Vec3<double>& w, const ExactSurface& surface) const;
  /// The same per length of the stretched direction, in units of the mean slope, so that it does
  /// not depend on roughness: sin t E[(cot t - X)+] at the angle t of that direction.
  double unit_visible_area(const Vec3<double>& w, const ExactSurface& surface) const;

 private:
  std::unique_ptr<const distributions::SlopeDistribution> distribution_;
  precompute::UnitSlopes slopes_;
  RadialDistribution all_radii_;
};

/// By how much the stretch of a surface multiplies roundings of dot(wi, wm): by 1 + alpha mu where
/// it is flat, with mu = E|X| at unit roughness. To that are added the length of the mean slope
/// and, where a sampler shears, the correlation times the ratio of the roughnesses.
double facing_stretch(const ExactSlopes& exact, const Configuration& configuration);

/// The slope (x / w, y / w) of a normal in the frame of the stretched incident direction, in units
/// of the mean slope. It is kept as a fraction because w is 0 at the horizon.
struct StretchedSlope {
  double x, y, w;
  double horizontal() const { return std::hypot(x, y); }
};

/// The frame in which the stretched incident direction has no y: there slopes of every surface and
/// azimuth have one distribution for each cotangent. Where the stretched direction is vertical, the
/// slope x of the frame is that along the x axis of the surface.
class StretchedFrame {
 public:
  StretchedFrame(const ExactSlopes& exact, const Configuration& configuration);

  /// Cotangent of the stretched incident direction.
  const BoundedSlope<double>& cotangent() const { return cotangent_; }
  /// The slope of the unit normal `wm`.
  StretchedSlope slope_of(const Vec3<double>& wm) const;
  /// The unit normal of a slope, the inverse of slope_of().
  Vec3<double> normal_of(const StretchedSlope& slope) const;
  /// By how much `slope` changes for each part of 1 by which the slopes of a normal are rounded.
  double rounding(const StretchedSlope& slope) const;
  /// d(solid angle) / d(slope) at `wm`: the density of slopes is that of normals times this.
  double jacobian(const Vec3<double>& wm) const;

 private:
  ExactSurface surface_;
  double mean_slope_, cos_, sin_;
  BoundedSlope<double> cotangent_;
};

/// The uniform numbers w_r, w_phi and w_x of one normal, in [0, 1].
struct Uniforms {
  double r, phi, x;
};

/// The smallest height wm.z from which a slope follows, twice the smallest normal number of single
/// precision. A lower one has lost its relative precision or is 0, and tells only that the slope is
/// beyond.
inline constexpr double kSmallestHeight = 2 * 0x1p-126;

/// For how many normals of one configuration an ExactDistribution is made.
enum class Use {
  many,  ///< the CDF of the radius is tabulated first, which takes some milliseconds
  few    ///< each radius is an integral of its own, of some 10 microseconds
};

/// The exact distribution of the normals of `kind` at one configuration, of Smith's model from
/// below the surface too where something is visible.
class ExactDistribution {
 public:
  /// `exact` must outlive this object.
  ExactDistribution(const ExactSlopes& exact, SampledNormals kind,
                    const Configuration& configuration, Use use = Use::many);

  const StretchedFrame& frame() const { return frame_; }

  /// The transform of a unit normal with wm.z >= 0. A normal lower than kSmallestHeight is only
  /// known to lie beyond a slope. The uniform random number `v` then places it in the mass that the
  /// distribution has there, so that this mass is counted too (the randomised transform of
  /// distributions with atoms). Maximum error: kRadialError and the rounding of the normal.
  Uniforms uniforms(const Vec3<double>& wm, double v) const;

  /// The density of normals per solid angle at the unit vector `wm`; 0 where it is not seen.
  double pdf(const Vec3<double>& wm) const;
  /// The density that `wm` would have if it faced wi. An error of the density is told relative to
  /// it, because dot(wi, wm) is rounded by a part of 1, not of itself.
  double facing_pdf(const Vec3<double>& wm) const;

 private:
  Probability<double> radius_cdf(const StretchedSlope& s) const;
  double azimuth_cdf(const StretchedSlope& s) const;
  double marginal_cdf(const StretchedSlope& s) const;
  /// Density of `wm` were it seen under `cosine`.
  double pdf_if_seen(const Vec3<double>& wm, double cosine) const;

  const ExactSlopes& exact_;
  SampledNormals kind_;
  Vec3<double> wi_;
  ExactSurface surface_;
  StretchedFrame frame_;
  double height_, cosine_, sine_, area_;
  std::unique_ptr<const RadialDistribution> own_radii_;
  precompute::MarginalDistribution visible_;
};

}  // namespace vndf::validate
