// The rules that both formats of files share. Whoever writes a file obeys them, so that every file
// can be read.
#include "vndf/provenance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vndf {
namespace {

std::optional<std::string> check_samples(const Specification& s) {
  if (s.r.size() != s.p22.size())
    return "the specification has " + std::to_string(s.r.size()) + " radii and " +
           std::to_string(s.p22.size()) + " densities, not as many of both";
  if (s.r.size() > kMaxSamples)
    return "the specification has more than " + std::to_string(kMaxSamples) + " samples";
  for (const auto* values : {&s.r, &s.p22})
    if (!std::ranges::all_of(*values, [](double v) { return std::isfinite(v); }))
      return "a sample of the specification is not a finite number";
  return {};
}

}  // namespace

std::optional<std::string> check_text(const std::string& name, const std::string& text) {
  if (text.size() > kMaxTextBytes)
    return "the text '" + name + "' is longer than " + std::to_string(kMaxTextBytes) + " bytes";
  if (text.find('\0') != std::string::npos) return "the text '" + name + "' has a zero byte";
  if (has_control_character(text)) return "the text '" + name + "' has a control character";
  return {};
}

bool has_control_character(std::string_view text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    if ((byte < 0x20 && byte != 0 && byte != '\n') || byte == 0x7f) return true;
    // In UTF-8 the controls of C1 are C2 80 to C2 9F.
    const auto next = k + 1 < text.size() ? static_cast<unsigned char>(text[k + 1]) : 0;
    if (byte == 0xc2 && next >= 0x80 && next < 0xa0) return true;
  }
  return false;
}

std::optional<std::string> check(const Provenance& p) {
  const std::pair<const char*, const std::string*> texts[] = {
      {"specification", &p.specification.text},
      {"command", &p.command},
      {"program", &p.program},
      {"notes", &p.notes}};
  for (const auto& [name, text] : texts)
    if (auto broken = check_text(name, *text)) return broken;
  if (p.surface)
    if (const auto broken = check(*p.surface)) return "of the surface of the map " + *broken;
  return check_samples(p.specification);
}

}  // namespace vndf
