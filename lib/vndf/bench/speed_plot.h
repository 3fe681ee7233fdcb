// The picture of a benchmark: speed against size, one panel for each distribution.
#pragma once

#include <string>

#include "vndf/bench/speed_report.h"

namespace vndf::bench {

/// A script for gnuplot that draws to the file `output` by `terminal` ("svg", "pngcairo"): across,
/// the bytes of the tables; upwards, the incoherent time per sample as a multiple of the
/// baseline's; for each power of ten, as a line of steps, the front of those whose u-error is below
/// it. Numbers name the marks in a key beside the panel; samplers without tables are horizontal
/// lines. Throws std::invalid_argument where no entry but the baseline has a u-error. `output` must
/// hold no quote.
std::string speed_plot(const SpeedReport& report, const std::string& terminal,
                       const std::string& output);

}  // namespace vndf::bench
