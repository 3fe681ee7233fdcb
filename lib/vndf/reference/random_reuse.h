// Lets one random number make a choice and then serve again: within the interval that it chose it
// is uniform (Heitz and d'Eon 2014, supplemental 1, section 2).
#pragma once

#include <algorithm>

namespace vndf {

/// The position of `u` within [begin, end] as a number in [0, 1]; 0 where the interval is empty.
template <class T>
T renormalised(T u, T begin, T end) {
  return end > begin ? std::clamp((u - begin) / (end - begin), T(0), T(1)) : T(0);
}

}  // namespace vndf
