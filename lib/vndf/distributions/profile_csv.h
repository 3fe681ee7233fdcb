// Radial profiles as text, because measurements come as tables. Two columns of a table count, and
// the others are ignored.
//
//   r,p22         density of slopes at slope radius r
//   theta,D       normal distribution function D at theta, radians in [0, pi/2)
//   theta_deg,D   the same with theta in degrees
//
// The header names the columns, in any order. If a table has several of these pairs, the first in
// this list counts. Each line is one sample, with a field for every name in the header. Radii or
// angles increase, and there are at least four. Blank lines and lines that start with '#' are
// skipped. D becomes p22 = D cos^4(theta) at r = tan(theta).
#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "vndf/distributions/radial_profile.h"

namespace vndf::distributions {

/// Reads a profile. Throws std::runtime_error, naming the file, the line and the rule that it
/// breaks.
RadialProfile read_profile_csv(const std::filesystem::path& path);

/// The same from a stream; `name` stands for the file in messages.
RadialProfile read_profile_csv(std::istream& stream, const std::string& name);

}  // namespace vndf::distributions
