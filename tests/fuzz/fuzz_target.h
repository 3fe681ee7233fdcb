// A fuzz target takes any bytes as one kind of input from outside. A reader may accept them or
// throw its error; whatever else happens is a defect: a crash, a hang, memory without bound, a
// message that floods a terminal, or accepted input that does not work. Clang's libFuzzer looks for
// such bytes (tools/fuzz.sh). Without it, run_corpus.cpp gives the target the files of its corpus,
// so that every compiler tests what was found once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

/// libFuzzer calls it with each input, which is not kept.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace vndf::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the process if `holds` is false, because a fuzzer looks for inputs that do.
inline void require(bool holds, std::string_view rule) {
  if (holds) return;
  std::cerr << "fuzz target: " << rule << '\n';
  std::abort();
}

/// The most characters of a message: the rule, a line of the input and, where a name is unknown,
/// all that are known, such as 32 parameters of a formula with 32 letters each.
inline constexpr std::size_t kMostMessage = 1500;

/// Requires that a person can read `message`: not empty, not long, nothing that drives a terminal.
inline void require_readable(std::string_view message) {
  const bool short_enough = !message.empty() && message.size() <= kMostMessage;
  const bool printable = std::ranges::all_of(
      message, [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; });
  if (!short_enough || !printable) std::cerr << "the message is: " << message << '\n';
  require(short_enough, "a message is empty or too long");
  require(printable, "a message has control characters");
}

/// Calls `read` and takes an Error of it for an answer, if its message is readable.
template <class Error, class Read>
void accept_or_throw(Read read) {
  try {
    read();
  } catch (const Error& error) {
    require_readable(error.what());
  }
}

}  // namespace vndf::fuzz
