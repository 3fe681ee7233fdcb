// The tables that the tests export, one of each kind that the kernel's text tells apart, with their
// golden vectors.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "vndf/devices/golden_vectors.h"
#include "vndf/kernel_tables.h"

namespace vndf::test {

struct ExportedCase {
  const char* distribution;
  double tolerance;
  std::size_t max_bytes;
  bool rows, roots, rim;  ///< whether the tables have rows of slope y, columns by roots and a rim
};

/// The bytes are fewer than the faster layout needs where columns by roots are wanted.
inline constexpr std::array kExportedCases{
    ExportedCase{"ggx", 1e-4, 262144, false, false, false},
    ExportedCase{"beckmann", 1e-4, 100000, false, true, false},
    ExportedCase{"exponential-power:p=0.5", 1e-3, 262144, true, false, false},
    ExportedCase{"mixture:0.75*ggx+0.25*beckmann@0.3", 1e-4, 120000, true, true, false},
    ExportedCase{"disk", 1e-4, 262144, false, false, true},
};
inline constexpr const ExportedCase& kPlainCase = kExportedCases[0];
inline constexpr const ExportedCase& kRowsCase = kExportedCases[3];

/// Baked from small tables of its distribution, once.
const KernelTables& tables_of(const ExportedCase& exported);

/// How many golden vectors the quick tests take, a multiple of the shaders' groups.
inline constexpr std::size_t kVectors = 2048;

/// What the library computes for the first `count` golden inputs, with tolerances of 0.
std::vector<devices::GoldenVector> exact_vectors(const ExportedCase& exported, std::size_t count);

/// The first kVectors golden vectors, made once.
const std::vector<devices::GoldenVector>& vectors_of(const ExportedCase& exported);

/// What a device is given of `vectors`: kDeviceInputs floats each, wi, alpha, u and the given
/// normal.
inline constexpr std::size_t kDeviceInputs = 10;
std::vector<float> device_inputs(std::span<const devices::GoldenVector> vectors);

/// What a device returns for each, the members of KernelOutput in their order.
inline constexpr std::size_t kDeviceOutputs = 11;
devices::KernelOutput device_output(std::span<const float> outputs, std::size_t vector);

/// How many of `outputs` are not within the tolerances, and the first that is not; nothing if all
/// are.
std::string differences(std::span<const devices::GoldenVector> vectors,
                        std::span<const float> outputs);

}  // namespace vndf::test
