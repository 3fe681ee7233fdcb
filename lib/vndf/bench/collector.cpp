// Each round reads the clocks before and after the calls of every trial. We do not use Google
// Benchmark for this because it shuffles all repetitions at once: a trial may then run several
// times in a row, with no baseline of the same minute.
#include "vndf/bench/collector.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <numeric>
#include <random>
#include <stdexcept>

namespace vndf::bench {
namespace {

struct Seconds {
  double processor = 0, wall = 0;
};

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Seconds time_of(const std::function<void()>& work, std::size_t calls) {
  const auto wall = std::chrono::steady_clock::now();
  const double processor = processor_time();
  for (std::size_t k = 0; k < calls; ++k) work();
  return {processor_time() - processor,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count()};
}

/// The time of some calls of a trial, and its processor time without the overhead.
struct Taken {
  Seconds all;
  double net = 0;
};

/// Work and overhead alternate call by call, because their difference is small compared with how
/// much either changes within a round.
Taken time_of(const Trial& trial, std::size_t calls) {
  if (!trial.overhead) {
    const Seconds all = time_of(trial.work, calls);
    return {all, all.processor};
  }
  Taken taken;
  for (std::size_t k = 0; k < calls; ++k) {
    const Seconds work = time_of(trial.work, 1), overhead = time_of(trial.overhead, 1);
    taken.all.processor += work.processor + overhead.processor;
    taken.all.wall += work.wall + overhead.wall;
    taken.net += work.processor - overhead.processor;
  }
  return taken;
}

/// The number of calls that take `seconds`. Finding it also warms up the caches.
std::size_t calls_for(const Trial& trial, double seconds) {
  for (std::size_t calls = 1;;) {
    const double taken = time_of(trial, calls).all.wall;
    if (taken >= seconds) return calls;
    // A short time is inaccurate, so we trust it for at most ten times as many calls.
    const double more = taken > 0 ? std::clamp(1.1 * seconds / taken, 1.1, 10.0) : 10.0;
    calls = std::max(calls + 1, static_cast<std::size_t>(static_cast<double>(calls) * more));
  }
}

void check(const CollectOptions& options) {
  if (options.repetitions < 1)
    throw std::invalid_argument("repetitions: " + std::to_string(options.repetitions) +
                                " is too few; give 1 or more");
  if (!(options.seconds > 0))
    throw std::invalid_argument("seconds of a repetition: give a number above 0");
}

/// The trials, their calls in each round, and the times of the rounds so far.
class Rounds {
 public:
  Rounds(const std::vector<Trial>& trials, double seconds)
      : trials_(trials), order_(trials.size()), figures_(trials.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    for (const Trial& t : trials) calls_.push_back(calls_for(t, seconds));
  }

  void run_one() {
    std::ranges::shuffle(order_, random_);
    for (const std::size_t k : order_) {
      const Taken taken = time_of(trials_[k], calls_[k]);
      figures_[k].push_back(taken.net / static_cast<double>(calls_[k] * trials_[k].samples));
      total_.processor += taken.all.processor;
      total_.wall += taken.all.wall;
    }
  }

  Collection collection() const {
    Collection result{{}, total_.wall > 0 ? total_.processor / total_.wall : 1};
    for (const auto& rounds : figures_) result.timings.push_back(timing_of(rounds));
    return result;
  }

 private:
  const std::vector<Trial>& trials_;
  std::vector<std::size_t> order_, calls_;
  std::vector<std::vector<double>> figures_;
  Seconds total_;
  std::mt19937_64 random_;
};

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("no values have no median; give one or more");
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

Timing timing_of(const std::vector<double>& rounds) {
  return {median(rounds), std::ranges::min(rounds), std::ranges::max(rounds), rounds};
}

Collection collect(const std::vector<Trial>& trials, const CollectOptions& options) {
  check(options);
  if (trials.empty()) return {};
  const auto tell = [&options](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  tell("warming up " + std::to_string(trials.size()) + " timings");
  Rounds rounds(trials, options.seconds);
  for (int round = 1; round <= options.repetitions; ++round) {
    tell("round " + std::to_string(round) + " of " + std::to_string(options.repetitions));
    rounds.run_one();
  }
  return rounds.collection();
}

}  // namespace vndf::bench
