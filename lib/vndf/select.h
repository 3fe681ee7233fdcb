// The smaller and the larger of two numbers, by value. std::min and std::max work on references,
// from which compilers make jumps that random numbers mispredict; these become one instruction.
// Where one argument is not a number, both return the second.
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
