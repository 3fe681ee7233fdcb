// The slope distribution that a command line asks for.
#include "commands/distribution_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>

#include "vndf/distributions/diagnose.h"
#include "vndf/distributions/family_list.h"
#include "vndf/distributions/formula_distribution.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/distributions/profile_csv.h"
#include "vndf/distributions/shape_invariance.h"
#include "vndf/distributions/slope_map.h"
#include "vndf/io/atomic_file.h"
#include "vndf/io/crc64.h"
#include "vndf/io/map_image.h"

namespace vndf::tools {
namespace {

using distributions::SlopeDistribution;

/// A distribution under the name that the user gives it.
class Renamed final : public SlopeDistribution {
 public:
  Renamed(std::string name, std::unique_ptr<SlopeDistribution> d)
      : name_(std::move(name)), d_(std::move(d)) {}
  std::string name() const override { return name_; }
  double p22(double r) const override { return d_->p22(r); }
  bool costly() const override { return d_->costly(); }
  std::vector<double> breaks() const override { return d_->breaks(); }
  double support() const override { return d_->support(); }
  std::optional<distributions::Marginals> marginals(double x) const override {
    return d_->marginals(x);
  }

 private:
  std::string name_;
  std::unique_ptr<SlopeDistribution> d_;
};

/// Quoted for a shell, where it needs to be.
std::string quoted(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.,:=@/";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// The words of a command line that quoted() wrote.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words(1);
  bool inside = false;  // of quotes
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\'')
      inside = !inside;
    else if (line[i] == '\\' && !inside && i + 1 < line.size())
      words.back() += line[++i];
    else if (line[i] == ' ' && !inside)
      words.emplace_back();
    else
      words.back() += line[i];
  }
  return words;
}

std::string file_checksum(const std::string& path) {
  io::Crc64 crc;
  crc.add(io::read_file(path));
  return io::hex_digits(crc.value());
}

std::map<std::string, double> parse_parameters(const std::vector<std::string>& list) {
  std::map<std::string, double> parameters;
  for (const std::string& text : list) {
    const auto equals = text.find('=');
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = equals == std::string::npos
                                   ? std::from_chars_result{end, std::errc::invalid_argument}
                                   : std::from_chars(text.data() + equals + 1, end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
      throw CLI::ValidationError("--param", "'" + text + "' is not NAME=NUMBER");
    if (!parameters.emplace(text.substr(0, equals), value).second)
      throw CLI::ValidationError("--param", "'" + text.substr(0, equals) + "' is given twice");
  }
  return parameters;
}

std::string parameter_options(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& p : list) text += " --param " + quoted(p);
  return text;
}

std::string break_options(const std::vector<double>& breaks) {
  std::string text;
  for (const double r : breaks) text += fmt::format(" --break {}", r);
  return text;
}

DistributionSource from_spec(const SourceArguments& a) {
  DistributionSource source;
  source.distribution = distributions::parse_distribution(a.spec);
  source.options = quoted(source.distribution->name());
  return source;
}

DistributionSource from_p22(const SourceArguments& a) {
  DistributionSource source;
  source.distribution = std::make_unique<distributions::FormulaDistribution>(
      distributions::FormulaDistribution::from_p22({a.p22, parse_parameters(a.parameters)},
                                                   a.breaks));
  source.options =
      "--p22 " + quoted(a.p22) + parameter_options(a.parameters) + break_options(a.breaks);
  return source;
}

DistributionSource from_ndf(const SourceArguments& a) {
  const distributions::NdfFormula ndf({a.ndf, parse_parameters(a.parameters)});
  DistributionSource source;
  source.options =
      "--ndf " + quoted(a.ndf) + parameter_options(a.parameters) + break_options(a.breaks);
  if (a.frozen_at && !ndf.uses_alpha())
    throw CLI::ValidationError("--frozen-at", "the formula does not use alpha");
  if (a.frozen_at) {
    source.options += fmt::format(" --frozen-at {}", *a.frozen_at);
    source.notes =
        fmt::format("the surface of alpha {}, stretched: not a family in alpha\n", *a.frozen_at);
  } else if (ndf.uses_alpha()) {
    distributions::require_shape_invariant(ndf, ndf.text());
    source.notes = "shape-invariant: alpha only stretches it\n";
  }
  source.distribution = std::make_unique<distributions::FormulaDistribution>(
      distributions::FormulaDistribution::from_ndf(ndf, a.frozen_at.value_or(1), a.breaks));
  return source;
}

std::string describe(const distributions::TailFit& tail) {
  switch (tail.kind) {
    case distributions::ProfileTail::none:
      return "tail: none, p22 is 0 beyond the last sample\n";
    case distributions::ProfileTail::exponential:
      return fmt::format("tail: exponential, p22 ~ exp(-{:.6g} r), ", tail.parameter) +
             fmt::format("{:.2g} of the mass, fitted within {:.2g}\n", tail.fraction_of_mass_beyond,
                         tail.residual);
    default:
      return fmt::format("tail: power, p22 ~ r^-{:.6g}, ", tail.parameter) +
             fmt::format("{:.2g} of the mass, fitted within {:.2g}\n", tail.fraction_of_mass_beyond,
                         tail.residual);
  }
}

distributions::ProfileTail tail_kind(const std::string& name) {
  if (name == "exponential") return distributions::ProfileTail::exponential;
  return name == "power" ? distributions::ProfileTail::power : distributions::ProfileTail::none;
}

