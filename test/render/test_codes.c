/* Codes straight from normals against colours that are encoded afterwards, for every instruction
 * set: normals of flat faces in perspective, which differ by rounding alone, and of others. */
#include "core/srgb.h"
#include "raster/tile.h"
#include "render/render_ops.h"
#include "shading/shading_ops.h"
#include "support.h"

enum { COUNT = 304, ROUNDS = 20000 }; /* 16 times an odd number: pairs and single vectors */

static float normals[3][COUNT], depths[COUNT], light[3][COUNT];
static int flat_ends[COUNT]; /* of the face that begins there, if it is flat; else 0 */

/* Faces of random lengths, each with normals of one direction but for `spread`. */
static void make_normals(uint64_t *state) {
    static const float spreads[] = {0, 0x1p-23f, 0x1p-20f, 0x1p-18f, 0x1p-17f, 0x1p-10f, 1};
    for (int i = 0; i < COUNT;) {
        const int end = i + 1 + (int)(test_random32(state) % 100);
        const float spread = spreads[test_random32(state) % 7];
        float face[3];
        for (int k = 0; k < 3; ++k) {
            face[k] = test_random32(state) % 8 ? test_uniform_float(state, -1, 1) : 0;
        }
        const float squared = face[0] * face[0] + face[1] * face[1] + face[2] * face[2];
        flat_ends[i] = spread <= 0x1p-23f && squared > 0.5f ? end : 0;
        for (; i < end && i < COUNT; ++i) {
            const float length = test_uniform_float(state, 0.5f, 2);
            for (int k = 0; k < 3; ++k) {
                normals[k][i] = (face[k] + spread * test_uniform_float(state, -1, 1)) * length;
            }
            depths[i] = test_random32(state) % 16 ? length : BURNISH_FARTHEST;
        }
    }
}

static void fold(uint64_t *state, burnish_light_constants *lights, burnish_kernels_shader *shader) {
    static const int orders[] = {2, 2, 4, 32};
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    burnish_material material = lighting.material;
    lighting.lobe.order = orders[test_random32(state) % 4];
    material.exponent = (float)(64 << test_random32(state) % 8);
    lighting.light_count = (int)(test_random32(state) % 3);
    lighting.lights[1] = lighting.lights[0];
    lighting.lights[1].vector[0] = -lighting.lights[0].vector[0];
    const int is_grey = (int)(test_random32(state) & 1);
    for (int k = 0; k < 3; ++k) {
        const int from = is_grey ? 0 : k;
        material.diffuse[k] = test_uniform_float(state, 0, 1);
        material.specular[k] = lighting.light_count == 1 ? 0 : test_uniform_float(state, 0, 1);
        lighting.lights[1].color[k] = test_uniform_float(state, 0, 2);
        material.diffuse[k] = material.diffuse[from];
        material.specular[k] = material.specular[from];
        lighting.lights[1].color[k] = lighting.lights[1].color[from];
    }
    CHECK1(burnish_shader_fold(&lighting, &material, &lighting.lobe, lights, shader, NULL) ==
           BURNISH_STATUS_OK);
}

/* Puts the codes of flat faces in place of their normals. */
static void code_faces(const burnish_render_ops *ops, const burnish_kernels_shader *shader,
                       const burnish_srgb_encoder *encoder) {
    burnish_code_direction known = {0};
    for (int first = 0; first < COUNT; ++first) {
        const float normal[3] = {normals[0][first], normals[1][first], normals[2][first]};
        const int32_t code =
            flat_ends[first] ? ops->face_code[shader->lobe.body](shader, encoder, normal, &known)
                             : 0;
        for (int i = first; code && i < flat_ends[first] && i < COUNT; ++i) {
            memcpy(&normals[0][i], &code, sizeof code);
        }
    }
}

static void test_all(void) {
    const uint32_t alpha = 0xff000000u, background = 0x123456u;
    burnish_code_direction known = {0};
    uint32_t codes[COUNT], expected[COUNT];
    burnish_srgb_encoder encoder;
    burnish_code_batch batch = {{normals[0], normals[1], normals[2]},
                                depths,
                                &encoder,
                                alpha,
                                background,
                                &known,
                                0,
                                codes};
    const burnish_kernels_points points = {.normal = {normals[0], normals[1], normals[2]}};
    float *const rgb[3] = {light[0], light[1], light[2]};
    const float *const shaded[3] = {light[0], light[1], light[2]};
    burnish_light_constants lights[2];
    burnish_kernels_shader shader;
    uint64_t state = test_seed(0x636f6465);
    int wrong[BURNISH_ISA_COUNT] = {0};
    burnish_srgb_encoder_make(&encoder);
    for (int round = 0; round < ROUNDS; ++round) {
        const burnish_isa isa = (burnish_isa)(round % BURNISH_ISA_COUNT);
        const burnish_shading_ops *kernels = burnish_shading_ops_for(isa);
        const burnish_render_ops *ops =
            burnish_kernels_for(isa) ? burnish_render_ops_for(isa) : NULL;
        known.shader = NULL;
        batch.has_codes = round / BURNISH_ISA_COUNT % 2;
        memset(flat_ends, 0, sizeof flat_ends);
        make_normals(&state);
        fold(&state, lights, &shader);
        if (!ops) {
            continue;
        }
        kernels->shade[shader.lobe.body][BURNISH_SHADE_DISTANT][BURNISH_SHADE_FLOAT](
            &shader, &points, COUNT, NULL, rgb);
        ops->encode_pixels(&encoder, COUNT, shaded, NULL, 0, 0, expected);
        if (batch.has_codes) {
            code_faces(ops, &shader, &encoder);
        }
        ops->shade_codes[shader.lobe.body](&shader, &batch, COUNT);
        for (int i = 0; i < COUNT; ++i) {
            const int is_shown = depths[i] > BURNISH_FARTHEST;
            wrong[isa] += codes[i] != (is_shown ? expected[i] | alpha : background);
        }
    }
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        CHECK(wrong[isa] == 0, "%s: %d codes differ", burnish_isa_name((burnish_isa)isa),
              wrong[isa]);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_all());
    return test_end("codes");
}
