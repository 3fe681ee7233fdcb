// The positive function of one slope.
#include "vndf/log_curve.h"

#include <cmath>
#include <limits>
#include <vector>

#include "catch.h"

using namespace vndf;
using vndf::test::Approx;

namespace {

/// (1 + x^2)^(-n) over asinh(x): a power tail.
LogCurve<double> power_curve(double n, std::size_t nodes, double step) {
  std::vector<LogCurveNode<double>> list;
  for (std::size_t k = 0; k < nodes; ++k) {
    const double a = step * static_cast<double>(k);
    list.push_back({-2 * n * std::log(std::cosh(a)), -2 * n * std::tanh(a) * step});
  }
  return {step, std::move(list)};
}

}  // namespace

TEST_CASE("a curve interpolates with the fourth power of the step") {
  const auto exact = [](double a) { return -3 * std::log(std::cosh(a)); };
  const auto worst = [&](double step) {
    const auto curve = power_curve(1.5, static_cast<std::size_t>(20 / step) + 1, step);
    double error = 0;
    for (double a = 0; a < 19; a += 0.0371)
      error = std::max(error, std::abs(curve.log_at(a) - exact(a)));
    return error;
  };
  CHECK(worst(0.1) < 2e-6);
  CHECK(worst(0.05) < worst(0.1) / 14);
}

TEST_CASE("a curve continues a power tail exactly") {
  const auto curve = power_curve(1, 201, 0.1);
  const double a = std::asinh(1e30);
  CHECK(curve.at(a) == Approx(1e-60).epsilon(1e-9));
}

TEST_CASE("the derivative of a curve is that of its logarithm") {
  const auto curve = power_curve(1, 201, 0.1);
  for (const double a : {0.0, 0.33, 4.0, 15.0, 19.99, 30.0})
    CHECK(curve.log_slope_at(a) == Approx(-2 * std::tanh(a)).margin(1e-4));
}

TEST_CASE("a curve has a value at any argument") {
  const auto curve = power_curve(1, 21, 0.5);
  CHECK(curve.log_at(-1) == curve.log_at(0));
  CHECK(curve.log_at(std::numeric_limits<double>::quiet_NaN()) == curve.log_at(0));
  CHECK(curve.at(std::numeric_limits<double>::infinity()) == 0);
  const LogCurve<double> flat(1, {{0.5, 0}, {0.5, 0}});
  CHECK(flat.log_at(std::numeric_limits<double>::infinity()) == 0.5);
}
