// The names of the attributes and arrays of a table file, which a reader looks for. It passes over
// all others.
#pragma once

#include <string>
#include <vector>

namespace vndf::io {

/// The array of the samples of a profile; only a profile has it.
inline constexpr char kSamples[] = "profile_samples";

/// The attribute of a figure of a certificate.
std::string certificate_name(const std::string& figure);

/// All attributes and all arrays of format version 4.0.
const std::vector<std::string>& attribute_names();
const std::vector<std::string>& array_names();

}  // namespace vndf::io
