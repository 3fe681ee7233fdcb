// How far a device of Vulkan is from the library, measured on a million inputs a distribution. The
// table is in tests/README.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <vector>

#include "devices/exported_cases.h"
#include "devices/shader_compiler.h"
#include "devices/vulkan_device.h"
#include "support/catch.h"

using namespace vndf;
using namespace vndf::test;
using devices::GoldenVector;
using devices::KernelOutput;

namespace {

constexpr std::size_t kInputs = 1 << 20;

double angle(const KernelOutput& a, const KernelOutput& b) {
  const double x = double{a.wm.x} - b.wm.x, y = double{a.wm.y} - b.wm.y,
               z = double{a.wm.z} - b.wm.z;
  return 2 * std::asin(std::min(std::hypot(x, y, z) / 2, 1.0));
}

/// Numbers next to the least that a device has all digits of may become 0.
double relative(float a, float b) {
  return a == b ? 0.0 : std::abs(double{a} - b) / std::max(std::abs(double{b}), 1e-30);
}

/// The larger difference of the two u; the inverse need not find both.
double inverse_difference(const KernelOutput& a, const KernelOutput& b) {
  if (a.found != b.found) return 0;
  return std::max(std::abs(a.u1 - b.u1), std::abs(a.u2 - b.u2));
}

/// A function of the kernel: how far two devices are apart in it.
struct Function {
  const char* name;
  std::function<double(const KernelOutput&, const KernelOutput&)> difference;
  std::function<bool(const KernelOutput&, const KernelOutput&)> identical;
};

Function number(const char* name, float KernelOutput::*value) {
  return {
      name,
      [=](const KernelOutput& a, const KernelOutput& b) { return relative(a.*value, b.*value); },
      [=](const KernelOutput& a, const KernelOutput& b) { return a.*value == b.*value; }};
}

const std::vector<Function>& functions() {
  static const std::vector<Function> all{{"sample", angle,
                                          [](const KernelOutput& a, const KernelOutput& b) {
                                            return std::memcmp(&a.wm, &b.wm, sizeof a.wm) == 0;
                                          }},
                                         {"invert", inverse_difference,
                                          [](const KernelOutput& a, const KernelOutput& b) {
                                            return a.u1 == b.u1 && a.u2 == b.u2 &&
                                                   a.found == b.found;
                                          }},
                                         number("density", &KernelOutput::density),
                                         number("pdf", &KernelOutput::pdf),
                                         number("d", &KernelOutput::d),
                                         number("lambda", &KernelOutput::lambda),
                                         number("g1", &KernelOutput::g1)};
  return all;
}

/// `exact` with tolerances that no golden vector has less of, which are quick to know.
GoldenVector with_least_tolerance(GoldenVector exact) {
  const auto units = [](float value) { return 0x1p-21f * std::fabs(value); };
  const KernelOutput& o = exact.output;
  exact.tolerance = {0x1p-21f,     units(o.density), units(o.d),
                     units(o.pdf), units(o.lambda),  units(o.g1),
                     units(o.u1),  units(o.u2),      0};
  return exact;
}

/// How many vectors have results beyond their tolerances.
std::size_t beyond_tolerance(const ExportedCase& exported, const std::vector<GoldenVector>& exact,
                             const std::vector<float>& outputs) {
  const Kernel kernel = tables_of(exported).kernel();
  std::size_t count = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const KernelOutput output = device_output(outputs, k);
    if (!first_difference(with_least_tolerance(exact[k]), output)) continue;
    if (const char* name = first_difference(golden_vector(kernel, exact[k].input), output)) {
      std::printf("  %s of vector %zu is beyond its tolerance\n", name, k);
      ++count;
    }
  }
  return count;
}

void print_figures(const Function& function, const std::vector<GoldenVector>& exact,
                   const std::vector<float>& outputs) {
  std::size_t identical = 0;
  double largest = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const KernelOutput output = device_output(outputs, k);
    identical += function.identical(output, exact[k].output) ? 1 : 0;
    largest = std::max(largest, function.difference(output, exact[k].output));
  }
  const double share = static_cast<double>(identical) / static_cast<double>(exact.size());
  std::printf("  %-8s %7.3f %% identical, difference %.2e at most\n", function.name, 100 * share,
              largest);
}

}  // namespace

TEST_CASE("a million golden vectors of each kind of tables are kept", "[.figures]") {
  const VulkanDevice device;
  std::printf("%s\n", device.name().c_str());
  for (const ExportedCase& exported : kExportedCases) {
    std::printf("%s\n", exported.distribution);
    const std::vector<GoldenVector> exact = exact_vectors(exported, kInputs);
    const Spirv shader =
        compile(exported_shader(tables_of(exported), devices::ShadingLanguage::glsl));
    const std::vector<float> inputs = device_inputs(exact);
    const std::vector<float> outputs =
        device.run(shader, {tables_of(exported).bytes(), inputs, exact.size() * kDeviceOutputs},
                   exact.size() / kGroupSize);
    for (const Function& function : functions()) print_figures(function, exact, outputs);
    std::fflush(stdout);
    CHECK(beyond_tolerance(exported, exact, outputs) == 0);
  }
}
