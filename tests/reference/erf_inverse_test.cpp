// Inverses of erf and erfc against Boost's, which are evaluated in long double.
#include "vndf/reference/erf_inverse.h"

#include <boost/math/special_functions/erf.hpp>

#include "support/catch.h"

using namespace vndf;

namespace {

double exact_erf_inverse(double x) {
  return static_cast<double>(boost::math::erf_inv(static_cast<long double>(x)));
}
double exact_erfc_inverse(double q) {
  return static_cast<double>(boost::math::erfc_inv(static_cast<long double>(q)));
}
double relative(double value, double exact) {
  return std::abs(value / exact - 1);
}

}  // namespace

TEST_CASE("erf_inverse and Giles's polynomial keep their stated errors between 0 and 1") {
  double giles = 0, in_double = 0, in_float = 0;
  for (int k = 1; k < 20000; ++k) {
    const double x = k / 20000.0, y = exact_erf_inverse(x);
    giles = std::max(giles, relative(giles_erf_inverse(x, -std::log((1 - x) * (1 + x))), y));
    in_double = std::max(in_double, relative(erf_inverse(x), y));
    const float rounded = static_cast<float>(x);
    in_float =
        std::max(in_float, relative(double{erf_inverse(rounded)}, exact_erf_inverse(rounded)));
  }
  CHECK(giles <= kGilesError);
  CHECK(giles > kGilesError / 2);
  CHECK(in_double <= kErfInverseError);
  CHECK(in_float <= kErfInverseFloatError);
}

TEST_CASE("erfc_inverse keeps its stated error from 1e-300 to 1") {
  double worst = 0;
  for (double exponent = -300; exponent < 0; exponent += 0.013) {
    const double q = std::pow(10, exponent);
    worst = std::max(worst, relative(erfc_inverse(q), exact_erfc_inverse(q)));
  }
  CHECK(worst <= kErfInverseError);
}

TEST_CASE("the ends of the inverses are infinite, their middle is 0, erf_inverse is odd") {
  CHECK(erfc_inverse(0) == INFINITY);
  CHECK(erfc_inverse(1) == 0);
  CHECK(erf_inverse(1.0) == INFINITY);
  CHECK(erf_inverse(-1.0f) == -INFINITY);
  CHECK(erf_inverse(0.0) == 0);
  for (const double x : {1e-300, 0.3, 0.7, 1 - 1e-15}) CHECK(erf_inverse(-x) == -erf_inverse(x));
}
