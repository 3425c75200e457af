// The lobes of an array of cases.
#define BURNISH_EXACT
#include "burnish.hlsl"
#include "values.glsl"
struct Case {
    float cosine, zeta, n;
    int number;
};
[[vk::binding(0)]] StructuredBuffer<Case> cases;
[[vk::binding(1)]] RWStructuredBuffer<float> values;

[numthreads(64, 1, 1)]
void main(uint3 at : SV_DispatchThreadID) {
    Case one = cases[at.x];
    values[at.x] = lobeByNumber(one.number, one.cosine, one.zeta, one.n);
}
