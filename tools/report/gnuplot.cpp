// Running gnuplot.
#include "report/gnuplot.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "vndf/io/atomic_file.h"
#include "vndf/io/picture_mark.h"

namespace vndf::tools {
namespace {

namespace fs = std::filesystem;

/// False if gnuplot is missing or fails; it says why on standard error.
bool run_gnuplot(const std::string& script) {
  // Standard output is dropped because gnuplot draws there where it cannot open its file. Scripts
  // are UTF-8, also where the machine has no language set.
  std::FILE* pipe = popen("LC_ALL=C.UTF-8 gnuplot >/dev/null", "w");
  if (pipe == nullptr) return false;
  // Writing to a gnuplot that is missing or has given up would end this program.
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  const bool written = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  const bool drawn = pclose(pipe) == 0;
  std::signal(SIGPIPE, before);
  return written && drawn;
}

/// Puts the mark of vndf into a drawn picture.
void mark(const std::string& picture) {
  std::string bytes = io::read_file(picture);
  const bool png = bytes.starts_with("\x89PNG");
  io::replace_file(picture, png ? io::marked_png(bytes) : bytes.append(io::kSvgMark));
}

}  // namespace

std::string terminal_for(const std::string& output) {
  // Gnuplot reads a quoted file name up to the next quote.
  if (output.find_first_of("'\n\\") != std::string::npos)
    throw std::runtime_error("'" + output + "': the name must not hold a quote or a backslash");
  const auto extension = fs::path(output).extension();
  if (extension == ".png") return "pngcairo";
  if (extension == ".svg") return "svg";
  throw std::runtime_error("'" + output + "': a picture's name must end in .png or .svg");
}

void draw(const std::string& output,
          const std::function<std::string(const std::string&)>& script_for) {
  const std::string drawn = output + "." + std::to_string(getpid()) + ".tmp";
  const bool done = run_gnuplot(script_for(drawn));
  std::error_code error;
  if (done) mark(drawn);
  if (done) fs::rename(drawn, output, error);
  if (done && !error) return;
  fs::remove(drawn, error);
  throw std::runtime_error(output + ": gnuplot did not draw it; is it installed (package " +
                           "gnuplot-nox), and is there room?");
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
  draw(scratch.string(), [&](const std::string& file) {
    return fmt::format(
        "set terminal pngcairo size {},{} font 'sans,15' background 'white'\n"
        "set output {}\nset encoding utf8\n{}\nset output\n",
        width, height, quoted(file), script);
  });
  std::string bytes = io::read_file(scratch);
  std::filesystem::remove(scratch);
  return bytes;
}

}  // namespace vndf::tools
