// Pictures are drawn by gnuplot, which reads a script.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace vndf::tools {

/// What draw() leaves in a picture, so that vndf knows later that it may replace the file: a
/// comment at the end of SVG, and in PNG a chunk tEXt with its length and CRC (PNG
/// specification, 11.3.4).
inline constexpr std::string_view kSvgMark = "<!-- Drawn by vndf -->\n";
inline constexpr std::string_view kPngMark{"\0\0\0\x0dtEXtSoftware\0vndf\x93\xf2\xd4\x2f", 25};

/// The terminal of gnuplot for the name of a picture. Throws std::runtime_error unless it ends in
/// .png or .svg and holds nothing that ends a quoted name in a script.
std::string terminal_for(const std::string& output);

/// Runs gnuplot on the script that `script_for` makes for the name of the file to draw to, which
/// becomes `output` when it is whole. Throws std::runtime_error, naming `output`, if gnuplot is
/// missing or fails; then nothing is left behind.
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
