// vndf experiment scenes: the pictures of the paper, as a page with their data beside it.
#include <fmt/format.h>

#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "commands/arguments.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/progress.h"
#include "render/picture.h"
#include "report/scenes_experiment.h"
#include "report/scenes_page.h"
#include "vndf/io/atomic_folder.h"
#include "vndf/support/text.h"

namespace vndf::tools {
namespace {

constexpr std::uint64_t kLeastSize = 16, kMostSize = 4096, kMostSamples = std::uint64_t{1} << 24;

struct ScenesArguments {
  std::string folder;
  ScenesOptions options;
};

/// Writes the images of a figure, each with what its header says.
void write_images(io::AtomicFolder& folder, const SceneFigure& figure) {
  const auto write = [&](const std::string& file, const std::string& sampling,
                         const render::Image& image, std::uint32_t samples) {
    folder.write(file, render::exr_bytes(image, {{"program", kProgram},
                                                 {"scene", figure.name},
                                                 {"sampling", sampling},
                                                 {"samples", fmt::to_string(samples)}}));
  };
  write(reference_file(figure), "reference", figure.reference.image, figure.reference.samples);
  for (const Way way : kWays) {
    const SceneRendering &samples = figure.equal_samples[way], &time = figure.equal_time[way];
    write(equal_samples_file(figure, way), name_of(way), samples.image, samples.samples);
    // Of visible normals, both are one.
    if (equal_time_file(figure, way) != equal_samples_file(figure, way))
      write(equal_time_file(figure, way), name_of(way), time.image, time.samples);
  }
}

nlohmann::ordered_json numbers_of(const ScenesOptions& options,
                                  const std::vector<SceneFigure>& figures) {
  auto list = nlohmann::ordered_json::array();
  for (const SceneFigure& figure : figures) list.push_back(to_json(figure));
  return {{"program", kProgram}, {"seed", options.seed}, {"figures", std::move(list)}};
}

void run_scenes(const ScenesArguments& a) {
  io::AtomicFolder folder(a.folder);  // what hinders it is told before any work
  Progress progress;
  progress.begin("tables");
  const SceneTables tables = bake_scene_tables(a.options.workers.threads);
  progress.begin("scenes");
  ScenesOptions options = a.options;
  options.workers = progress.workers(a.options.workers.threads);
  const std::vector<SceneFigure> figures = run_scenes_experiment(tables, options);
  progress.erase();
  for (const SceneFigure& figure : figures) write_images(folder, figure);
  folder.write("numbers.json", json_text(numbers_of(options, figures)) + "\n");
  folder.write("index.html", scenes_page({kProgram, options.seed}, figures));
  folder.put_in_place();
  for (const SceneFigure& figure : figures) std::cout << describe(figure) << '\n';
  std::cout << fmt::format("wrote {}\n", support::printable(a.folder + "/index.html"));
  require_printed();
}

}  // namespace

void add_scenes_experiment(CLI::App& group) {
  auto* command = group.add_subcommand(
      "scenes",
      "Render scenes with every way of drawing normals, as a page with their data\n\n"
      "The pictures are those of Figures 1, 2, 9 and 10 of Heitz and d'Eon 2014, at equal samples "
      "and "
      "at equal time.");
  const auto a = std::make_shared<ScenesArguments>();
  command->add_option("folder", a->folder, "Folder of the page; an earlier one is replaced")
      ->required();
  command->add_option("--spp", a->options.samples, "Samples a pixel, at equal samples")
      ->check(whole_number(1, kMostSamples))
      ->capture_default_str();
  command->add_option("--reference-spp", a->options.reference_samples, "Those of references")
      ->check(whole_number(2, kMostSamples))
      ->capture_default_str();
  command->add_option("--size", a->options.size, "Width and height of a picture in pixels")
      ->check(whole_number(kLeastSize, kMostSize))
      ->capture_default_str();
  command->add_option("--seed", a->options.seed, "Seed of the random numbers")
      ->check(whole_number())
      ->capture_default_str();
  add_threads(*command, a->options.workers.threads);
  command->callback([a] { run_scenes(*a); });
}

}  // namespace vndf::tools
