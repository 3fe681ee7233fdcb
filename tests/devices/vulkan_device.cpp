// Vulkan from its instance to one dispatch. The loader's own C++ classes free what they hold and
// throw where a call fails.
#include "devices/vulkan_device.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vulkan/vulkan_raii.hpp>

namespace vndf::test {
namespace {

vk::raii::Instance make_instance(const vk::raii::Context& context) {
  const vk::ApplicationInfo application("vndf tests", 0, nullptr, 0, VK_API_VERSION_1_1);
  return {context, vk::InstanceCreateInfo({}, &application)};
}

vk::raii::PhysicalDevice first_device(const vk::raii::Instance& instance) {
  vk::raii::PhysicalDevices devices(instance);
  if (devices.empty()) throw std::runtime_error("this driver of Vulkan has no device");
  return std::move(devices.front());
}

std::uint32_t compute_family(const vk::raii::PhysicalDevice& device) {
  const auto families = device.getQueueFamilyProperties();
  const auto computes = [](const vk::QueueFamilyProperties& family) {
    return static_cast<bool>(family.queueFlags & vk::QueueFlagBits::eCompute);
  };
  const auto found = std::ranges::find_if(families, computes);
  if (found == families.end()) throw std::runtime_error("the device of Vulkan does not compute");
  return static_cast<std::uint32_t>(found - families.begin());
}

/// A wrong shader may read outside its buffers, which must be a wrong result and not the end of the
/// test; every device can see to that.
vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
  const float priority = 1;
  const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
  vk::PhysicalDeviceFeatures features;
  features.robustBufferAccess = VK_TRUE;
  return {physical, vk::DeviceCreateInfo({}, queue, {}, {}, &features)};
}

/// Memory that the processor and the device both see.
std::uint32_t shared_memory_type(const vk::raii::PhysicalDevice& device, std::uint32_t fits) {
  constexpr auto kShared =
      vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
  const auto properties = device.getMemoryProperties();
  for (std::uint32_t type = 0; type < properties.memoryTypeCount; ++type)
    if ((fits >> type & 1) != 0 &&
        (properties.memoryTypes[type].propertyFlags & kShared) == kShared)
      return type;
  throw std::runtime_error("the device of Vulkan shares no memory with the processor");
}

std::string describe(const vk::PhysicalDeviceProperties& properties) {
  const std::uint32_t version = properties.driverVersion;
  return std::string(properties.deviceName.data()) + ", driver " +
         std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

}  // namespace

struct VulkanDevice::State {
  vk::raii::Context context;
  vk::raii::Instance instance = make_instance(context);
  vk::raii::PhysicalDevice physical = first_device(instance);
  std::uint32_t family = compute_family(physical);
  vk::raii::Device device = make_device(physical, family);
  vk::raii::Queue queue{device, family, 0};
};

namespace {

class StorageBuffer {
 public:
  StorageBuffer(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device,
                std::size_t bytes)
      : buffer_(device, vk::BufferCreateInfo({}, bytes, vk::BufferUsageFlagBits::eStorageBuffer)),
        memory_(device, allocation(physical)) {
    buffer_.bindMemory(*memory_, 0);
    mapped_ = memory_.mapMemory(0, VK_WHOLE_SIZE);
  }

  void* mapped() const { return mapped_; }
  vk::DescriptorBufferInfo description() const { return {*buffer_, 0, VK_WHOLE_SIZE}; }

 private:
  vk::MemoryAllocateInfo allocation(const vk::raii::PhysicalDevice& physical) const {
    const auto needed = buffer_.getMemoryRequirements();
    return {needed.size, shared_memory_type(physical, needed.memoryTypeBits)};
  }

