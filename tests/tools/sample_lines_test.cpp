// Lines on standard input of vndf sample that are not what they should be.
#include <string>

#include "support/catch.h"
#include "support/program_folder.h"

using vndf::test::contains;
using vndf::test::FolderWithTables;

TEST_CASE("a line that cannot be sampled is named with its number and the rule") {
  const FolderWithTables folder;
  const std::string good = "0 0 1 1 1 0.5 0.5\n";
  const auto refused = [&](const std::string& line, const std::string& rule) {
    CAPTURE(line.substr(0, 60));
    const auto r = folder.run("sample ggx.h5 --stdin", good + line + "\n" + good);
    CHECK(r.status == 1);
    CHECK_THAT(r.error, contains("standard input, line 2: ") && contains(rule));
    CHECK(r.out.find('\n') == r.out.size() - 1);  // the first line is answered, and only it
  };
  const std::string form = "give seven numbers or ten: wx wy wz ax ay [correlation mean_x mean_y]";
  refused("", form);
  refused("0 0 1 1 1 0.5", form);
  refused("0 0 1 1 1 0.5 0.5 0.5", form);
  refused("0 0 1 1 1 0.5 0.5 0.5 0.5", form);
  refused("0 0 1 1 1 0.5 0.5 0.5 0.5 0.5 0.5", form);
  refused("0 0 1 1 1 0.5 x", form);
  refused("0 0 1 1 1 0.5 nan", "[0, 1]");
  refused("0 0 1 1 1 inf 0.5", "[0, 1]");
  refused("nan 0 1 1 1 0.5 0.5", "finite");
  refused("inf 0 1 1 1 0.5 0.5", "finite");
  refused("0 0 1 inf 1 0.5 0.5", "alpha must be finite");
  refused("0 0 1 1 1 1 0 0 0.5 0.5", "the correlation must be inside (-1, 1)");
  refused("0 0 1 1 1 0 nan 0 0.5 0.5", "the mean slope must be finite");
  refused("0 0 1 1 1 0 1e39 0 0.5 0.5", "beyond single precision; give --double");
  refused("0 0 1 1 1 0.5 1.5", "[0, 1]");
  refused("0 0 1 -1 1 0.5 0.5", "alpha");
  refused(std::string(2000000, '1'), "longer than 1000 bytes");
  refused("0 0 1 1 1 0.5 0.5" + std::string(2000, ' '), "longer than 1000 bytes");
}

TEST_CASE("the last line needs no end") {
  const FolderWithTables folder;
  CHECK(folder.run("sample ggx.h5 --stdin", "0 0 1 1 1 0.5 0.5").status == 0);
  CHECK(folder.run("sample ggx.h5 --stdin", "").status == 0);
}
