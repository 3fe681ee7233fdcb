// Needs the runtime library alone: the tables are made in memory, and no file library is linked.
#include <vndf/bsdf/dielectric_bsdf.h>
#include <vndf/tabulated_sampler.h>

#include <vector>

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
  const vndf::DielectricBsdf glass(sampler, {1, 1}, 1.5f);
  return glass.sample({0, 0, 1}, 0.5f, 0.5f, 0.5f).weight > 0 ? 0 : 1;
}
