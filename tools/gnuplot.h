// Pictures are drawn by gnuplot, which reads a script.
#pragma once

#include <functional>
#include <string>

namespace vndf::tools {

/// The terminal of gnuplot for the name of a picture. Throws std::runtime_error unless it ends in
/// .png or .svg and holds nothing that ends a quoted name in a script.
std::string terminal_for(const std::string& output);

/// Runs gnuplot on the script that `script_for` makes for the name of the file to draw to, which
/// becomes `output` when it is whole. Throws std::runtime_error, naming `output`, if gnuplot is
/// missing or fails; then nothing is left behind.
void draw(const std::string& output,
          const std::function<std::string(const std::string&)>& script_for);

}  // namespace vndf::tools
