// A sky to light scenes with. Its formula is our own and no model of the atmosphere: it is made to
// show surfaces well, and to have both a large light and a small one.
#pragma once

#include "render/image.h"

namespace vndf::render {

/// An image for Environment, 1024 x 512. The sky is blue and brighter towards the horizon, and the
/// ground is a dim grey-brown. The sun is warm, 40 degrees high, at the azimuth of 220 degrees from
/// the x axis, which is in front on the left of what a camera sees that looks along y. It is even
/// up to 1.5 degrees from its middle and ends at 4.5 degrees. Its irradiance on the ground is 3
/// times that of the rest of the sky within 2 %. The mean luminance of the whole is 0.62 within 5
/// %; a ground of albedo 0.35 is then a middle grey, and gold is not as bright as to look pale.
Image sky_image();

}  // namespace vndf::render
