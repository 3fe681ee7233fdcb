// Measures tables against the exact distribution, as a renderer runs them.
#include "precompute/measure_certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "precompute/conditional_slopes.h"
#include "precompute/map_errors.h"
#include "precompute/visible_slopes.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::precompute {
namespace {

constexpr std::size_t kRows = 420;       // golden rows of each table
constexpr std::size_t kUniform = 192;    // u uniform, for the mean
constexpr std::size_t kColumns = 384;    // columns uniform, for the maximum
constexpr std::size_t kEdgeColumns = 3;  // first and last cells, each at four places
constexpr double kSmallestTail = 1e-9;   // of the slopes x at which the conditional is judged
constexpr double kDensityEnd = 1e-6;     // the density is judged between this and 1 - this
constexpr std::size_t kCurvePoints = 4000;
constexpr double kNdfTail = 1e-12;
constexpr double kFarthestRatio = 8;  // of the mass of a tail
constexpr double kDegree = std::numbers::pi / 180;

/// Inverse of the conditional column on the whole of u2: [0, 1/2] the lower half of the rows.
Probability<double> conditional_u2(double t) {
  const bool lower = t < 0.5;
  const double half = conditional_column_inverse(lower ? 1 - 2 * t : 2 * t - 1).complement / 2;
  return lower ? from_tail(half) : from_complement(half);
}

Probability<float> narrow(const Probability<double>& p) {
  return {static_cast<float>(p.u), static_cast<float>(p.complement)};
}

/// One row of one table: the exact CDF, with complement, of what the sampler returns for u, in
/// single and in double precision.
template <class FloatMap, class DoubleMap>
struct Row {
  double place;  // what the certificate calls this row
  Probability<double> (*column_inverse)(double);
  FloatMap sampled_single;
  DoubleMap sampled_double;
  bool in_double;  // the precision that is judged

  /// u as the judged precision holds it.
  Probability<double> given(const Probability<double>& u) const {
    return in_double ? u : widened(narrow(u));
  }
  Probability<double> sampled(const Probability<double>& u) const {
    return in_double ? sampled_double(u) : sampled_single(narrow(u));
  }
};

template <class Mass>
TailRatios tail_ratios(Mass mass) {
  return {tail_ratio(mass, 1e-4, kFarthestRatio), tail_ratio(mass, 1e-5, kFarthestRatio),
          tail_ratio(mass, 1e-6, kFarthestRatio)};
}

void keep_farthest_of_each(TailRatios& ratios, const TailRatios& candidate) {
  keep_farthest(ratios.e4, candidate.e4);
  keep_farthest(ratios.e5, candidate.e5);
  keep_farthest(ratios.e6, candidate.e6);
}

/// The places in (0, 1) at which one row is judged, beyond those uniform in u.
template <class R>
std::vector<Probability<double>> hard_probabilities(const R& row, std::size_t columns,
                                                    double shift) {
  std::vector<Probability<double>> places;
  for (std::size_t k = 0; k < kColumns; ++k) places.push_back(row.column_inverse(golden(k, shift)));
  for (std::size_t k = 0; k < 4 * kEdgeColumns; ++k) {
    const double t = (static_cast<double>(k) / 4 + 0.125) / static_cast<double>(columns - 1);
    places.push_back(row.column_inverse(t));
    places.push_back(row.column_inverse(1 - t));
  }
  add_tails(places);
  return places;
}

template <class R>
TableErrors judge_row(const R& row, std::size_t index, std::size_t columns) {
  TableErrors errors;
  const auto judge = [&](const Probability<double>& exact_u) {
    const Probability<double> u = row.given(exact_u);
    const double error = std::abs(u_error(row.sampled(u), u));
    if (error > errors.max_u_error) {
      errors.max_u_error = error;
      errors.worst_row = row.place;
      errors.worst_u = exact_u.u;
    }
    if (std::min(exact_u.u, exact_u.complement) >= kDensityEnd)
      errors.max_density_error =
          std::max(errors.max_density_error, density_error(row.sampled_double, exact_u));
    return error;
  };
  const double shift = golden(index, 0.25);
  for (std::size_t k = 0; k < kUniform; ++k)
    errors.mean_u_error += judge(from_tail(golden(k, shift))) / kUniform;
  for (const auto& u : hard_probabilities(row, columns, shift)) judge(u);
  errors.lower = tail_ratios([&](double e) { return row.sampled(from_tail(e)).u; });
  errors.upper = tail_ratios([&](double e) { return row.sampled(from_complement(e)).complement; });
  return errors;
}

TableErrors combine(const std::vector<TableErrors>& rows) {
  TableErrors all;
  for (const TableErrors& r : rows) {
    if (r.max_u_error > all.max_u_error) {
      all.max_u_error = r.max_u_error;
      all.worst_row = r.worst_row;
      all.worst_u = r.worst_u;
    }
    all.mean_u_error += r.mean_u_error / static_cast<double>(rows.size());
    all.max_density_error = std::max(all.max_density_error, r.max_density_error);
    keep_farthest_of_each(all.lower, r.lower);
    keep_farthest_of_each(all.upper, r.upper);
  }
  return all;
}

/// Everything that judging needs, made once.
struct Judge {
  const UnitSlopes& slopes;
  TabulatedSampler<float> sampler;
  TabulatedSampler<double> sampler_double;

