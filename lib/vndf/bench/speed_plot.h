// The picture of a benchmark, which shows speed against size in one panel for each distribution.
#pragma once

#include <string>

#include "vndf/bench/speed_report.h"

namespace vndf::bench {

/// A script for gnuplot that draws to the file `output` with `terminal` ("svg", "pngcairo"). The
/// plots show the bytes of the tables across and upwards the incoherent time per sample as a
/// multiple of the baseline's. For each power of ten, a line of steps is the Pareto front of the
/// samplers whose u-error is below it. Marks are numbered, with the names in a key beside the plot,
/// and samplers without tables are horizontal lines. Throws std::invalid_argument if no entry but
/// the baseline has a u-error. `output` must not contain a quote.
std::string speed_plot(const SpeedReport& report, const std::string& terminal,
                       const std::string& output);

}  // namespace vndf::bench
