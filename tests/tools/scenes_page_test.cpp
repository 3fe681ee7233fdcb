// The page of the experiment with scenes says what its numbers say.
#include "report/scenes_page.h"

#include "support/catch.h"

using namespace vndf::tools;
using vndf::render::Image;
using vndf::render::Rgb;
using vndf::test::contains;

namespace {

constexpr std::size_t kSide = 32;

/// A grey image with one bright pixel.
Image image_with(float brightness, std::size_t x, std::size_t y) {
  Image image{kSide, kSide, std::vector<Rgb>(kSide * kSide, Rgb{0.5f, 0.5f, 0.5f})};
  image.pixels[y * kSide + x] = {brightness, brightness, brightness};
  return image;
}

SceneRendering rendering(double relative_mse, std::size_t fireflies, double seconds) {
  const double share = static_cast<double>(fireflies) / (kSide * kSide);
  return {.image = image_with(20, 30, 1),
          .samples = 64,
          .seconds = seconds,
          .error = {.relative_mse = relative_mse,
                    .standard_error = relative_mse / 4,
                    .fireflies = fireflies,
                    .firefly_share = share,
                    .brightest = fireflies > 0 ? 40.0 : 2.0,
                    .x = 30,
                    .y = 1}};
}

SceneFigure figure_of_numbers() {
  SceneFigure figure{.name = "slab", .title = "A <slab>", .setup = "Light & glass."};
  figure.reference = {image_with(0.5f, 0, 0), 1024, 12.5, 0.001};
  figure.equal_samples[Way::previous] = rendering(0.8, 256, 3);
  figure.equal_samples[Way::walter] = rendering(0.4, 3, 3.5);
  figure.equal_samples[Way::visible] = rendering(0.1, 0, 4);
  figure.equal_samples[Way::analytic] = rendering(0.1, 0, 5);
  figure.equal_time = figure.equal_samples;
  figure.equal_time[Way::previous] = rendering(0.6, 128, 4);
  figure.equal_time[Way::walter] = rendering(0.05, 1, 4);
  return figure;
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size())
    ++count;
  return count;
}

}  // namespace

TEST_CASE("the findings are sentences of the numbers, whoever wins") {
  const std::string text = findings(figure_of_numbers());
  CHECK_THAT(text, contains("At 64 samples a pixel, the relative MSE of the previous method is 8 "
                            "times that of visible normals by tables; Walter's is 4 times that."));
  CHECK_THAT(text, contains("In equal time they are 6 and 0.5 times."));
  CHECK_THAT(text, contains("Fireflies are 256 pixels of the previous method, 3 of Walter's, and 0 "
                            "of visible normals by tables, of 1024 each."));
  CHECK_THAT(text, contains("the error by tables is 1 times that of the analytic sampler, and "
                            "their time 0.8 times."));
  CHECK_THAT(text, contains("The smallest error here is 50 times that of the reference itself."));
}

TEST_CASE("the inset is where the previous method is brightest, and lies in the image") {
  SceneFigure figure = figure_of_numbers();
  const auto inset_at = [&](std::size_t x, std::size_t y) {
    auto& error = figure.equal_samples[Way::previous].error;
    error.x = x;
    error.y = y;
    return inset_of(figure);
  };
  const Inset corner = inset_at(31, 0);
  CHECK(corner.side == 16);
  CHECK(corner.x == 16);
  CHECK(corner.y == 0);
  const Inset middle = inset_at(17, 14);
  CHECK(middle.x == 9);
  CHECK(middle.y == 6);

  figure.reference.image = {256, 200};
  CHECK(inset_at(255, 199).side == 32);
  CHECK(inset_at(255, 199).y == 168);
  figure.reference.image = {8, 4};
  CHECK(inset_at(7, 3).side == 4);
  CHECK(inset_at(7, 3).x == 4);
}

TEST_CASE("the page needs no other file, links every file of data, and escapes what it is given") {
  const SceneFigure figure = figure_of_numbers();
  const std::string page = scenes_page({"vndf <1>", 7}, {figure, figure});
  CHECK_THAT(page, contains("vndf &lt;1&gt;") && !contains("vndf <1>") && contains("seed 7"));
  CHECK_THAT(page, contains("A &lt;slab&gt;") && contains("Light &amp; glass."));
  for (const char* outside : {"http", "<script", "<link", "url(", "@import"})
    CHECK(count_of(page, outside) == 0);
  // of a figure: five pictures with an inset each, and four insets at equal time
  CHECK(count_of(page, "src=\"data:image/png;base64,iVBORw0KGgo") == 2 * (2 * 5 + 4));
  CHECK(count_of(page, "src=") == 2 * (2 * 5 + 4));
  CHECK(count_of(page, "class=\"inset\"") == 2 * (5 + 4));
  CHECK_THAT(page, contains("img.inset { image-rendering: pixelated;"));
  for (const Way way : kWays)
    for (const std::string& file : {equal_samples_file(figure, way), equal_time_file(figure, way)})
      CHECK_THAT(page, contains("href=\"" + file + "\""));
  CHECK_THAT(page, contains("href=\"" + reference_file(figure) + "\""));
}

TEST_CASE("every number of the page's table has its name, which a narrow screen shows") {
  const std::string page = scenes_page({"vndf", 1}, {figure_of_numbers()});
  const std::size_t rows = 2 * kWays.size(), columns = 6;
  CHECK(count_of(page, "<td class=\"number\" data-name=\"") == rows * columns);
  CHECK(count_of(page, "data-name=\"variance ratio\">8</td>") == 2);  // visible and analytic
  CHECK_THAT(page, contains("data-name=\"relative MSE\">0.4 ± 25 %</td>"));
  CHECK_THAT(page, contains("td.number::before { content: attr(data-name)"));
}

TEST_CASE("captions tell fireflies where there are some") {
  const std::string page = scenes_page({"vndf", 1}, {figure_of_numbers()});
  CHECK_THAT(page,
             contains("<b>previous method</b>, 64 samples, 3.0 s. Relative MSE 0.8. Fireflies: "
                      "256 of 1024 pixels, the brightest 40 times the reference."));
  CHECK_THAT(page, contains("<b>visible normals, tables</b>, 64 samples, 4.0 s. Relative MSE 0.1. "
                            "No pixel is a firefly."));
}

TEST_CASE("a figure as JSON has all numbers and the files that hold its images") {
  const auto json = to_json(figure_of_numbers());
  CHECK(json.at("name") == "slab");
  CHECK(json.at("width") == kSide);
  CHECK(json.at("reference").at("relative_mse") == 0.001);
  const auto& previous = json.at("equal_samples").at(0);
  CHECK(previous.at("sampling") == "previous");
  CHECK(previous.at("relative_mse") == 0.8);
  CHECK(previous.at("standard_error") == 0.2);
  CHECK(previous.at("fireflies") == 256);
  CHECK(previous.at("file") == "slab-previous.exr");
  CHECK(json.at("equal_samples").at(2).at("variance_ratio") == 8);
  CHECK(json.at("equal_time").at(1).at("file") == "slab-walter-equal-time.exr");
  // the same picture, since the time is its time
  CHECK(json.at("equal_time").at(2).at("file") == "slab-visible.exr");
}

TEST_CASE("a figure as text has a line for each rendering") {
  const std::string text = describe(figure_of_numbers());
  CHECK(count_of(text, "\n") == 1 + 2 * (1 + kWays.size()) + 1);
  CHECK_THAT(text, contains("at equal samples") && contains("at equal time"));
  CHECK_THAT(text, contains("reference: 1024 samples, 12.50 s, relative MSE 0.001"));
}
