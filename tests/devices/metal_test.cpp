// The exported Metal, compiled for the processor with a stand-in for Metal's standard library,
// because Metal's own compiler is found on Apple's machines alone.
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "devices/exported_cases.h"
#include "devices/run_tool.h"
#include "support/catch.h"
#include "support/temporary_folder.h"
#include "vndf/devices/export_source.h"

using namespace vndf;
using namespace vndf::test;
using devices::TablePlace;

namespace {

void write(const std::filesystem::path& path, const void* data, std::size_t size) {
  std::ofstream(path, std::ios::binary)
      .write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

/// Where the source of a case gives other numbers than the library. No product may be fused with a
/// sum, as in the library.
std::string metal_differences(const ExportedCase& exported, TablePlace place) {
  const TemporaryFolder folder;
  const KernelTables& tables = tables_of(exported);
  const auto vectors = exact_vectors(exported, kVectors);
  const std::vector<float> inputs = device_inputs(vectors);
  std::string source = export_shading(tables, devices::ShadingLanguage::metal, {"golden", place});
  source += place == TablePlace::buffer ? "#define TABLES vndf_golden(words.data())\n"
                                        : "#define TABLES vndf_golden()\n";
  write(folder / "tables.h", source.data(), source.size());
  write(folder / "tables", tables.bytes().data(), tables.bytes().size());
  write(folder / "inputs", inputs.data(), inputs.size() * sizeof(float));
  run_tool("cd " + folder.path().string() +
           " && " VNDF_COMPILER
           " -std=c++14 -O0 -ffp-contract=off -Wall -Wextra -Werror -I. -I" VNDF_SHADERS
           " -I" VNDF_SHADERS "/metal " VNDF_SHADERS "/golden_metal.cpp -o golden && ./golden");
  const std::string bytes = content(folder / "outputs");
  std::vector<float> outputs(bytes.size() / sizeof(float));
  std::memcpy(outputs.data(), bytes.data(), bytes.size());
  return differences(vectors, outputs);
}

}  // namespace

TEST_CASE("Metal that reads its tables from a buffer gives the library's numbers") {
  for (const ExportedCase& exported : kExportedCases) {
    CAPTURE(exported.distribution);
    CHECK(metal_differences(exported, TablePlace::buffer) == "");
  }
}

TEST_CASE("Metal whose tables are constants gives the library's numbers") {
  CHECK(metal_differences(kPlainCase, TablePlace::constants) == "");
}
