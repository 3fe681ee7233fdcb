// Picture: the functions of a distribution, exact and as the sampler computes them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "report/gnuplot.h"
#include "report/plot_parts.h"
#include "report/report_pictures.h"
#include "vndf/io/exr_image.h"
#include "vndf/validate/pictures/distribution_curves.h"

namespace vndf::tools {
namespace {

using validate::Curve;
using validate::DistributionCurves;
using validate::SamplerUnderTest;

constexpr std::size_t kPlaces = 180, kMarkEvery = 9;
constexpr const char* kColours[]{"#3b528b", "#21918c", "#b5367a"};
/// The smallest value that is shown, over the largest.
constexpr double kShown = 1e-8;
constexpr int kHeight = 620;

std::string block(const std::string& name, const Curve& curve) {
  std::string text = "$" + name + " << EOD\n";
  for (std::size_t k = 0; k < curve.at.size(); ++k)
    text += fmt::format("{:.6g} {:.6g} {:.6g}\n", curve.at[k], curve.exact[k], curve.sampler[k]);
  return text + "EOD\n";
}

double decade_below(double value) {
  return std::pow(10, std::floor(std::log10(value)));
}

/// The decades in which the curves lie, as far as they are shown.
std::string value_range(const std::vector<Curve>& curves) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const Curve& c : curves)
    for (const double v : c.exact) {
      if (!(v > 0) || std::isinf(v)) continue;  // no slopes there, or a pole of p22
      high = std::max(high, v);
      low = std::min(low, v);
    }
  return fmt::format("set yrange [{:.3e}:{:.3e}]\n", decade_below(std::max(low, high * kShown)),
                     10 * decade_below(high));
}

/// Curves that share their axes: lines for the exact ones, rings for those of the sampler.
std::string panel(const std::string& name, const std::vector<Curve>& curves) {
  std::string blocks, plots;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const std::string one = fmt::format("{}{}", name, k);
    blocks += block(one, curves[k]);
    plots += fmt::format(
        "{0}${1} using 1:2 with lines lw 2 lc rgb '{2}' title 'alpha {3}', ${1} every {4} using "
        "1:3 with points pt 6 ps 1.1 lc rgb '{2}' notitle",
        k == 0 ? "" : ", ", one, kColours[k], curves[k].alpha, kMarkEvery);
  }
  return blocks + value_range(curves) + "plot " + plots + "\n";
}

std::string script(const DistributionCurves& curves) {
  Frame frame{0.055, 0.125, 0.265, 0.785};
  const auto next_margins = [&frame] {
    const std::string text = margins(frame);
    frame.x += 0.33;
    return text;
  };
  std::string text =
      "set multiplot\nset tics out nomirror font ',12'\nset grid lc rgb '#dddddd'\nunset key\n"
      "set logscale xy\nset format '10^{%T}'\n";
  text += fmt::format("set xrange [{:.4e}:{:.4e}]\nset xlabel 'slope r' offset 0,0.5\n",
                      curves.p22.at.front(), curves.p22.at.back());
  text += "set title 'p22(r), alpha 1' offset 0,-0.5\n" + next_margins() + panel("p", {curves.p22});
  text +=
      "unset logscale x\nset format x\nset xrange [0:90]\nset xtics 15\nset key top left font "
      "',12'\nset xlabel '{/Italic θ} (degrees)'\nset title 'Lambda'\n" +
      next_margins() + panel("lambda", curves.lambda);
  text += "unset key\nset xlabel '{/Italic θ}_m (degrees)'\nset title 'D'\n" + next_margins() +
          panel("d", curves.d);
  return text + "unset multiplot\n";
}

constexpr const char* kCaption =
    "Lines: exact, by quadrature. Rings: the sampler's own functions. p22 is the density of slopes "
    "at alpha 1, from a hundredth of the mean slope to the largest, or to where one slope in a "
    "million lies beyond; there a power tail descends straight. Lambda grows without bound towards "
    "90 degrees. D is per solid angle. A ring beside its line is an error of some per cent; "
    "smaller ones are in the table above.";

void add_layer(io::ExrImage& exr, const std::string& layer, const char* axis, const Curve& curve) {
  exr.channels[layer + "." + axis] = channel(curve.at);
  exr.channels[layer + ".exact"] = channel(curve.exact);
  exr.channels[layer + ".sampler"] = channel(curve.sampler);
}

io::ExrImage data(const SamplerUnderTest& sampler, const DistributionCurves& curves) {
  io::ExrImage exr{kPlaces, 1};
  add_layer(exr, "p22", "slope", curves.p22);
  for (const Curve& c : curves.lambda)
    add_layer(exr, fmt::format("lambda_{}", c.alpha), "theta", c);
  for (const Curve& c : curves.d) add_layer(exr, fmt::format("d_{}", c.alpha), "theta", c);
  exr.attributes = {
      {"sampler", sampler.name},
      {"axes", "one row; the axis of a layer is its channel slope or theta (degrees)"},
      {"values", "exact, and as the sampler computes it; the number in a name is alpha"}};
  return exr;
}

}  // namespace

Picture curve_picture(const SamplerUnderTest& sampler, const PictureOptions& options) {
  const auto curves = distribution_curves(sampler, {0.1, 0.5, 1}, kPlaces);
  return {"curves", "The distribution: p22, Lambda, D", kCaption,
          png_of(script(curves), kPictureWidth, kHeight, options.scratch / "curves.png"),
          write_exr_image(data(sampler, curves))};
}

}  // namespace vndf::tools
