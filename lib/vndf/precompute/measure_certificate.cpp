// Measures the pair of tables against the exact distribution.
#include "vndf/precompute/measure_certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "vndf/precompute/conditional_distribution.h"
#include "vndf/precompute/function_errors.h"
#include "vndf/precompute/map_errors.h"
#include "vndf/precompute/marginal_distribution.h"
#include "vndf/precompute/row_errors.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::precompute {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Probability<float> narrow(const Probability<double>& p) {
  return {static_cast<float>(p.u), static_cast<float>(p.complement)};
}

/// A row by its exact CDFs at the slopes that the sampler returns in single and in double
/// precision, both as functions of u.
template <class FloatMap, class DoubleMap>
class PairRow final : public RowMap {
 public:
  PairRow(FloatMap in_single, DoubleMap in_double, bool measured_in_double)
      : single_(in_single), double_(in_double), in_double_(measured_in_double) {}

  Probability<double> given(const Probability<double>& u) const override {
    return in_double_ ? u : widened(narrow(u));
  }
  Probability<double> cdf(const Probability<double>& u) const override {
    return in_double_ ? double_(u) : single_(narrow(u));
  }
  Probability<double> tail_cdf(const Probability<double>& u) const override { return cdf(u); }
  Probability<double> smooth_cdf(const Probability<double>& u,
                                 const Probability<double>&) const override {
    return double_(u);
  }

 private:
  FloatMap single_;
  DoubleMap double_;
  bool in_double_;  // the precision that is measured
};

/// The pair as a renderer runs it, with the rows that are compared with the exact distribution.
struct MeasuredPair {
  const UnitSlopes& slopes;
  TabulatedSampler<float> sampler;
  TabulatedSampler<double> sampler_double;

  /// A direction stretched to unit mean slope. Its parts are floats and count as exact, so that
  /// their rounding is no error of the tables.
  struct Direction {
    float z, s;
  };

  static Direction direction(const BoundedSlope<double>& c) {
    return {static_cast<float>(c.numerator() / c.hypotenuse()),
            static_cast<float>(c.denominator() / c.hypotenuse())};
  }
  Direction direction(double theta) const {
    return {static_cast<float>(std::cos(theta)),
            static_cast<float>(slopes.mean_slope() * std::sin(theta))};
  }

  TableErrors marginal_row(const Direction& w, std::size_t index) const {
    const BoundedSlope<float> c = bounded_cotangent(w.z, w.s);
    const BoundedSlope<double> exact = bounded_cotangent<double>(w.z, w.s);
    const MarginalDistribution visible(slopes, exact);
    // From the bounded form, because the slope itself may be beyond the range of single precision.
    const auto cdf_of = [&](const auto& x) {
      const double sigma = x.sigma;
      return visible.cdf(std::min(std::log(sigma / (1 - sigma)), visible.farthest()));
    };
    const auto sampled = [&](const Probability<float>& u) {
      return cdf_of(sampler.map().marginal(c, u));
    };
    const auto sampled_double = [&](const Probability<double>& u) {
      return cdf_of(sampler_double.map().marginal(exact, u));
    };
    const double theta = std::atan2(w.s / slopes.mean_slope(), w.z) / kDegree;
    const QuantileTable& table = sampler.tables().marginal;
    return measure_row(PairRow(sampled, sampled_double, table.in_double()),
                       {theta, marginal_column_inverse<double>, table.columns()}, index);
  }

  TableErrors conditional_row(double x, std::size_t index) const {
    const auto bounded = bounded_from_sigma(static_cast<float>(bounded_from_slope(x).sigma));
    const BoundedSlope<double> exact = bounded_from_sigma<double>(bounded.sigma);
    const SlopeTables& tables = sampler.tables();
    const ConditionalDistribution conditional(slopes, exact.slope(),
                                              sampler.map().coordinates().scale);
    const auto cdf_of = [&](auto sign, auto v) {
      const double y = conditional_value_inverse(double{v}).slope();
      const double half = conditional.cdf(y).complement / 2;
      return sign < 0 ? from_tail(half) : from_complement(half);
    };
    const auto sampled = [&](const Probability<float>& u2) {
      const auto folded = fold(u2);
      return cdf_of(folded.sign, sampler.map().conditional(bounded, folded.p));
    };
    const auto sampled_double = [&](const Probability<double>& u2) {
      const auto folded = fold(u2);
      return cdf_of(folded.sign, sampler_double.map().conditional(exact, folded.p));
    };
    const double place = exact.slope() * slopes.mean_slope();
    return measure_row(PairRow(sampled, sampled_double, tables.conditional.in_double()),
                       {place, conditional_u2, tables.conditional.columns()}, index);
  }
};

/// Measures rows of the marginal from row coordinate `first` to `last`, and at more incidences.
template <class Incidences, class Measures>
TableErrors marginal_errors(const MeasuredPair& pair, double first, double last,
                            const Incidences& incidences, Measures measures,
                            const support::Workers& workers) {
  const PairCoordinates& at = pair.sampler.map().coordinates();
  const auto intervals = static_cast<double>(pair.sampler.tables().marginal.rows() - 1);
  const auto rows = static_cast<std::size_t>(std::round((last - first) * intervals)) + 1;
  std::vector<MeasuredPair::Direction> directions;
  for (const double row : off_grid_rows(rows, kMeasuredRows))
    directions.push_back(
        MeasuredPair::direction(at.marginal_row_inverse(first + (last - first) * row)));
  for (const double degrees : incidences) directions.push_back(pair.direction(degrees * kDegree));
  std::erase_if(directions, [&](const MeasuredPair::Direction& w) {
    return !measures(bounded_cotangent<double>(w.z, w.s));
  });
  return measure_rows(directions.size(), workers,
                      [&](std::size_t i) { return pair.marginal_row(directions[i], i); });
}

TableErrors conditional_errors(const MeasuredPair& pair, const support::Workers& workers) {
  const SlopeTables& tables = pair.sampler.tables();
  const PairCoordinates& at = pair.sampler.map().coordinates();
  std::vector<double> reached;
  for (const double row : off_grid_rows(tables.conditional.rows(), kMeasuredRows)) {
    const double x = at.conditional_row_inverse(row);
    const auto sigma = static_cast<float>(bounded_from_slope(x).sigma);
    if (measures_conditional(pair.slopes, x, sigma)) reached.push_back(x);
  }
  return measure_rows(reached.size(), workers,
                      [&](std::size_t i) { return pair.conditional_row(reached[i], i); });
}

}  // namespace

Certificate measure_certificate(const UnitSlopes& slopes,
                                const std::shared_ptr<const SlopeTables>& tables,
                                const support::Workers& workers) {
  const MeasuredPair pair{slopes, TabulatedSampler<float>(tables),
                          TabulatedSampler<double>(tables)};
  Certificate certificate;
  const double grazing = pair.sampler.map().coordinates().marginal_rows.row(1);
  certificate.marginal = marginal_errors(
      pair, 0, grazing, kHardIncidences, [](const auto&) { return true; }, workers);
  certificate.below = marginal_errors(
      pair, grazing, 1, kHardIncidencesBelow,
      [&](const auto& c) { return measures_below(slopes, c); }, workers);
  certificate.conditional = conditional_errors(pair, workers);
  FunctionErrors(slopes, pair.sampler).measure(certificate, workers);
  return certificate;
}

}  // namespace vndf::precompute
