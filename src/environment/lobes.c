#include "environment/lobes.h"

#include "core/arithmetic.h"

burnish_light_lobes burnish_light_lobes_for(float alpha) {
    const float a = alpha > 0.01f ? alpha < 1.0f ? alpha : 1.0f : 0.01f;
    return (burnish_light_lobes){1, {{8, 0.1f / (a * a) + 0.4f, 1.0f}}};
}
