// vndf validate: judges table files and reference samplers.
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
#include "commands/verdicts.h"
#include "report/validation_report.h"
#include "report/verdict_text.h"
#include "vndf/validate/sampler/named_samplers.h"

namespace vndf::tools {
namespace {

using validate::SlopeLaw;
using validate::Subject;
using validate::Thoroughness;

struct ValidateArguments {
  std::vector<std::string> subjects;
  bool quick = false, thorough = false, list = false;
  std::optional<std::uint64_t> seed;
  unsigned threads = 0;
  std::string json, report;
};

/// Laws of the reference samplers, which those of one distribution share.
class Laws {
 public:
  std::shared_ptr<const SlopeLaw> of(const validate::NamedSubject& subject) {
    auto& law = laws_[subject.distribution];
    if (!law) law = std::make_shared<SlopeLaw>(subject.make_distribution());
    return law;
  }

 private:
  std::map<std::string, std::shared_ptr<const SlopeLaw>> laws_;
};

Subject subject_of(const std::string& argument, Laws& laws) {
  if (names_a_file(argument)) {
    const AnyTables tables = load_tables(argument);
    const auto law = std::make_shared<SlopeLaw>(distribution_of(tables));
    if (const auto* pair = std::get_if<io::TableFile>(&tables))
      return validate::tabulated_subject(argument, law, pair->tables, pair->certificate);
    return validate::kernel_subject(argument, law, std::get<KernelTables>(tables));
  }
  const auto& named = validate::find_subject(argument);
  return named.make(named.name, laws.of(named));
}

Thoroughness thoroughness(const ValidateArguments& a) {
  if (a.quick) return Thoroughness::quick;
  return a.thorough ? Thoroughness::thorough : Thoroughness::standard;
}

/// Nothing if none is asked for.
std::unique_ptr<ValidationReport> report_of(const ValidateArguments& a, std::uint64_t seed) {
  if (a.report.empty()) return nullptr;
  const char* effort = a.quick ? " --quick" : a.thorough ? " --thorough" : "";
  return std::make_unique<ValidationReport>(a.report, ReportCircumstances{kProgram, effort, seed});
}

/// True if all subjects pass.
bool validate_all(const ValidateArguments& a) {
  if (!a.json.empty()) require_output(a.json, a.subjects);
  Laws laws;
  std::vector<Subject> subjects;  // wrong names are told before any work
  for (const std::string& argument : a.subjects) subjects.push_back(subject_of(argument, laws));

  const std::uint64_t seed = a.seed.value_or(fresh_seed());
  const auto report = report_of(a, seed);  // what hinders it is told before any work, too
  std::cout << fmt::format("seed {}\n", seed);
  const validate::JudgeOptions options{.thoroughness = thoroughness(a),
                                       .seed = seed,
                                       .subjects = subjects.size(),
                                       .workers = {a.threads}};
  bool passed = true;
  auto verdicts = nlohmann::ordered_json::array();
  for (const Subject& subject : subjects) {
    const auto verdict = validate::judge(subject, options);
    std::cout << describe(verdict) << std::flush;
    verdicts.push_back(to_json(verdict));
    if (report) report->add(subject, verdict, options.workers);
    passed = passed && verdict.passed();
  }
  if (!a.json.empty())
    write_json(a.json, {{"program", kProgram},
                        {"seed", seed},
                        {"passed", passed},
                        {"subjects", std::move(verdicts)}});
  if (report) report->finish();
  require_printed();
  return passed;
}

}  // namespace

void add_validate(CLI::App& app) {
  auto* command =
      app.add_subcommand("validate", "Judge samplers against the exact law; status 1 if one fails");
  const auto a = std::make_shared<ValidateArguments>();
  command->add_option("subjects", a->subjects, "Table files and names of reference samplers");
  auto* quick = command->add_flag("--quick", a->quick, "Seconds, fewer places and samples");
  command->add_flag("--thorough", a->thorough, "1e9 samples")->excludes(quick);
  command->add_option("--seed", a->seed, "Seed of the random numbers; a fresh one where not given")
      ->check(whole_number());
  add_threads(*command, a->threads);
  command->add_option("--json", a->json, "Write the verdicts to this file too");
  command->add_option("--report", a->report,
                      "Write a page with pictures and their data to this folder (needs gnuplot)");
  command->add_flag("--list", a->list, "List the reference samplers and stop");
  command->callback([a] {
    if (a->list) {
      for (const auto& s : validate::named_subjects())
        std::cout << fmt::format("{:<24} {}\n", s.name, s.distribution);
      return;
    }
    if (a->subjects.empty()) throw CLI::RequiredError("subjects");
    if (!validate_all(*a)) throw CLI::RuntimeError(1);
  });
}

}  // namespace vndf::tools
