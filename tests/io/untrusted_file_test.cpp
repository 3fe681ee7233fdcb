// The bytes of a file that nobody vouches for: nothing is read outside of them or again and again,
// and no more is allocated than the file has a right to.
#include "vndf/io/untrusted_file.h"

#include "support/catch.h"
#include "vndf/io/inflate.h"

using namespace vndf::io;
using namespace vndf::test;
using namespace std::string_view_literals;

TEST_CASE("a cursor takes numbers and texts one after the other, and nothing beyond the end") {
  ByteCursor cursor("\x01\x02\x03\x04name\0\x80\x3f"sv);
  CHECK(cursor.number<std::uint16_t>() == 0x201);
  CHECK(cursor.number<std::uint8_t>() == 3);
  CHECK(cursor.take(1) == "\x04");
  CHECK(cursor.text() == "name");
  CHECK(cursor.left() == 2);
  CHECK_THROWS_AS(cursor.number<float>(), FormatError);
  CHECK_THROWS_AS(cursor.take(~std::uint64_t{0}), FormatError);
  CHECK_THROWS_AS(cursor.text(), FormatError);
  CHECK(cursor.left() == 2);
}

TEST_CASE("what is padded to eight bytes must be there with its padding") {
  ByteCursor cursor("12345678901234567"sv);
  CHECK(cursor.take_padded(3) == "123");
  CHECK(cursor.take_padded(8) == "90123456");
  CHECK_THROWS_AS(cursor.take_padded(1), FormatError);
}

TEST_CASE("blocks are inside the file, and all together no larger than it") {
  UntrustedFile file("0123456789"sv);
  CHECK(file.block(2, 3) == "234");
  CHECK(file.block(10, 0).empty());
  CHECK_THROWS_AS(file.block(11, 0), FormatError);
  CHECK_THROWS_AS(UntrustedFile("0123456789"sv).block(8, 3), FormatError);
  CHECK_THROWS_AS(UntrustedFile("0123456789"sv).block(~std::uint64_t{0}, 2), FormatError);
  CHECK(file.block(3, 7) == "3456789");
  CHECK_THROWS_WITH(file.block(0, 1), contains("more than once"));
}

TEST_CASE("arrays are together no larger than 16 MiB and 16 times the file") {
  UntrustedFile file("0123456789"sv);
  CHECK(most_array_bytes(10) == (16u << 20) + 160);
  file.claim(most_array_bytes(10) - 1);
  file.claim(1);
  CHECK_THROWS_WITH(file.claim(1), contains("larger than a file of its size can hold"));
}

TEST_CASE("a stream that inflates to more than it may is refused") {
  // The zlib stream of twelve times "a", by Python's zlib.
  constexpr std::string_view kStream = "\x78\x9c\x4b\x4c\x44\x00\x00\x1d\x9a\x04\x8d"sv;
  CHECK(inflate(kStream, 12) == "aaaaaaaaaaaa");
  CHECK(inflate(kStream, 99).size() == 12);
  CHECK_THROWS_AS(inflate(kStream, 11), FormatError);
  CHECK_THROWS_AS(inflate(kStream.substr(0, 9), 12), FormatError);
  CHECK_THROWS_AS(inflate("", 12), FormatError);
}
