// What cases share is made once, when it is first asked for.
#include "vndf/bench/shared_builds.h"

#include <any>
#include <memory>
#include <stdexcept>

#include "support/catch.h"

using namespace vndf::bench;

TEST_CASE("a key is built when it is first asked for, and once") {
  SharedBuilds builds;
  int made = 0;
  const auto make = [&made] { return ++made; };
  CHECK(made == 0);
  CHECK(builds.get("a", make)->value == 1);
  CHECK(builds.get("a", make)->value == 1);
  CHECK(builds.get("b", make)->value == 2);
  CHECK(made == 2);
  CHECK(builds.get("a", make)->seconds >= 0);
}

TEST_CASE("what was built lives as long as the builds, or whoever still holds it") {
  std::weak_ptr<int> watched;
  std::shared_ptr<const Built<std::shared_ptr<int>>> kept;
  {
    SharedBuilds builds;
    kept = builds.get("a", [] { return std::make_shared<int>(7); });
    watched = kept->value;
  }
  CHECK_FALSE(watched.expired());
  kept.reset();
  CHECK(watched.expired());
}

TEST_CASE("a build that failed is tried again, and a key keeps its type") {
  SharedBuilds builds;
  CHECK_THROWS_AS(builds.get("a", []() -> int { throw std::runtime_error("no room"); }),
                  std::runtime_error);
  CHECK(builds.get("a", [] { return 3; })->value == 3);
  CHECK_THROWS_AS(builds.get("a", [] { return 3.0; }), std::bad_any_cast);
}
