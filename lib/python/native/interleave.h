// Numbers that lie side by side in memory, two or three for each sample, as columns and back, with
// the widest vectors of the processor (Google Highway). Without this the change between the two
// layouts takes three times as long as sampling.
#pragma once

#include <cstddef>

namespace vndf::python {

/// Split `count` pairs or triples.
void split_pairs(const float* numbers, std::size_t count, float* x, float* y);
void split_triples(const float* numbers, std::size_t count, float* x, float* y, float* z);
/// Joins columns to `count` triples.
void join_triples(const float* x, const float* y, const float* z, std::size_t count,
                  float* numbers);

}  // namespace vndf::python
