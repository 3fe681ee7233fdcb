// Bakes tables for export, and compares what devices make of them.
#include "devices/exported_cases.h"

#include <cstring>
#include <map>

#include "support/built_tables.h"
#include "vndf/baking/bake.h"

namespace vndf::test {

const KernelTables& tables_of(const ExportedCase& exported) {
  static std::map<std::string, KernelTables> cache;
  const auto found = cache.find(exported.distribution);
  if (found != cache.end()) return found->second;
  const SlopeTables& pair = *small_tables(exported.distribution).tables;
  const BakeOptions options{.tolerance = exported.tolerance, .max_bytes = exported.max_bytes};
  return cache.emplace(exported.distribution, bake(pair, options)).first->second;
}

std::vector<devices::GoldenVector> exact_vectors(const ExportedCase& exported, std::size_t count) {
  const Kernel kernel = tables_of(exported).kernel();
  std::vector<devices::GoldenVector> vectors;
  vectors.reserve(count);
  for (const devices::KernelInput& input : devices::golden_inputs(count))
    vectors.push_back({input, call_kernel(kernel, input), {}});
  return vectors;
}

const std::vector<devices::GoldenVector>& vectors_of(const ExportedCase& exported) {
  static std::map<std::string, std::vector<devices::GoldenVector>> cache;
  auto& vectors = cache[exported.distribution];
  if (vectors.empty()) vectors = devices::golden_vectors(tables_of(exported).kernel(), kVectors);
  return vectors;
}

std::vector<float> device_inputs(std::span<const devices::GoldenVector> vectors) {
  std::vector<float> inputs;
  inputs.reserve(vectors.size() * kDeviceInputs);
  for (const auto& [input, output, tolerance] : vectors)
    inputs.insert(inputs.end(), {input.wi.x, input.wi.y, input.wi.z, input.alpha.x, input.alpha.y,
                                 input.u1, input.u2, output.wm.x, output.wm.y, output.wm.z});
  return inputs;
}

devices::KernelOutput device_output(std::span<const float> outputs, std::size_t vector) {
  devices::KernelOutput output;
  static_assert(sizeof output == kDeviceOutputs * sizeof(float));
  std::memcpy(&output, &outputs[vector * kDeviceOutputs], sizeof output);
  return output;
}

std::string differences(std::span<const devices::GoldenVector> vectors,
                        std::span<const float> outputs) {
  if (outputs.size() != vectors.size() * kDeviceOutputs)
    return std::to_string(outputs.size()) + " numbers came back";
  std::size_t count = 0;
  std::string first;
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    const char* name = first_difference(vectors[k], device_output(outputs, k));
    if (name && count++ == 0) first = std::string(name) + " of vector " + std::to_string(k);
  }
  if (count == 0) return {};
  return std::to_string(count) + " of " + std::to_string(vectors.size()) + " differ, first " +
         first;
}

}  // namespace vndf::test
