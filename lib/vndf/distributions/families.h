// The slope distributions that come with the toolkit, each normalised at unit roughness, with P, Q
// and M in closed form where they are known (Heitz and d'Eon 2014, supplemental 1, for Beckmann and
// GGX; the others by the integrals of slope_integrals.h). Closed forms hold to 1e-14, relative, in
// the tails too (1e-13 at exponents of 1000). Constructors throw std::invalid_argument for a
// parameter out of its range.
#pragma once

#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"

namespace vndf::distributions {

/// Beckmann: Gaussian slopes, p22(r) = exp(-r^2) / pi.
class Beckmann final : public SlopeDistribution {
 public:
  std::string name() const override { return "beckmann"; }
  double p22(double r) const override;
  std::optional<Marginals> marginals(double x) const override;
};

/// GGX (Trowbridge-Reitz): p22(r) = 1 / (pi (1 + r^2)^2).
class Ggx final : public SlopeDistribution {
 public:
  std::string name() const override { return "ggx"; }
  double p22(double r) const override;
  std::optional<Marginals> marginals(double x) const override;
};

/// p22(r) = (g - 1) / (pi s) (1 + r^2 / s)^-g: one distribution, for which several units of slope
/// are in use.
class PowerLaw : public SlopeDistribution {
 public:
  double p22(double r) const override;
  std::optional<Marginals> marginals(double x) const override;

 protected:
  /// g > 3/2 and s > 0, which the derived class has checked.
  PowerLaw(double g, double s);

 private:
  double density(double x) const;

  double g_, scale_;      // scale_ = sqrt(s)
  double at_zero_, top_;  // p22(0) and P(0)
};

/// Student-T (Ribardiere et al. 2017): s = gamma - 1, gamma > 3/2. gamma = 2 is GGX, infinity
/// Beckmann.
class StudentT final : public PowerLaw {
 public:
  explicit StudentT(double gamma);
  std::string name() const override;

 private:
  double gamma_;
};

/// Hyper-Cauchy (Wellems et al. 2006): p22(r) = (q - 1) 2^(q - 1) / (pi (2 + r^2)^q), q > 3/2:
/// Student-T with slopes scaled by sqrt(2 / (q - 1)).
class HyperCauchy final : public PowerLaw {
 public:
  explicit HyperCauchy(double q);
  std::string name() const override;

 private:
  double q_;
};

/// Blinn-Phong D(theta) = (n + 2) / (2 pi) cos^n(theta), n > -1, at its own scale r = tan(theta):
/// p22 = D cos^4, Student-T of gamma = (n + 4) / 2 and alpha = sqrt(2 / (n + 2)).
class BlinnPhong final : public PowerLaw {
 public:
  explicit BlinnPhong(double n);
  std::string name() const override;

 private:
  double n_;
};

/// p22(r) = p / (2 pi Gamma(2 / p)) exp(-r^p), p > 0. p = 2 is Beckmann. Hoffman's Generalised
/// Beckmann (2016) has the exponent p / 2.
class ExponentialPower final : public SlopeDistribution {
 public:
  explicit ExponentialPower(double p);
  std::string name() const override;
  double p22(double r) const override;
  std::optional<Marginals> marginals(double x) const override;

 private:
  double p_;
  int squarings_;  // that make r^p of r; -1 if none do
  double log_factor_;
};

/// K (Beckmann whose squared roughness is gamma-distributed), 0 < nu <= 100:
/// p22(r) = 2 nu / (pi Gamma(nu)) (z / 2)^(nu - 1) K_{nu-1}(z), z = 2 sqrt(nu) r. Infinite at r = 0
/// for nu <= 1.
class KDistribution final : public SlopeDistribution {
 public:
  explicit KDistribution(double nu);
  std::string name() const override;
  double p22(double r) const override;
  /// Bessel functions are costly. nu = 1 and 3 have P, Q and M in closed form and need fewer of
  /// them.
  bool costly() const override { return nu_ != 1 && nu_ != 3; }
  std::optional<Marginals> marginals(double x) const override;

 private:
  double nu_, factor_;
};

/// Pearson II: p22(r) = (m + 1) / pi (1 - r^2)^m for r < 1, m >= -1/2. For m < 0 it grows without
/// bound towards r = 1, which costs every quadrature over it precision: sqrt(1e-16) at -1/2.
class PearsonII : public SlopeDistribution {
 public:
  explicit PearsonII(double m);
  std::string name() const override;
  double p22(double r) const override;
  std::vector<double> breaks() const override { return {1}; }
  double support() const override { return 1; }
  std::optional<Marginals> marginals(double x) const override;

 private:
  double m_, top_;
};

/// The uniform disk: p22(r) = 1 / pi for r < 1.
class UniformDisk final : public PearsonII {
 public:
  UniformDisk() : PearsonII(0) {}
  std::string name() const override { return "disk"; }
};

/// A uniform ring: p22(r) = 1 / (pi (1 - inner^2)) for inner < r < 1, 0 <= inner < 1.
class Annulus final : public SlopeDistribution {
 public:
  explicit Annulus(double inner);
  std::string name() const override;
  double p22(double r) const override;
  std::vector<double> breaks() const override;
  double support() const override { return 1; }
  std::optional<Marginals> marginals(double x) const override;

 private:
  double inner_, area_;  // area_ = 1 - inner^2, over pi
};

/// A volcano, no normal upright: p22(r) = r^2 exp(-r^2) / pi.
class Volcano final : public SlopeDistribution {
 public:
  std::string name() const override { return "volcano"; }
  double p22(double r) const override;
  std::optional<Marginals> marginals(double x) const override;
};

}  // namespace vndf::distributions
