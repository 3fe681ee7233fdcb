// The error of code that works on bytes and does not know in which file they are. load() and save()
// catch it and add the name of the file.
#pragma once

#include <stdexcept>
#include <string>

namespace vndf::io {

/// The message is one sentence: the rule that is broken, and what to do about it.
class FormatError : public std::runtime_error {
 public:
  FormatError(const std::string& rule, const std::string& remedy)
      : std::runtime_error(rule + "; " + remedy) {}

  /// `error` with the name of the array that it is about.
  static FormatError about_array(const std::string& name, const FormatError& error) {
    return FormatError("the array '" + name + "': " + error.what());
  }

 private:
  explicit FormatError(const std::string& sentence) : std::runtime_error(sentence) {}
};

/// Returns what `read` returns. Adds the name of the array to a FormatError that it throws.
template <class Read>
auto about_array(const std::string& name, const Read& read) {
  try {
    return read();
  } catch (const FormatError& error) {
    throw FormatError::about_array(name, error);
  }
}

}  // namespace vndf::io
