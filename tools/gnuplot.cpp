// Running gnuplot.
#include "gnuplot.h"

#include <cstdio>
#include <filesystem>
#include <stdexcept>

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

}  // namespace vndf::tools
