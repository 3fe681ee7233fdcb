// Bytes as a formula: the first line is p22(r), and the lines after it are parameters NAME=NUMBER.
#include <sstream>
#include <stdexcept>
#include <string>

#include "fuzz/fuzz_target.h"
#include "vndf/distributions/compiled_formula.h"

namespace {

vndf::distributions::Formula formula_of(const std::string& text) {
  std::istringstream lines(text);
  vndf::distributions::Formula formula;
  std::getline(lines, formula.text);
  for (std::string line; std::getline(lines, line);) {
    const auto equals = line.find('=');
    if (equals != std::string::npos)
      formula.parameters[line.substr(0, equals)] = std::strtod(line.c_str() + equals + 1, nullptr);
  }
  return formula;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vndf;
  fuzz::accept_or_throw<std::invalid_argument>([&] {
    const distributions::CompiledFormula formula(formula_of(std::string(fuzz::text_of(data, size))),
                                                 {"r", "alpha"});
    for (const double r : {0.0, 1e-3, 1.0, 1e3}) {
      (void)formula(r, 0.5);
      (void)formula.at_slope(r, 0.5);
    }
  });
  return 0;
}
