// An image of radiance as a file: as it is, for programs, or as a picture for people.
#pragma once

#include <map>
#include <string>

#include "render/image.h"

namespace vndf::render {

/// The radiance in the channels R, G and B of an EXR file, with `attributes` and the mark of vndf
/// (picture_mark.h). The same image gives the same bytes. Throws io::FormatError if the image is
/// empty.
std::string exr_bytes(const Image& image, const std::map<std::string, std::string>& attributes);

/// The colour in [0, 1] that a screen shows for the radiance `c`. Colours of which the largest
/// channel is at most 0.8 are left as they are, so a grey of 0.5 is a grey of 0.5. Of brighter ones
/// the largest channel approaches 1, and they become pale the more it is reduced, as bright things
/// look on film. Channels that are negative or not a number count as 0.
///
/// This is the curve of the Khronos PBR Neutral tone mapper (Khronos Group 2024) without its first
/// step, which takes 0.04 from every colour for the light that plastics reflect.
Rgb tone_mapped(const Rgb& c);

/// An 8-bit PNG file of tone_mapped(`exposure` * radiance) with the transfer function of sRGB (IEC
/// 61966-2-1) and the mark of vndf. `exposure` is finite and > 0. Throws io::FormatError if the
/// image is empty or libpng fails.
std::string png_bytes(const Image& image, float exposure);

}  // namespace vndf::render
