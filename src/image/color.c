#include "burnish/image.h"
#include "core/srgb.h"

float burnish_srgb_decode(float value) {
    return burnish_srgb_value_to_linear(value);
}
