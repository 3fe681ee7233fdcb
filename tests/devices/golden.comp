#version 450
#extension GL_GOOGLE_include_directive : require
// Every function of the kernel at golden inputs, by Vulkan. The test writes "tables.h": an exported
// source, VNDF_WORD before it where it reads a buffer, and after it TABLES, the call that gives its
// tables.

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Tables { uvec4 words[]; };
layout(std430, binding = 1) readonly buffer Inputs { float inputs[]; };
layout(std430, binding = 2) writeonly buffer Outputs { float outputs[]; };

#include "tables.h"
#include "every_function.h"

vec3 input3(uint k) {
  return vec3(inputs[k], inputs[k + 1u], inputs[k + 2u]);
}
vec2 input2(uint k) {
  return vec2(inputs[k], inputs[k + 1u]);
}

void main() {
  uint from = gl_GlobalInvocationID.x * 10u, to = gl_GlobalInvocationID.x * 11u;
  GoldenOutput o = every_function(TABLES, input3(from), input2(from + 3u), input2(from + 5u),
                                  input3(from + 7u));
  outputs[to] = o.wm.x;
  outputs[to + 1u] = o.wm.y;
  outputs[to + 2u] = o.wm.z;
  outputs[to + 3u] = o.density;
  outputs[to + 4u] = o.d;
  outputs[to + 5u] = o.pdf;
  outputs[to + 6u] = o.lambda;
  outputs[to + 7u] = o.g1;
  outputs[to + 8u] = o.u1;
  outputs[to + 9u] = o.u2;
  outputs[to + 10u] = o.found;
}
