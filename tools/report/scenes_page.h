// The page of the experiment with scenes: the pictures of all ways of sampling side by side, what
// they show where the previous method is worst, and the numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/scene_figure.h"

namespace vndf::tools {

/// What all figures of the page have in common.
struct ScenesRun {
  std::string program;  ///< name and version
  std::uint64_t seed = 0;
};

/// A square part of an image, in pixels.
struct Inset {
  std::size_t x = 0, y = 0, side = 0;
};

/// Where to look closer: the surroundings of the brightest pixel of the previous method at equal
/// samples, an eighth of the image wide, moved so that all of it lies in the image.
Inset inset_of(const SceneFigure& figure);

/// What the numbers of a figure say, in whole sentences of plain text. A ratio is told as it is, so
/// that a sentence is true whichever of the two is larger.
std::string findings(const SceneFigure& figure);

/// The page as HTML with its pictures inside; the data are linked. It is readable on a narrow
/// screen too.
std::string scenes_page(const ScenesRun& run, const std::vector<SceneFigure>& figures);

}  // namespace vndf::tools
