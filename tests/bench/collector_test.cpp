// Medians, rounds, and that each trial gets its own figures. No bound on a time is asserted.
#include "vndf/bench/collector.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include "support/catch.h"

using namespace vndf::bench;
using vndf::test::contains;

namespace {

/// Seconds that the first call has passed already.
constexpr double kNextToNothing = 1e-12;

/// Work of some microseconds that counts its calls.
std::function<void()> busy_work(int& count) {
  return [&count] {
    ++count;
    volatile double sum = 0;
    for (int k = 0; k < 2000; ++k) sum = sum + k;
  };
}

}  // namespace

TEST_CASE("the median is the middle value or the mean of the middle two") {
  CHECK(median({3}) == 3);
  CHECK(median({9, 1, 2}) == 2);
  CHECK(median({4, 1, 3, 100}) == 3.5);
  CHECK(median({1, 1, 1, 1e9, 1e9}) == 1);
  CHECK_THROWS_AS(median({}), std::invalid_argument);
}

TEST_CASE("a timing is median, least and greatest of its rounds, which it keeps") {
  const Timing t = timing_of({5, 2, 8});
  CHECK(t.median == 5);
  CHECK(t.lowest == 2);
  CHECK(t.highest == 8);
  CHECK(t.rounds == std::vector<double>{5, 2, 8});
}

TEST_CASE("every trial runs and has a timing of its own samples") {
  int calls[2]{};
  // The same work counted as one sample and as a thousand: the times must differ as they do.
  const auto timings =
      collect({{busy_work(calls[0]), 1}, {busy_work(calls[1]), 1000}}, {3, 2e-3}).timings;
  REQUIRE(timings.size() == 2);
  for (const Timing& t : timings) {
    CHECK(t.rounds.size() == 3);
    CHECK(t.lowest > 0);
    CHECK(t.lowest <= t.median);
    CHECK(t.median <= t.highest);
  }
  CHECK(calls[0] >= 3);
  CHECK(calls[1] >= 3);
  CHECK(timings[0].median > timings[1].median);
}

TEST_CASE("a round runs each trial once, and rounds differ in their order") {
  // A trial of one call a round writes its number.
  std::vector<int> order;
  std::vector<Trial> trials;
  constexpr int kTrials = 6, kRounds = 20;
  for (int k = 0; k < kTrials; ++k) trials.push_back({[&order, k] { order.push_back(k); }});
  collect(trials, {kRounds, kNextToNothing});
  // The warm-up comes before.
  REQUIRE(order.size() >= kTrials * (kRounds + 1));
  std::set<std::vector<int>> orders;
  for (auto end = order.end(); end - order.begin() > kTrials; end -= kTrials) {
    if (orders.size() == kRounds) break;
    std::vector<int> round(end - kTrials, end);
    orders.insert(round);
    std::ranges::sort(round);
    CHECK(round == std::vector<int>{0, 1, 2, 3, 4, 5});
  }
  CHECK(orders.size() > kRounds / 2);
}

TEST_CASE("an overhead runs as often as the work, and its time is taken off") {
  int calls[2]{};
  const auto nothing = [&calls] { ++calls[0]; };
  const auto timings = collect({{nothing, 1, busy_work(calls[1])}}, {3, 2e-3}).timings;
  CHECK(calls[0] == calls[1]);
  CHECK(timings[0].median < 0);
}

TEST_CASE("the processor's share is of the time that passed") {
  const double waiting =
      collect({{[] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }}}, {2, 1e-3})
          .processor_share;
  CHECK(waiting >= 0);
  CHECK(waiting < 0.5);
  CHECK(collect({}, {2, 1e-4}).processor_share == 1);
}

TEST_CASE("the progress tells every round before it runs") {
  std::vector<std::string> told;
  collect({{[] {}}}, {2, 1e-4, [&](const std::string& what) { told.push_back(what); }});
  CHECK(told == std::vector<std::string>{"warming up 1 timings", "round 1 of 2", "round 2 of 2"});
}

TEST_CASE("collecting twice gives the second list only") {
  const Trial trial{[] {}, 1};
  CHECK(collect({trial, trial, trial}, {1, 1e-4}).timings.size() == 3);
  CHECK(collect({trial}, {2, 1e-4}).timings.size() == 1);
  CHECK(collect({}, {2, 1e-4}).timings.empty());
}

TEST_CASE("what a trial throws reaches the caller") {
  const Trial bad{[] { throw std::runtime_error("no tables"); }, 1};
  CHECK_THROWS_WITH(collect({{[] {}, 1}, bad}, {2, 1e-4}), "no tables");
}

TEST_CASE("options out of range are errors") {
  const Trial trial{[] {}, 1};
  CHECK_THROWS_WITH(collect({trial}, {0, 1e-3}), contains("repetitions"));
  CHECK_THROWS_WITH(collect({trial}, {1, 0}), contains("seconds"));
  CHECK_THROWS_AS(collect({trial}, {1, std::numeric_limits<double>::quiet_NaN()}),
                  std::invalid_argument);
}
