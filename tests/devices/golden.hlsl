// Every function of the kernel at golden inputs, in HLSL; see golden.comp.

StructuredBuffer<uint4> words : register(t0);
StructuredBuffer<float> inputs : register(t1);
RWStructuredBuffer<float> outputs : register(u2);

#include "tables.h"
#define vec3 float3
#define vec2 float2
#include "every_function.h"

float3 input3(uint k) {
  return float3(inputs[k], inputs[k + 1], inputs[k + 2]);
}
float2 input2(uint k) {
  return float2(inputs[k], inputs[k + 1]);
}

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  uint from = id.x * 10, to = id.x * 11;
  GoldenOutput o = every_function(TABLES, input3(from), input2(from + 3), input2(from + 5),
                                  input3(from + 7));
  outputs[to] = o.wm.x;
  outputs[to + 1] = o.wm.y;
  outputs[to + 2] = o.wm.z;
  outputs[to + 3] = o.density;
  outputs[to + 4] = o.d;
  outputs[to + 5] = o.pdf;
  outputs[to + 6] = o.lambda;
  outputs[to + 7] = o.g1;
  outputs[to + 8] = o.u1;
  outputs[to + 9] = o.u2;
  outputs[to + 10] = o.found;
}
