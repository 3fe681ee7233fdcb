// The validator on records: samples that somebody's sampler has drawn, at configurations of its
// author's choice. Checked are the distribution of the normals, by the transform of each to uniform
// numbers, whatever the map; the map, where random numbers are given and it is the monotone
// inverse; and the density, where it is given. What is not checked is told, with the reason.
#pragma once

#include <cstdint>
#include <optional>

#include "vndf/support/parallel.h"
#include "vndf/validate/records.h"
#include "vndf/validate/validate.h"

namespace vndf::validate {

/// Fewer records than this show no error that is worth the name.
inline constexpr std::size_t kFewestRecords = 100;
/// The largest relative error of a given density, of what it would be for a normal that faces wi.
inline constexpr double kRecordDensityError = 1e-3;

/// What the sampler behind the records claims, and what it is allowed.
struct RecordOptions {
  /// Which normals are drawn.
  SampledNormals normals = SampledNormals::visible_smith;
  /// Whether the map from (u1, u2) to slopes is said to be the monotone inverse of the CDFs,
  /// increasing or decreasing in either number, with the two in either role. Where this is not said
  /// it is recognised (record_maps.h).
  std::optional<bool> monotone_inverse = {};
  /// The largest |CDF(x(u)) - u| of a map that is the monotone inverse.
  double u_error = 1e-5;
  /// By how much the distribution may differ: by the errors of the tables which made the records.
  DeclaredErrors declared = {};
  /// Of the random numbers that place normals lower than kSmallestHeight (ExactDistribution).
  std::uint64_t seed = 1;
  support::Workers workers = {};
};

/// The results at single configurations, or in bands of them where there are many, and over all
/// records. The check of the configuration or band in which a statistic is worst is called "worst
/// group". A sampler whose normals are exact is accepted whatever its map is, but for a probability
/// of kRunSignificance. Directions below the surface that see less than kLeastArea of it, and all
/// directions below V-cavities, have no distribution; their records are left out. Throws
/// std::invalid_argument for fewer other records than kFewestRecords.
Verdict validate_records(const Records& records, const ExactSlopes& exact,
                         const RecordOptions& options);

}  // namespace vndf::validate
