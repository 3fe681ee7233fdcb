// Work on several threads.
#include "vndf/support/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include "support/catch.h"

using vndf::support::parallel_for;

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
  parallel_for(100, {3, [&](std::size_t d) { last = d; }}, [](std::size_t) {});
  CHECK(last == 100);
}
