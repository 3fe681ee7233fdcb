// A slope distribution that is given by samples of its radial density p22, as from a measurement or
// from a map. The density between the samples is a smooth, positive curve through them. Beyond the
// last sample nothing is known, so the user declares the tail, which is fitted and reported.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vndf/distributions/fit_profile.h"
#include "vndf/distributions/radial_profile.h"
#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// What the density does beyond the last sample.
enum class ProfileTail {
  none,         ///< it is 0
  exponential,  ///< it falls as exp(-b r)
  power         ///< it falls as r^-e
};

struct TailFit {
  ProfileTail kind = ProfileTail::none;
  /// b of exponential, e of power, 0 of none.
  double parameter = 0;
  /// Share of the mass that lies beyond the last sample: what is assumed rather than measured.
  double fraction_of_mass_beyond = 0;
  /// Root mean square of log p22 minus the fitted line, over the samples of the fit: a relative
  /// deviation. 0 where nothing was fitted.
  double residual = 0;
};

/// The smallest exponent of a power tail, not itself valid: r^-3 has an infinite mean slope.
inline constexpr double kSmallestTailExponent = 3;

/// Farthest sample in mean slopes. Beyond, a build places rows over decades without mass for
/// minutes.
inline constexpr double kFarthestSample = 1e8;

/// The density passes through every sample, or is fitted to more than kMostProfileSamples of them
/// (fit_profile.h). Between two samples of positive density, log p22 is a
/// cubic in ProfileCoordinate. The cubics form a spline (C2). Where it would leave the range of the
/// two samples around it, its slopes are limited (C1), so that noisy samples cause no overshoot.
/// Between a positive and a zero sample p22 is linear in r, and before the first sample it is
/// constant.
class MeasuredProfile final : public SlopeDistribution {
 public:
  /// The samples keep the rules of checked_profile(). Zeros at the end declare a compact support
  /// and go with ProfileTail::none. The tail starts at the last sample. Its parameter is fitted by
  /// least squares to the last sixteenth of the samples, at least 4 of them, unless `parameter`
  /// gives it. Throws std::invalid_argument for samples that break the rules, and std::domain_error
  /// for a tail that does not fit or is without a finite mean slope, and for samples that reach
  /// beyond kFarthestSample.
  MeasuredProfile(std::string name, RadialProfile samples, ProfileTail tail,
                  std::optional<double> parameter = {});

  std::string name() const override { return name_; }
  double p22(double r) const override;
  std::vector<double> breaks() const override;
  double support() const override;
  /// P, Q and M, integrated from sample to sample because a quadrature that does not know the
  /// samples struggles with noisy ones. Maximum relative error: 1e-10 where neighbouring samples
  /// lie within a factor 2 of each other.
  std::optional<Marginals> marginals(double x) const override;

  /// The samples that the density passes through, without superfluous zeros at the ends. The same
  /// distribution is made of them again.
  const RadialProfile& samples() const { return samples_; }
  /// How far the density is from the samples as given, if they were too many to keep.
  const std::optional<FitResidual>& resampling() const { return resampling_; }
  const TailFit& tail() const { return tail_; }
  /// 2 pi int r p22 dr and E|X|, both with the tail and with the error of marginals().
  double mass() const { return mass_; }
  double mean_slope() const { return mean_slope_; }

 private:
  /// log p22 and its derivative in the coordinate t.
  struct Knot {
    double r, t, value, slope;
  };

  void place_knots();
  void fit_tail(std::optional<double> parameter);
  void check_tail() const;
  void join_knots();
  void integrate();
  double log_slope_of_tail() const;
  double between(std::size_t next, double r) const;
  double beyond(double r) const;
  void add_tail(double x, double low, Marginals& sum) const;
  [[noreturn]] void fail(const std::string& why) const;

  std::string name_;
  RadialProfile samples_;
  TailFit tail_;
  std::optional<FitResidual> resampling_;
  ProfileCoordinate coordinate_;
  std::vector<Knot> knots_;
  double mass_ = 0, mean_slope_ = 0;
};

}  // namespace vndf::distributions
