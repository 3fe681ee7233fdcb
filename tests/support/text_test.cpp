// Numbers as text and back.
#include "vndf/support/text.h"

#include <limits>
#include <string>

#include "support/catch.h"

using namespace vndf::support;
using namespace vndf::test;

TEST_CASE("a finite number reads back as exactly the number whose text it is") {
  for (const double value : {0.0, -1.5, 0.1, 1e300, -5e-324, std::numeric_limits<double>::max()})
    CHECK(finite_number(number_text(value)) == value);
}

TEST_CASE("a quoted text has at most 60 bytes, all printable, around the place that it is about") {
  const auto times = [](std::size_t count, char c) { return std::string(count, c); };
  CHECK(quoted("plain") == "'plain'");
  CHECK(quoted("").size() == 2);
  CHECK(quoted(times(60, 'a')).size() == 62);
  CHECK_THAT(quoted(times(61, 'a')), contains(times(60, 'a') + "...'") && !contains("'..."));
  CHECK_THAT(quoted("a\x1b[31m\n\t\x7f\xc3\xa4"), contains("'a?[31m" + times(5, '?') + "'"));
  const std::string middle = times(100, 'a') + "X" + times(100, 'b');
  CHECK_THAT(quoted(middle, 100),
             contains("'..." + times(30, 'a') + "X" + times(29, 'b') + "...'"));
  CHECK_THAT(quoted(middle, 200), contains("'..." + times(60, 'b') + "'"));
  CHECK(quoted(middle, 1000) == quoted(middle, 200));
}

TEST_CASE("a printable text keeps the characters of UTF-8 and escapes what drives a terminal") {
  CHECK(printable("σ = 1, 'plain' \\") == "σ = 1, 'plain' \\");
  CHECK(printable("a\x1b]0;b\x07\r\n\tc\x7f") == "a\\x1b]0;b\\x07\\x0d\\n\\x09c\\x7f");
  CHECK(printable("\xc2\x9b"
                  "31m") == "\\xc2\\x9b31m");  // CSI of C1
  CHECK(printable("\xc2\xa0\xed\x9f\xbf\xf4\x8f\xbf\xbf") ==
        "\xc2\xa0\xed\x9f\xbf\xf4\x8f\xbf\xbf");
}

TEST_CASE("bytes that are not UTF-8 are escaped one by one") {
  for (const std::string wrong :
       {"\x80", "\xff", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf0\x80\x80\xaf",
        "\xf4\x90\x80\x80", "\xe2\x82", "\xf5\x80\x80\x80"}) {
    CAPTURE(wrong.size());
    const std::string shown = printable(wrong);
    CHECK(shown.size() == 4 * wrong.size());
    CHECK(shown.find_first_not_of("\\xabcdef0123456789") == std::string::npos);
  }
}

TEST_CASE("a printable text that is too long is cut between characters") {
  CHECK(printable("abcdef", 6) == "abcdef");
  CHECK(printable("abcdefg", 6) == "abcdef...");
  CHECK(printable("aσσ", 4) == "aσ...");
  CHECK(printable("ab\x1b", 4) == "ab...");
}

TEST_CASE("a text that is no finite number is none") {
  for (const char* text : {"", "x", "1x", "1 ", " 1", "+1", "inf", "-inf", "nan", "1e999", "1e"}) {
    CAPTURE(text);
    CHECK_FALSE(finite_number(text).has_value());
  }
}
