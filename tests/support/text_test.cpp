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

TEST_CASE("a text that is no finite number is none") {
  for (const char* text : {"", "x", "1x", "1 ", " 1", "+1", "inf", "-inf", "nan", "1e999", "1e"}) {
    CAPTURE(text);
    CHECK_FALSE(finite_number(text).has_value());
  }
}
