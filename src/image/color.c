#include "burnish/image.h"
#include "core/float_mode.h"
#include "core/srgb.h"

float burnish_srgb_decode(float value) {
    const burnish_float_mode before = burnish_float_mode_enter();
    const float linear = burnish_srgb_value_to_linear(value);
    burnish_float_mode_leave(before);
    return linear;
}
