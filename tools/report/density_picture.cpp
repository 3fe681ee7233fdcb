// Picture: the density of visible slopes, sampled and exact, as in the figures of Heitz and d'Eon
// 2014, and their difference.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/gnuplot.h"
#include "report/plot_parts.h"
#include "report/report_pictures.h"
#include "vndf/io/exr_image.h"
#include "vndf/validate/pictures/slope_histogram.h"

namespace vndf::tools {
namespace {

using validate::Configuration;
using validate::Grid;
using validate::SampledNormals;
using validate::SamplerUnderTest;
using validate::SlopeHistogram;

constexpr std::array kAngles{0.0, 30.0, 60.0, 90.0};
constexpr double kPhi = 45, kAlphaX = 2, kAlphaY = 1;
constexpr int kHeight = 1270;
/// The streams of random numbers below this are those of the distribution check.
constexpr std::uint64_t kFirstStream = 1000;

using Histograms = std::array<SlopeHistogram, kAngles.size()>;

Histograms histograms(const SamplerUnderTest& sampler, const PictureOptions& options) {
  Histograms list;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Configuration c = validate::at_angles(kAngles[k], kPhi, kAlphaX, kAlphaY);
    list[k] = slope_histogram(
        sampler, c, shown_slopes(*sampler.exact, c.alpha),
        {.seed = options.seed, .stream = kFirstStream + k, .workers = options.workers});
  }
  return list;
}

double highest_density(const Histograms& list) {
  double highest = 0;
  for (const SlopeHistogram& h : list) highest = std::max(highest, largest(h.exact));
  return highest;
}

/// One row of panels. Only the titles tell its panels apart.
struct PanelRow {
  std::string label;
  Grid SlopeHistogram::*grid;
  std::string colours, colour_label;
  std::string (*title)(const SlopeHistogram&);
};

std::string angle_title(const SlopeHistogram& h) {
  return fmt::format("set title '{{/Italic θ}} = {:.0f}°' offset 0,-0.6\n",
                     h.configuration.theta());
}
std::string no_title(const SlopeHistogram&) {
  return "unset title\n";
}
std::string mean_square_title(const SlopeHistogram& h) {
  const double error = std::sqrt(2 / std::max(1.0, static_cast<double>(h.compared)));
  return fmt::format("set title 'mean square {:.3f} ± {:.3f}' font ',12' offset 0,-0.7\n",
                     h.mean_square, error);
}

/// The line of slopes of the facets that are seen at 90 degrees; nothing where there is none.
std::string edge_of_visibility(const SamplerUnderTest& sampler, const Configuration& c) {
  if (sampler.claims.normals == SampledNormals::all || c.theta() == 0) return "";
  return fmt::format(", ({} - {} * x) / {} with lines dt 2 lw 1.5 lc rgb '#888888' notitle", c.wi.z,
                     c.wi.x, c.wi.y);
}

std::string row_of_panels(const SamplerUnderTest& sampler, const Histograms& list,
                          const PanelRow& row, std::size_t number) {
  constexpr double kLeft = 0.062, kStep = 0.213, kSide = 0.198, kUp = 0.308;
  const bool lowest = number == 0;
  Frame frame{kLeft, 0.058 + kUp * static_cast<double>(number), kSide,
              kSide * kPictureWidth / kHeight};
  std::string text = row.colours;
  text += fmt::format("set ylabel '{}: slope y' offset 1\nset format y\n", row.label);
  text += lowest ? "set xlabel 'slope x' offset 0,0.7\nset format x\n"
                 : "unset xlabel\nset format x ''\n";
  text += colour_box({kLeft + kStep * 3 + kSide + 0.012, frame.y, 0.013, frame.height},
                     row.colour_label);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string name = fmt::format("panel{}_{}", number, k);
    const double w = list[k].half_width;
    text += grid_block(name, list[k].*row.grid) + margins(frame) + row.title(list[k]);
    text += "plot " + grid_image(name, list[k].*row.grid, -w, w, -w, w) +
            edge_of_visibility(sampler, list[k].configuration) + "\n";
    if (k == 0) text += "unset ylabel\nset format y ''\nunset colorbox\n";
    frame.x += kStep;
  }
  return text;
}

