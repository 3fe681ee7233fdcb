// Medians, and that each trial gets its own figures. No bound on a time is asserted.
#include "bench/collector.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "catch.h"

using namespace vndf::bench;
using vndf::test::contains;

TEST_CASE("the median is the middle value or the mean of the middle two") {
  CHECK(median({3}) == 3);
  CHECK(median({9, 1, 2}) == 2);
  CHECK(median({4, 1, 3, 100}) == 3.5);
  CHECK(median({1, 1, 1, 1e9, 1e9}) == 1);
  CHECK_THROWS_AS(median({}), std::invalid_argument);
}

TEST_CASE("a timing is median, least and greatest") {
  const Timing t = timing_of({5, 2, 8});
  CHECK(t.median == 5);
  CHECK(t.lowest == 2);
  CHECK(t.highest == 8);
}

TEST_CASE("every trial runs and has a timing of its own samples") {
  int calls[2]{};
  // The same work counted as one sample and as a thousand: the times must differ as they do.
  const auto work = [](int& count) {
    return [&count] {
      ++count;
      volatile double sum = 0;
      for (int k = 0; k < 2000; ++k) sum = sum + k;
    };
  };
  const auto timings = collect({{work(calls[0]), 1}, {work(calls[1]), 1000}}, {3, 2e-3});
  REQUIRE(timings.size() == 2);
  for (const Timing& t : timings) {
    CHECK(t.lowest > 0);
    CHECK(t.lowest <= t.median);
    CHECK(t.median <= t.highest);
  }
  CHECK(calls[0] >= 3);
  CHECK(calls[1] >= 3);
  CHECK(timings[0].median > timings[1].median);
}

TEST_CASE("collecting twice gives the second list only") {
  const Trial trial{[] {}, 1};
  CHECK(collect({trial, trial, trial}, {1, 1e-4}).size() == 3);
  CHECK(collect({trial}, {2, 1e-4}).size() == 1);
  CHECK(collect({}, {2, 1e-4}).empty());
}

TEST_CASE("what a trial throws reaches the caller") {
  const Trial bad{[] { throw std::runtime_error("no tables"); }, 1};
  CHECK_THROWS_WITH(collect({{[] {}, 1}, bad}, {2, 1e-4}), "no tables");
}

TEST_CASE("options out of range are refused") {
  const Trial trial{[] {}, 1};
  CHECK_THROWS_WITH(collect({trial}, {0, 1e-3}), contains("repetitions"));
  CHECK_THROWS_WITH(collect({trial}, {1, 0}), contains("seconds"));
  CHECK_THROWS_AS(collect({trial}, {1, std::numeric_limits<double>::quiet_NaN()}),
                  std::invalid_argument);
}
