// How far one row of a sampler's map is from the exact law, whatever the sampler is: the u-errors
// of what it returns, its density and its tails, at places that no grid of columns has a period
// with.
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
/// CDFs are those of the exact law at the slope that the sampler returns, with their complements.
class RowMap {
 public:
  virtual ~RowMap() = default;

  /// `u` as the sampler takes it.
  virtual Probability<double> given(const Probability<double>& u) const = 0;
  /// At a `u` of given().
  virtual Probability<double> cdf(const Probability<double>& u) const = 0;
  /// At any `u` of a tail, where steps of the random numbers at the end u = 1 are no error of the
  /// map.
  virtual Probability<double> tail_cdf(const Probability<double>& u) const = 0;
  /// At `u` very near `place`, of the piece of the map there in double precision, so that it may be
  /// differentiated.
  virtual Probability<double> smooth_cdf(const Probability<double>& u,
                                         const Probability<double>& place) const = 0;
};

/// Where a row is judged.
struct RowPlaces {
  double row;  ///< what the certificate calls it
  /// The graded axis of columns and their number: its places beyond those uniform in u.
  Probability<double> (*column_inverse)(double);
  std::size_t columns;
  /// Where cells may begin whatever their number.
  std::vector<Probability<double>> edges = {};
};

/// Inverse of the conditional column on the whole of u2: [0, 1/2] the lower half of the rows.
Probability<double> conditional_u2(double t);

/// `index` of the row shifts its places.
TableErrors judge_row(const RowMap& map, const RowPlaces& places, std::size_t index);

/// Those of a table of `count` rows, of which `row` gives the errors of each.
TableErrors judge_rows(std::size_t count, const support::Workers& workers,
                       const std::function<TableErrors(std::size_t)>& row);

/// Farthest ratio of the mass of a tail that is told from others.
inline constexpr double kFarthestRatio = 8;

/// Golden rows of each table at which it is judged.
inline constexpr std::size_t kJudgedRows = 420;

/// Angles of incidence, in degrees, at which slope x is judged beside them.
inline constexpr std::array<double, 9> kHardIncidences{0.0,  1e-7,  1e-3,   0.2, 0.3,
                                                       89.9, 89.99, 89.999, 90.0};

/// Whether slope y is judged given slope x, which a table holds as `sigma` in single precision:
/// where 1e-9 of the slopes x lie beyond, and not on a pole, which leaves no law or one that none
/// samples.
bool judges_conditional(const UnitSlopes& slopes, double x, float sigma);

}  // namespace vndf::precompute
