// Meshes from OBJ text: what is read, what is made where the text says nothing, and every reason to
// refuse a file.
#include "render/mesh_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.h"
#include "vndf/io/format_error.h"

using namespace vndf;
using namespace vndf::render;
using vndf::test::Approx;
using vndf::test::contains;

namespace {

using Triangle = std::array<std::uint32_t, 3>;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Mesh mesh(const std::string& text) {
  return mesh_of(parse_obj(text));
}

void check_vector(const Vector& v, const Vector& expected) {
  CHECK(v.x == Approx(expected.x).margin(1e-6));
  CHECK(v.y == Approx(expected.y).margin(1e-6));
  CHECK(v.z == Approx(expected.z).margin(1e-6));
}

void check_refused(const std::string& text, const std::string& why) {
  CHECK_THROWS_AS(mesh(text), io::FormatError);
  CHECK_THROWS_WITH(mesh(text), contains(why) && contains("; "));
}

struct TemporaryFile {
  std::filesystem::path path = std::filesystem::temp_directory_path() / "vndf-mesh-file-test.obj";
  ~TemporaryFile() { std::filesystem::remove(path); }
};

}  // namespace

TEST_CASE("positions and faces are read, and faces become fans") {
  const Mesh m = mesh(kSquare + "f 1 2 3 4\n");
  REQUIRE(m.positions.size() == 4);
  check_vector(m.positions[2], {1, 1, 0});
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(mesh("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5").triangles ==
        std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
}

TEST_CASE("a concave face of four corners is cut at its inner corner, wherever that is") {
  // An arrowhead that points along x; its inner corner is the fourth.
  const std::string arrow = "v 0 -1 0\nv 2 0 0\nv 0 1 0\nv 0.5 0 0\n";
  for (const std::string face : {"f 1 2 3 4", "f 2 3 4 1", "f 3 4 1 2", "f 4 1 2 3"}) {
    const Mesh m = mesh(arrow + face);
    REQUIRE(m.triangles.size() == 2);
    for (const Vector& normal : m.normals) check_vector(normal, {0, 0, 1});
  }
}

TEST_CASE("faces that no fan fills are refused with their line") {
  const std::string comb = "v 0 0 0\nv 1 3 0\nv 2 0 0\nv 3 3 0\nv 4 0 0\nv 4 -1 0\nv 0 -1 0\n";
  check_refused(comb + "f 7 6 5 4 3 2 1\n", "line 8: the face is not convex; triangulate the mesh");
}

TEST_CASE("corners on a straight side may be rounded") {
  // From either of the first two corners a triangle of the fan looks back.
  const std::string text = kSquare + "v 0.3 1e-6 0\nv 0.6 1.1e-6 0\nf 1 5 6 2 3 4\n";
  CHECK(mesh(text).triangles.size() == 4);
}

TEST_CASE("indices count from 1, or back from the last") {
  const Mesh m = mesh(kSquare + "f -4 -3 -2\nv 5 0 0\nf -1 2 3\n");
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}, {3, 1, 2}});
  check_vector(m.positions[3], {5, 0, 0});
}

TEST_CASE("blanks, comments, line ends of Windows and further numbers do not matter") {
  const Mesh m = mesh(
      "# a mesh\r\n\r\n  v\t0 0 0 1\r\nv +1 -0 0e0 0.5 0.5 0.5 # red\r\nv 1 1. 0\r\n"
      "f 1/ 2// 3#\r\n");
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}});
  check_vector(m.positions[1], {1, 0, 0});
}

TEST_CASE("other statements are passed over, and no other file is read") {
  const Mesh m = mesh("mtllib /dev/stdin\no name\ng a b\ns off\nusemtl m\nvp 1 nan\n" + kSquare +
                      "l 1 2\np 1\nt a 900000000/0/0\nf 1 2 3\ncall other.obj\n");
  CHECK(m.triangles.size() == 1);
}

TEST_CASE("normals of the file are made unit vectors, and corners that differ are not joined") {
  const Mesh m = mesh(kSquare + "vn 0 0 5\nvn 0 3 4\nf 1//1 2//1 3//1\nf 1//1 3//2 4//2\n");
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 3, 4}});
  check_vector(m.normals[2], {0, 0, 1});
  check_vector(m.normals[3], {0, 0.6f, 0.8f});
  check_vector(m.positions[3], m.positions[2]);
}

TEST_CASE("missing normals are the averages of triangles at a position, weighted by area") {
  // Areas 0.5 and 1, seen along z and along x.
  const Mesh m = mesh("v 0 0 0\nv -1 0 0\nv 0 -1 0\nv 0 0 -2\nf 1 2 3\nf 1 3 4\n");
  const float size = std::sqrt(5.0f);
  check_vector(m.normals[0], {2 / size, 0, 1 / size});
  check_vector(m.normals[1], {0, 0, 1});
  check_vector(m.normals[3], {1, 0, 0});
}

TEST_CASE("normals are averaged over texture seams") {
  const Mesh m = mesh(
      "v 0 0 0\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\nvt 0 0\nvt 1 0\nvt 0 1\nvt 5 5\n"
      "f 1/1 2/2 3/3\nf 1/4 3/1 4/2\n");
  REQUIRE(m.positions.size() == 6);
  check_vector(m.normals[0], m.normals[3]);
}

TEST_CASE("tangents run along the first texture coordinate") {
  const std::string corners = "f 1/1 2/2 3/3\n";
  check_vector(mesh(kSquare + "vt 0 0\nvt 1 0\nvt 1 1\n" + corners).tangents[0], {1, 0, 0});
  check_vector(mesh(kSquare + "vt 0 0\nvt 0 1\nvt 1 1\n" + corners).tangents[1], {0, 1, 0});
  check_vector(mesh(kSquare + "vt 0 0\nvt -1 0\nvt -1 1\n" + corners).tangents[2], {-1, 0, 0});
  const Mesh slanted = mesh("v 0 0 0\nv 3 0 4\nv 0 1 0\nvt 0\nvt 1\nvt 0 1\n" + corners);
  check_vector(slanted.tangents[0], {0.6f, 0, 0.8f});
}

