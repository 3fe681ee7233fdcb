// The sampler that renderers run: Algorithm 4 of Heitz and d'Eon 2014 over baked tables. A sample
// takes two square roots, two divisions and two or three lookups, whatever the distribution is.
//
// C++, CUDA and GLSL share this text, so that no second copy of it can drift. It is written in the
// subset that they have in common, without pointers, containers, templates and recursion, over the
// names of kernel_language.h. Nothing in it allocates, throws or sets errno. Include this file, or
// paste its parts in their order into a language that includes nothing.
//
// Slopes are in units of U, which was chosen when the tables were baked, and in the bounded form of
// table_coordinates.h, sigma = tau / (1 + tau), tau = x + sqrt(1 + x^2), so that
//
//   x = (sigma - 1/2) / d,   sqrt(1 + x^2) = (1/2 - d) / d,   d = sigma (1 - sigma).
//
// Tables are cells of cubics, small where a table bends. Every axis is a positive float, the place,
// whose leading bits, exponent and some of the mantissa, are the key of an entry in a guide. The
// entry says where the cell begins and where its coefficients are, so that no search is needed. The
// axes are
//
//   incidence   g + an offset, where g = 1 / (1 + c), c = cot(theta) in units of U. g is 0 at the
//               pole and 1 at grazing. Below the horizon g = 1 / (1 - c), on an axis of its own.
//   u1          p = q below one half, and a power of two times p above it, which keeps the halves
//               apart, where q = min(u1, 1 - u1): both ends keep their full relative precision.
//               Where tables are to be small p = sqrt(2 q) + an offset instead, for slope x is
//               smooth in it towards c.
//   u2          p, because the distribution is symmetric in slope y, whose sign is that of
//               u2 - 1/2. Where rows of y are needed too, the half of the axis near u2 = 1/2 is
//               mirrored and again a power of two larger, because slope y may be steep there if its
//               density is hollow or pointed.
//   slope x     |s - s0| + an offset, where s is what the marginal holds and s0 that of x = 0; a
//               power of two larger above s0.
//
// The tables hold one of two things. Where slope y over its scale does not depend on x, as for
// Beckmann and Student-T slopes, GGX among them, the tables are separable: a cell of the marginal
// is a patch of 4 x 4 coefficients, cubic in u1 and in g, of the root of sigma, which bends less
// than sigma where the tail is heavy; a cell of the conditional is a cubic in u2 of -|y| over the
// scale. For any other distribution a cell of the marginal is a patch of s, in which the
// distribution is smooth too; the pair's map, a cubic of s, gives the root of sigma; and a cell of
// the conditional is a patch in u2 and in s.
//
// Directions below the horizon see only steep slopes, far in the tail, which neither s nor the rows
// of y over s tell apart. So a cell of their marginal is a patch of the root of sigma over that of
// g, whatever the distribution, and their rows of y are over the root.
//
// In memory the four coefficients of a cubic are (c0, c2, c1, c3), because two lanes at a time are
// then added.

#include "vndf/kernel_text/tables.h"

#include "vndf/kernel_text/sample.h"

#include "vndf/kernel_text/map.h"

#include "vndf/kernel_text/evaluate.h"
