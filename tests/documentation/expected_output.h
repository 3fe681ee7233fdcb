// Whether a command printed what its page says.
#pragma once

#include <string>

namespace vndf::documentation {

/// Numbers of a page may differ by this fraction where its mark allows no more: elementary
/// functions of another C library round otherwise.
inline constexpr double kNumberTolerance = 1e-4;

/// An empty string if `actual` is what `expected` says, else the first expected line that it lacks.
/// Between words any number of spaces is the same. Numbers may differ by the fraction `tolerance`.
/// "..." stands for any text within a line; as a line of its own, for any lines.
std::string first_difference(const std::string& expected, const std::string& actual,
                             double tolerance = kNumberTolerance);

}  // namespace vndf::documentation
