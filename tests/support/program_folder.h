// The program as a person or a script meets it, run in a folder of its own.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/temporary_folder.h"

namespace vndf::test {

struct Result {
  int status;
  std::string out, error;
};

/// A temporary folder, and the program run inside it.
class Folder : public TemporaryFolder {
 public:
  /// Where nothing can be printed.
  Result run_on_full_disk(const std::string& arguments) const {
    return run_to("/dev/full", path(), arguments, "");
  }

  Result run(const std::string& arguments, const std::string& input = "") const {
    return run_to("", path(), arguments, input);
  }

  /// With another working directory, one inside this folder.
  Result run_in(const std::string& subfolder, const std::string& arguments) const {
    return run_to("", path() / subfolder, arguments, "");
  }

  /// Names of the files inside.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path()))
      names.push_back(entry.path().filename());
    return names;
  }

 private:
  /// Standard output goes to `place`, or to the result where that is empty.
  Result run_to(const std::string& place, const std::filesystem::path& directory,
                const std::string& arguments, const std::string& input) const {
    const std::filesystem::path streams = path().string() + "-streams";
    std::filesystem::create_directories(streams);
    std::ofstream(streams / "in") << input;
    const std::string command = "cd " + directory.string() + " && " VNDF_PROGRAM " " + arguments +
                                " <" + (streams / "in").string() + " >" +
                                (place.empty() ? (streams / "out").string() : place) + " 2>" +
                                (streams / "error").string();
    const int status = std::system(command.c_str());
    const Result result{WEXITSTATUS(status), content(streams / "out"), content(streams / "error")};
    std::filesystem::remove_all(streams);
    return result;
  }
};

/// A folder with a small table file, "ggx.h5".
class FolderWithTables : public Folder {
 public:
  FolderWithTables() { REQUIRE(run("build ggx -o ggx.h5 --size 32x48 --quiet").status == 0); }
};

}  // namespace vndf::test
