// Picture: the u-error of a map, |CDF(x(u)) - u|.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/gnuplot.h"
#include "report/plot_parts.h"
#include "report/report_pictures.h"
#include "vndf/io/exr_image.h"
#include "vndf/validate/pictures/u_error_map.h"

namespace vndf::tools {
namespace {

using validate::kSmallestShownU;
using validate::SamplerUnderTest;
using validate::UErrorMap;

constexpr double kTheta = 45;  // from which the conditional is seen
constexpr std::size_t kRows = 121, kColumns = 201;
constexpr double kSmallest = 1e-9, kLargest = 1e-2;  // errors that have colours of their own
constexpr int kHeight = 790;

double logit(double u) {
  return std::log(u / (1 - u));
}

/// Tick marks of an axis in logit(u).
std::string u_ticks() {
  constexpr std::pair<const char*, double> kTicks[]{
      {"1e-6", 1e-6}, {"1e-4", 1e-4}, {"0.01", 0.01},       {"0.1", 0.1},        {"0.5", 0.5},
      {"0.9", 0.9},   {"0.99", 0.99}, {"1-1e-4", 1 - 1e-4}, {"1-1e-6", 1 - 1e-6}};
  std::string text;
  for (const auto& [label, u] : kTicks)
    text += fmt::format("{}'{}' {:.4f}", text.empty() ? "" : ", ", label, logit(u));
  return "(" + text + ")";
}

/// The range of an axis.
struct Range {
  double low, high;
};

Range u_range() {
  return {logit(kSmallestShownU), -logit(kSmallestShownU)};
}

std::string panel(const std::string& name, const UErrorMap& map, const Range& y) {
  const auto logarithm = [](double e) { return std::log10(std::clamp(e, kSmallest, kLargest)); };
  const Range u = u_range();
  return grid_block(name, mapped(map.error, logarithm)) +
         fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\nplot {}\n", u.low, u.high, y.low,
                     y.high, grid_image(name, map.error, u.low, u.high, y.low, y.high));
}

std::string script(const UErrorMap& marginal, const UErrorMap& conditional) {
  const Frame left{0.062, 0.135, 0.372, 0.79}, right{0.54, 0.135, 0.372, 0.79};
  return fmt::format(
             "set multiplot\n{}set cbrange [{}:{}]\nset format cb '10^{{%.0f}}'\nunset key\n"
             "set tics out nomirror font ',12'\nset xtics {} rotate by -40\n",
             kSizes, std::log10(kSmallest), std::log10(kLargest), u_ticks()) +
         ground("#bbbbbb") + margins(left) +
         "unset colorbox\nset title 'slope x'\nset xlabel 'u_1' offset 0,1\nset ytics 0,15,90\n"
         "set ylabel '{/Italic θ} (degrees)'\n" +
         panel("marginal", marginal, {0, 90}) + margins(right) +
         colour_box({0.924, right.y, 0.013, right.height}, "u-error") +
         fmt::format(
             "set title 'slope y given slope x'\nset xlabel 'u_2' offset 0,1\nset ytics {}\n"
             "set ylabel 'u_1 of slope x'\n",
             u_ticks()) +
         panel("conditional", conditional, u_range()) + "unset multiplot\n";
}

std::string caption(const SamplerUnderTest& sampler, const UErrorMap& marginal,
                    const UErrorMap& conditional) {
  std::string unclaimed;
  if (sampler.claims.inverse_from > 0)
    unclaimed =
        fmt::format(" (this map is claimed from {:.3g} degrees on)", sampler.claims.inverse_from);
  return fmt::format(
      "Left: slope x over incidence and u1. Right: slope y given the slope x that is sampled at "
      "u1, seen from {} degrees, over u2; what is within the rounding of both slopes is 0. The "
      "axes of u run from {:.0e} to its complement, both tails as wide as the middle. Largest "
      "here: {:.2e} of slope x, {:.2e} of slope y; the bound of this sampler is {:.2e}. Tables "
      "show the waves of their rows and columns, below the bound everywhere; rounding shows as "
      "noise of 1e-8 to 1e-7; towards both ends the error must fade with the mass that is left. A "
      "band or a block that stands out is a wrong branch, a fit that ends, or a tail that is cut. "
      "Grey: nothing is claimed there{}, or so little mass is left that it is not checked.",
      kTheta, kSmallestShownU, largest(marginal.error), largest(conditional.error),
      sampler.bounds.u_error, unclaimed);
}

io::ExrImage data(const SamplerUnderTest& sampler, const UErrorMap& marginal,
                  const UErrorMap& conditional) {
  return {
      kColumns,
      kRows,
      {{"slope_x.u_error", channel(marginal.error)},
       {"slope_y.u_error", channel(conditional.error)}},
      {{"sampler", sampler.name},
       {"axes",
        fmt::format("slope_x: logit(u1) to the right, from u1 = {0:.0e} to its complement, theta "
                    "up from 0 to 90 degrees; slope_y: logit(u2) to the right and logit(u1) up, "
                    "likewise from {0:.0e}, seen from {1} degrees",
                    kSmallestShownU, kTheta)},
       {"values", "|CDF(x(u)) - u|; nan where nothing is claimed or checked"}}};
}

}  // namespace

Picture error_picture(const SamplerUnderTest& sampler, const PictureOptions& options) {
  const std::string title = "u-error of the slopes, |CDF(x(u)) - u|";
  if (!sampler.claims.monotone_inverse)
    return {
        "u-error", title,
        "There is no such picture: this sampler does not claim to be the monotone inverse of the "
        "distribution in (u1, u2), so no value of the CDF belongs to a random number. Its "
        "distribution is checked by "
        "counting, above."};
  const auto marginal = marginal_error_map(sampler, kRows, kColumns, options.workers);
  const auto conditional = conditional_error_map(sampler, kTheta, kRows, kColumns, options.workers);
  return {"u-error", title, caption(sampler, marginal, conditional),
          png_of(script(marginal, conditional), kPictureWidth, kHeight,
                 options.scratch / "u-error.png"),
          write_exr_image(data(sampler, marginal, conditional))};
}

}  // namespace vndf::tools
