// The kernel in a shading language. The text is the one that C++ compiles (vndf/kernel_text.h); a
// translation only writes some of its words as the language spells them. Languages without
// namespaces get names that begin with vndf_, so that none of them meets one of a renderer.
#pragma once

#include <string>
#include <string_view>

namespace vndf::devices {

enum class ShadingLanguage {
  glsl,   ///< GLSL 4.50 and GLSL ES 3.00
  hlsl,   ///< shader model 5 and later
  metal,  ///< Metal 2 and later
};

/// All functions of the kernel and the names that they are written in, in `language`. GLSL and HLSL
/// read the k-th word of 16 bytes of the tables by VNDF_WORD(k), which must be defined before.
/// Metal reads them through a pointer into the address space VNDF_ADDRESS.
std::string kernel_in(ShadingLanguage language);

/// `text`, written in the words of the kernel, in `language`.
std::string translate(std::string_view text, ShadingLanguage language);

}  // namespace vndf::devices
