// Rows are placed where a table changes fast.
#include "vndf/precompute/place_rows.h"

#include <algorithm>
#include <cmath>

#include "support/catch.h"

using namespace vndf;
using namespace vndf::precompute;

namespace {

using Probabilities = std::vector<Probability<double>>;

/// A table whose values rise linearly in u up to scale(base).
template <class Scale>
RowSource source_of(Scale scale) {
  return {[scale](double base, const Probabilities& u) {
            std::vector<double> row;
            for (const auto& p : u) row.push_back(p.u * scale(base));
            return row;
          },
          marginal_column_inverse<double>};
}

/// Largest error relative to the value when `rows` rows are interpolated linearly.
template <class Scale>
double worst_error(const std::vector<RowKnot>& knots, std::size_t rows, Scale scale) {
  const RowAxis axis(knots);
  double worst = 0;
  for (double base = 0; base < (knots.empty() ? 1 : knots.back().base); base += 1.3e-5) {
    const double at = axis.row(base) * static_cast<double>(rows - 1);
    const double low = axis.base(std::floor(at) / static_cast<double>(rows - 1));
    const double high =
        axis.base(std::min(1.0, (std::floor(at) + 1) / static_cast<double>(rows - 1)));
    const double f = at - std::floor(at);
    const double interpolated = (1 - f) * scale(low) + f * scale(high);
    worst = std::max(worst, std::abs(interpolated / scale(base) - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("rows stay equidistant where a table changes about as fast everywhere") {
  CHECK(place_rows(source_of([](double b) { return 1 + b; }), 256, {}).empty());
  CHECK(place_rows(source_of([](double b) { return std::exp(b); }), 256, {}).empty());
}

TEST_CASE("rows crowd around a feature, and the error falls") {
  const auto step = [](double b) { return 2 + std::tanh(200 * (b - 0.3)); };
  const auto knots = place_rows(source_of(step), 256, {});
  REQUIRE(knots.size() > 2);
  CHECK(worst_error(knots, 256, step) < worst_error({}, 256, step) / 20);
}

TEST_CASE("a square root at a break is resolved") {
  const auto edge = [](double b) { return 1 + (b < 0.4 ? std::sqrt(0.4 - b) : 0.0); };
  auto source = source_of(edge);
  source.breaks = {0.4};
  const auto knots = place_rows(source, 256, {});
  CHECK(worst_error(knots, 256, edge) < 1e-3);
  CHECK(worst_error({}, 256, edge) > 5e-3);
}

TEST_CASE("a layer next to base 0 is resolved") {
  const auto layer = [](double b) { return 2 - std::exp(-b / 1e-3); };
  const auto knots = place_rows(source_of(layer), 256, {});
  CHECK(worst_error({}, 256, layer) > 0.1);
  CHECK(worst_error(knots, 256, layer) < 1e-3);
}

TEST_CASE("knots lie on rows, increase, and end where the table ends") {
  auto source = source_of([](double b) { return 1 + b * b * b * b; });
  source.end = 0.7;
  source.breaks = {0.25};
  const auto knots = place_rows(source, 64, {});
  REQUIRE(knots.size() >= 2);
  CHECK(knots.front().row == 0);
  CHECK(knots.back().base == 0.7);
  CHECK(knots.back().row == 1);
  for (std::size_t k = 1; k < knots.size(); ++k) {
    CHECK(knots[k].base > knots[k - 1].base);
    CHECK(knots[k].row > knots[k - 1].row);
    CHECK(std::abs(knots[k].row * 63 - std::round(knots[k].row * 63)) < 1e-9);
  }
}
