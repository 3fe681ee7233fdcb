// The command line as text.
#include "commands/command_line.h"

#include <array>
#include <cstdio>
#include <string_view>

#include "vndf/provenance.h"

namespace vndf::tools {
namespace {

/// A word that no file may hold as it is, as bash and zsh read it: $'a\x1b'.
std::string quoted_control(std::string_view text) {
  std::string result = "$'";
  for (const char c : text) {
    std::array<char, 8> code{};
    const bool plain = c >= ' ' && c <= '~' && c != '\'' && c != '\\';
    std::snprintf(code.data(), code.size(), plain ? "%c" : "\\x%02x",
                  static_cast<unsigned char>(c));
    result += code.data();
  }
  return result + "'";
}

std::string quoted(std::string_view text) {
  if (has_control_character(text)) return quoted_control(text);
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.,:=@/";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string_view::npos)
    return std::string(text);
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

std::string command_line(int argc, const char* const* argv) {
  std::string line = "vndf";
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--threads") ++i;  // with its number
    if (word == "--quiet" || word == "--json" || word.starts_with("--threads")) continue;
    line.append(" ").append(quoted(word));
  }
  return line;
}

}  // namespace vndf::tools
