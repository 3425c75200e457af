// Every lobe of the shaders at one cosine, by number: what tests compare with burnish/lobe.h.
// The C++ stand-ins of GLSL, HLSL, Metal and OSL all read it.
float lobeByNumber(int number, float cosine, float zeta, float n) {
    if (number == 0) { return burnishLobe2(cosine, zeta); }
    if (number == 1) { return burnishLobe4(cosine, zeta); }
    if (number == 2) { return burnishLobe8(cosine, zeta); }
    if (number == 3) { return burnishLobe16(cosine, zeta); }
    if (number == 4) { return burnishLobe32(cosine, zeta); }
    if (number == 5) { return burnishSchlick(cosine, n); }
    return burnishPower(cosine, n);
}
