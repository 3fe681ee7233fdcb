// Whether all that a page says is so: its commands run and print what it shows, its programs are
// those that the tests compile, and what it links to exists.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vndf::documentation {

struct Surroundings {
  std::filesystem::path source;   // the top of the repository
  std::filesystem::path scratch;  // an empty folder in which the commands run
  std::filesystem::path program;  // vndf, on the path of the commands
};

/// What is wrong with a page, one line each, with its line number. `folder` is that of the page,
/// from which its links start.
std::vector<std::string> problems_of(const std::string& text, const std::filesystem::path& folder,
                                     const Surroundings& surroundings);

}  // namespace vndf::documentation
