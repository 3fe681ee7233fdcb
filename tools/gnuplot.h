// Pictures are drawn by gnuplot, which reads a script.
#pragma once

#include <string>

namespace vndf::tools {

/// The terminal of gnuplot for the name of a picture. Throws std::runtime_error unless it ends in
/// .png or .svg and holds nothing that ends a quoted name in a script.
std::string terminal_for(const std::string& output);

/// Runs a script. Throws std::runtime_error if gnuplot is missing or fails.
void run_gnuplot(const std::string& script);

}  // namespace vndf::tools
