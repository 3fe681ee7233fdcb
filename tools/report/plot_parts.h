// Parts of gnuplot scripts that draw grids of numbers, and the same grids as channels of an image.
#pragma once

#include <string>
#include <vector>

#include "vndf/validate/pictures/grid.h"

namespace vndf::tools {

/// Palettes: of sizes, and of what lies on either side of a middle.
inline constexpr const char* kSizes =
    "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 "
    "'#fde725')\n";
inline constexpr const char* kSides =
    "set palette defined (0 '#2166ac', 0.25 '#92c5de', 0.5 '#f7f7f7', 0.75 '#f4a582', 1 "
    "'#b2182b')\n";

/// Width of a picture in pixels, for a page that shows it at two thirds of that.
inline constexpr int kPictureWidth = 1680;

/// A rectangle of the picture: its lower left corner and its size, as parts of the whole.
struct Frame {
  double x, y, width, height;
};

/// The plots that follow fill `frame`.
std::string margins(const Frame& frame);

/// The colours of the plots that follow are explained in `frame`.
std::string colour_box(const Frame& frame, const std::string& label);

/// The plots that follow have ground of `colour` where the grid holds what is no number.
std::string ground(const char* colour);

/// `grid` as the data block $`name`.
std::string grid_block(const std::string& name, const validate::Grid& grid);

/// What to plot for the block of `grid`, over the rectangle that its cells fill.
std::string grid_image(const std::string& name, const validate::Grid& grid, double x0, double x1,
                       double y0, double y1);

/// `f` of every number.
template <class F>
validate::Grid mapped(validate::Grid grid, F f) {
  for (double& v : grid.values) v = f(v);
  return grid;
}

/// Rows from the top, as in an image.
std::vector<float> channel(const validate::Grid& grid);
std::vector<float> channel(const std::vector<double>& values);

}  // namespace vndf::tools
