// vndf render: a picture of a scene whose material has the slopes of a table or of a reference
// sampler.
#include <fmt/format.h>

#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/arguments.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/progress.h"
#include "commands/table_files.h"
#include "render/mesh_file.h"
#include "render/metals.h"
#include "render/picture.h"
#include "render/render_image.h"
#include "render/scenes.h"
#include "vndf/io/atomic_file.h"
#include "vndf/io/radiance_image.h"
#include "vndf/support/text.h"

namespace vndf::tools {
namespace {

using render::RenderOptions;
using render::Sampling;
using render::SceneChoices;

constexpr std::uint64_t kMostPixels = 16384, kMostSamples = 1u << 24;
constexpr double kLeastSeconds = 1e-3, kMostSeconds = 1e6;
// Samplers, refraction and reflectance are tested within these.
constexpr double kLeastAlpha = 1e-4, kMostAlpha = 10, kLeastIndex = 0.1, kMostIndex = 10;
constexpr double kMostExposure = 1e6;

struct Arguments {
  std::string scene, output, surface = "ggx-caps", sampling = "visible", light = "mis";
  std::vector<double> alpha;
  std::optional<std::string> metal, environment;
  std::optional<double> glass;
  std::string size = "512";
  std::uint64_t samples = 64, seed = 1;
  double seconds = 0, exposure = 1;
  unsigned threads = 0;
  bool quiet = false, force = false;
};

const std::map<std::string, Sampling> kSamplings{
    {"previous", Sampling::previous}, {"walter", Sampling::walter}, {"visible", Sampling::visible}};

std::shared_ptr<const render::Surface> surface_of(const Arguments& a) {
  const Sampling sampling = kSamplings.at(a.sampling);
  if (!names_a_file(a.surface)) return render::analytic_surface(a.surface, sampling);
  AnyTables tables = load_tables(a.surface);
  if (auto* pair = std::get_if<io::TableFile>(&tables))
    return render::tabulated_surface(pair->tables, sampling);
  return render::tabulated_surface(
      std::make_shared<const KernelTables>(std::get<KernelTables>(std::move(tables))), sampling);
}

/// The metal called `text`, or that of the numbers "ETA,K".
ConductorFresnel<float, 3> metal_of(const std::string& text) {
  std::vector<std::string> known;
  for (const render::Metal& metal : render::kMetals) {
    if (text == metal.name) return metal.fresnel;
    known.emplace_back(metal.name);
  }
  const std::size_t comma = text.find(',');
  const auto eta = support::finite_number(text.substr(0, comma));
  const auto k =
      comma == std::string::npos ? std::nullopt : support::finite_number(text.substr(comma + 1));
  if (eta && k && *eta >= kLeastIndex && *eta <= kMostIndex && *k >= 0 && *k <= kMostIndex) {
    const auto e = static_cast<float>(*eta), i = static_cast<float>(*k);
    return {{e, e, e}, {i, i, i}};
  }
  throw CLI::ValidationError(
      "--metal",
      fmt::format(
          "{} is neither a metal nor two numbers ETA,K, ETA from 0.1 to 10 and K from 0 to 10{}; "
          "known: {}",
          support::quoted(text), support::did_you_mean(text, known), support::listed(known)));
}

/// "WIDTHxHEIGHT", or one number for both.
void set_size(RenderOptions& options, const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto side = [&](const std::string& digits) -> std::size_t {
    if (const std::string rule = whole_number(1, kMostPixels)(digits); !rule.empty())
      throw CLI::ValidationError("--size", rule);
    return std::stoul(digits);
  };
  options.width = side(text.substr(0, cross));
  options.height = cross == std::string::npos ? options.width : side(text.substr(cross + 1));
}

RenderOptions options_of(const Arguments& a) {
  RenderOptions options;
  set_size(options, a.size);
  options.samples = static_cast<std::uint32_t>(a.samples);
  options.seconds = a.seconds;
  options.seed = a.seed;
  options.sample_lights = a.light == "mis";
  return options;
}

render::Image image_of(const io::RadianceImage& file) {
  render::Image image{file.width, file.height};
  for (std::size_t i = 0; i < file.values.size(); i += 3)
    image.pixels.push_back({file.values[i], file.values[i + 1], file.values[i + 2]});
  return image;
}

render::Environment environment_of(const std::string& name) {
  if (name == "sky") return render::Environment::sky();
  if (name == "white") return render::Environment::constant({1, 1, 1});
  return render::Environment(image_of(io::read_radiance_image(name)));
}

/// What can be told before any file is read.
SceneChoices choices_of(const Arguments& a) {
  SceneChoices choices;
  if (!a.alpha.empty())
    choices.alpha =
        Alpha<float>{static_cast<float>(a.alpha.front()), static_cast<float>(a.alpha.back())};
  if (a.metal) choices.substance = metal_of(*a.metal);
  if (a.glass) choices.substance = render::Glass{static_cast<float>(*a.glass)};
  return choices;
}

render::Scene scene_of(const Arguments& a, const render::Surface& surface,
                       const SceneChoices& choices) {
  if (extension_of(a.scene) == ".obj")
    return render::make_scene(render::read_obj(a.scene), surface, choices);
  return render::make_scene(a.scene, surface, choices);
}

/// What the header of an EXR file says of the picture.
std::map<std::string, std::string> description_of(const Arguments& a,
                                                  const render::Rendering& rendering) {
  return {{"program", kProgram},
          {"scene", a.scene},
          {"surface", a.surface},
          {"sampling", a.sampling},
          {"light", a.light},
          {"samples", fmt::to_string(rendering.samples)},
          {"seed", fmt::to_string(a.seed)}};
}

void render_file(const Arguments& a) {
  const std::string extension = extension_of(a.output);
  RenderOptions options = options_of(a);
  SceneChoices choices = choices_of(a);
  require_output(a.output, {a.scene, a.surface, a.environment.value_or("")}, a.force);
  const auto surface = surface_of(a);
  if (a.environment) choices.environment = environment_of(*a.environment);
  const render::Scene scene = scene_of(a, *surface, choices);

  Progress progress(!a.quiet);
  progress.begin("rendering");
  options.workers = progress.workers(a.threads);
  const render::Rendering rendering = render::render(scene, options);
  progress.erase();
  io::replace_file(a.output,
                   extension == ".png"
                       ? render::png_bytes(rendering.image, static_cast<float>(a.exposure))
                       : render::exr_bytes(rendering.image, description_of(a, rendering)));
  if (!a.quiet)
    std::cout << fmt::format("{}: {} x {} pixels, {} samples each, {:.1f} s\n",
                             support::printable(a.output), options.width, options.height,
                             rendering.samples, rendering.seconds);
}

std::string scene_help() {
  std::string text;
  for (const auto& scene : render::named_scenes())
    text += fmt::format("{}: {}; ", scene.name, scene.description);
  return text + "FILE.obj: a mesh in the place of the ball";
}

}  // namespace

void add_render(CLI::App& app) {
  auto* command = app.add_subcommand("render",
                                     "Render a scene with a rough surface\n\n"
                                     "A small path tracer shows what a distribution does to a "
                                     "surface. The same seed gives the same "
                                     "picture, whatever the number of threads.");
  const auto a = std::make_shared<Arguments>();
  command->add_option("scene", a->scene, scene_help())->required();
  command
      ->add_option("-o,--output", a->output,
                   "Picture to write: .exr, or .png for a tone-mapped one")
      ->type_name("FILE")
      ->required();
  command
      ->add_option(
          "--surface", a->surface,
          "Table file, or reference sampler: " + support::listed(render::analytic_surfaces()))
      ->capture_default_str();
  command->add_option("--alpha", a->alpha, "Roughness along x and y; the scene has its own")
      ->delimiter(',')
      ->expected(1, 2)
      ->type_name("AX[,AY]")
      ->check(number_between(kLeastAlpha, kMostAlpha));
  auto* metal = command->add_option("--metal", a->metal,
                                    "copper, gold, silver, or a complex refractive index");
  metal->type_name("NAME|ETA,K");
  command->add_option("--glass", a->glass, "Refractive index of glass")
      ->check(number_between(kLeastIndex, kMostIndex))
      ->excludes(metal);
  command
      ->add_option("--sampling", a->sampling,
                   "Normals that are drawn: all (previous), all of a rougher surface (walter), or "
                   "those that are seen (visible)")
      ->check(CLI::IsMember({"previous", "walter", "visible"}))
      ->capture_default_str();
  command
      ->add_option("--light", a->light,
                   "Whether light is also sampled directly (mis) or only found by paths (none)")
      ->check(CLI::IsMember({"mis", "none"}))
      ->capture_default_str();
  command
      ->add_option("--environment", a->environment,
                   "Surroundings in place of the scene's: sky, white, or an image in latitude and "
                   "longitude")
      ->type_name("sky|white|FILE.exr");
  auto* samples = command->add_option("--spp", a->samples, "Samples a pixel")
                      ->check(whole_number(1, kMostSamples))
                      ->capture_default_str();
  command->add_option("--seconds", a->seconds, "Render for this time, in place of --spp")
      ->check(number_between(kLeastSeconds, kMostSeconds))
      ->excludes(samples);
  command->add_option("--size", a->size, "Pixels")->type_name("N|WxH")->capture_default_str();
  command->add_option("--seed", a->seed, "Seed of the random numbers")
      ->check(whole_number())
      ->capture_default_str();
  auto* exposure =
      command->add_option("--exposure", a->exposure, "Factor of the radiance in a .png picture");
  exposure->check(number_between(1 / kMostExposure, kMostExposure))->capture_default_str();
  add_threads(*command, a->threads);
  command->add_flag("--quiet", a->quiet, "Print nothing but warnings");
  add_force(*command, a->force);
  command->callback([a, exposure] {
    const std::string extension = extension_of(a->output);
    if (extension != ".png" && extension != ".exr")
      throw CLI::ValidationError("--output",
                                 support::quoted(a->output) + " ends neither in .exr nor in .png");
    if (extension == ".exr" && exposure->count() > 0)
      throw CLI::ValidationError("--exposure",
                                 "is for .png pictures; an .exr file holds the radiance itself");
    render_file(*a);
  });
}

}  // namespace vndf::tools
