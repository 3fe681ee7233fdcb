// Every function of the kernel at golden inputs, in Metal on the processor; see golden.comp. It
// reads the files "tables" and "inputs" and writes "outputs".
#include <cstdio>
#include <vector>

#include "tables.h"

using vec3 = metal::float3;
using vec2 = metal::float2;
#include "every_function.h"

namespace {

template <class T>
std::vector<T> values_in(const char* name) {
  std::vector<T> values(1 << 20);
  std::FILE* file = std::fopen(name, "rb");
  const std::size_t bytes =
      file ? std::fread(values.data(), 1, values.size() * sizeof(T), file) : 0;
  values.resize((bytes + sizeof(T) - 1) / sizeof(T));
  return values;
}

}  // namespace

int main() {
  const auto words = values_in<metal::uint4>("tables");
  const auto inputs = values_in<float>("inputs");
  std::FILE* outputs = std::fopen("outputs", "wb");
  for (std::size_t k = 0; k + 10 <= inputs.size(); k += 10) {
    const float* in = &inputs[k];
    const GoldenOutput out = every_function(TABLES, {in[0], in[1], in[2]}, {in[3], in[4]},
                                            {in[5], in[6]}, {in[7], in[8], in[9]});
    std::fwrite(&out, sizeof out, 1, outputs);
  }
  return std::fclose(outputs);
}
