// Parts of gnuplot scripts that draw grids of numbers, and the same grids as channels of an image.
#pragma once

#include <string>
#include <vector>

#include "vndf/validate/pictures/grid.h"

namespace vndf::tools {

/// Palettes: one for sizes, and one for what lies on either side of a middle.
inline constexpr const char* kSizes =
    "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 "
    "'#fde725')\n";
inline constexpr const char* kSides =
    "set palette defined (0 '#2166ac', 0.25 '#92c5de', 0.5 '#f7f7f7', 0.75 '#f4a582', 1 "
    "'#b2182b')\n";

/// Width of a picture in pixels. The page shows it at two thirds of that, so that it is sharp.
inline constexpr int kPictureWidth = 1680;

/// A rectangle of the picture: its lower left corner and its size, as parts of the whole.
struct Frame {
  double x, y, width, height;
};

/// The plots that follow fill `frame`.
std::string margins(const Frame& frame);

/// The colours of the plots that follow are explained in a bar that fills `frame`.
std::string colour_box(const Frame& frame, const std::string& label);

/// The plots that follow have a ground of `colour`, which shows where the grid holds no number.
std::string ground(const char* colour);

/// `grid` as the data block $`name`.
std::string grid_block(const std::string& name, const validate::Grid& grid);

/// What to plot for the block of `grid`, over the rectangle from (x0, y0) to (x1, y1).
std::string grid_image(const std::string& name, const validate::Grid& grid, double x0, double x1,
                       double y0, double y1);

/// `f` of every number.
template <class F>
validate::Grid mapped(validate::Grid grid, F f) {
  for (double& v : grid.values) v = f(v);
  return grid;
}

/// The numbers as a channel of an image, whose rows run from the top.
std::vector<float> channel(const validate::Grid& grid);
std::vector<float> channel(const std::vector<double>& values);

}  // namespace vndf::tools
