// Runs a compute shader on a device of Vulkan, so that the exported sources are tested as renderers
// run them. Drivers that compute on the processor need no GPU: Mesa's lavapipe, and SwiftShader,
// which comes with Chromium. VK_DRIVER_FILES (VK_ICD_FILENAMES for older loaders) says which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace vndf::test {

/// How many invocations a work group of the shaders has.
inline constexpr std::size_t kGroupSize = 64;

/// The storage buffers that a shader reads and writes, at the bindings 0, 1 and 2.
struct ShaderBuffers {
  std::span<const std::byte> tables;
  std::span<const float> inputs;
  std::size_t outputs;  ///< how many floats it writes
};

class VulkanDevice {
 public:
  /// The first device of the driver. Throws std::runtime_error if there is none.
  VulkanDevice();
  ~VulkanDevice();
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;

  /// What the driver calls itself, with its version.
  const std::string& name() const { return name_; }

  /// Runs main() of a compute shader `groups` times kGroupSize times and returns what it wrote.
  /// Throws std::runtime_error if the device cannot.
  std::vector<float> run(std::span<const std::uint32_t> spirv, const ShaderBuffers& buffers,
                         std::size_t groups) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::string name_;
};

}  // namespace vndf::test
