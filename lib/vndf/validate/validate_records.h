// The validator on records: samples that somebody's sampler has drawn, at configurations of his
// choice. Checked are the distribution of the normals, by the transform of each to uniform numbers,
// whatever the map; the map, where random numbers are given and it is the monotone inverse; and the
// density, where it is given.
#pragma once

#include <cstdint>
#include <optional>

#include "vndf/support/parallel.h"
#include "vndf/validate/records.h"
#include "vndf/validate/validate.h"

namespace vndf::validate {

/// Fewer records than this see no error that is worth the name.
inline constexpr std::size_t kFewestRecords = 100;
/// Largest relative error of a given density, of what it would be for a normal that faces wi.
inline constexpr double kRecordDensityError = 1e-3;

struct RecordOptions {
  SampledNormals normals = SampledNormals::visible_smith;
  /// Whether (u1, u2) to slopes claims to be the monotone inverse of the distribution; where not
  /// said, it does if 99 in 100 slopes x are within 1e-2 in u of it.
  std::optional<bool> monotone_inverse = {};
  /// Largest |CDF(x(u)) - u| of a map.
  double u_error = 1e-5;
  /// What the distribution may differ by: that of the tables which made it.
  DeclaredErrors declared = {};
  /// Of the random numbers that place normals lower than kSmallestHeight.
  std::uint64_t seed = 1;
  support::Workers workers = {};
};

/// Results at single configurations, or bands of them where there are many, and over all records.
/// Throws std::invalid_argument for fewer records than kFewestRecords.
Verdict validate_records(const Records& records, const ExactSlopes& exact,
                         const RecordOptions& options);

}  // namespace vndf::validate
