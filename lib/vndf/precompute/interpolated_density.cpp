// Samples a costly density into a curve.
#include "vndf/precompute/interpolated_density.h"

#include <cmath>

#include "vndf/precompute/make_curve.h"

namespace vndf::precompute {
namespace {

constexpr std::size_t kNodes = 8192;  // of each segment
// The curve ends at sinh(40) = 1e17 typical slopes, or before, where the density is nearly lost in
// double precision.
constexpr double kFarthestAsinh = 40;
constexpr double kSmallestDensity = 1e-290;

class Interpolated final : public distributions::SlopeDistribution {
 public:
  Interpolated(const distributions::SlopeDistribution& d, double scale, LogCurve<double> curve)
      : exact_(d), scale_(scale), curve_(std::move(curve)) {}
  std::string name() const override { return exact_.name(); }
  double p22(double r) const override {
    return r == 0 ? exact_.p22(0) : curve_.at(std::asinh(r / scale_));
  }
  std::vector<double> breaks() const override { return exact_.breaks(); }
  double support() const override { return exact_.support(); }
  std::optional<distributions::Marginals> marginals(double x) const override {
    return exact_.marginals(x);
  }

 private:
  const distributions::SlopeDistribution& exact_;
  double scale_;
  LogCurve<double> curve_;
};

}  // namespace

std::unique_ptr<distributions::SlopeDistribution> interpolated_density(
    const distributions::SlopeDistribution& d, double scale, const support::Workers& workers) {
  const auto density = [&](double a) { return d.p22(scale * std::sinh(a)); };
  double end = kFarthestAsinh;
  while (!(density(end) > kSmallestDensity) && end > 1e-3) end *= 0.98;
  const auto ends = segment_ends(d, scale, end);
  const CurveOptions options{.nodes = kNodes, .open = std::isinf(d.support()), .cusp = true};
  // A pole at the centre has no logarithm, so its first node lies next to it.
  const auto log_density = [&](double a) {
    const double value = density(a);
    return std::log(std::isinf(value) ? density(1e-12) : value);
  };
  return std::make_unique<Interpolated>(d, scale, make_curve(log_density, ends, options, workers));
}

}  // namespace vndf::precompute
