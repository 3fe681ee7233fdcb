// vndf experiment, whose first part is variance: how fast each way of sampling a rough metal
// converges.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands/arguments.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/progress.h"
#include "commands/table_files.h"
#include "vndf/distributions/specification.h"
#include "vndf/precompute/build_tables.h"
#include "vndf/validate/experiment/named_estimators.h"

namespace vndf::tools {
namespace {

using validate::EstimatorResult;
using validate::VarianceOptions;

struct VarianceArguments {
  std::string distribution, tables, light = "both";
  std::vector<double> alpha{0.5}, lamp{30, 180}, metal{0.2, 3};
  double theta = 80, azimuth = 0, samples = 1e7;
  std::uint64_t seed = 1;
  unsigned threads = 0;
  bool json = false;
};

std::shared_ptr<const SlopeTables> tables_of(const VarianceArguments& a) {
  if (!a.tables.empty()) return load_pair(a.tables).tables;
  const auto distribution = distributions::make_distribution({a.distribution});
  return precompute::build_tables(*distribution, {.threads = a.threads}).tables;
}

std::vector<validate::Environment> lights_of(const VarianceArguments& a) {
  std::vector<validate::Environment> lights;
  if (a.light != "lamp") lights.push_back(validate::smooth_environment());
  if (a.light != "smooth") lights.push_back(validate::lamp_environment(a.lamp[0], a.lamp[1]));
  return lights;
}

VarianceOptions options_of(const VarianceArguments& a) {
  VarianceOptions options;
  options.theta = a.theta;
  options.azimuth = a.azimuth;
  options.alpha = {a.alpha.front(), a.alpha.back()};
  options.metal = {a.metal[0], a.metal[1]};
  options.samples = static_cast<std::uint64_t>(a.samples);
  options.seed = a.seed;
  options.workers = {a.threads};
  return options;
}

std::string samples_rule(const std::string& text) {
  double n = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, n);
  const bool whole =
      error == std::errc() && stop == end && n >= 1 && n <= 1e15 && n == std::floor(n);
  return whole ? "" : "'" + text + "' is not a whole number from 1 to 1e15";
}

std::size_t pixels_at(const EstimatorResult& r, std::size_t level) {
  return r.tally.pyramid.pixels(level).count;
}

std::string estimator_lines(const std::vector<EstimatorResult>& results) {
  std::string text =
      fmt::format("{:<9} {:<20} {:>10} {:>10} {:>9} {:>9} {:>9} {:>7} {:>7}\n", "surface",
                  "estimator", "mean", "variance", "gain", "largest", "lost", "error", "off by");
  for (const auto& r : results)
    text += fmt::format(
        "{:<9} {:<20} {:>10.6f} {:>10.4g} {:>9.3f} {:>9.4g} {:>7.2f} % {:>7.1e} {:>7.1f}\n",
        r.surface, r.name, r.samples().mean, r.samples().variance(), r.gain, r.tally.largest_weight,
        100 * r.lost_fraction(), r.samples().standard_error(), r.deviation);
  return text;
}

/// Spread of a pixel relative to its mean, for 1, 4, 16, ... samples.
std::string convergence_lines(const std::vector<EstimatorResult>& results) {
  std::string text = fmt::format("{:<30}", "spread of a pixel of N samples");
  for (std::size_t k = 0; k < validate::PixelPyramid::kLevels; ++k)
    text += fmt::format(" {:>7}", 1 << (2 * k));
  for (const auto& r : results) {
    text += fmt::format("\n{:<9} {:<20}", r.surface, r.name);
    for (std::size_t k = 0; k < validate::PixelPyramid::kLevels && pixels_at(r, k) > 1; ++k)
      text += fmt::format(" {:>7.2g}",
                          std::sqrt(r.tally.pyramid.pixels(k).variance()) / r.samples().mean);
  }
  return text + "\n";
}

nlohmann::ordered_json to_json(const EstimatorResult& r) {
  nlohmann::ordered_json pixels = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < validate::PixelPyramid::kLevels && pixels_at(r, k) > 1; ++k)
    pixels.push_back({{"samples", 1 << (2 * k)},
                      {"pixels", pixels_at(r, k)},
                      {"spread", std::sqrt(r.tally.pyramid.pixels(k).variance())}});
  return {{"estimator", r.name},
          {"surface", r.surface},
          {"visible_normals", r.visible},
          {"samples", r.samples().count},
          {"mean", r.samples().mean},
          {"standard_error", r.samples().standard_error()},
          {"variance", r.samples().variance()},
          {"largest_weight", r.tally.largest_weight},
          {"lost_fraction", r.lost_fraction()},
          {"gain_over_algorithm_1", r.gain},
          {"gain_over_first_visible", r.gain_over_visible},
          {"deviation_in_standard_errors", r.deviation},
          {"pixels", pixels}};
}

