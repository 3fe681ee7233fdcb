// The pictures of one sampler in a report. The data come from lib/vndf/validate/pictures; gnuplot
// draws them, and they are kept as EXR for whoever wants to look closer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::tools {

/// One picture with its text and its data.
struct Picture {
  std::string name;                ///< one word, in the name of its file of data
  std::string title;               ///< what is drawn
  std::string caption;             ///< what one sees, and what would be wrong
  std::string png = {}, exr = {};  ///< bytes; empty where there is nothing to draw
};

/// What drawing needs.
struct PictureOptions {
  std::uint64_t seed = 1;
  support::Workers workers = {};
  std::filesystem::path scratch = {};  ///< a folder for files that do not stay
};

/// Sampled and exact density of slopes at four incidences, and their difference
/// (slope_histogram.h).
Picture density_picture(const validate::SamplerUnderTest& sampler, const PictureOptions& options);

/// The u-error of both slopes (u_error_map.h); only a caption where the sampler claims no map.
Picture error_picture(const validate::SamplerUnderTest& sampler, const PictureOptions& options);

/// The weights of the sampler and of the previous method at grazing incidence (sample_weights.h).
Picture weight_picture(const validate::SamplerUnderTest& sampler, const PictureOptions& options);

/// p22, Lambda and D (distribution_curves.h).
Picture curve_picture(const validate::SamplerUnderTest& sampler, const PictureOptions& options);

}  // namespace vndf::tools
