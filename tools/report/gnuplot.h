// Pictures are drawn by gnuplot, which reads a script.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace vndf::tools {

/// The terminal of gnuplot for the name of a picture. Throws std::runtime_error unless it ends in
/// .png or .svg and holds nothing that ends a quoted name in a script.
std::string terminal_for(const std::string& output);

/// Runs gnuplot on the script that `script_for` makes for the name of the file to draw to, which
/// becomes `output` with the mark of vndf when it is whole. Throws std::runtime_error, naming
/// `output`, if gnuplot is missing or fails; then nothing is left behind.
void draw(const std::string& output,
          const std::function<std::string(const std::string&)>& script_for);

/// Throws std::runtime_error if gnuplot is missing. It is asked before long work.
void require_gnuplot();

/// `text` as a quoted string of a script.
std::string quoted(const std::string& text);

/// The bytes of a PNG picture of `width` x `height` pixels that `script` draws on white ground.
/// `scratch` is a file to draw to, gone afterwards.
std::string png_of(const std::string& script, int width, int height,
                   const std::filesystem::path& scratch);

}  // namespace vndf::tools
