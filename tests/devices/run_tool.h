// Runs a program that a test needs, such as a compiler.
#pragma once

#include <array>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

namespace vndf::test {

/// Returns what the command prints. Throws std::runtime_error with it if the command fails.
inline std::string run_tool(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("no process for: " + command);
  std::string printed;
  std::array<char, 4096> part{};
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe))
    printed.append(part.data(), size);
  if (pclose(pipe) != 0) throw std::runtime_error(command + " failed:\n" + printed);
  return printed;
}

}  // namespace vndf::test
