// The positive function of one slope.
#include "vndf/log_curve.h"

#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

/// A curve through log f with derivative `slope`, both of a = asinh(x).
template <class F, class G>
LogCurveSegment<double> segment_of(F log_f, G slope, double begin, double end, Grading grading,
                                   std::size_t count) {
  LogCurveSegment<double> s{begin, end, grading, {}};
  const double step = 1 / static_cast<double>(count - 1);
  for (std::size_t k = 0; k < count; ++k) {
    const double t = step * static_cast<double>(k);
    const double a = begin + (end - begin) * graded_inverse(t, grading);
    const double da = (end - begin) * graded_inverse_derivative(t, grading) * step;
    s.nodes.push_back({log_f(a), slope(a) * da});
  }
  return s;
}

/// (1 + x^2)^(-n): a power tail.
LogCurve<double> power_curve(double n, std::size_t count, double end,
                             Grading grading = Grading::none) {
  return {{segment_of([=](double a) { return -2 * n * std::log(std::cosh(a)); },
                      [=](double a) { return -2 * n * std::tanh(a); }, 0, end, grading, count)},
          true};
}

}  // namespace

TEST_CASE("a curve interpolates with the fourth power of the spacing, however it is graded") {
  const auto exact = [](double a) { return -3 * std::log(std::cosh(a)); };
  for (const auto grading : {Grading::none, Grading::low}) {
    const auto worst = [&](std::size_t count) {
      const auto curve = power_curve(1.5, count, 20, grading);
      double error = 0;
      for (double a = 0; a < 19; a += 0.0371)
        error = std::max(error, std::abs(curve.log_at(a) - exact(a)));
      return error;
    };
    CHECK(worst(201) < 1e-4);
    CHECK(worst(401) < worst(201) / 12);
  }
}

TEST_CASE("a curve continues a power tail exactly") {
  const auto curve = power_curve(1, 201, 20);
  CHECK(curve.at(std::asinh(1e30)) == Approx(1e-60).epsilon(1e-9));
  CHECK(power_curve(1, 2001, 20, Grading::low).at(std::asinh(1e12)) == Approx(1e-24).epsilon(1e-6));
}

TEST_CASE("the derivative of a curve is that of its logarithm") {
  const auto curve = power_curve(1, 201, 20);
  for (const double a : {0.0, 0.33, 4.0, 15.0, 19.99, 30.0})
    CHECK(curve.log_slope_at(a) == Approx(-2 * std::tanh(a)).margin(1e-4));
}

TEST_CASE("a curve is zero outside its segments, unless it is open") {
  const auto one = [](double) { return 0.0; };
  const LogCurve<double> ring({segment_of(one, one, 0.5, 1, Grading::both, 9)}, false);
  CHECK(ring.at(0.2) == 0);
  CHECK(ring.at(0.5) == 1);
  CHECK(ring.at(0.75) == 1);
  CHECK(ring.at(1.01) == 0);
  CHECK(ring.at(std::numeric_limits<double>::infinity()) == 0);
}

TEST_CASE("each segment keeps its own side of a jump") {
  const auto level = [](double value) { return [value](double) { return value; }; };
  const LogCurve<double> curve({segment_of(level(0), level(0), 0, 1, Grading::both, 5),
                                segment_of(level(2), level(0), 1, 3, Grading::both, 5)},
                               false);
  CHECK(curve.log_at(0.999999) == 0);
  CHECK(curve.log_at(1.000001) == 2);
}

TEST_CASE("grading and its inverse undo each other") {
  for (const auto grading : {Grading::none, Grading::low, Grading::both})
    for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      CHECK(graded(graded_inverse(t, grading), grading) == Approx(t).margin(1e-15));
      const double slope =
          (graded_inverse(t + 1e-7, grading) - graded_inverse(t - 1e-7, grading)) / 2e-7;
      CHECK(graded_inverse_derivative(t, grading) == Approx(slope).margin(1e-6));
    }
}

TEST_CASE("a curve has a value at any argument") {
  const auto curve = power_curve(1, 21, 10);
  CHECK(curve.log_at(-1) == curve.log_at(0));
  CHECK(curve.log_at(std::numeric_limits<double>::quiet_NaN()) == curve.log_at(0));
  CHECK(curve.at(std::numeric_limits<double>::infinity()) == 0);
  const LogCurve<double> flat({{0, 1, Grading::none, {{0.5, 0}, {0.5, 0}}}}, true);
  CHECK(flat.log_at(std::numeric_limits<double>::infinity()) == 0.5);
}
