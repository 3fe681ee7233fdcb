// Links the runtime alone: tables made in memory, no file library.
#include "vndf/tabulated_sampler.h"

int main() {
  const std::vector<float> rows{0, 0.25f, 0.5f, 0.75f, 1, 0, 0.25f, 0.5f, 0.75f, 1};
  const vndf::LogCurve<double> curve({{0, 1, vndf::Grading::none, {{0, 0}, {-1, -1}}}}, true);
  const vndf::TabulatedSampler<float> sampler(vndf::share({.distribution = "line",
                                                           .mean_slope = 1,
                                                           .marginal = {2, 5, rows},
                                                           .conditional = {2, 5, rows},
                                                           .marginal_rows = {},
                                                           .conditional_rows = {},
                                                           .marginal_map = {{0, 1}, {1, 1}},
                                                           .log_ndf = curve,
                                                           .log_backfacing = curve}));
  const auto wm = sampler.sample({0, 0, 1}, {1, 1}, 0.5f, 0.5f);
  return wm.z > 0 ? 0 : 1;
}
