// A fragment shader's body that calls every function once; glslang drops those that nobody calls.
float everyFunction(vec3 N, vec3 L, vec3 V, float n) {
    float zeta = burnishZetaTaylor(n, 2.0) + burnishZetaEnergy(n, 2.0) + burnishZetaShift7(n);
    zeta += burnishZetaProjected(n, 4.0) + burnishZetaLevel(n, 2.0, 0.5) + burnishZetaShift3(n);
    zeta += burnishZetaMinimax(n, 8.0);
    float lambda = burnishLambda(N, L);
    float sum = burnishLobe2(lambda, zeta) + burnishLobe4(lambda, zeta) + burnishLobe8(lambda, zeta);
    sum += burnishLobe16(lambda, zeta) + burnishLobe32(lambda, zeta);
    // max, because contraction.py would take this function's own sums of products for the lobes'
    sum += max(burnishComposite3(lambda, n, zeta, n), burnishComposite4(lambda, n, zeta, n, n));
    sum += max(burnishComposite5(lambda, n, zeta, n, n, n), burnishComposite6(lambda, n, zeta, n, n, n, n));
    sum += max(burnishExpFalloff3(n), max(burnishExpFalloff4(n), burnishExpFalloff5(n)));
    sum += max(burnishFresnelWeight(n), specularComposite(lambda, n));
    sum += burnishPower(lambda, n) + burnishSchlick(lambda, n);
    sum += burnishNormalizeLobe(zeta, 2.0) + burnishNormalizePower(n);
    sum += burnishNormalizeLobeDistribution(zeta, 2.0) + burnishNormalizePowerDistribution(n);
    sum += burnishExponentFromRoughness(lambda) + burnishRoughnessFromExponent(n);
    sum += burnishPhongFromBlinn(n) + burnishBlinnFromPhong(n) + burnishToksvigExponent(n, lambda);
    sum += specularBurnish(lambda, n) + specularBurnishNormalized(lambda, n);
    sum += burnishLit(N, L, V, zeta, 4).y + burnishLitPhong(N, L, V, zeta, 4).y;
    sum += burnishLitPoint(N, L, V, zeta, 4).y + burnishLighting(N, L, V, N, N, V, n).x;
#ifndef BURNISH_EXACT // area lights do not have the CPU's bits
    sum += burnishRectLightGgx(L, N, V, 1, N, V, n).y + burnishDiscLightGgx(L, N, V, 1, N, V, n).y;
    sum += burnishGgxAlbedo(lambda, n).x;
    sum += burnishRectLight(L, N, V, 1, N, V, zeta, 4).y + burnishDiscLight(L, N, V, 2, N, V, zeta, 4).x;
#endif
    return sum;
}
