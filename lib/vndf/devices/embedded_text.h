// The text of the kernel and of the headers around it, which the program carries so that it can
// write them into other people's renderers.
#pragma once

#include <string_view>

namespace vndf::devices {

/// The text of a header of the runtime, such as "vndf/kernel.h". Throws std::logic_error for one
/// that is not embedded.
std::string_view embedded_text(std::string_view header);

}  // namespace vndf::devices
