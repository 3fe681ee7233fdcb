// The normal equations of B-splines, which have seven diagonals, by Cholesky's method.
#include "vndf/distributions/least_squares_spline.h"

#include <algorithm>
#include <array>

namespace vndf::distributions {
namespace {

// A cubic piece is the sum of this many B-splines.
constexpr std::size_t kOrder = 4;
// This part of the diagonal is added to it, so that rounding cannot make the equations singular
// where the samples of a piece crowd at one of its ends. It moves a value by as much.
constexpr double kRidge = 1e-13;

using Basis = std::array<double, kOrder>;

/// The values at `t` of the B-splines that are not zero in the piece that begins at knot `piece`,
/// by de Boor's recurrence.
Basis basis_at(const std::vector<double>& knots, std::size_t piece, double t) {
  Basis values{1};
  for (std::size_t order = 1; order < kOrder; ++order) {
    double carried = 0;
    for (std::size_t k = 0; k < order; ++k) {
      const double right = knots[piece + k + 1], left = knots[piece + k + 1 - order];
      const double part = values[k] / (right - left);
      values[k] = carried + (right - t) * part;
      carried = (t - left) * part;
    }
    values[order] = carried;
  }
  return values;
}

/// A symmetric matrix: rows[i][k] is the element in row i and column i + k.
using Band = std::vector<Basis>;

/// Solves `matrix` x = `right` in place by the decomposition L D L^T.
void solve(Band& matrix, std::vector<double>& right) {
  const std::size_t n = right.size();
  const auto width = [&](std::size_t i) { return std::min(kOrder, n - i); };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 1; k < width(i); ++k) {
      const double factor = matrix[i][k] / matrix[i][0];
      for (std::size_t j = k; j < width(i); ++j) matrix[i + k][j - k] -= factor * matrix[i][j];
      right[i + k] -= factor * right[i];
    }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = 1; k < width(i); ++k) right[i] -= matrix[i][k] * right[i + k];
    right[i] /= matrix[i][0];
  }
}

}  // namespace

LeastSquaresSpline::LeastSquaresSpline(const WeightedSamples& samples,
                                       std::span<const double> knots) {
  knots_.assign(kOrder - 1, knots.front());
  knots_.insert(knots_.end(), knots.begin(), knots.end());
  knots_.insert(knots_.end(), kOrder - 1, knots.back());
  coefficients_.assign(knots_.size() - kOrder, 0);
  Band matrix(coefficients_.size(), Basis{});
  for (std::size_t i = 0; i < samples.t.size(); ++i) {
    const std::size_t piece = piece_of(samples.t[i]), first = piece + 1 - kOrder;
    const Basis basis = basis_at(knots_, piece, samples.t[i]);
    for (std::size_t a = 0; a < kOrder; ++a) {
      const double weighted = samples.weight[i] * basis[a];
      coefficients_[first + a] += weighted * samples.value[i];
      for (std::size_t b = a; b < kOrder; ++b) matrix[first + a][b - a] += weighted * basis[b];
    }
  }
  for (Basis& row : matrix) row[0] *= 1 + kRidge;
  solve(matrix, coefficients_);
}

/// The index of the knot at which the piece with `t` begins.
std::size_t LeastSquaresSpline::piece_of(double t) const {
  const auto begin = knots_.begin() + kOrder, end = knots_.end() - kOrder;
  return static_cast<std::size_t>(std::upper_bound(begin, end, t) - knots_.begin()) - 1;
}

double LeastSquaresSpline::at(double t) const {
  const std::size_t piece = piece_of(t);
  const Basis basis = basis_at(knots_, piece, t);
  double sum = 0;
  for (std::size_t k = 0; k < kOrder; ++k) sum += basis[k] * coefficients_[piece + 1 - kOrder + k];
  return sum;
}

}  // namespace vndf::distributions
