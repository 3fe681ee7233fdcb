// The smaller and the larger of two numbers, by value. Of std::min and std::max, which work on
// references, compilers make jumps that random numbers mispredict; of these they make one
// instruction. If one argument is not a number, both return the second.
#pragma once

namespace vndf {

template <class T>
constexpr T smaller(T a, T b) {
  return a < b ? a : b;
}

template <class T>
constexpr T larger(T a, T b) {
  return a > b ? a : b;
}

}  // namespace vndf
