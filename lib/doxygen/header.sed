# The comment at the head of a header documents the file, so that the HTML pages show it too. No line
# is added, so that the warnings of Doxygen name the right one.
1,/^#pragma once/ {
  s|^//|///|
  s|^#pragma once|/// \\file|
}