  /// A direction of the unit-mean-slope configuration, as floats that are then taken as exact.
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
    const VisibleSlopes visible(slopes, exact);
    // From the bounded form, for the slope itself may be beyond the range of single precision.
    const auto cdf_of = [&](const auto& x) {
      const double sigma = x.sigma;
      return visible.cdf(std::min(std::log(sigma / (1 - sigma)), visible.farthest()));
    };
    const auto sampled = [&](const Probability<float>& u) {
      return cdf_of(sampler.sample_marginal(c, u));
    };
    const auto sampled_double = [&](const Probability<double>& u) {
      return cdf_of(sampler_double.sample_marginal(exact, u));
    };
    const double theta = std::atan2(w.s / slopes.mean_slope(), w.z) / kDegree;
    const Row row{theta, marginal_column_inverse<double>, sampled, sampled_double,
                  sampler.tables().marginal.in_double()};
    return judge_row(row, index, sampler.tables().marginal.columns());
  }

  TableErrors conditional_row(double x, std::size_t index) const {
    const auto bounded = bounded_from_sigma(static_cast<float>(bounded_from_slope(x).sigma));
    const BoundedSlope<double> exact = bounded_from_sigma<double>(bounded.sigma);
    const SlopeTables& tables = sampler.tables();
    const ConditionalSlopes conditional(
        slopes, exact.slope(), {tables.conditional_constant, tables.conditional_quadratic});
    const auto cdf_of = [&](auto sign, auto v) {
      const double y = conditional_value_inverse(double{v}).slope();
      const double half = conditional.cdf(y).complement / 2;
      return sign < 0 ? from_tail(half) : from_complement(half);
    };
    const auto sampled = [&](const Probability<float>& u2) {
      const auto folded = fold(u2);
      return cdf_of(folded.sign, sampler.sample_conditional(bounded, folded.p));
    };
    const auto sampled_double = [&](const Probability<double>& u2) {
      const auto folded = fold(u2);
      return cdf_of(folded.sign, sampler_double.sample_conditional(exact, folded.p));
    };
    const double place = exact.slope() * slopes.mean_slope();
    const Row row{place, conditional_u2, sampled, sampled_double, tables.conditional.in_double()};
    return judge_row(row, index, sampler.tables().conditional.columns());
  }

  double d_error(double r) const {
    const double length = std::hypot(1, r * slopes.mean_slope());
    const Vec3<float> wm{static_cast<float>(-r * slopes.mean_slope() / length), 0,
                         static_cast<float>(1 / length)};
    const double exact = exact_d(wm), given = double{sampler.d(wm, {1, 1})};
    return exact > 0 ? std::abs(given / exact - 1) : given;
  }

  double exact_d(const Vec3<float>& wm) const {
    const double z = wm.z, mu = slopes.mean_slope();
    const double radius = std::hypot(double{wm.x}, double{wm.y}) / (z * mu);
    return slopes.p22(radius) / (mu * mu * z * z * z * z);
  }

  double exact_lambda(const Vec3<float>& w) const {
    const double horizontal = slopes.mean_slope() * std::hypot(double{w.x}, double{w.y});
    return horizontal * slopes.backfacing(w.z / horizontal).value / w.z;
  }

  double lambda_error(double theta) const {
    const Vec3<float> w{static_cast<float>(std::sin(theta)), 0,
                        static_cast<float>(std::cos(theta))};
    const double exact = exact_lambda(w);
    return std::abs(double{sampler.lambda(w, {1, 1})} - exact) / (1 + exact);
  }

