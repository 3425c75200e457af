// The light of the lines of lobe/test/data/area.csv.
#define vec2 float2
#define vec3 float3
#include "burnish.hlsl"
#include "area.glsl"
[[vk::binding(0)]] StructuredBuffer<float> cases;
[[vk::binding(1)]] RWStructuredBuffer<float2> values;

float3 at(uint i) { return float3(cases[i], cases[i + 1], cases[i + 2]); }

[numthreads(64, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = thread.x * 21;
    values[thread.x] = areaLight(int(cases[i]), int(cases[i + 1]), int(cases[i + 2]), cases[i + 3], at(i + 4), at(i + 7), at(i + 10), at(i + 13), at(i + 16));
}
