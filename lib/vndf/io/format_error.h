// Why some bytes are not a table file. Thrown by the code that judges bytes and does not know where
// they came from; load() and save() add the name of the file.
#pragma once

#include <stdexcept>
#include <string>

namespace vndf::io {

/// The rule that is broken and what to do about it, as one sentence.
class Refusal : public std::runtime_error {
 public:
  Refusal(const std::string& rule, const std::string& remedy)
      : std::runtime_error(rule + "; " + remedy) {}
};

}  // namespace vndf::io