  /// Relative to the density that the normal would have if it faced wi: near the edge of visibility
  /// dot(wi, wm) has only absolute precision.
  double pdf_error(double theta, float u1, float u2) const {
    const Vec3<float> wi{static_cast<float>(std::sin(theta)), 0,
                         static_cast<float>(std::cos(theta))};
    const Vec3<float> wm = sampler.sample(wi, {1, 1}, u1, u2);
    const double cosine = double{wi.x} * wm.x + double{wi.y} * wm.y + double{wi.z} * wm.z;
    const double facing = exact_d(wm) / (wi.z * (1 + exact_lambda(wi)));
    const double error = double{sampler.pdf(wi, wm, {1, 1})} - std::max(0.0, cosine) * facing;
    return facing > 0 ? std::abs(error) / facing : std::abs(error);
  }
};

TableErrors judge_marginal(const Judge& judge, const Workers& workers) {
  const RowAxis rows(judge.sampler.tables().marginal_rows);
  std::vector<Judge::Direction> directions;
  for (const double row : off_grid_rows(judge.sampler.tables().marginal.rows(), kRows))
    directions.push_back(Judge::direction(marginal_base_inverse(rows.base(row))));
  for (const double degrees : {0.0, 1e-7, 1e-3, 0.2, 0.3, 89.9, 89.99, 89.999, 90.0})
    directions.push_back(judge.direction(degrees * kDegree));
  std::vector<TableErrors> judged(directions.size());
  parallel_for(judged.size(), workers,
               [&](std::size_t i) { judged[i] = judge.marginal_row(directions[i], i); });
  return combine(judged);
}

TableErrors judge_conditional(const Judge& judge, const Workers& workers) {
  const SlopeTables& tables = judge.sampler.tables();
  const RowAxis rows(tables.conditional_rows);
  std::vector<double> reached;
  for (const double row : off_grid_rows(tables.conditional.rows(), kRows)) {
    const double x = conditional_base_inverse(rows.base(row));
    // Given x = 0 a pole leaves no law, or one that none samples.
    const bool centre = static_cast<float>(bounded_from_slope(x).sigma) == 0.5f;
    if (centre && std::isinf(judge.slopes.p22(0))) continue;
    if (judge.slopes.m(std::asinh(x)) > kSmallestTail &&
        ConditionalSlopes::reachable(judge.slopes, x))
      reached.push_back(x);
  }
  std::vector<TableErrors> judged(reached.size());
  parallel_for(judged.size(), workers,
               [&](std::size_t i) { judged[i] = judge.conditional_row(reached[i], i); });
  return combine(judged);
}

template <class F>
double largest(std::size_t count, const Workers& workers, F error) {
  std::vector<double> errors(count);
  parallel_for(count, workers, [&](std::size_t i) { errors[i] = error(i); });
  return *std::max_element(errors.begin(), errors.end());
}

}  // namespace

Certificate measure_certificate(const UnitSlopes& slopes,
                                const std::shared_ptr<const SlopeTables>& tables,
                                const Workers& workers) {
  const Judge judge{slopes, TabulatedSampler<float>(tables), TabulatedSampler<double>(tables)};
  Certificate certificate;
  certificate.marginal = judge_marginal(judge, workers);
  certificate.conditional = judge_conditional(judge, workers);

  double farthest = 0;  // asinh of the radius
  while (slopes.m(farthest) > kNdfTail && farthest < 16) farthest += 0.01;
  certificate.max_d_error = largest(kCurvePoints, workers, [&](std::size_t k) {
    const double root = golden(k);  // squared, the radii crowd where D may have a pole
    return judge.d_error(std::sinh(farthest * root * root));
  });
  const auto theta = [](std::size_t k) { return std::numbers::pi / 2 * golden(k); };
  certificate.max_lambda_error =
      largest(kCurvePoints, workers, [&](std::size_t k) { return judge.lambda_error(theta(k)); });
  certificate.max_pdf_error = largest(kCurvePoints, workers, [&](std::size_t k) {
    const double u2 = golden(k * 7, 0.125);
    return judge.pdf_error(theta(k), static_cast<float>(golden(k * 3)), static_cast<float>(u2));
  });
  return certificate;
}

}  // namespace vndf::precompute
