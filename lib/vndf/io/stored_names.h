// The names of the attributes and arrays of a table file, which a reader looks for. It passes over
// all others.
#pragma once

#include <string>
#include <vector>

namespace vndf::io {

/// The array of the samples of a profile; only a profile has it.
inline constexpr char kSamples[] = "profile_samples";

/// The attribute of the surface of a map; only the tables of a map have it.
inline constexpr char kSurface[] = "surface";

/// The attribute of a figure of a certificate.
std::string certificate_name(const std::string& figure);

/// All attributes and all arrays of format version 4.1.
const std::vector<std::string>& attribute_names();
const std::vector<std::string>& array_names();

}  // namespace vndf::io
