// Parts of gnuplot scripts that draw grids of numbers.
#include "report/plot_parts.h"

#include <fmt/format.h>

#include <cmath>

#include "report/gnuplot.h"

namespace vndf::tools {
namespace {

/// Stands for what is not a number, because gnuplot warns of that in a matrix.
constexpr double kNoNumber = -1e9;

}  // namespace

std::string margins(const Frame& f) {
  return fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
      "set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n",
      f.x, f.x + f.width, f.y, f.y + f.height);
}

std::string colour_box(const Frame& f, const std::string& label) {
  return fmt::format(
      "set colorbox vertical user origin screen {:.4f}, screen {:.4f} size screen {:.4f}, screen "
      "{:.4f}\nset cblabel {}\n",
      f.x, f.y, f.width, f.height, quoted(label));
}

std::string ground(const char* colour) {
  return fmt::format(
      "set object 1 rectangle from graph 0,0 to graph 1,1 behind fc rgb '{}' fs noborder\n",
      colour);
}

std::string grid_block(const std::string& name, const validate::Grid& grid) {
  std::string text = "$" + name + " << EOD\n";
  for (std::size_t k = 0; k < grid.values.size(); ++k) {
    const double v = grid.values[k];
    text += fmt::format("{:.5g}{}", std::isfinite(v) ? v : kNoNumber,
                        (k + 1) % grid.columns == 0 ? '\n' : ' ');
  }
  return text + "EOD\n";
}

std::string grid_image(const std::string& name, const validate::Grid& grid, double x0, double x1,
                       double y0, double y1) {
  return fmt::format(
      "${} matrix using ({} + ($1 + 0.5) * {}):({} + ($2 + 0.5) * {}):($3 > {} ? $3 : NaN) with "
      "image notitle",
      name, x0, (x1 - x0) / static_cast<double>(grid.columns), y0,
      (y1 - y0) / static_cast<double>(grid.rows), kNoNumber / 2);
}

std::vector<float> channel(const validate::Grid& grid) {
  std::vector<float> values;
  for (std::size_t j = grid.rows; j-- > 0;)
    for (std::size_t i = 0; i < grid.columns; ++i)
      values.push_back(static_cast<float>(grid.at(i, j)));
  return values;
}

std::vector<float> channel(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace vndf::tools
