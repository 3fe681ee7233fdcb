// Measures one row of a sampler's map from u to slopes against the exact distribution, for any
// sampler: the u-errors of the slopes it returns, its density, and the masses of its tails. The
// places have no common period with any grid of columns.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "vndf/certificate.h"
#include "vndf/precompute/unit_slopes.h"
#include "vndf/support/parallel.h"
#include "vndf/table_coordinates.h"

namespace vndf::precompute {

/// One row of a map: slope x over all u1 at one incidence, or slope y over all u2 at one slope x.
/// Each function returns the exact CDF, with its complement, at the slope that the sampler returns.
class RowMap {
 public:
  virtual ~RowMap() = default;

  /// Returns `u` as the sampler takes it, rounded to its precision.
  virtual Probability<double> given(const Probability<double>& u) const = 0;
  /// Takes a `u` that given() has returned.
  virtual Probability<double> cdf(const Probability<double>& u) const = 0;
  /// Takes any `u` of a tail. Random numbers in single precision come in steps near u = 1, which
  /// are no error of the map.
  virtual Probability<double> tail_cdf(const Probability<double>& u) const = 0;
  /// Follows the piece of the map at `place` in double precision to a `u` very near it, so that it
  /// can be differentiated.
  virtual Probability<double> smooth_cdf(const Probability<double>& u,
                                         const Probability<double>& place) const = 0;
};

/// Where a row is measured, beside places that are uniform in u.
struct RowPlaces {
  double row;  ///< the name of the row in the certificate: its angle or its slope
  /// The graded axis of columns, and how many columns it has.
  Probability<double> (*column_inverse)(double);
  std::size_t columns;
  /// Places where cells may begin, whatever their number.
  std::vector<Probability<double>> edges = {};
};

/// Inverse of the conditional column over the whole of u2. [0, 1/2] is the lower half of the rows,
/// which the table leaves out by symmetry.
Probability<double> conditional_u2(double t);

/// Measures one row. `index` is the number of the row, by which its places are shifted so that no
/// two rows are measured at the same ones.
TableErrors measure_row(const RowMap& map, const RowPlaces& places, std::size_t index);

/// Measures `count` rows, the errors of which `row` returns, and keeps the largest of each error
/// and the mean of the means.
TableErrors measure_rows(std::size_t count, const support::Workers& workers,
                         const std::function<TableErrors(std::size_t)>& row);

/// Ratios between the sampled and the exact mass of a tail are clamped to this and its inverse.
inline constexpr double kFarthestRatio = 8;

/// Golden rows of each table that are measured.
inline constexpr std::size_t kMeasuredRows = 420;

/// Angles of incidence, in degrees, that are measured beside the golden rows.
inline constexpr std::array<double, 9> kHardIncidences{0.0,  1e-7,  1e-3,   0.2, 0.3,
                                                       89.9, 89.99, 89.999, 90.0};

/// The same below the horizon.
inline constexpr std::array<double, 9> kHardIncidencesBelow{90.001, 90.01, 90.1, 91,   100,
                                                            120,    150,   179,  179.9};

/// Whether rows at the cotangent `c` < 0 are measured: at least kLeastArea is visible.
bool measures_below(const UnitSlopes& slopes, const BoundedSlope<double>& c);

/// Whether slope y is measured given the slope `x`, which a table keeps as `sigma` in single
/// precision. It is unless less than 1e-9 of the partial moment lies beyond x, which no sampler
/// reaches, or x is a pole of p22, where y has no distribution.
bool measures_conditional(const UnitSlopes& slopes, double x, float sigma);

}  // namespace vndf::precompute