DistributionSource from_profile(const SourceArguments& a) {
  auto profile = std::make_unique<distributions::MeasuredProfile>(
      std::filesystem::path(a.profile).stem().string(), distributions::read_profile_csv(a.profile),
      tail_kind(a.tail));
  DistributionSource source;
  source.options = "--profile " + quoted(a.profile) + " --tail " + a.tail;
  source.input_checksum = file_checksum(a.profile);
  source.notes = describe(profile->tail());
  source.distribution = std::move(profile);
  return source;
}

DistributionSource from_map(const SourceArguments& a) {
  const auto image = io::read_slope_map(a.map);
  auto estimate = distributions::estimate_slope_map(
      image.slopes, {.name = std::filesystem::path(a.map).stem().string(), .force = a.force});
  const auto& s = estimate.statistics;
  DistributionSource source;
  source.options = "--normal-map " + quoted(a.map) + (a.force ? " --force" : "");
  source.input_checksum = file_checksum(a.map);
  source.notes =
      fmt::format("map: mean slope ({:.6g}, {:.6g}), alpha {:.6g} x {:.6g}, correlation {:.4g}\n",
                  s.mean_x, s.mean_y, s.alpha_x, s.alpha_y, s.correlation) +
      fmt::format("estimated from {} texels: u-error below {:.2e} (95 %), ", s.texels, s.u_error) +
      fmt::format("asymmetry {:.3f} (bound {:.3f})\n", s.asymmetry, s.asymmetry_bound) +
      describe(estimate.distribution->tail());
  source.distribution = std::move(estimate.distribution);
  return source;
}

DistributionSource undiagnosed(const SourceArguments& a) {
  if (!a.spec.empty()) return from_spec(a);
  if (!a.p22.empty()) return from_p22(a);
  if (!a.ndf.empty()) return from_ndf(a);
  return a.profile.empty() ? from_map(a) : from_profile(a);
}

void require_one_source(const SourceArguments& a) {
  int given = 0;
  for (const auto* source : {&a.spec, &a.p22, &a.ndf, &a.profile, &a.map})
    given += !source->empty();
  if (given != 1)
    throw CLI::ValidationError(
        "distribution", "give one of: a named distribution, --p22, --ndf, --profile, --normal-map");
  if (a.p22.empty() && a.ndf.empty() && !a.parameters.empty())
    throw CLI::ValidationError("--param", "goes with --p22 or --ndf");
  if (a.p22.empty() && a.ndf.empty() && !a.breaks.empty())
    throw CLI::ValidationError("--break", "goes with --p22 or --ndf");
  if (a.ndf.empty() && a.frozen_at) throw CLI::ValidationError("--frozen-at", "goes with --ndf");
}

}  // namespace

void add_source_options(CLI::App& command, SourceArguments& a) {
  command.add_option("distribution", a.spec,
                     "Named distribution, such as ggx, student-t:gamma=2.5 or "
                     "mixture:0.7*ggx+0.3*beckmann@0.2 (--list shows all)");
  const std::string group = "Your own distribution, in place of a named one";
  command.add_option("--p22", a.p22, "Slope density, a formula in r, at any scale")->group(group);
  command.add_option("--ndf", a.ndf, "Normal distribution, a formula in theta, or theta and alpha")
      ->group(group);
  command.add_option("--param", a.parameters, "NAME=NUMBER that a formula uses; may be repeated")
      ->group(group);
  command
      .add_option("--break", a.breaks,
                  "Slope radius at which a formula jumps or has a kink; may be repeated")
      ->group(group);
  command.add_option("--frozen-at", a.frozen_at, "Take the surface of this alpha as the shape")
      ->group(group);
  command.add_option("--profile", a.profile, "CSV file with columns r,p22 or theta,D")
      ->group(group);
  command.add_option("--tail", a.tail, "What a profile does beyond its last sample")
      ->check(CLI::IsMember({"none", "exponential", "power"}))
      ->capture_default_str()
      ->group(group);
  command.add_option("--normal-map", a.map, "EXR file of normals or slopes")->group(group);
  command.add_flag("--force", a.force, "Accept a map whose slopes are not radially symmetric")
      ->group(group);
  command.add_option("--name", a.name, "Name of the distribution")->group(group);
}

DistributionSource make_distribution(const SourceArguments& a) {
  require_one_source(a);
  DistributionSource source = undiagnosed(a);
  if (!a.name.empty()) {
    source.options += " --name " + quoted(a.name);
    source.distribution = std::make_unique<Renamed>(a.name, std::move(source.distribution));
  }
  const bool singular = !a.spec.empty() && std::isinf(source.distribution->p22(0));
  distributions::diagnose(*source.distribution, {.singularity_at_zero_allowed = singular});
  return source;
}

DistributionSource distribution_of_recipe(const std::string& recipe) {
  auto words = words_of(recipe);
  if (words.size() < 3 || words[0] != "vndf" || words[1] != "build")
    throw std::runtime_error("it is not a command line of vndf build");
  words.erase(words.begin(), words.begin() + 2);
  std::reverse(words.begin(), words.end());  // as CLI11 takes them
  CLI::App app;
  SourceArguments arguments;
  add_source_options(app, arguments);
  std::string ignored;  // what a recipe says of the tables
  for (const char* option : {"--size", "--precision", "--tolerance", "--max-bytes", "-o"})
    app.add_option(option, ignored);
  app.parse(words);
  return make_distribution(arguments);
}

std::string list_of_families() {
  std::string text;
  for (const auto& f : distributions::families())
    text += fmt::format("{:<18} {}\n{:<18} p22 = {}\n", f.name,
                        f.parameters.empty() ? "no parameters" : f.parameters, "", f.density);
  return text;
}

}  // namespace vndf::tools
