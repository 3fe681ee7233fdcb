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
};

}  // namespace vndf::io
