// The light of one line of lobe/test/data/area.csv: what tests compare with its last two columns.
// The C++ stand-ins of GLSL, HLSL, Metal and OSL all read it.
vec2 areaLight(int shape, int sides, int order, float zeta, vec3 center, vec3 halfU, vec3 halfV, vec3 N, vec3 R) {
    if (shape == 2) { return burnishRectLightGgx(center, halfU, halfV, sides, N, R, zeta); }
    if (shape == 1) { return burnishDiscLight(center, halfU, halfV, sides, N, R, zeta, order); }
    return burnishRectLight(center, halfU, halfV, sides, N, R, zeta, order);
}
