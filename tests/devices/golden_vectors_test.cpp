// Golden vectors: what they ask for, that a device which rounds badly passes, and that a wrong one
// does not.
#include "vndf/devices/golden_vectors.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "support/built_tables.h"
#include "support/catch.h"
#include "vndf/baking/bake.h"

using namespace vndf;
using namespace vndf::devices;

namespace {

/// Plain tables, tables with rows of slope y, and tables with a rim.
const std::vector<std::string> kDistributions{"ggx", "exponential-power:p=0.5",
                                              "annulus:inner=0.5"};

KernelTables tables_of(const std::string& distribution) {
  return bake(*test::small_tables(distribution).tables, {.tolerance = 1e-2});
}

std::size_t failures(const Kernel& kernel, const std::vector<GoldenVector>& vectors) {
  return static_cast<std::size_t>(std::ranges::count_if(vectors, [&](const GoldenVector& golden) {
    return first_difference(golden, call_kernel(kernel, golden.input)) != nullptr;
  }));
}

template <class Holds>
bool any_of(const std::vector<KernelInput>& inputs, Holds holds) {
  return std::ranges::any_of(inputs, holds);
}

}  // namespace

TEST_CASE("golden inputs are at the pole, the horizon and all ends, and outside their range") {
  const auto inputs = golden_inputs(1000);
  using In = const KernelInput&;
  CHECK(any_of(inputs, [](In in) { return in.wi.x == 0 && in.wi.y == 0; }));
  CHECK(any_of(inputs, [](In in) { return in.wi.x != 0 && std::abs(in.wi.x) < 1e-20f; }));
  CHECK(any_of(inputs, [](In in) { return in.wi.z == 0; }));
  CHECK(any_of(inputs, [](In in) { return in.wi.z < 0; }));
  CHECK(any_of(inputs, [](In in) { return in.u1 == 0; }));
  CHECK(any_of(inputs, [](In in) { return in.u1 == 1; }));
  CHECK(any_of(inputs, [](In in) { return in.u2 == 0.5f; }));
  CHECK(any_of(inputs, [](In in) { return in.u2 > 1; }));
  CHECK(any_of(inputs, [](In in) { return in.alpha.x == 0; }));
  CHECK(any_of(inputs, [](In in) { return in.alpha.x == 1e-4f; }));
  CHECK(any_of(inputs, [](In in) { return in.alpha.y >= 999 * in.alpha.x && in.alpha.x > 0; }));
  CHECK(any_of(inputs, [](In in) { return in.alpha.x == 10; }));
  const auto more = golden_inputs(2000);
  CHECK(more[999].u1 == inputs[999].u1);  // the sequence goes on
}

TEST_CASE("the kernel itself passes its golden vectors") {
  for (const std::string& distribution : kDistributions) {
    INFO(distribution);
    const KernelTables tables = tables_of(distribution);
    CHECK(failures(tables.kernel(), golden_vectors(tables.kernel(), 500)) == 0);
  }
}

TEST_CASE("devices that round badly pass, also those of which the tolerances were not made") {
  for (const std::string& distribution : kDistributions) {
    INFO(distribution);
    const KernelTables tables = tables_of(distribution);
    std::size_t different = 0, failed = 0;
    for (const GoldenVector& golden : golden_vectors(tables.kernel(), 1000)) {
      const KernelOutput rough =
          call_rough_kernel(tables.kernel(), golden.input, golden.output.wm, {.seed = 12345});
      different += rough.wm.x != golden.output.wm.x;
      failed += first_difference(golden, rough) != nullptr;
    }
    CHECK(failed == 0);
    CHECK(different > 250);  // they do round
  }
}

TEST_CASE("tolerances are small: an angle of 1e-5 at most inputs") {
  // The rest are at the ends of u, in heavy tails, where cells meet that were baked to 1e-2 only,
  // and at the rims of the annulus.
  struct Share {
    const char* distribution;
    double above;
  };
  for (const auto& [distribution, above] :
       {Share{"ggx", 0.05}, Share{"exponential-power:p=0.5", 0.1},
        Share{"annulus:inner=0.5", 0.2}}) {
    INFO(distribution);
    const KernelTables tables = tables_of(distribution);
    const auto vectors = golden_vectors(tables.kernel(), 1000);
    const auto count = std::ranges::count_if(
        vectors, [](const GoldenVector& golden) { return golden.tolerance.wm > 1e-5f; });
    CHECK(static_cast<double>(count) < above * 1000);
  }
}

TEST_CASE("a mistake in any result is found, and named") {
  const KernelTables tables = tables_of("ggx");
  const GoldenVector golden = golden_vectors(tables.kernel(), 1).front();
  struct Mistake {
    const char* name;
    float KernelOutput::*result;
  };
  for (const auto& [name, result] :
       {Mistake{"density", &KernelOutput::density}, Mistake{"d", &KernelOutput::d},
        Mistake{"pdf", &KernelOutput::pdf}, Mistake{"lambda", &KernelOutput::lambda},
        Mistake{"g1", &KernelOutput::g1}, Mistake{"inverse_u1", &KernelOutput::u1},
        Mistake{"inverse_u2", &KernelOutput::u2}, Mistake{"found", &KernelOutput::found}}) {
    KernelOutput wrong = golden.output;
    wrong.*result *= 1.001f;
    CHECK(first_difference(golden, wrong) == std::string(name));
    wrong.*result = std::nanf("");
    CHECK(first_difference(golden, wrong) == std::string(name));
  }
  KernelOutput wrong = golden.output;
  wrong.wm.y += 1e-4f;
  CHECK(first_difference(golden, wrong) == std::string("wm"));
}

TEST_CASE("the tables of another distribution, and tables with one wrong number, fail") {
  const KernelTables ggx = tables_of("ggx");
  const auto vectors = golden_vectors(ggx.kernel(), 500);
  CHECK(failures(tables_of("student-t:gamma=3.1").kernel(), vectors) > 400);
  kernel::VndfTables wrong = ggx.kernel().tables();
  wrong.unit *= 1.0001f;
  CHECK(failures(Kernel(wrong), vectors) > 250);
}

TEST_CASE("the name of a distribution stays in its line of the CSV") {
  const KernelTables tables = tables_of("ggx").with_text({.distribution = "two\nlines"});
  std::istringstream lines(golden_csv(tables, {}));
  std::string line;
  while (std::getline(lines, line) && line.starts_with("#")) {
  }
  CHECK(line.starts_with("wi_x,"));
}

TEST_CASE("the numbers of the CSV are the vectors, to the last bit") {
  const KernelTables tables = tables_of("ggx");
  const auto vectors = golden_vectors(tables.kernel(), 200);
  std::istringstream lines(golden_csv(tables, vectors));
  std::string line;
  while (std::getline(lines, line) && line.starts_with("#")) {
  }
  CHECK(line.starts_with("wi_x,wi_y,wi_z,alpha_x,alpha_y,u1,u2,wm_x"));
  const auto columns = std::ranges::count(line, ',') + 1;
  CHECK(columns == 7 + 3 + 1 + 2 * 8);
  for (const GoldenVector& golden : vectors) {
    REQUIRE(std::getline(lines, line));
    CHECK(std::ranges::count(line, ',') + 1 == columns);
    std::vector<float> numbers;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::stof(field));
    CHECK(numbers[0] == golden.input.wi.x);
    CHECK(numbers[6] == golden.input.u2);
    CHECK(numbers[7] == golden.output.wm.x);
    CHECK(numbers[11] == golden.output.density);
    CHECK(numbers[23] == golden.output.u2);
  }
  CHECK_FALSE(std::getline(lines, line));
}
