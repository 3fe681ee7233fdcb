// Numbers as text and back.
#include "vndf/support/text.h"

#include <limits>

#include "support/catch.h"

using namespace vndf::support;

TEST_CASE("a finite number reads back as exactly the number whose text it is") {
  for (const double value : {0.0, -1.5, 0.1, 1e300, -5e-324, std::numeric_limits<double>::max()})
    CHECK(finite_number(number_text(value)) == value);
}

TEST_CASE("a text that is no finite number is none") {
  for (const char* text : {"", "x", "1x", "1 ", " 1", "+1", "inf", "-inf", "nan", "1e999", "1e"}) {
    CAPTURE(text);
    CHECK_FALSE(finite_number(text).has_value());
  }
}
