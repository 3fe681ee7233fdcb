// The exported GLSL in WebGL 2, as a browser runs it, against golden vectors.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "devices/exported_cases.h"
#include "devices/run_tool.h"
#include "support/catch.h"
#include "support/temporary_folder.h"
#include "vndf/devices/export_source.h"

using namespace vndf;
using namespace vndf::test;

namespace {

/// The bits of numbers of four bytes, as JavaScript writes an array without its brackets.
std::string listed(std::span<const std::byte> bytes) {
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += sizeof(std::uint32_t)) {
    std::uint32_t number = 0;
    std::memcpy(&number, &bytes[k], std::min(sizeof number, bytes.size() - k));
    text += std::to_string(number) + ",";
  }
  return text;
}

void fill_in(std::string& page, const std::string& place, const std::string& text) {
  page.replace(page.find(place), place.size(), text);
}

std::string page_for(const ExportedCase& exported) {
  const KernelTables& tables = tables_of(exported);
  const std::vector<float> inputs = device_inputs(vectors_of(exported));
  std::string page = content(VNDF_SHADERS "/golden_webgl.html");
  fill_in(page, "@SOURCE@",
          export_shading(tables, devices::ShadingLanguage::glsl,
                         {"golden", devices::TablePlace::buffer}) +
              content(VNDF_SHADERS "/every_function.h"));
  fill_in(page, "@WORDS@", listed(tables.bytes()));
  fill_in(page, "@INPUTS@", listed(std::as_bytes(std::span(inputs))));
  return page;
}

/// What the page says: numbers, as bits, or what went wrong.
std::string shown_by_browser(const std::string& page) {
  const TemporaryFolder folder;
  std::ofstream(folder / "page.html") << page;
  const std::string shown =
      run_tool("(" VNDF_CHROMIUM
               " --headless --no-sandbox --disable-gpu --use-angle=swiftshader"
               " --enable-unsafe-swiftshader --dump-dom file://" +
               (folder / "page.html").string() + " 2>/dev/null)");
  const std::string open = "<pre id=\"results\">";
  const std::size_t from = shown.find(open) + open.size();
  return shown.substr(from, shown.find("</pre>", from) - from);
}

}  // namespace

TEST_CASE("GLSL in WebGL 2 keeps the golden vectors", "[.slow]") {
  if (std::string(VNDF_CHROMIUM).ends_with("NOTFOUND")) {
    WARN("not tested: chromium is not installed");
    return;
  }
  for (const ExportedCase& exported : kExportedCases) {
    CAPTURE(exported.distribution);
    const std::string shown = shown_by_browser(page_for(exported));
    std::istringstream numbers(shown);
    std::vector<float> outputs;
    for (std::uint32_t bits; numbers >> bits;) outputs.push_back(std::bit_cast<float>(bits));
    INFO(shown.substr(0, 1000));
    CHECK(differences(vectors_of(exported), outputs) == "");
  }
}
