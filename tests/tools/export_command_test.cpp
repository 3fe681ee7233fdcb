// Tables as sources and golden vectors on the command line: written, or refused in words.
#include <algorithm>
#include <string>

#include "support/catch.h"
#include "support/program_folder.h"
#include "vndf/kernel_tables.h"

using vndf::test::contains;
using vndf::test::content;
using vndf::test::Folder;
using vndf::test::Result;

namespace {

/// With a pair of tables, "ggx.h5", and those baked from it, "ggx.vndf".
class FolderWithBoth : public Folder {
 public:
  FolderWithBoth() {
    REQUIRE(run("build ggx -o ggx.h5 --size 64 --quiet").status == 0);
    REQUIRE(run("bake ggx.h5 -o ggx.vndf --tolerance 1e-3 --quiet").status == 0);
  }
};

void check_refusal(const Folder& folder, const std::string& arguments, int status,
                   const std::string& message) {
  INFO(arguments);
  const auto before = folder.files();
  const Result r = folder.run(arguments);
  CHECK(r.status == status);
  CHECK_THAT(r.error, contains(message));
  CHECK(folder.files() == before);
}

}  // namespace

TEST_CASE("export writes a source of each language, which vndf may write again") {
  const FolderWithBoth folder;
  for (const char* form : {"header", "cuda", "glsl", "hlsl", "metal"}) {
    INFO(form);
    const std::string command = std::string("export ggx.vndf -o source --as ") + form;
    const Result r = folder.run(command);
    CHECK(r.status == 0);
    CHECK_THAT(r.out, contains("wrote source, "));
    CHECK_THAT(content(folder / "source"), contains("Visible normals of ggx"));
    CHECK_THAT(content(folder / "source"), contains("vndf_sample_towards"));
  }
}

TEST_CASE("a source for a shading language tells where the bytes of its buffer are") {
  const FolderWithBoth folder;
  CHECK_THAT(folder.run("export ggx.vndf -o a.glsl --as glsl --tables buffer").out,
             contains("the bytes of ggx.vndf"));
  CHECK_THAT(content(folder / "a.glsl"), contains("vndf_ggx(uint first)"));
  CHECK_FALSE(contains("buffer").match(
      folder.run("export ggx.vndf -o a.glsl --as glsl --tables constants").out));
  CHECK_THAT(content(folder / "a.glsl"), contains("vndf_ggx()"));
}

TEST_CASE("export bakes a pair to the tolerance that is asked for") {
  const FolderWithBoth folder;
  REQUIRE(folder.run("export ggx.h5 -o ggx.bin --as bytes --tolerance 1e-3 --quiet").status == 0);
  const vndf::KernelTables bytes = vndf::load(folder / "ggx.bin");
  const vndf::KernelTables baked = vndf::load(folder / "ggx.vndf");
  CHECK(std::ranges::equal(bytes.with_text({}).bytes(), baked.with_text({}).bytes()));
  REQUIRE(folder.run("export ggx.vndf -o same.bin --as bytes --quiet").status == 0);
  CHECK(content(folder / "same.bin") == content(folder / "ggx.vndf"));
}

TEST_CASE("names in the source are that of the file or the one that is given") {
  const FolderWithBoth folder;
  REQUIRE(folder.run("export ggx.vndf -o a.h --as header --name rough_metal --quiet").status == 0);
  CHECK_THAT(content(folder / "a.h"), contains("Kernel rough_metal_kernel()"));
  REQUIRE(folder.run("convert ggx.vndf student-t.2.vndf").status == 0);
  REQUIRE(folder.run("export student-t.2.vndf -o a.h --as header --quiet").status == 0);
  CHECK_THAT(content(folder / "a.h"), contains("Kernel student_t_2_kernel()"));
}

TEST_CASE("golden vectors are as many lines as are asked for, behind their explanation") {
  const FolderWithBoth folder;
  REQUIRE(folder.run("export ggx.vndf -o v.csv --vectors 37 --quiet").status == 0);
  const std::string text = content(folder / "v.csv");
  CHECK(text.starts_with("# Golden vectors of the kernel of ggx, exported by vndf "));
  const auto header = text.find("wi_x,");
  CHECK(std::ranges::count(text.substr(header), '\n') == 38);
}

TEST_CASE("what export cannot do is refused, and nothing is written") {
  const FolderWithBoth folder;
  check_refusal(folder, "export ggx.vndf -o a.h", 2, "--as");
  check_refusal(folder, "export ggx.vndf -o a.h --as fortran", 2, "fortran");
  check_refusal(folder, "export ggx.vndf -o a.h --as header --vectors 3", 2, "--as");
  check_refusal(folder, "export ggx.vndf -o a.h --vectors 0", 2, "--vectors");
  check_refusal(folder, "export ggx.vndf -o a.h --as header --tables buffer", 2, "--tables");
  check_refusal(folder, "export ggx.vndf -o a.h --as header --name 2x", 2, "'2x'");
  check_refusal(folder, "export ggx.vndf -o a.bin --as bytes --name x", 2, "--name");
  check_refusal(folder, "export ggx.vndf -o a.csv --vectors 3 --name x", 2, "--name");
  check_refusal(folder, "export ggx.vndf -o a.h --as header --tolerance 1e-3", 2,
                "is baked already");
  check_refusal(folder, "export ggx.vndf -o a.h --as header --max-bytes 100000", 2,
                "is baked already");
  check_refusal(folder, "export ggx.h5 -o a.h --as header --max-bytes 100", 1, "bytes");
  check_refusal(folder, "export 2x.h5 -o a.h --as header", 2, "'2x'");  // before it is read
  check_refusal(folder, "export none.vndf -o a.h --as header", 1, "none.vndf");
  check_refusal(folder, "export ggx.vndf -o none/a.h --as header", 1, "none");
  check_refusal(folder, "export ggx.vndf -o ggx.vndf --as bytes", 1, "it is also read");
}
