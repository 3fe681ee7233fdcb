// A slope distribution given by samples of its radial density p22, as measurements, tables and
// slope maps give it: a smooth, positive curve through the samples and a declared tail beyond the
// last.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// p22 at radii r, in any scale of either.
struct RadialProfile {
  std::vector<double> r, p22;
};

/// What the density does beyond the last sample: ends, falls as exp(-b r), falls as r^-e.
enum class ProfileTail { none, exponential, power };

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

/// Passes through every sample. Between two samples of positive density, log p22 is a cubic in
/// log(1 + r^2 / s^2), s the radius of half the largest density: a flat centre and a power tail are
/// both straight lines in it. The cubics join as a spline (C2) whose slopes are limited (C1) where
/// it would leave the range of the two samples around it, so noisy samples cause no overshoot.
/// Between a positive and a zero sample p22 is linear in r. Before the first sample it is constant.
class MeasuredProfile final : public SlopeDistribution {
 public:
  /// `samples`: at least 4, r >= 0 increasing, p22 >= 0. Zeros at the end declare a compact support
  /// and go with ProfileTail::none. The tail starts at the last sample with the slope fitted by
  /// least squares to the last sixteenth of the samples, 4 at least; `parameter` replaces that
  /// slope. Throws std::invalid_argument for samples outside these rules, std::domain_error for
  /// samples that are all zero and for a tail without a finite mean slope.
  MeasuredProfile(std::string name, RadialProfile samples, ProfileTail tail,
                  std::optional<double> parameter = {});

  std::string name() const override { return name_; }
  double p22(double r) const override;
  std::vector<double> breaks() const override;
  double support() const override;
  /// P, Q and M sample by sample: quadratures that do not know the samples struggle with noisy
  /// ones. Maximum relative error: 1e-10 where the samples lie within a factor 2 of each other.
  std::optional<Marginals> marginals(double x) const override;

  /// The samples as given, less superfluous zeros at the end.
  const RadialProfile& samples() const { return samples_; }
  const TailFit& tail() const { return tail_; }
  /// 2 pi int r p22 dr and E|X|, tail included, as exact as marginals().
  double mass() const { return mass_; }
  double mean_slope() const { return mean_slope_; }

 private:
  /// log p22 and its derivative in the coordinate t = log(1 + r^2 / s^2).
  struct Knot {
    double r, t, value, slope;
  };

  void place_knots();
  void fit_tail(std::optional<double> parameter);
  void join_run(std::size_t first, std::size_t end);
  void integrate();
  double coordinate(double r) const;
  double log_slope_of_tail() const;
  double between(std::size_t next, double r) const;
  double beyond(double r) const;
  void add_tail(double x, double low, Marginals& sum) const;
  [[noreturn]] void fail(const std::string& why) const;

  std::string name_;
  RadialProfile samples_;
  TailFit tail_;
  double inverse_square_scale_ = 1;
  std::vector<Knot> knots_;
  double mass_ = 0, mean_slope_ = 0;
};

}  // namespace vndf::distributions
