// Random inputs in structures of arrays.
#include "vndf/bench/sample_inputs.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace vndf::bench {

SampleInputs::SampleInputs(std::size_t samples, std::uint64_t seed) {
  const std::size_t size = std::max<std::size_t>(1, (samples + kBlock - 1) / kBlock) * kBlock;
  for (auto& v : values_) v.resize(size);
  for (auto& v : normals_) v.resize(size);
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return std::ldexp(static_cast<float>(random() >> 40), -24); };
  for (std::size_t k = 0; k < size; ++k) {
    const float z = 1 - uniform(), phi = 2 * std::numbers::pi_v<float> * uniform();
    const float horizontal = std::sqrt((1 - z) * (1 + z));
    const float sample[kRead]{horizontal * std::cos(phi),
                              horizontal * std::sin(phi),
                              z,
                              std::pow(0.05f, uniform()),
                              std::pow(0.05f, uniform()),
                              uniform(),
                              uniform()};
    for (std::size_t i = 0; i < kRead; ++i) values_[i][k] = sample[i];
  }
}

SampleBlock SampleInputs::next() {
  const auto read = [this](std::size_t i) {
    return std::span<const float>(values_[i]).subspan(at_, kBlock);
  };
  const auto written = [this](std::size_t i) {
    return std::span(normals_[i]).subspan(at_, kBlock);
  };
  const SampleBlock block{read(0), read(1), read(2),    read(3),    read(4),
                          read(5), read(6), written(0), written(1), written(2)};
  at_ = (at_ + kBlock) % size();
  return block;
}

std::size_t samples_beyond_caches() {
  constexpr std::size_t kAssumed = std::size_t{64} << 20;
  std::size_t largest = 0;
  for (const auto& cache : benchmark::CPUInfo::Get().caches)
    largest = std::max(largest, static_cast<std::size_t>(cache.size));
  return 2 * (largest > 0 ? largest : kAssumed) / kInputBytes;
}

}  // namespace vndf::bench