std::string script(const SamplerUnderTest& sampler, const Histograms& list) {
  const double w = list.front().half_width;
  const std::string density = fmt::format("{}set cbrange [0:{}]\n", kSizes, highest_density(list));
  const std::array rows{
      PanelRow{"difference", &SlopeHistogram::deviation,
               std::string(kSides) + "set cbrange [-4:4]\n", "standard errors", mean_square_title},
      PanelRow{"exact", &SlopeHistogram::exact, density, "density", no_title},
      PanelRow{"sampled", &SlopeHistogram::sampled, density, "density", angle_title}};
  std::string text = fmt::format(
      "set multiplot\nset xrange [{0}:{1}]\nset yrange [{0}:{1}]\nset tics out nomirror font "
      "',12'\n"
      "unset key\n",
      -w, w);
  for (std::size_t r = 0; r < rows.size(); ++r) text += row_of_panels(sampler, list, rows[r], r);
  return text + "unset multiplot\n";
}

std::string text_of(SampledNormals normals) {
  if (normals == SampledNormals::visible_smith) return "the visible normals of Smith's surface";
  if (normals == SampledNormals::visible_v_cavity) return "the visible normals of V-cavities";
  return "all normals, the same for every incidence";
}

std::string caption(const SamplerUnderTest& sampler, const Histograms& list, std::uint64_t seed) {
  const SlopeHistogram& h = list.front();
  const double side = 2 * h.half_width / static_cast<double>(h.exact.columns);
  const double expected = highest_density(list) * side * side * static_cast<double>(h.samples);
  std::string inside;
  for (const SlopeHistogram& one : list)
    inside += fmt::format("{}{:.1f} %", inside.empty() ? "" : ", ", 100 * one.inside);
  std::string text = fmt::format(
      "The distribution of {}. Each picture is a histogram of {} normals (seed {}) in {} x {} "
      "cells, which "
      "hold {} of them; what lies beyond is not shown. Where n samples are expected in a cell, "
      "their noise is 1/sqrt(n), {:.1f} % in the highest cell, and the eye sees no smaller error. "
      "The last row does: sampled less exact in units of that noise. It should have no pattern, 5 "
      "cells in 100 beyond 2 and hardly one beyond 4, and its mean square should be 1 within a few "
      "of the errors given. A patch or a line of one colour is an error of the sampler; whether it "
      "is one that its bounds allow, the table above says.",
      text_of(sampler.claims.normals), h.samples, seed, h.exact.columns, h.exact.rows, inside,
      100 / std::sqrt(expected));
  if (sampler.claims.normals != SampledNormals::all)
    text += " Dashed: the edge of visibility, facets seen at 90 degrees; none beyond may be drawn.";
  return text;
}

io::ExrImage data(const SamplerUnderTest& sampler, const Histograms& list, std::uint64_t seed) {
  const SlopeHistogram& first = list.front();
  io::ExrImage exr{first.exact.columns, first.exact.rows};
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string layer = fmt::format("theta_{:02.0f}", kAngles[k]);
    exr.channels[layer + ".sampled"] = channel(list[k].sampled);
    exr.channels[layer + ".exact"] = channel(list[k].exact);
    exr.channels[layer + ".deviation"] = channel(list[k].deviation);
  }
  exr.attributes = {{"sampler", sampler.name},
                    {"axes", fmt::format("slope x to the right and slope y up, {:.9g} to {:.9g}",
                                         -first.half_width, first.half_width)},
                    {"values", "mean density of slopes in each cell; deviation in standard errors"},
                    {"samples", fmt::format("{}", first.samples)},
                    {"seed", fmt::format("{}", seed)}};
  return exr;
}

}  // namespace

Picture density_picture(const SamplerUnderTest& sampler, const PictureOptions& options) {
  const Histograms list = histograms(sampler, options);
  return {"density",
          fmt::format("Density of slopes, alpha {} x {}, phi {} degrees", kAlphaX, kAlphaY, kPhi),
          caption(sampler, list, options.seed),
          png_of(script(sampler, list), kPictureWidth, kHeight, options.scratch / "density.png"),
          write_exr_image(data(sampler, list, options.seed))};
}

}  // namespace vndf::tools
