// One C++ text of a header and all that it includes of vndf, so that a renderer needs neither our
// headers nor their folders.
#pragma once

#include <string>
#include <string_view>

namespace vndf::devices {

/// The text of the runtime's `header` with each header of vndf in the place where it is included
/// first. The headers of the standard library, which are all that is left to include, come first,
/// in alphabetical order, but those that only some compilers have stay where they are.
std::string amalgamate(std::string_view header);

}  // namespace vndf::devices
