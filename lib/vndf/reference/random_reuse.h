// A random number that has made a choice is uniform again within the interval that it chose (Heitz
// and d'Eon 2014, supplemental 1, section 2).
#pragma once

#include <algorithm>

namespace vndf {

/// `u` in [begin, end] as a number in [0, 1]; 0 where the interval is empty.
template <class T>
T renormalised(T u, T begin, T end) {
  return end > begin ? std::clamp((u - begin) / (end - begin), T(0), T(1)) : T(0);
}

}  // namespace vndf
