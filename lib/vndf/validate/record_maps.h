// Whether the map behind records is the monotone inverse of the CDFs, and how far from it it is.
//
// The map is recognised from the records alone, for each configuration by itself, because published
// samplers are the inverse at some incidences and take polar coordinates at others. It may increase
// or decrease in either random number, and either number may make the slope x. What is recognised
// must not depend on how large the error of the map is, or a bad map would escape for being bad. So
// ranks are compared, which any error that keeps the order of the slopes leaves as they are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/exact/exact_distribution.h"
#include "vndf/validate/records.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// The smallest rank correlation of both slopes' CDFs with the random numbers at which a map is
/// recognised. Concentric maps of the square to a disk (Shirley and Chiu 1997), which renderers use
/// and which are no inverse, have up to 0.9885 for slope x of GGX in 2000 records at 14 incidences,
/// and tests see none in 100 records at each of 91. Maps whose error changes the order of slopes by
/// 0.02 of u (root mean square) have 0.9976.
inline constexpr double kMapCorrelation = 0.997;
/// The fewest records of a configuration, or of a band of them, that a map is recognised from.
inline constexpr std::size_t kFewestForMap = 100;

/// How maps of records are judged.
struct RecordMapOptions {
  /// Whether all the records are said to be of an inverse; where it is not said it is recognised.
  std::optional<bool> monotone_inverse = {};
  /// The largest error in u.
  double u_error = 1e-5;
  support::Workers workers = {};
};

/// The results at the configurations where there is an inverse, and a line for those where there is
/// none.
struct RecordMapResults {
  std::vector<CheckResult> results;
  std::vector<SkippedCheck> skipped;
};

/// Judges `records`, which have random numbers and are of visible normals of Smith's surface.
/// `uniforms` are those of the normals, in the order of the records. Configurations of fewer than
/// kFewestForMap records are put in bands of equal numbers by the incidence after the stretch, on
/// which alone the exact map depends. Next to a band that is no inverse another may hold a part of
/// what is none, so it is not judged either.
///
/// The u-error is |CDF(x) - u| for every record, and |CDF(y | x) - u| for some thousands, less what
/// the rounding of a normal to single precision explains.
RecordMapResults check_record_maps(const Records& records, const ExactSlopes& exact,
                                   std::span<const Uniforms> uniforms,
                                   const RecordMapOptions& options);

}  // namespace vndf::validate