void print(const VarianceArguments& a, const std::string& distribution,
           const std::vector<validate::Environment>& lights,
           const std::vector<std::vector<EstimatorResult>>& results) {
  if (a.json) {
    nlohmann::ordered_json report{{"distribution", distribution},
                                  {"theta", a.theta},
                                  {"azimuth", a.azimuth},
                                  {"alpha", {a.alpha.front(), a.alpha.back()}},
                                  {"metal", a.metal},
                                  {"seed", a.seed},
                                  {"lights", nlohmann::ordered_json::array()}};
    for (std::size_t i = 0; i < lights.size(); ++i) {
      nlohmann::ordered_json light{{"light", lights[i].name},
                                   {"estimators", nlohmann::ordered_json::array()}};
      for (const auto& r : results[i]) light["estimators"].push_back(to_json(r));
      report["lights"].push_back(light);
    }
    std::cout << json_text(report) << '\n';
    return;
  }
  std::cout << fmt::format("{}, alpha {:g} x {:g}, theta {:g} degrees, {:g} samples, seed {}\n",
                           distribution, a.alpha.front(), a.alpha.back(), a.theta,
                           static_cast<double>(results[0][0].samples().count), a.seed);
  for (std::size_t i = 0; i < lights.size(); ++i)
    std::cout << fmt::format("\nlight: {}\n", lights[i].name) << estimator_lines(results[i])
              << convergence_lines(results[i]);
  std::cout << "\ngain: variance of algorithm 1 on the same surface over that of the estimator\n"
               "largest, lost: largest weight of a sample, samples of weight 0\n"
               "error, off by: standard error of the mean; distance from the mean of the others\n"
               "of the surface, in standard errors (beyond 4.5 one of them is wrong)\n";
}

void variance(const VarianceArguments& a) {
  const auto lights = lights_of(a);  // refused before any work
  validate::require_valid(options_of(a));
  Progress progress;
  progress.begin("tables");
  const auto tables = tables_of(a);
  const auto estimators = validate::named_estimators(tables);
  std::vector<std::vector<EstimatorResult>> results;
  for (const auto& light : lights) {
    VarianceOptions options = options_of(a);
    options.light = light;
    options.workers = progress.workers(a.threads);
    progress.begin("sampling: " + light.name);
    results.push_back(validate::run_variance_experiment(estimators, options));
  }
  progress.erase();
  print(a, tables->distribution, lights, results);
}

/// How many numbers an option takes.
struct Count {
  int least, most;
};

/// An option that takes numbers with commas between them.
void add_numbers(CLI::App& command, const std::string& name, std::vector<double>& numbers,
                 const std::string& help, Count count, const std::string& form) {
  command.add_option(name, numbers, help)
      ->delimiter(',')
      ->expected(count.least, count.most)
      ->type_name(form)
      ->capture_default_str();
}

void add_variance_experiment(CLI::App& experiments) {
  auto* command = experiments.add_subcommand(
      "variance",
      "Compare how fast ways of sampling a rough metal converge, for one pixel\n\n"
      "This is the experiment of Figure 10 of Heitz and d'Eon 2014. All ways have the same mean, "
      "so "
      "that what counts is the variance.");
  const auto a = std::make_shared<VarianceArguments>();
  auto* distribution = command->add_option("--distribution", a->distribution,
                                           "Named distribution, as for vndf build");
  auto* tables = command->add_option("--tables", a->tables, "Table file, in place of a name");
  tables->type_name("FILE");
  distribution->excludes(tables);
  add_numbers(*command, "--alpha", a->alpha, "Roughness along x and y", {1, 2}, "AX[,AY]");
  command->add_option("--theta", a->theta, "Angle of incidence in degrees, 0 to 90")
      ->capture_default_str();
  command->add_option("--azimuth", a->azimuth, "Its azimuth in degrees")->capture_default_str();
  add_numbers(*command, "--metal", a->metal, "Complex refractive index", {2, 2}, "ETA,K");
  command->add_option("--light", a->light, "smooth, lamp (small and bright) or both")
      ->check(CLI::IsMember({"smooth", "lamp", "both"}))
      ->capture_default_str();
  add_numbers(*command, "--lamp", a->lamp, "Where the lamp is, in degrees", {2, 2},
              "THETA,AZIMUTH");
  command->add_option("--samples", a->samples, "For each estimator; rounded up to blocks of 65536")
      ->check(CLI::Validator(samples_rule, "N"))
      ->capture_default_str();
  command->add_option("--seed", a->seed, "Seed of the random numbers")
      ->check(whole_number())
      ->capture_default_str();
  add_threads(*command, a->threads);
  command->add_flag("--json", a->json, "Print one JSON object");
  command->callback([a, command] {
    if (a->light == "smooth" && command->count("--lamp") > 0)
      throw CLI::ValidationError("--lamp", "places the lamp, which --light smooth leaves out");
    if (a->distribution.empty() && a->tables.empty())
      throw CLI::RequiredError("--distribution or --tables");
    variance(*a);
  });
}

}  // namespace

void add_experiment(CLI::App& app) {
  auto* group = app.add_subcommand("experiment", "Compare ways of sampling by experiments");
  group->require_subcommand(1);
  add_variance_experiment(*group);
  add_scenes_experiment(*group);
}

}  // namespace vndf::tools
