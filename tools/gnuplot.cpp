// Running gnuplot.
#include "gnuplot.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "io/whole_file.h"

namespace vndf::tools {

std::string terminal_for(const std::string& output) {
  // Gnuplot reads a quoted file name up to the next quote.
  if (output.find_first_of("'\n\\") != std::string::npos)
    throw std::runtime_error("'" + output + "': the name must not hold a quote or a backslash");
  const auto extension = std::filesystem::path(output).extension();
  if (extension == ".png") return "pngcairo";
  if (extension == ".svg") return "svg";
  throw std::runtime_error("'" + output + "': a picture's name must end in .png or .svg");
}

void run_gnuplot(const std::string& script) {
  std::FILE* pipe = popen("gnuplot", "w");
  if (pipe == nullptr) throw std::runtime_error("cannot start gnuplot");
  const bool written = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  if (pclose(pipe) != 0 || !written)
    throw std::runtime_error("gnuplot failed; is it installed (package gnuplot-nox)?");
}

void require_gnuplot() {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0)
    throw std::runtime_error(
        "pictures are drawn by gnuplot, which is not installed; install it (package gnuplot-nox)");
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

std::string png_of(const std::string& script, int width, int height,
                   const std::filesystem::path& scratch) {
  run_gnuplot(
      fmt::format("set terminal pngcairo size {},{} font 'sans,15' background 'white'\n"
                  "set output {}\nset encoding utf8\n{}\nset output\n",
                  width, height, quoted(scratch.string()), script));
  std::string bytes = io::read_whole_file(scratch);
  std::filesystem::remove(scratch);
  return bytes;
}

}  // namespace vndf::tools
