// Google Benchmark as a library: trials are registered under their numbers, a reporter collects.
#include "bench/collector.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>

namespace vndf::bench {
namespace {

/// Keeps the seconds per sample of each repetition, by the number of the trial.
class Collector : public benchmark::BenchmarkReporter {
 public:
  explicit Collector(const std::vector<Trial>& trials) : trials_(trials), seconds_(trials.size()) {}

  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const std::size_t k = std::stoul(run.run_name.function_name);
      const double calls = static_cast<double>(run.iterations);
      seconds_[k].push_back(run.cpu_accumulated_time / calls /
                            static_cast<double>(trials_[k].samples));
    }
  }

  const std::vector<std::vector<double>>& seconds() const { return seconds_; }

 private:
  const std::vector<Trial>& trials_;
  std::vector<std::vector<double>> seconds_;
};

/// Only the command line of the library can ask for interleaving.
void interleave_repetitions() {
  std::string program = "vndf", flag = "--benchmark_enable_random_interleaving=true";
  char* arguments[] = {program.data(), flag.data(), nullptr};
  int count = 2;
  benchmark::Initialize(&count, arguments);
}

void register_trials(const std::vector<Trial>& trials, const CollectOptions& options,
                     std::exception_ptr& failure) {
  benchmark::ClearRegisteredBenchmarks();
  for (std::size_t k = 0; k < trials.size(); ++k) {
    const auto run = [&work = trials[k].work, &failure](benchmark::State& state) {
      try {
        for (auto _ : state) work();
      } catch (...) {
        failure = std::current_exception();
        state.SkipWithError("it threw an exception");
      }
    };
    benchmark::RegisterBenchmark(std::to_string(k).c_str(), run)
        ->Repetitions(options.repetitions)
        ->MinTime(options.seconds);
  }
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("no values have no median; give one or more");
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

Timing timing_of(const std::vector<double>& values) {
  return {median(values), std::ranges::min(values), std::ranges::max(values)};
}

std::vector<Timing> collect(const std::vector<Trial>& trials, const CollectOptions& options) {
  if (options.repetitions < 1)
    throw std::invalid_argument("repetitions: " + std::to_string(options.repetitions) +
                                " is too few; give 1 or more");
  if (!(options.seconds > 0))
    throw std::invalid_argument("seconds of a repetition: give a number above 0");
  if (trials.empty()) return {};
  std::exception_ptr failure;
  interleave_repetitions();
  register_trials(trials, options, failure);
  Collector collector(trials);
  benchmark::RunSpecifiedBenchmarks(&collector, nullptr, ".");
  benchmark::ClearRegisteredBenchmarks();
  if (failure) std::rethrow_exception(failure);

  std::vector<Timing> timings;
  for (const auto& seconds : collector.seconds()) {
    if (seconds.size() != static_cast<std::size_t>(options.repetitions))
      throw std::runtime_error("Google Benchmark reported " + std::to_string(seconds.size()) +
                               " of " + std::to_string(options.repetitions) +
                               " repetitions; unset the environment variables BENCHMARK_*");
    timings.push_back(timing_of(seconds));
  }
  return timings;
}

}  // namespace vndf::bench
