#include "burnish/image.h"
#include "core/environment.h"
#include "core/srgb.h"

float burnish_srgb_decode(float value) {
    const burnish_environment before = burnish_environment_enter();
    const float linear = burnish_srgb_value_to_linear(value);
    burnish_environment_leave(before);
    return linear;
}
