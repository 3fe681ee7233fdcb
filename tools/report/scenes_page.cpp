// The page of the experiment with scenes.
#include "report/scenes_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/picture.h"
#include "report/html.h"

namespace vndf::tools {
namespace {

/// The part of the width of an image that an inset shows, and its least side in pixels.
constexpr std::size_t kPart = 8, kLeastSide = 16;

/// The luminance that the mean of a picture gets, as a photographer exposes for a middle tone.
/// White surroundings are then seen as white, but not so bright that noise in them is lost.
constexpr double kMiddle = 0.5;

/// Pixels of insets stay squares. On a narrow screen there are two pictures in a row, and every row
/// of a table becomes a block in which each number has its name.
constexpr const char* kStyle = R"(
.shots { display: grid; grid-template-columns: repeat(5, minmax(0, 1fr)); gap: 12px 8px; margin: 0.5em 0 1em; }
.shots.four { grid-template-columns: repeat(4, minmax(0, 1fr)); }
.shots figcaption { line-height: 1.35; margin-top: 3px; overflow-wrap: anywhere; }
.picture { position: relative; }
.picture i { position: absolute; outline: 1.5px solid #c1121f; }
img.inset { image-rendering: pixelated; margin-top: 4px; }
.note { color: #444; max-width: 62em; }
tr.group td { font-weight: bold; padding-top: 0.7em; }
@media (max-width: 720px) {
  .shots, .shots.four { grid-template-columns: repeat(2, minmax(0, 1fr)); }
  table, tbody { display: block; }
  tr.heads { display: none; }
  tr { display: grid; grid-template-columns: repeat(2, 1fr); column-gap: 1em; padding: 4px 0; border-bottom: 1px solid #ddd; }
  td { border: 0; padding: 0; }
  td.name { grid-column: 1 / -1; font-weight: bold; }
  td.number { text-align: left; white-space: normal; }
  td.number::before { content: attr(data-name) " "; color: #666; }
}
)";

std::string row(const std::string& name, const std::vector<NamedNumber>& numbers) {
  std::string text = fmt::format("<tr><td class=\"name\">{}</td>", escaped(name));
  for (const NamedNumber& number : numbers)
    text += fmt::format("<td class=\"number\" data-name=\"{}\">{}</td>", number.name, number.text);
  return text + "</tr>\n";
}

std::string rows(const std::string& title, const Comparison& comparison) {
  std::string text = fmt::format("<tr class=\"group\"><td colspan=\"7\">{}</td></tr>\n", title);
  for (const Way way : kWays) text += row(name_of(way), numbers_of(comparison, way));
  return text;
}

std::string table(const SceneFigure& figure) {
  std::string text = "<table><tr class=\"heads\"><th></th>";
  for (const NamedNumber& number : numbers_of(figure.equal_samples, Way::previous))
    text += fmt::format("<th class=\"number\">{}</th>", number.name);
  return text + "</tr>\n" + rows("at equal samples", figure.equal_samples) +
         rows("at equal time", figure.equal_time) + "</table>\n";
}

/// The part of an image that an inset shows.
render::Image part_of(const render::Image& image, const Inset& inset) {
  render::Image part{inset.side, inset.side};
  for (std::size_t y = 0; y < inset.side; ++y)
    for (std::size_t x = 0; x < inset.side; ++x)
      part.pixels.push_back(image.at(inset.x + x, inset.y + y));
  return part;
}

/// How the pictures of a figure are shown.
struct View {
  Inset inset;
  float exposure;  ///< factor of radiance
};

View view_of(const SceneFigure& figure) {
  const double mean = render::mean_luminance(figure.reference.image);
  return {inset_of(figure), static_cast<float>(kMiddle / mean)};
}

std::string img(const std::string& name, const char* css_class, const render::Image& image,
                float exposure) {
  return fmt::format("<img class=\"{}\" alt=\"{}\" src=\"{}\">", css_class, escaped(name),
                     png_address(render::png_bytes(image, exposure)));
}

/// The picture with the outline of the inset on it.
std::string outlined(const std::string& name, const render::Image& image, const View& view) {
  const Inset& inset = view.inset;
  const auto percent_of = [](std::size_t part, std::size_t whole) {
    return 100 * static_cast<double>(part) / static_cast<double>(whole);
  };
  return fmt::format(
      "<div class=\"picture\">{}<i style=\"left: {:.3f}%; top: {:.3f}%; width: {:.3f}%; height: "
      "{:.3f}%\"></i></div>\n",
      img(name, "whole", image, view.exposure), percent_of(inset.x, image.width),
      percent_of(inset.y, image.height), percent_of(inset.side, image.width),
      percent_of(inset.side, image.height));
}

std::string magnified(const std::string& name, const render::Image& image, const View& view) {
  return img(name + ", magnified", "inset", part_of(image, view.inset), view.exposure) + "\n";
}

std::string shot(const std::string& pictures, const std::string& caption, const std::string& file) {
  return fmt::format("<figure>\n{}<figcaption>{} <a href=\"{}\">EXR</a></figcaption>\n</figure>\n",
                     pictures, caption, escaped(file));
}

std::string fireflies_text(const SceneRendering& r) {
  if (r.error.fireflies == 0) return "No pixel is a firefly.";
  return fmt::format("Fireflies: {} of {} pixels, the brightest {:.3g} times the reference.",
                     r.error.fireflies, r.image.pixels.size(), r.error.brightest);
}

std::string caption_of(Way way, const SceneRendering& r) {
  return fmt::format("<b>{}</b>, {} samples, {:.1f} s. Relative MSE {:.2g}. {}",
                     escaped(name_of(way)), r.samples, r.seconds, r.error.relative_mse,
                     fireflies_text(r));
}

std::string equal_samples_shots(const SceneFigure& figure, const View& view) {
  std::string text = "<div class=\"shots\">\n";
  for (const Way way : kWays) {
    const SceneRendering& r = figure.equal_samples[way];
    text += shot(outlined(name_of(way), r.image, view) + magnified(name_of(way), r.image, view),
                 caption_of(way, r), equal_samples_file(figure, way));
  }
  const Reference& reference = figure.reference;
  return text +
         shot(outlined("reference", reference.image, view) +
                  magnified("reference", reference.image, view),
              fmt::format("<b>reference</b>, {} samples, {:.1f} s. Its own relative MSE is about "
                          "{:.2g}.",
                          reference.samples, reference.seconds, reference.relative_mse),
              reference_file(figure)) +
         "</div>\n";
}

std::string equal_time_shots(const SceneFigure& figure, const View& view) {
  std::string text = "<div class=\"shots four\">\n";
  for (const Way way : kWays) {
    const SceneRendering& r = figure.equal_time[way];
    text += shot(magnified(name_of(way), r.image, view), caption_of(way, r),
                 equal_time_file(figure, way));
  }
  return text + "</div>\n";
}

std::string section(const SceneFigure& figure) {
  const View view = view_of(figure);
  return fmt::format("<h2 id=\"{}\">{}</h2>\n<p>{}</p>\n<p>{}</p>\n<h3>At equal samples</h3>\n{}",
                     escaped(figure.name), escaped(figure.title), escaped(figure.setup),
                     escaped(findings(figure)), equal_samples_shots(figure, view)) +
         "<h3>At equal time, the outlined part</h3>\n" + equal_time_shots(figure, view) +
         table(figure);
}

std::string ratio_text(double a, double b) {
  return fmt::format("{:.3g}", a / b);
}

double smallest_error(const SceneFigure& figure) {
  double smallest = figure.equal_samples[Way::previous].error.relative_mse;
  for (const Comparison* comparison : {&figure.equal_samples, &figure.equal_time})
    for (const Way way : kWays)
      smallest = std::min(smallest, (*comparison)[way].error.relative_mse);
  return smallest;
}

std::string firefly_sentence(const Comparison& comparison) {
  const auto count = [&](Way way) { return comparison[way].error.fireflies; };
  return fmt::format(
      "Fireflies are {} pixels of the previous method, {} of Walter's, and {} of visible normals "
      "by "
      "tables, of {} each.",
      count(Way::previous), count(Way::walter), count(Way::visible),
      comparison[Way::previous].image.pixels.size());
}

std::string tables_sentence(const Comparison& comparison) {
  const SceneRendering &tables = comparison[Way::visible], &analytic = comparison[Way::analytic];
  return fmt::format(
      "Tables and the analytic sampler draw from one distribution: the error by tables is {} times "
      "that of the analytic sampler, and their time {} times.",
      ratio_text(tables.error.relative_mse, analytic.error.relative_mse),
      ratio_text(tables.seconds, analytic.seconds));
}

std::string intro(const ScenesRun& run) {
  return fmt::format(
      "<p>Made by {}, <code>vndf experiment scenes</code>, seed {}. Each scene is rendered with "
      "normals drawn in four ways: by the density of all normals (Algorithm 1 of Heitz and d'Eon "
      "2014, the previous method), by that of a rougher surface (Walter et al. 2007), and by the "
      "density of visible normals, from tables and in closed form or by root finding "
      "(analytic).</p>\n"
      "<p class=\"note\">The relative MSE is the mean of (I - R)² / (R² + eps) over pixels and "
      "colours, where R is the reference, and eps the square of {:g} times its mean luminance; its "
      "standard error says how much it depends on few pixels. A "
      "firefly is a pixel whose luminance is beyond {:g} times the reference, that is sqrt(R² + "
      "eps), and the column <i>brightest</i> has the largest of these ratios. The variance ratio "
      "is the relative MSE of the previous method over that of the row. An error near that of the "
      "reference itself cannot be told from it. Seconds are those of a clock, so that equal times "
      "are equal work only where nothing else is running. All numbers: <a "
      "href=\"numbers.json\"><code>numbers.json</code></a>.</p>\n",
      escaped(run.program), run.seed, render::kDarkness, render::kFirefly);
}

}  // namespace

Inset inset_of(const SceneFigure& figure) {
  const render::Image& image = figure.reference.image;
  const render::ImageError& error = figure.equal_samples[Way::previous].error;
  const std::size_t shortest = std::min(image.width, image.height);
  const std::size_t side = std::min(std::max(image.width / kPart, kLeastSide), shortest);
  const auto start = [&](std::size_t middle, std::size_t size) {
    return std::min(middle - std::min(middle, side / 2), size - side);
  };
  return {start(error.x, image.width), start(error.y, image.height), side};
}

std::string findings(const SceneFigure& figure) {
  const Comparison &samples = figure.equal_samples, &time = figure.equal_time;
  return fmt::format(
      "At {} samples a pixel, the relative MSE of the previous method is {:.3g} times that of "
      "visible normals by tables; Walter's is {} times that. In equal time they are {:.3g} and {} "
      "times. {} {} The smallest error here is {} times that of the reference itself.",
      samples[Way::visible].samples, samples.variance_ratio(Way::visible),
      ratio_text(samples[Way::walter].error.relative_mse, samples[Way::visible].error.relative_mse),
      time.variance_ratio(Way::visible),
      ratio_text(time[Way::walter].error.relative_mse, time[Way::visible].error.relative_mse),
      firefly_sentence(samples), tables_sentence(samples),
      ratio_text(smallest_error(figure), figure.reference.relative_mse));
}

std::string scenes_page(const ScenesRun& run, const std::vector<SceneFigure>& figures) {
  std::string body = intro(run);
  for (const SceneFigure& figure : figures) body += section(figure);
  return html_text({"Scenes by previous methods and by visible normals", kStyle, body});
}

}  // namespace vndf::tools
