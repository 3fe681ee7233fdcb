// vndf validate: checks table files and reference samplers against their exact distributions.
#include <fmt/format.h>

#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "commands/arguments.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/progress.h"
#include "commands/surface_options.h"
#include "commands/table_files.h"
#include "report/validation_report.h"
#include "report/verdict_text.h"
#include "vndf/validate/sampler/named_samplers.h"

namespace vndf::tools {
namespace {

using validate::ExactSlopes;
using validate::SamplerUnderTest;
using validate::Thoroughness;

struct ValidateArguments {
  std::vector<std::string> samplers;
  bool quick = false, thorough = false, list = false, force = false;
  std::optional<std::uint64_t> seed;
  unsigned threads = 0;
  std::string json, report;
  SurfaceArguments surface;
};

/// The slopes of the reference samplers, made once for all samplers of one distribution.
class SharedSlopes {
 public:
  std::shared_ptr<const ExactSlopes> of(const validate::NamedSampler& sampler) {
    auto& exact = made_[sampler.distribution];
    if (!exact) exact = std::make_shared<ExactSlopes>(sampler.make_distribution());
    return exact;
  }

 private:
  std::map<std::string, std::shared_ptr<const ExactSlopes>> made_;
};

/// `sampler`, to be checked on the surface of the options, or on that which its tables record.
/// Options that make no surface are refused before any work.
SamplerUnderTest on_surface(SamplerUnderTest sampler, const SurfaceArguments& surface,
                            const std::optional<SurfaceSlopes>& recorded) {
  sampler.surface = [=, name = sampler.name](const Alpha<double>& alpha) {
    return surface_of(surface, alpha, name, recorded);
  };
  sampler.surface({1, 1});
  return sampler;
}

SamplerUnderTest sampler_of(const std::string& file, const AnyTables& tables) {
  const auto exact = std::make_shared<ExactSlopes>(distribution_of(file, tables));
  if (const auto* pair = std::get_if<io::TableFile>(&tables))
    return validate::tables_under_test(file, exact, pair->tables, pair->certificate);
  return validate::baked_tables_under_test(file, exact, std::get<KernelTables>(tables));
}

SamplerUnderTest sampler_of(const std::string& argument, const SurfaceArguments& surface,
                            SharedSlopes& shared) {
  if (names_a_file(argument)) {
    const AnyTables tables = load_tables(argument);
    return on_surface(sampler_of(argument, tables), surface, provenance_of(tables).surface);
  }
  const auto& named = validate::find_sampler(argument);
  return on_surface(named.make(named.name, shared.of(named)), surface, {});
}

Thoroughness thoroughness(const ValidateArguments& a) {
  if (a.quick) return Thoroughness::quick;
  return a.thorough ? Thoroughness::thorough : Thoroughness::standard;
}

/// The report, or nothing if none is asked for.
std::unique_ptr<ValidationReport> report_of(const ValidateArguments& a, std::uint64_t seed) {
  if (a.report.empty()) return nullptr;
  const char* effort = a.quick ? " --quick" : a.thorough ? " --thorough" : "";
  return std::make_unique<ValidationReport>(a.report, ReportedRun{kProgram, effort, seed});
}

std::uint64_t fresh_seed() {
  std::random_device random;
  return (std::uint64_t{random()} << 32) | random();
}

/// Validates all samplers; true if all pass.
bool validate_all(const ValidateArguments& a) {
  if (!a.json.empty()) require_output(a.json, a.samplers, a.force);
  SharedSlopes shared;
  std::vector<SamplerUnderTest> samplers;  // wrong names are told before any work
  for (const std::string& argument : a.samplers)
    samplers.push_back(sampler_of(argument, a.surface, shared));

  const std::uint64_t seed = a.seed.value_or(fresh_seed());
  const auto report = report_of(a, seed);  // what hinders it is told before any work, too
  std::cout << fmt::format("seed {}\n", seed);
  Progress progress;
  validate::ValidationOptions options{.thoroughness = thoroughness(a),
                                      .seed = seed,
                                      .samplers = samplers.size(),
                                      .workers = progress.workers(a.threads)};
  bool passed = true;
  auto verdicts = nlohmann::ordered_json::array();
  for (const SamplerUnderTest& sampler : samplers) {
    options.begin = [&](const std::string& check) { progress.begin(sampler.name + ": " + check); };
    const auto verdict = validate::validate_sampler(sampler, options);
    progress.erase();
    std::cout << describe(verdict) << std::flush;
    verdicts.push_back(to_json(verdict));
    if (report) {
      progress.begin(sampler.name + ": pictures");
      report->add(sampler, verdict, options.workers);
      progress.erase();
    }
    passed = passed && verdict.passed();
  }
  if (!a.json.empty())
    write_json(a.json, {{"program", kProgram},
                        {"seed", seed},
                        {"passed", passed},
                        {"samplers", std::move(verdicts)}});
  if (report) report->finish();
  require_printed();
  return passed;
}

}  // namespace

void add_validate(CLI::App& app) {
  auto* command = app.add_subcommand("validate",
                                     "Check samplers against their exact distribution\n\n"
                                     "The checks look for errors of the normals, of their "
                                     "densities and of their distribution. The "
                                     "status is 1 if a sampler fails.");
  const auto a = std::make_shared<ValidateArguments>();
  command->add_option("samplers", a->samplers, "Table files and names of reference samplers");
  auto* quick = command->add_flag("--quick", a->quick, "Seconds, fewer places and samples");
  command->add_flag("--thorough", a->thorough, "1e9 samples")->excludes(quick);
  command->add_option("--seed", a->seed, "Seed of the random numbers; a fresh one where not given")
      ->check(whole_number());
  add_threads(*command, a->threads);
  add_surface_options(*command, a->surface);
  auto* json = command->add_option("--json", a->json, "Write the verdicts to this file too")
                   ->type_name("FILE");
  add_force(*command, a->force);
  command->get_option("--force")->needs(json);
  command
      ->add_option("--report", a->report,
                   "Write a page with pictures and their data to this folder (needs gnuplot)")
      ->type_name("FOLDER");
  exclude_others(*command,
                 command->add_flag("--list", a->list, "List the reference samplers and stop"));
  command->callback([a] {
    if (a->list) {
      for (const auto& s : validate::named_samplers())
        std::cout << fmt::format("{:<24} {}\n", s.name, s.distribution);
      return;
    }
    if (a->samplers.empty()) throw CLI::RequiredError("samplers");
    if (!validate_all(*a)) throw CLI::RuntimeError(1);
  });
}

}  // namespace vndf::tools
