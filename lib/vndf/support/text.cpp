// Formats numbers without a locale and finds nearest names.
#include "vndf/support/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace vndf::support {
namespace {

/// Returns how many insertions, deletions and replacements turn `a` into `b`, by the rows of the
/// usual table (Wagner and Fischer 1974).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// Whether `part` is in `name` and more than a stray letter, as "phong" in "blinn-phong".
bool is_part(std::string_view part, std::string_view name) {
  return part.size() >= 3 && name.find(part) != std::string_view::npos;
}

/// How many bytes the first character of `text` takes in UTF-8 (RFC 3629), or 0 if there is none
/// that can be shown: a control character, an overlong form, a surrogate or another wrong byte.
std::size_t shown_bytes(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7f ? 1 : 0;
  const std::size_t length = lead < 0xc2   ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0u) != 0x80u) return 0;
  // The second byte has a narrower range after these first ones. After C2 it would be a control.
  const unsigned second = byte(1);
  const bool wrong = (lead == 0xc2 && second < 0xa0) || (lead == 0xe0 && second < 0xa0) ||
                     (lead == 0xed && second >= 0xa0) || (lead == 0xf0 && second < 0x90) ||
                     (lead == 0xf4 && second >= 0x90);
  return wrong ? 0 : length;
}

std::string escaped(char c) {
  if (c == '\n') return "\\n";
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
}

}  // namespace

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";  // without the sign
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end};
}

std::optional<double> finite_number(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return {};
  return value;
}

std::string rounded_text(double value) {
  if (std::isnan(value)) return "nan";
  char buffer[32];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 3);
  return {buffer, end};
}

std::string quoted(std::string_view text, std::size_t position) {
  constexpr std::size_t kMost = 60;
  const std::size_t last = text.size() > kMost ? text.size() - kMost : 0;
  const std::size_t first = std::min(position > kMost / 2 ? position - kMost / 2 : 0, last);
  std::string shown = first > 0 ? "'..." : "'";
  for (const char c : text.substr(first, kMost)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (first < last ? "...'" : "'");
}

std::string printable(std::string_view text, std::size_t most) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t length = shown_bytes(text);
    const std::string next = length > 0 ? std::string(text.substr(0, length)) : escaped(text[0]);
    if (next.size() > most - shown.size()) return shown + "...";
    shown += next;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + item;
  return text;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  const std::string* best = nullptr;
  std::size_t best_distance = 0;
  for (const auto& candidate : known) {
    const std::size_t distance = is_part(name, candidate) ? 1 : edit_distance(name, candidate);
    const std::size_t allowed =
        std::max<std::size_t>(1, (std::max(name.size(), candidate.size()) + 1) / 3);
    if (distance > allowed || (best != nullptr && distance >= best_distance)) continue;
    best = &candidate;
    best_distance = distance;
  }
  return best == nullptr ? "" : "; did you mean '" + *best + "'?";
}

}  // namespace vndf::support