  vk::raii::Buffer buffer_;
  vk::raii::DeviceMemory memory_;
  void* mapped_ = nullptr;
};

constexpr vk::DescriptorSetLayoutBinding binding(std::uint32_t number) {
  return {number, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute};
}
constexpr std::array kBindings{binding(0), binding(1), binding(2)};

/// A shader that is ready to run, with the layout of its bindings.
struct Program {
  Program(const vk::raii::Device& device, std::span<const std::uint32_t> spirv)
      : bindings(device, vk::DescriptorSetLayoutCreateInfo({}, kBindings)),
        layout(device, vk::PipelineLayoutCreateInfo({}, *bindings)),
        shader(device, vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data())),
        pipeline(device, nullptr,
                 vk::ComputePipelineCreateInfo(
                     {}, {{}, vk::ShaderStageFlagBits::eCompute, *shader, "main"}, *layout)) {}

  vk::raii::DescriptorSetLayout bindings;
  vk::raii::PipelineLayout layout;
  vk::raii::ShaderModule shader;
  vk::raii::Pipeline pipeline;
};

/// The buffers, bound to the bindings of a program.
struct BoundBuffers {
  BoundBuffers(const vk::raii::Device& device, const Program& program,
               const std::array<vk::DescriptorBufferInfo, kBindings.size()>& buffers)
      : pool(device, vk::DescriptorPoolCreateInfo(
                         vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, kPoolSize)),
        sets(device, vk::DescriptorSetAllocateInfo(*pool, *program.bindings)) {
    for (std::uint32_t number = 0; number < kBindings.size(); ++number)
      device.updateDescriptorSets(
          vk::WriteDescriptorSet(*sets.front(), number, 0, vk::DescriptorType::eStorageBuffer, {},
                                 buffers[number]),
          {});
  }

  static constexpr vk::DescriptorPoolSize kPoolSize{vk::DescriptorType::eStorageBuffer,
                                                    static_cast<std::uint32_t>(kBindings.size())};

  vk::raii::DescriptorPool pool;
  vk::raii::DescriptorSets sets;
};

template <class T>
void fill(const StorageBuffer& buffer, std::span<const T> values) {
  std::memcpy(buffer.mapped(), values.data(), values.size_bytes());
}

}  // namespace

VulkanDevice::VulkanDevice() {
  try {
    state_ = std::make_unique<State>();
  } catch (const vk::Error& error) {
    throw std::runtime_error(std::string("Vulkan does not start: ") + error.what());
  }
  name_ = describe(state_->physical.getProperties());
}

VulkanDevice::~VulkanDevice() = default;

std::vector<float> VulkanDevice::run(std::span<const std::uint32_t> spirv,
                                     const ShaderBuffers& buffers, std::size_t groups) const {
  const auto& [context, instance, physical, family, device, queue] = *state_;
  const StorageBuffer tables(physical, device, buffers.tables.size());
  const StorageBuffer inputs(physical, device, buffers.inputs.size_bytes());
  const StorageBuffer outputs(physical, device, buffers.outputs * sizeof(float));
  fill(tables, buffers.tables);
  fill(inputs, buffers.inputs);

  const Program program(device, spirv);
  const BoundBuffers bound(device, program,
                           {tables.description(), inputs.description(), outputs.description()});

  const vk::raii::CommandPool pool(device, vk::CommandPoolCreateInfo({}, family));
  const vk::raii::CommandBuffers commands(
      device, vk::CommandBufferAllocateInfo(*pool, vk::CommandBufferLevel::ePrimary, 1));
  const vk::raii::CommandBuffer& list = commands.front();
  list.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  list.bindPipeline(vk::PipelineBindPoint::eCompute, *program.pipeline);
  list.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *program.layout, 0, *bound.sets.front(),
                          {});
  list.dispatch(static_cast<std::uint32_t>(groups), 1, 1);
  list.pipelineBarrier(
      vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost, {},
      vk::MemoryBarrier(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead), {}, {});
  list.end();
  queue.submit(vk::SubmitInfo({}, {}, *list));
  queue.waitIdle();

  std::vector<float> results(buffers.outputs);
  std::memcpy(results.data(), outputs.mapped(), buffers.outputs * sizeof(float));
  return results;
}

}  // namespace vndf::test
