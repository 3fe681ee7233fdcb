// Numbers as text in what is exported.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace vndf::devices {

/// What printf() prints, which must be shorter than 512 bytes.
template <class... Values>
std::string printed(const char* format, Values... values) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace vndf::devices
