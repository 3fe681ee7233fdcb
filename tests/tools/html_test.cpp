// Parts of pages.
#include "report/html.h"

#include "support/catch.h"

using namespace vndf::tools;
using vndf::test::contains;

TEST_CASE("text of any kind stands in HTML as it is read") {
  CHECK(escaped("a<b> & \"c\" 'd'") == "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
  CHECK(escaped("plain, α") == "plain, α");
}

// The examples of RFC 4648, section 10.
TEST_CASE("the address of a picture has its bytes in base 64") {
  const std::string start = "data:image/png;base64,";
  CHECK(png_address("") == start);
  CHECK(png_address("f") == start + "Zg==");
  CHECK(png_address("fo") == start + "Zm8=");
  CHECK(png_address("foo") == start + "Zm9v");
  CHECK(png_address("foob") == start + "Zm9vYg==");
  CHECK(png_address("fooba") == start + "Zm9vYmE=");
  CHECK(png_address("foobar") == start + "Zm9vYmFy");
  CHECK(png_address(std::string("\0\xff\x7f", 3)) == start + "AP9/");
}

TEST_CASE("a page has its title, its style and its body once, and tells phones its width") {
  const std::string page = html_text({"a & b", "i { color: red; }", "<p>body</p>\n"});
  CHECK_THAT(page, contains("<title>a &amp; b</title>") &&
                       contains("<h1>a &amp; b</h1>\n<p>body</p>\n</body>"));
  CHECK_THAT(page, contains("i { color: red; }</style>"));
  CHECK_THAT(page, contains("<meta name=\"viewport\" content=\"width=device-width"));
}
