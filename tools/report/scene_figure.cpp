// A figure of the experiment with scenes.
#include "report/scene_figure.h"

#include <fmt/format.h>

namespace vndf::tools {
namespace {

/// The name in names of files and in JSON.
std::string word_of(Way way) {
  constexpr std::array kWords{"previous", "walter", "visible", "analytic"};
  return kWords[static_cast<std::size_t>(way)];
}

std::string lines(const std::string& title, const Comparison& comparison) {
  std::string text = fmt::format("{:<26}", title);
  for (const NamedNumber& number : numbers_of(comparison, Way::previous))
    text += fmt::format(" {:>16}", number.name);
  for (const Way way : kWays) {
    text += fmt::format("\n{:<26}", name_of(way));
    for (const NamedNumber& number : numbers_of(comparison, way))
      text += fmt::format(" {:>16}", number.text);
  }
  return text + "\n";
}

nlohmann::ordered_json to_json(const Comparison& comparison, Way way, const std::string& file) {
  const SceneRendering& r = comparison[way];
  return {{"sampling", word_of(way)},
          {"samples", r.samples},
          {"seconds", r.seconds},
          {"relative_mse", r.error.relative_mse},
          {"standard_error", r.error.standard_error},
          {"variance_ratio", comparison.variance_ratio(way)},
          {"fireflies", r.error.fireflies},
          {"firefly_share", r.error.firefly_share},
          {"brightest", r.error.brightest},
          {"file", file}};
}

}  // namespace

std::string name_of(Way way) {
  constexpr std::array kNames{"previous method", "Walter's method", "visible normals, tables",
                              "visible normals, analytic"};
  return kNames[static_cast<std::size_t>(way)];
}

double Comparison::variance_ratio(Way way) const {
  return (*this)[Way::previous].error.relative_mse / (*this)[way].error.relative_mse;
}

std::string reference_file(const SceneFigure& figure) {
  return figure.name + "-reference.exr";
}

std::string equal_samples_file(const SceneFigure& figure, Way way) {
  return figure.name + "-" + word_of(way) + ".exr";
}

std::string equal_time_file(const SceneFigure& figure, Way way) {
  // The time is that of visible normals, so that they are rendered once for both comparisons.
  if (way == Way::visible) return equal_samples_file(figure, way);
  return figure.name + "-" + word_of(way) + "-equal-time.exr";
}

std::vector<NamedNumber> numbers_of(const Comparison& comparison, Way way) {
  const SceneRendering& r = comparison[way];
  return {{"samples", fmt::to_string(r.samples)},
          {"seconds", fmt::format("{:.2f}", r.seconds)},
          {"relative MSE", fmt::format("{:.3g} ± {:.2g} %", r.error.relative_mse,
                                       100 * r.error.standard_error / r.error.relative_mse)},
          {"variance ratio", fmt::format("{:.3g}", comparison.variance_ratio(way))},
          {"fireflies", fmt::format("{:.2g} %", 100 * r.error.firefly_share)},
          {"brightest", fmt::format("{:.3g}", r.error.brightest)}};
}

std::string describe(const SceneFigure& figure) {
  const Reference& reference = figure.reference;
  return fmt::format("{}\n{}{}reference: {} samples, {:.2f} s, relative MSE {:.2g}\n", figure.title,
                     lines("at equal samples", figure.equal_samples),
                     lines("at equal time", figure.equal_time), reference.samples,
                     reference.seconds, reference.relative_mse);
}

nlohmann::ordered_json to_json(const SceneFigure& figure) {
  auto samples = nlohmann::ordered_json::array(), time = samples;
  for (const Way way : kWays) {
    samples.push_back(to_json(figure.equal_samples, way, equal_samples_file(figure, way)));
    time.push_back(to_json(figure.equal_time, way, equal_time_file(figure, way)));
  }
  return {{"name", figure.name},
          {"title", figure.title},
          {"width", figure.reference.image.width},
          {"height", figure.reference.image.height},
          {"reference",
           {{"samples", figure.reference.samples},
            {"seconds", figure.reference.seconds},
            {"relative_mse", figure.reference.relative_mse},
            {"file", reference_file(figure)}}},
          {"equal_samples", std::move(samples)},
          {"equal_time", std::move(time)}};
}

}  // namespace vndf::tools