TEST_CASE("tangents are horizontal where there is no usable texture coordinate") {
  check_vector(mesh(kSquare + "f 1 2 3\n").tangents[0], {1, 0, 0});
  check_vector(mesh(kSquare + "f 3 2 1\n").tangents[0], {1, 0, 0});
  const std::string wall = "v 0 0 0\nv 0 0 1\nv 0 1 0\n";  // seen along -x
  check_vector(mesh(wall + "f 1 2 3\n").tangents[0], {0, -1, 0});
  check_vector(mesh(wall + "vt 0 0\nvt 1 1\nf 1/1 2/2 3/2\n").tangents[0], {0, -1, 0});
  // The texture runs along z, and so does this normal.
  const std::string along = "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n";
  check_vector(mesh(wall + along).tangents[0], {1, 0, 0});
}

TEST_CASE("triangles without area are left out, and their vertices too") {
  const Mesh m = mesh(kSquare + "v 0.5 0 0\nv 0.5 1e-8 0\nf 1 5 2\nf 1 1 2\nf 1 6 2\nf 1 2 3\n");
  CHECK(m.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(m.positions.size() == 3);
  CHECK(mesh("v 0 0 0\nv 1 0 0\nv 0.5 1e-6 0\nf 1 2 3\n").triangles.size() == 1);
}

TEST_CASE("meshes at both ends of the range of sizes are whole") {
  for (const std::string size : {"1e9", "2e-9"}) {
    const Mesh m = mesh("v 0 0 0\nv " + size + " 0 0\nv 0 " + size +
                        " 0\nvt 0 0\nvt 1e9 0\nvt 0 1e-38\nf 1/1 2/2 3/3\n");
    check_vector(m.normals[0], {0, 0, 1});
    check_vector(m.tangents[0], {1, 0, 0});
  }
  check_refused("v 0 0 0\nv 5e-10 0 0\nv 0 5e-10 0\nf 1 2 3\n", "all of it is within 1e-9");
}

TEST_CASE("numbers that are none are refused with their line") {
  for (const std::string word : {"nan", "inf", "-inf", "1e999", "abc", "0x10", "1,5", "--1"})
    check_refused("v 0 0 0\nv 0 " + word + " 0\n", "line 2: '" + word + "' is not a finite number");
  check_refused(kSquare + "v 1 2\n", "line 5: it has fewer numbers than it needs");
  check_refused("v 0 0 1.1e9\n", "line 1: '1.1e9' is more than 1e+09; scale the mesh down");
  check_refused("vt\n", "line 1: it has fewer numbers");
  check_refused("vt 0 x\n", "line 1: 'x' is not a finite number");
  check_refused("vn 0 0 nan\n", "line 1: 'nan' is not a finite number");
  check_refused("vn 0 -0 0\n", "line 1: the normal has no length");
  check_refused(std::string("v 0 0 0\0\n", 9), "line 1: '0?' is not a finite number");
}

TEST_CASE("indices of nothing are refused with their line") {
  check_refused(kSquare + "f 1 2 5\n", "line 5: the index 5 is not one of the 4 above it");
  check_refused(kSquare + "f 1 2 -5\n", "line 5: the index -5 is not one of the 4 above it");
  check_refused(kSquare + "f 0 1 2\n", "line 5: the index 0 is not one");
  check_refused("f 1 2 3\n" + kSquare, "line 1: the index 1 is not one of the 0 above it");
  check_refused(kSquare + "f 1/1 2 3\n", "line 5: the index 1 is not one of the 0 above it");
  check_refused(kSquare + "f 1//1 2 3\n", "line 5: the index 1 is not one of the 0 above it");
  for (const std::string index : {"99999999999999999999", "1.5", "a", "+1", "\\"})
    check_refused(kSquare + "f 1 2 " + index + "\n", "line 5: '" + index + "' is not an index");
  check_refused(kSquare + "f 1 2 /3\n", "line 5: '' is not an index");
  check_refused(kSquare + "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n",
                "line 7: '1/1/1/1' has more than three indices");
  check_refused(kSquare + "f 1 2\n", "line 5: a face has three corners or more");
}

TEST_CASE("a mesh without a triangle is refused") {
  for (const std::string& text :
       {std::string(), kSquare, kSquare + "f 1 1 2\n", std::string("solid stl\nfacet\n")})
    check_refused(text, "it has no triangles with an area; give a Wavefront OBJ file");
}

TEST_CASE("files that cannot be read are refused by name") {
  CHECK_THROWS_WITH(read_obj("no-such.obj"), "no-such.obj: there is no such file; check the path");
  CHECK_THROWS_WITH(read_obj("."), contains(".: it is not a file; "));
  const TemporaryFile file;
  std::ofstream(file.path) << kSquare << "f 1 2 x\n";
  CHECK_THROWS_AS(read_obj(file.path), std::runtime_error);
  CHECK_THROWS_WITH(read_obj(file.path),
                    contains("vndf-mesh-file-test.obj: line 5: 'x' is not an index; "));
  std::ofstream(file.path) << kSquare << "f 1 2 3\n";
  CHECK(read_obj(file.path).triangles.size() == 1);
  std::filesystem::resize_file(file.path, (std::uintmax_t{512} << 20) + 1);
  CHECK_THROWS_WITH(read_obj(file.path), contains("it has more than 512 MiB; "));
}
