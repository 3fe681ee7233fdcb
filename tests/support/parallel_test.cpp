// Work on several threads.
#include "vndf/support/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include "support/catch.h"

using vndf::support::parallel_for;
using vndf::support::part_of;
using vndf::support::Workers;

TEST_CASE("every piece is done once") {
  std::vector<std::atomic<int>> done(1000);
  parallel_for(done.size(), {7}, [&](std::size_t i) { ++done[i]; });
  for (const auto& d : done) REQUIRE(d == 1);
}

TEST_CASE("no pieces and fewer pieces than threads are fine") {
  std::atomic<int> done = 0;
  parallel_for(0, {4}, [&](std::size_t) { ++done; });
  CHECK(done == 0);
  parallel_for(2, {16}, [&](std::size_t) { ++done; });
  CHECK(done == 2);
}

TEST_CASE("an exception of a piece reaches the caller and ends the work") {
  std::atomic<int> done = 0;
  const auto piece = [&](std::size_t i) {
    if (i == 3) throw std::runtime_error("piece 3");
    ++done;
  };
  CHECK_THROWS_WITH(parallel_for(1000000, {2}, piece), "piece 3");
  CHECK(done < 1000000);
}

TEST_CASE("progress counts to the number of pieces") {
  std::size_t last = 0;
  const auto progress = [&](std::size_t done, std::size_t count) {
    CHECK(count == 100);
    CHECK(done == ++last);
  };
  parallel_for(100, {3, progress}, [](std::size_t) {});
  CHECK(last == 100);
}

TEST_CASE("the parts of some work have one progress") {
  std::vector<double> fractions;
  const Workers whole{1, [&](std::size_t done, std::size_t count) {
                        fractions.push_back(static_cast<double>(done) / static_cast<double>(count));
                      }};
  parallel_for(2, part_of(whole, 0, 2), [](std::size_t) {});
  parallel_for(1, part_of(whole, 1, 2), [](std::size_t) {});
  CHECK(fractions == std::vector<double>{0.25, 0.5, 1});
  CHECK(!part_of({4}, 1, 2).progress);
}
