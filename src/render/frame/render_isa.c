/* The table of rendering kernels for the instruction set that BURNISH_VECTOR_... chooses. */
#include "render/frame/codes_simd.h"
#include "render/frame/pixels_simd.h"
#include "render/frame/tones_simd.h"
#include "render/light/ground_simd.h"
#include "render/light/maps/occlusion_simd.h"
#include "render/light/maps/shadow_simd.h"
#include "render/light/near_cells_simd.h"
#include "render/light/ray_light_simd.h"
#include "render/render_ops.h"
#include "render/splats/splatting_simd.h"
#include "render/texture/mask_simd.h"
#include "render/texture/passing_simd.h"
#include "render/texture/texture_points_simd.h"
#include "render/texture/texture_simd.h"
#include "render/texture/texture_surface_simd.h"
#include "simd/isa.h"

#define OP(name) .name = name

extern const burnish_render_ops BURNISH_ISA_TABLE(burnish_render_ops, VECTOR_WORD);
const burnish_render_ops BURNISH_ISA_TABLE(burnish_render_ops, VECTOR_WORD) = {
    OP(find_materials),
    OP(normalize_array),
    OP(position_from_depth),
    OP(collect_material),
    OP(scatter_material),
    OP(occlude),
    OP(sample_sky),
    OP(sample_lamp),
    OP(add_bounces),
    OP(cast_shadow),
    OP(add_silhouette),
    OP(blur_columns),
    OP(darken_ground),
    OP(shadow_ground),
    OP(plane_records),
    OP(locate_points),
    OP(find_taps),
    OP(sample_texture),
    OP(cover_samples),
    OP(interpolate_tangents),
    OP(turn_normals),
    OP(find_facing),
    OP(vary_points),
    OP(bend_normals),
    OP(pass_points),
    OP(map_tones),
    OP(encode_pixels),
    OP(pack_groups),
    OP(blend_splats),
    OP(apply_near_cells),
    .shade_codes = {[BURNISH_LOBE_BODY_NONE] = codes_none,
                    [BURNISH_LOBE_BODY_SQUARE] = codes_square,
                    [BURNISH_LOBE_BODY_SQUARES] = codes_squares,
                    [BURNISH_LOBE_BODY_COMPOSITE] = codes_composite},
    .face_code = {[BURNISH_LOBE_BODY_NONE] = face_none,
                  [BURNISH_LOBE_BODY_SQUARE] = face_square,
                  [BURNISH_LOBE_BODY_SQUARES] = face_squares,
                  [BURNISH_LOBE_BODY_COMPOSITE] = face_composite},
    OP(compare_block),
};
