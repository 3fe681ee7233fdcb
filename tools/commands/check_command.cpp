// vndf check: checks the samples of any sampler, from a file of records. The exit status is 0 where
// they are accepted, 1 where they are rejected, and 2 where the input cannot be used.
#include <iostream>
#include <memory>
#include <string>

#include "commands/arguments.h"
#include "commands/commands.h"
#include "commands/messages.h"
#include "commands/output_file.h"
#include "commands/progress.h"
#include "commands/table_files.h"
#include "report/verdict_text.h"
#include "vndf/distributions/specification.h"
#include "vndf/validate/records.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/validate_records.h"

namespace vndf::tools {
namespace {

using validate::ExactSlopes;
using validate::RecordOptions;
using validate::SampledNormals;

constexpr int kRejected = 1, kUnusable = 2;

struct CheckArguments {
  std::string records, against, normals = "visible", inverse = "detect", json;
  double u_error = RecordOptions{}.u_error;
  unsigned threads = 0;
  bool force = false;
};

SampledNormals normals_of(const std::string& name) {
  if (name == "v-cavity") return SampledNormals::visible_v_cavity;
  return name == "all" ? SampledNormals::all : SampledNormals::visible_smith;
}

RecordOptions options_of(const CheckArguments& a) {
  RecordOptions options{
      .normals = normals_of(a.normals), .u_error = a.u_error, .workers = {a.threads}};
  if (a.inverse != "detect") options.monotone_inverse = a.inverse == "yes";
  return options;
}

std::unique_ptr<ExactSlopes> against(const std::string& argument) {
  if (names_a_file(argument))
    return std::make_unique<ExactSlopes>(distribution_of(argument, load_tables(argument)));
  return std::make_unique<ExactSlopes>(distributions::make_distribution({argument}));
}

validate::Verdict validated(const std::string& file, const validate::Records& records,
                            const ExactSlopes& exact, const RecordOptions& options) {
  try {
    return validate_records(records, exact, options);
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(file + ": " + e.what());
  }
}

validate::Verdict check(const CheckArguments& a) {
  Progress progress;
  progress.begin("reading " + a.records);
  const auto exact = against(a.against);
  const auto records = validate::read_records(a.records);
  RecordOptions options = options_of(a);
  options.workers = progress.workers(a.threads);
  progress.begin("checking");
  auto verdict = validated(a.records, records, *exact, options);
  verdict.sampler = a.records + " against " + a.against;
  return verdict;
}

/// Checks the records and shows the verdict; true if they are accepted.
bool check_and_report(const CheckArguments& a) {
  if (!a.json.empty()) require_output(a.json, {a.records, a.against}, a.force);
  const auto verdict = check(a);
  std::cout << describe(verdict) << conclusion(verdict);
  if (!a.json.empty()) {
    auto report = to_json(verdict);
    report["program"] = kProgram;
    write_json(a.json, report);
  }
  require_printed();
  return verdict.passed();
}

}  // namespace

void add_check(CLI::App& app) {
  auto* command = app.add_subcommand(
      "check",
      "Check the samples of any sampler\n\n"
      "The program that is checked writes what its sampler was given and what it returned, one "
      "sample a line. The status is 1 if the samples are rejected, and 2 if the file cannot be "
      "used.");
  const auto a = std::make_shared<CheckArguments>();
  command
      ->add_option("records", a->records,
                   "CSV file wx,wy,wz,ax,ay[,correlation,mean_x,mean_y][,u1,u2],mx,my,mz[,pdf], "
                   "one sample a line")
      ->required();
  command->add_option("--against", a->against, "Named distribution, specification or table file")
      ->required();
  command->add_option("--normals", a->normals, "Which normals are claimed to be drawn")
      ->check(CLI::IsMember({"visible", "v-cavity", "all"}))
      ->capture_default_str();
  command
      ->add_option("--inverse", a->inverse,
                   "Whether (u1, u2) to slopes is the monotone inverse of the CDFs")
      ->check(CLI::IsMember({"detect", "yes", "no"}))
      ->capture_default_str();
  command->add_option("--u-error", a->u_error, "Largest error of the map in u")
      ->check(positive_number())
      ->capture_default_str();
  add_threads(*command, a->threads);
  auto* json = command->add_option("--json", a->json, "Write the verdict to this file too")
                   ->type_name("FILE");
  add_force(*command, a->force);
  command->get_option("--force")->needs(json);
  command->callback([a, command] {
    if (a->inverse == "no" && command->count("--u-error") > 0)
      throw CLI::ValidationError("--u-error", "bounds the map, which --inverse no does not check");
    bool accepted = false;
    try {
      accepted = check_and_report(*a);
    } catch (const std::exception& e) {
      print_failure(e.what());
      throw CLI::RuntimeError(kUnusable);
    }
    if (!accepted) throw CLI::RuntimeError(kRejected);
  });
}

}  // namespace vndf::tools
