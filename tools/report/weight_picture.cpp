// Picture: sample weights over the unit square of random numbers, Figure 4 of Heitz and d'Eon 2014.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "report/gnuplot.h"
#include "report/plot_parts.h"
#include "report/report_pictures.h"
#include "vndf/io/exr_image.h"
#include "vndf/validate/pictures/sample_weights.h"

namespace vndf::tools {
namespace {

using validate::Configuration;
using validate::SampledNormals;
using validate::SamplerUnderTest;
using validate::SampleWeights;

constexpr double kTheta = 1.5;  // radians, as in the paper
constexpr double kAlpha = 0.5;
constexpr std::size_t kCells = 160;
constexpr int kHeight = 780;

struct Panel {
  std::string name, title;  ///< a word; what is drawn
  SampleWeights weights;
};

/// The sampler and the previous method, or this alone where the sampler is of that method.
std::vector<Panel> panels_of(const SamplerUnderTest& sampler) {
  const Configuration c = validate::at_angles(kTheta / validate::kDegree, 0, kAlpha, kAlpha);
  if (sampler.claims.normals == SampledNormals::all)
    return {{"previous", "this sampler (all normals)", sample_weights(sampler, c, kCells)}};
  return {{"visible", "this sampler (visible normals)", sample_weights(sampler, c, kCells)},
          {"previous", "the previous method (all normals)", previous_weights(sampler, c, kCells)}};
}

std::string script(const std::vector<Panel>& panels) {
  constexpr double kStep = 0.45, kWidth = 0.38;
  const auto logarithm = [](double weight) {
    return weight > 0 ? std::clamp(std::log2(weight), -3.0, 3.0) : validate::kUnknown;
  };
  std::string text = fmt::format(
      "set multiplot\n{}set cbrange [-3:3]\n"
      "set cbtics ('1/8' -3, '1/4' -2, '1/2' -1, '1' 0, '2' 1, '4' 2, '8' 3)\n"
      "set xrange [0:1]\nset yrange [0:1]\nset tics out nomirror\nset xtics 0.25\nset ytics 0.25\n"
      "unset key\nset xlabel 'u_1' offset 0,0.5\nset ylabel 'u_2' offset 1\n",
      kSides);
  text += ground("black");
  Frame frame{0.065, 0.1, kWidth, 0.815};
  text += colour_box({frame.x + kStep * static_cast<double>(panels.size() - 1) + kWidth + 0.014,
                      frame.y, 0.013, frame.height},
                     "weight");
  for (const Panel& p : panels) {
    text += grid_block(p.name, mapped(p.weights.weight, logarithm)) + margins(frame);
    text += fmt::format("set title '{}, at most {:.3g}' offset 0,-0.5\nplot {}\n", p.title,
                        p.weights.largest, grid_image(p.name, p.weights.weight, 0, 1, 0, 1));
    text += "unset ylabel\nunset colorbox\n";
    frame.x += kStep;
  }
  return text + "unset multiplot\n";
}

std::string caption(const SamplerUnderTest& sampler, const std::vector<Panel>& panels) {
  std::string text = fmt::format(
      "The weight of each reflected sample at grazing incidence, theta {} = {:.2f} degrees, alpha "
      "{}, for facets that reflect everything (Figure 4 of Heitz and d'Eon 2014). Black: samples "
      "of weight 0, lost because their facet faces away or their reflection goes into the surface.",
      kTheta, kTheta / validate::kDegree, kAlpha);
  for (const Panel& p : panels)
    text += fmt::format(" Of {}: largest {:.3g}, mean {:.4f}, lost {:.1f} %.", p.title,
                        p.weights.largest, p.weights.mean, 100 * p.weights.lost);
  if (sampler.claims.normals == SampledNormals::all)
    return text +
           " This sampler draws all normals, so half of the square is lost and weights have no "
           "bound; those of visible normals are never above 1.";
  if (sampler.claims.normals == SampledNormals::visible_v_cavity)
    text +=
        " The noise is the choice between the two facets of a cavity, made by the last digits of "
        "u1.";
  return text +
         " Weights of visible normals are never above 1: red on the left would be an error. Both "
         "methods estimate the same reflectance, so their means agree to the coarseness of the "
         "cells.";
}

io::ExrImage data(const SamplerUnderTest& sampler, const std::vector<Panel>& panels) {
  io::ExrImage exr{kCells, kCells};
  for (const Panel& p : panels) exr.channels[p.name + ".weight"] = channel(p.weights.weight);
  exr.attributes = {{"sampler", sampler.name},
                    {"axes", "u1 to the right and u2 up, from 0 to 1"},
                    {"values", "weight of the reflected sample"}};
  return exr;
}

}  // namespace

Picture weight_picture(const SamplerUnderTest& sampler, const PictureOptions& options) {
  const auto panels = panels_of(sampler);
  return {"weights", "Sample weights over the random numbers, at grazing incidence",
          caption(sampler, panels),
          png_of(script(panels), kPictureWidth, kHeight, options.scratch / "weights.png"),
          write_exr_image(data(sampler, panels))};
}

}  // namespace vndf::tools
