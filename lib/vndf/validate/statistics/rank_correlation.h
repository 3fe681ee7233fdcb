// The rank correlation of two variables (Spearman 1904). It tells whether one increases or
// decreases with the other, however the scale of either is bent, so a map that is wrong by a factor
// is still found to be a map.
#pragma once

#include <span>

namespace vndf::validate {

/// The correlation, from -1 to 1, of the ranks of `a` and `b`, which are of equal size and hold no
/// NaN: 1 where b increases with a, -1 where it decreases. Equal values share the mean of their
/// ranks. 0 where either has one value only.
double rank_correlation(std::span<const double> a, std::span<const double> b);

}  // namespace vndf::validate
