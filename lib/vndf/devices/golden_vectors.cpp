// Chooses hard inputs and measures tolerances.
#include "vndf/devices/golden_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "vndf/devices/printed.h"
#include "vndf/devices/table_text.h"
#include "vndf/version.h"

namespace vndf::devices {
namespace {

/// The tolerance must hold for every device that keeps the rules, but only a few can be tried. They
/// err four times as much, so that they also go wherever one that errs less may go: next to the end
/// of a cell a device may take the next cell, where the tables give a little more or less.
constexpr std::uint64_t kRoughDevices = 16;
constexpr int kExcess = 4;
constexpr float kSafety = 2, kLeastUnits = 2;

/// Random numbers that are the same with every standard library.
class Random {
 public:
  /// A multiple of 2^-24 in [0, 1).
  float uniform() { return std::ldexp(static_cast<float>(bits_() >> 8), -24); }
  template <class T, std::size_t N>
  T any_of(const std::array<T, N>& values) {
    return values[bits_() % N];
  }
  /// Between both, uniform in the logarithm.
  float logarithmic(float low, float high) { return low * std::pow(high / low, uniform()); }

 private:
  std::mt19937 bits_{1};
};

/// The direction with this cosine to the normal.
Vec3<float> direction(float sine, float cosine, float azimuth) {
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

Vec3<float> with_cosine(float cosine, float azimuth) {
  return direction(std::sqrt((1 - cosine) * (1 + cosine)), cosine, azimuth);
}

KernelInput random_input(Random& random) {
  KernelInput input;
  input.wi = with_cosine(2 * random.uniform() - 1, 6.2831853f * random.uniform());
  input.alpha = {random.logarithmic(0.01f, 10), random.logarithmic(0.01f, 10)};
  input.u1 = random.uniform();
  input.u2 = random.uniform();
  return input;
}

/// Every argument is at or next to a place where something ends or changes.
KernelInput hard_input(Random& random) {
  constexpr std::array kSines{0.0f, 1e-30f, 1e-8f, 1e-4f, 1e-2f};
  constexpr std::array kCosines{0.0f, 1e-12f, 1e-6f, 1e-3f, 0.05f, 0.5f};
  constexpr std::array kAlphas{1e-4f, 1e-2f, 0.5f, 1.0f, 10.0f};
  constexpr std::array kRatios{1.0f, 1.0f, 0.1f, 1000.0f};
  constexpr std::array kU{0.0f, 0x1p-25f,       0x1p-24f,     1e-6f,        0x1.fffffep-2f,
                          0.5f, 0x1.000002p-1f, 1 - 0x1p-20f, 1 - 0x1p-24f, 1.0f};
  const float azimuth = random.any_of(std::array{0.0f, 1.5707964f, 3.0f, 6.0f});
  const float alpha = random.any_of(kAlphas);
  KernelInput input;
  input.wi = random.uniform() < 0.3f ? direction(random.any_of(kSines), 1, azimuth)
                                     : with_cosine(random.any_of(kCosines), azimuth);
  if (random.uniform() < 0.3f) input.wi.z = -input.wi.z;
  input.alpha = {alpha, std::clamp(alpha * random.any_of(kRatios), 1e-4f, 10.0f)};
  input.u1 = random.any_of(kU);
  input.u2 = random.uniform() < 0.5f ? random.any_of(kU) : random.uniform();
  return input;
}

KernelInput input_outside(Random& random) {
  KernelInput input = random_input(random);
  const int which = random.any_of(std::array{0, 1, 2, 3});
  if (which == 0) input.alpha.x = 0;
  if (which == 1) input.alpha.y = -input.alpha.y;
  if (which == 2) input.u1 = -1;
  if (which == 3) input.u2 = 2;
  return input;
}

float distance(const Vec3<float>& a, const Vec3<float>& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// The difference of two results, 0 for equal ones, which may be infinite.
float difference(float a, float b) {
  if (a == b) return 0;
  const float result = std::fabs(a - b);
  return std::isfinite(result) ? result : std::numeric_limits<float>::infinity();
}

/// A result that is one number, and its tolerance.
struct Result {
  const char* name;
  float KernelOutput::*value;
  float KernelTolerance::*tolerance;
};
constexpr std::array kResults{
    Result{"density", &KernelOutput::density, &KernelTolerance::density},
    Result{"d", &KernelOutput::d, &KernelTolerance::d},
    Result{"pdf", &KernelOutput::pdf, &KernelTolerance::pdf},
    Result{"lambda", &KernelOutput::lambda, &KernelTolerance::lambda},
    Result{"g1", &KernelOutput::g1, &KernelTolerance::g1},
    Result{"inverse_u1", &KernelOutput::u1, &KernelTolerance::u1},
    Result{"inverse_u2", &KernelOutput::u2, &KernelTolerance::u2},
    Result{"found", &KernelOutput::found, &KernelTolerance::found},
};

KernelTolerance tolerance_of(const Kernel& kernel, const KernelInput& input,
                             const KernelOutput& exact) {
  KernelTolerance largest{};
  for (std::uint64_t device = 0; device < kRoughDevices; ++device) {
    const KernelOutput rough = call_rough_kernel(kernel, input, exact.wm, {device, kExcess});
    largest.wm = std::max(largest.wm, distance(rough.wm, exact.wm));
    for (const auto& [name, value, tolerance] : kResults)
      largest.*tolerance = std::max(largest.*tolerance, difference(rough.*value, exact.*value));
  }
  constexpr float kLeast = kLeastUnits * std::numeric_limits<float>::epsilon();
  largest.wm = kSafety * std::max(largest.wm, kLeast);
  for (const auto& [name, value, tolerance] : kResults) {
    const float size = std::fabs(exact.*value);
    const float least = std::isfinite(size) ? kLeast * size + kernel::kVndfLeast : 0.0f;
    largest.*tolerance = kSafety * std::max(largest.*tolerance, least);
  }
  // A normal that was drawn at the end of u has an inverse only by rounding.
  const auto inside = [](float u) { return u > kernel::kVndfLeastU && u < kernel::kVndfMostU; };
  if (!inside(input.u1) || !inside(input.u2))
    largest.u1 = largest.u2 = largest.found = std::numeric_limits<float>::infinity();
  return largest;
}

}  // namespace

std::vector<KernelInput> golden_inputs(std::size_t count) {
  Random random;
  std::vector<KernelInput> inputs;
  inputs.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const bool outside = k % 16 == 15;
    inputs.push_back(outside      ? input_outside(random)
                     : k % 2 == 0 ? random_input(random)
                                  : hard_input(random));
  }
  return inputs;
}

GoldenVector golden_vector(const Kernel& kernel, const KernelInput& input) {
  const KernelOutput output = call_kernel(kernel, input);
  return {input, output, tolerance_of(kernel, input, output)};
}

std::vector<GoldenVector> golden_vectors(const Kernel& kernel, std::size_t count) {
  std::vector<GoldenVector> vectors;
  vectors.reserve(count);
  for (const KernelInput& input : golden_inputs(count))
    vectors.push_back(golden_vector(kernel, input));
  return vectors;
}

const char* first_difference(const GoldenVector& golden, const KernelOutput& output) {
  if (!(distance(output.wm, golden.output.wm) <= golden.tolerance.wm)) return "wm";
  for (const auto& [name, value, tolerance] : kResults) {
    const float apart = difference(output.*value, golden.output.*value);
    if (std::isnan(output.*value) || apart > golden.tolerance.*tolerance) return name;
  }
  return nullptr;
}

std::string golden_csv(const KernelTables& tables, const std::vector<GoldenVector>& vectors) {
  std::string text = "# Golden vectors of the kernel of " +
                     on_one_line(tables.text().distribution) +
                     ", exported by vndf " VNDF_VERSION R"(.
# A port must give each result to its tolerance, which is in the column behind it. wm is what
# sampling gives for wi, alpha and u, and wm_tolerance the largest distance from it; density is that
# of the map at wm. D, pdf and the inverse (inverse_u1, inverse_u2; found is 0 where there is none)
# are those of the wm that stands here, Lambda and G1 those of wi.
wi_x,wi_y,wi_z,alpha_x,alpha_y,u1,u2,wm_x,wm_y,wm_z,wm_tolerance)";
  for (const Result& result : kResults)
    text.append(",").append(result.name).append(",").append(result.name).append("_tolerance");
  text += "\n";
  for (const auto& [input, output, tolerance] : vectors) {
    for (const float value : {input.wi.x, input.wi.y, input.wi.z, input.alpha.x, input.alpha.y,
                              input.u1, input.u2, output.wm.x, output.wm.y, output.wm.z})
      text += printed("%.9g,", static_cast<double>(value));
    text += printed("%.2g", static_cast<double>(tolerance.wm));
    for (const Result& result : kResults)
      text += printed(",%.9g,%.2g", static_cast<double>(output.*result.value),
                      static_cast<double>(tolerance.*result.tolerance));
    text += "\n";
  }
  return text;
}

}  // namespace vndf::devices
