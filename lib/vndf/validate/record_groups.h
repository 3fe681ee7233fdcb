// Groups of records that are counted or judged together: those of one configuration, or those of a
// band of incidence and surface where every record has a configuration of its own.
#pragma once

#include <cstddef>
#include <vector>

#include "vndf/validate/records.h"

namespace vndf::validate {

/// Indices of records in their list.
using Indices = std::vector<std::size_t>;

/// The records of each configuration, each list in increasing order.
std::vector<Indices> records_by_configuration(const Records& records);

/// The records of each band: the incidence from the mean facet is cut at fixed angles, either
/// roughness at powers of 10, and correlation at -+0.25 and -+0.75.
std::vector<Indices> records_by_band(const Records& records);

/// The middle of a group that is not empty: the median of each number.
Place middle_of(const Records& records, const Indices& group);

}  // namespace vndf::validate
