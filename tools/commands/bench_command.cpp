// vndf bench: the speed of every sampler beside its errors, in one run.
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands/arguments.h"
#include "commands/commands.h"
#include "commands/output_file.h"
#include "commands/progress.h"
#include "report/gnuplot.h"
#include "vndf/bench/cases.h"
#include "vndf/bench/cuda_bench.h"
#include "vndf/bench/speed_plot.h"
#include "vndf/bench/speed_report.h"

namespace vndf::tools {
namespace {

struct BenchArguments {
  std::vector<std::string> files, only, distributions = bench::kUsualDistributions;
  int repetitions = bench::CollectOptions().repetitions;
  std::string json, plot, device = "cpu";
  bool quick = false, force = false;
};

/// What --quick leaves: enough to see that everything runs, too little to trust a figure.
void make_quick(bench::CaseOptions& cases, bench::SpeedOptions& speed) {
  cases.sides = {16, 64};
  cases.tolerances = {1e-4};
  speed.collect.seconds = 1e-3;
  speed.samples = std::size_t{1} << 16;
}

void run_bench(const BenchArguments& arguments) {
  // A name that cannot be written to is refused before any work.
  const std::string terminal = arguments.plot.empty() ? "" : terminal_for(arguments.plot);
  for (const std::string& name : {arguments.json, arguments.plot})
    if (!name.empty()) require_output(name, arguments.files, arguments.force);
  bench::CaseOptions cases{.distributions = arguments.distributions, .files = arguments.files};
  bench::SpeedOptions speed;
  speed.program = kProgram;
  speed.collect.repetitions = arguments.repetitions;
  Progress progress;
  speed.collect.progress = [&](const std::string& what) { progress.begin(what); };
  if (arguments.quick) make_quick(cases, speed);

  const auto report =
      bench::measure_speed(bench::chosen(bench::all_cases(cases), arguments.only), speed);
  progress.erase();
  std::cout << bench::describe(report);
  if (!arguments.json.empty()) write_json(arguments.json, bench::to_json(report));
  if (!terminal.empty())
    draw(arguments.plot,
         [&](const std::string& name) { return bench::speed_plot(report, terminal, name); });
}

/// Times files of baked tables on a CUDA device.
void run_on_cuda(const BenchArguments& arguments) {
  if (arguments.files.empty())
    throw CLI::ValidationError("--device", "cuda takes files of baked tables; give .vndf files");
  if (!arguments.json.empty()) require_output(arguments.json, arguments.files, arguments.force);
  bench::CudaOptions options;
  options.rounds = arguments.repetitions;
  if (arguments.quick) options.samples = std::size_t{1} << 20;
  nlohmann::ordered_json all{{"program", kProgram}};
  bool right = true;
  for (const std::string& file : arguments.files) {
    const bench::CudaReport report = bench::run_cuda_bench(load(file), options);
    std::cout << file << " on " << bench::describe(report) << '\n';
    all["files"].push_back(bench::to_json(report));
    all["files"].back()["file"] = file;
    right = right && report.golden_failures == 0;
  }
  if (!arguments.json.empty()) write_json(arguments.json, all);
  if (!right) throw CLI::RuntimeError(1);
}

}  // namespace

void add_bench(CLI::App& app) {
  auto* command =
      app.add_subcommand("bench",
                         "Time every sampler, tabulated or not, beside its errors\n\n"
                         "Times are those of one core. They are compared with spherical caps for "
                         "GGX, which are timed in the same rounds.");
  const auto arguments = std::make_shared<BenchArguments>();
  command->add_option("files", arguments->files,
                      "Files of tables to time, .h5, .exr or .vndf, instead of distributions");
  auto* device =
      command
          ->add_option(
              "--device", arguments->device,
              "cpu, or cuda: the kernel of baked tables on a GPU, where the program was built "
              "with CUDA")
          ->check(CLI::IsMember({"cpu", "cuda"}))
          ->capture_default_str();
  auto* only = command->add_option("--only", arguments->only,
                                   "Only samplers in whose names one of these words occurs");
  auto* distribution =
      command->add_option("--distribution", arguments->distributions, "Distributions to tabulate")
          ->capture_default_str();
  command
      ->add_option("--repetitions", arguments->repetitions,
                   "Rounds, each of which times every sampler once")
      ->check(whole_number(1, 1000000))
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write all figures to this file")
      ->type_name("FILE");
  auto* plot = command
                   ->add_option("--plot", arguments->plot,
                                "Draw speed against size: .svg or .png (needs gnuplot)")
                   ->type_name("FILE");
  add_force(*command, arguments->force);
  command->add_flag("--quick", arguments->quick,
                    "Few sizes, short timings: to see that it runs, not for figures");
  command->callback([=] {
    if (arguments->device == "cuda") {
      for (const CLI::Option* option : {only, distribution, plot})
        if (option->count() > 0) throw CLI::ExcludesError(option->get_name(), device->get_name());
      return run_on_cuda(*arguments);
    }
    const bool files_alone = !arguments->files.empty() && command->count("--distribution") == 0;
    if (files_alone) arguments->distributions.clear();
    run_bench(*arguments);
  });
}

}  // namespace vndf::tools
