// From the options of a command line to the specification of a distribution.
#include "commands/distribution_source.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "vndf/distributions/family_list.h"
#include "vndf/distributions/formula_distribution.h"
#include "vndf/distributions/profile_csv.h"
#include "vndf/distributions/shape_invariance.h"
#include "vndf/distributions/slope_integrals.h"
#include "vndf/distributions/slope_map.h"
#include "vndf/distributions/specification.h"
#include "vndf/io/map_image.h"
#include "vndf/support/text.h"

namespace vndf::tools {
namespace {

/// Adds the option that helps to a message of the library, which knows no command line.
std::domain_error with_option(const std::domain_error& error, const std::string& option) {
  return std::domain_error(std::string(error.what()) + " (" + option + ")");
}

std::map<std::string, double> parse_parameters(const std::vector<std::string>& list) {
  std::map<std::string, double> parameters;
  for (const std::string& text : list) {
    const auto equals = text.find('=');
    const auto value = equals == std::string::npos
                           ? std::optional<double>()
                           : support::finite_number(std::string_view(text).substr(equals + 1));
    if (!value) throw CLI::ValidationError("--param", "'" + text + "' is not NAME=NUMBER");
    if (!parameters.emplace(text.substr(0, equals), *value).second)
      throw CLI::ValidationError("--param", "'" + text.substr(0, equals) + "' is given twice");
  }
  return parameters;
}

DistributionSource from_ndf(const SourceArguments& a) {
  const distributions::Formula formula{a.ndf, parse_parameters(a.parameters)};
  DistributionSource source{distributions::specify_ndf(formula, a.frozen_at, a.breaks, a.name)};
  if (a.frozen_at)
    source.notes =
        fmt::format("the surface of alpha {}, stretched: not a family in alpha\n", *a.frozen_at);
  else if (distributions::NdfFormula(formula).uses_alpha())
    source.notes = "shape-invariant: alpha only stretches it\n";
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

std::string describe(const char* what, const distributions::FitResidual& fit, std::size_t kept) {
  return fmt::format("{}: {} samples in place of {}, CDF of slopes within {:.1e}, ", what, kept,
                     fit.samples, fit.u_error) +
         fmt::format("p22 within {:.1e} (root mean square, relative)\n", fit.density);
}

distributions::ProfileTail tail_kind(const std::string& name) {
  if (name == "exponential") return distributions::ProfileTail::exponential;
  return name == "power" ? distributions::ProfileTail::power : distributions::ProfileTail::none;
}

/// The user's name or that of the file.
std::string name_of(const SourceArguments& a, const std::string& path) {
  return a.name.empty() ? std::filesystem::path(path).stem().string() : a.name;
}

DistributionSource from_profile(const SourceArguments& a) {
  distributions::RadialProfile samples = distributions::read_profile_csv(a.profile);
  std::string notes;
  if (a.smooth) {
    auto [fewer, residual] = distributions::smoothed(std::move(samples));
    notes = describe("smoothed", residual, fewer.r.size());
    samples = std::move(fewer);
  }
  const distributions::MeasuredProfile profile(name_of(a, a.profile), std::move(samples),
                                               tail_kind(a.tail.value_or("none")));
  if (const auto& residual = profile.resampling())
    notes += describe("resampled", *residual, profile.samples().r.size());
  return {distributions::specify_profile(profile), notes + describe(profile.tail())};
}

io::NormalEncoding encoding_of(const std::string& name) {
  if (name == "plain") return io::NormalEncoding::plain;
  return name == "shifted" ? io::NormalEncoding::shifted : io::NormalEncoding::automatic;
}

DistributionSource from_map(const SourceArguments& a) {
  const auto image = io::read_slope_map(a.map, encoding_of(a.encoding.value_or("automatic")));
  const auto estimate = distributions::estimate_slope_map(
      image.slopes, {.name = name_of(a, a.map), .ignore_asymmetry = a.ignore_asymmetry});
  const auto& s = estimate.statistics;
  return {distributions::specify_profile(*estimate.distribution),
          fmt::format("image: {}, {} x {} texels\n", image.content, image.width, image.height) +
              fmt::format("estimated from {} texels: u-error below {:.2e} (95 %), ", s.texels,
                          s.u_error) +
              fmt::format("asymmetry {:.3f} (bound {:.3f})\n", s.asymmetry, s.asymmetry_bound) +
              describe(estimate.distribution->tail()),
          s.surface};
}

void require_one_source(const SourceArguments& a) {
  int given = 0;
  for (const auto* source : {&a.spec, &a.p22, &a.ndf, &a.profile, &a.map})
    given += !source->empty();
  if (given != 1)
    throw CLI::ValidationError(
        "distribution", "give one of: a named distribution, --p22, --ndf, --profile, --normal-map");
}

/// Refuses an option that would do nothing, because the user meant it to do something.
void require_effect(const SourceArguments& a) {
  const auto require = [](bool given, bool has_effect, const char* option, const char* sources) {
    if (given && !has_effect)
      throw CLI::ValidationError(option, std::string("goes with ") + sources);
  };
  const bool formula = !a.p22.empty() || !a.ndf.empty();
  require(!a.parameters.empty(), formula, "--param", "--p22 or --ndf");
  require(!a.breaks.empty(), formula, "--break", "--p22 or --ndf");
  require(a.frozen_at.has_value(), !a.ndf.empty(), "--frozen-at", "--ndf");
  require(a.tail.has_value(), !a.profile.empty(), "--tail", "--profile");
  require(a.smooth, !a.profile.empty(), "--smooth", "--profile");
  require(a.encoding.has_value(), !a.map.empty(), "--encoding", "--normal-map");
  require(a.ignore_asymmetry, !a.map.empty(), "--ignore-asymmetry", "--normal-map");
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
      ->type_name("FILE")
      ->group(group);
  command.add_option("--tail", a.tail, "What a profile does beyond its last sample (default none)")
      ->check(CLI::IsMember({"none", "exponential", "power"}))
      ->group(group);
  command.add_flag("--smooth", a.smooth, "Take the noise out of a profile, and report how much")
      ->group(group);
  command
      .add_option("--normal-map", a.map, "EXR, PNG or TIFF file of normals, or EXR file of slopes")
      ->type_name("FILE")
      ->group(group);
  command
      .add_option("--encoding", a.encoding,
                  "How a map stores normals n as values v: plain (n = v), shifted (n = 2 v - 1) or "
                  "automatic (the default: plain if any v is negative)")
      ->check(CLI::IsMember({"automatic", "plain", "shifted"}))
      ->group(group);
  command
      .add_flag("--ignore-asymmetry", a.ignore_asymmetry,
                "Accept a map whose slopes are not radially symmetric")
      ->group(group);
  command.add_option("--name", a.name, "Name of the distribution")->group(group);
}

DistributionSource source_of(const SourceArguments& a) {
  require_one_source(a);
  require_effect(a);
  if (!a.spec.empty()) return {distributions::specify_family(a.spec, a.name)};
  if (!a.p22.empty())
    return {distributions::specify_p22({a.p22, parse_parameters(a.parameters)}, a.breaks, a.name)};
  if (!a.ndf.empty()) return from_ndf(a);
  if (!a.profile.empty()) return from_profile(a);
  try {
    return from_map(a);
  } catch (const distributions::AsymmetricMap& error) {
    throw with_option(error, "--ignore-asymmetry");
  }
}

std::unique_ptr<distributions::SlopeDistribution> make_distribution(
    const DistributionSource& source) {
  try {
    return distributions::make_distribution(source.specification);
  } catch (const distributions::NotShapeInvariant& error) {
    throw with_option(error, "--frozen-at ALPHA");
  } catch (const distributions::DivergentIntegral& error) {
    throw with_option(error, "--break RADIUS");
  }
}

std::string list_of_families() {
  std::string text;
  for (const auto& f : distributions::families())
    text += fmt::format("{:<18} {}\n{:<18} p22 = {}\n", f.name,
                        f.parameters.empty() ? "no parameters" : f.parameters, "", f.density);
  return text;
}

}  // namespace vndf::tools
