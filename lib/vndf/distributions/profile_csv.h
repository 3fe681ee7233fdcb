// Radial profiles as text, because measurements come as tables. A table has two columns.
//
//   r,p22         density of slopes at slope radius r
//   theta,D       normal distribution function D at theta, radians in [0, pi/2)
//   theta_deg,D   the same with theta in degrees
//
// The header tells which. Each line is one sample. Radii or angles increase, and there are at least
// four. Blank lines and lines that start with '#' are skipped. D becomes p22 = D cos^4(theta) at
// r = tan(theta).
#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "vndf/distributions/measured_profile.h"

namespace vndf::distributions {

/// Reads a profile. Throws std::runtime_error, naming the file, the line and the rule that it
/// breaks.
RadialProfile read_profile_csv(const std::filesystem::path& path);

/// The same from a stream; `name` stands for the file in messages.
RadialProfile read_profile_csv(std::istream& stream, const std::string& name);

}  // namespace vndf::distributions
