/* The sections of the man page of `burnish render`, in addition to its flags. */
#include <stdio.h>

#include "render/flags.h"
#include "render/settings/flag_values.h"

static void each_material(cli_take_term *take) {
    for (size_t i = 0; render_preset_words[i].name; ++i) {
        const render_preset *preset = &render_presets[i];
        char tag[40], text[200];
        snprintf(tag, sizeof tag, "*%s*", preset->name);
        snprintf(text, sizeof text, "%s (ks %g, n %g%s; roughness %g).", preset->what,
                 (double)preset->specular, (double)preset->exponent,
                 preset->tint > 0 ? ", in the surface's colour" : "", (double)preset->roughness);
        take(tag, text);
    }
}

static const cli_term look_terms[] = {
    {"*studio*", "a product studio: a window, two strips of light, a panel behind and a table, "
                 "which metals and glossy surfaces reflect; a light grey background, ambient "
                 "occlusion and *--tone-mapping=soft*, so white is white and colours keep their "
                 "hue. Black materials that reflect less than 0.035 reflect as much, with a "
                 "highlight and a warning. Objects that stand have a *--ground*. For web pages and "
                 "thumbnails. Standard views along an "
                 "axis also have "
                 "thin, soft *--edges*, because steps in depth are hard to see there."},
    {"*three-point*", "key, fill and rim light from single directions, whose highlights have the "
                      "shape of *--lobe*; otherwise as *studio*."},
    {"*plain*", "the lights of *three-point*, brighter, on white, without ambient occlusion: the "
                "fastest look."},
    {"*clay*",
     "matt, warm surfaces and strong ambient occlusion, to show shapes. Edges as in *studio*."},
    {"*technical*",
     "edges on light, matt surfaces: *--look=plain --edges --light=directional:-0.45,0.75,0.85:0.5 "
     "--ambient=0.36 --specular=0*, on a light grey."},
    {"*drawing*", "only edges, as lines if the output ends in *.svg* or *.pdf*: *--look=plain "
                  "--edges --color=white --specular=0 --light=none --ambient=1*."},
    {"*lobes*",
     "highlights on dark surfaces, which *--exponent*, *--lobe* and *--equation* change: "
     "*--look=plain --light=directional:-0.55,0.75,0.85 --specular=0.9*, on a dark grey."},
    {NULL, NULL},
};

static const cli_term light_terms[] = {
    {"*directional*", "from the direction _X_,_Y_,_Z_ as the camera sees it: x to the right, y up, "
                      "z toward the viewer."},
    {"*point*", "at that position as the camera sees it; the unit is the distance from the camera "
                "to the focal point."},
    {"*rect*, *disc*",
     "a rectangular or elliptical area light, for which _WIDTH_,_HEIGHT_ follow the position: "
     "*rect:-1,1,0:0.8,0.5*. Its intensity is its radiance: a light that filled half of the sky "
     "with 1 would light a white surface that faces it to 1. Options after the size: *distant*, "
     "seen in the same directions from everywhere, with the position in the directions of "
     "*directional*; *two-sided*; *target=*_X_,_Y_,_Z_, which it faces (otherwise the focal point, "
     "or 0,0,0 for *world-*); *upright=*_X_,_Y_,_Z_, along which its height is (otherwise 0,1,0). "
     "Parts below a surface's horizon do not light it; objects do not block its light, except by "
     "ambient occlusion."},
    {"*sphere*, *line*",
     "a ball, for which _RADIUS_ follows the position: *sphere:-1,1,0:0.3*; or a tube between two "
     "positions: *line:-1,1,0:1,1,0:0.05*. Their intensity is their radiance. They shine in all "
     "directions but not into themselves, and the only option is *distant*."},
    {"*world-directional*, *world-point*, *world-rect*, *world-disc*, *world-sphere*, "
     "*world-line*",
     "the same in the scene's coordinates."},
    {"*file*",
     "the lights of the input (glTF with KHR_lights_punctual), scaled together so a white surface "
     "in the middle of the object that faces them is white."},
    {"*none*", "removes the lights of the look and all lights before it."},
    {NULL, NULL},
};

static const cli_term format_terms[] = {
    {"*.png*", "8 bits per channel, sRGB, with alpha where the background is transparent."},
    {"*.jpg*, *.jpeg*", "no alpha: *--no-background* is an error. Colour is not subsampled."},
    {"*.webp*",
     "lossless, or lossy with *--quality*; alpha as in PNG; at most 16383 pixels per side."},
    {"*.svg*",
     "lines and areas of one colour, with *--look=drawing*: edges, surfaces whose colour differs "
     "from the background, cut faces with their hatching, and annotations. Sheets are supported. "
     "Letters are paths; their text is in *aria-label*. Flags of light and shading are errors. "
     "Sizes are in pixels, or in millimetres with *--dpi*."},
    {"*.pdf*", "the same lines and areas on one page, at 96 dots per inch unless *--dpi* is given. "
               "Labels can be searched."},
    {"*.exr*", "32 bits per channel: *R*, *G*, *B* (linear, alpha multiplied in), *A*, *Z*, *N.X*, "
               "*N.Y*, *N.Z*, *id*, *material* and *coverage*, as in *PLANES*. No sheets."},
    {"*.npy*",
     "linear RGBA, 32-bit floats of shape (height, width, 4), alpha not multiplied in. No sheets."},
    {NULL, NULL},
};

static const cli_term plane_terms[] = {
    {"*.npy*",
     "*depth*: float32, infinity in empty pixels. *normal*: float32, x, y, z. *triangle*, "
     "*material*: int32, -1 in empty pixels. *coverage*: uint8, 0 to 255. *color*: as *--output*."},
    {"*.exr*", "the channels of *--output*; triangle and material are 4294967295 in empty pixels."},
    {"*.png*",
     "*depth*: 16 bits, 0 in empty pixels, else *low* + (value - 1) / 65534 x (*high* - *low*), "
     "which are in the JSON report. *normal*: 16 bits per channel, 2 x value / 65535 - 1; 0, 0, 0 "
     "in empty pixels. *triangle*, *material*: 65536 R + 256 G + B - 1, up to 16777214. "
     "*coverage*: 16 bits. *color* is not available. The files have no sRGB tag."},
    {NULL, NULL},
};

static const cli_term json_terms[] = {
    {"*burnish*", "the version"},
    {"*input, format, output*", "*output* is null when nothing is written"},
    {"*status, code, error*",
     "done, 0 and null, or failed, the exit code and the line on standard error"},
    {"*width, height*", "of the picture, in pixels"},
    {"*rows*", "with *--rows*: the first row and the number of rows, which is also *height*; "
               "*pixel_bounds* counts from the first row of the whole picture"},
    {"*triangles, vertices, materials, textures, exponents*",
     "of the drawn mesh. A position with two normals counts as two vertices here, and as one in "
     "the command info"},
    {"*color_by, color_range*",
     "what *--color-by* names, and the values of the first and the last colour; null without it"},
    {"*points, splats, lines*",
     "of an input without faces; splats, which are points there, also of others"},
    {"*thumbnail*", "true if the picture that a 3MF or G-code file holds is drawn, no geometry"},
    {"*bounding_box, unit*",
     "*min* and *max* of the object, for points and lines without the solids that are drawn; the "
     "unit, such as millimeter, if the input has one (3MF, glTF), else null"},
    {"*parts*",
     "of scenes and robots: *name*, *triangles*, and *transform*, 3 rows of 4 numbers that "
     "place it in the scene, without *--explode*; the command info lists parts of others"},
    {"*origin*", "subtracted from coordinates, in double precision, before they are rounded to "
                 "single precision: 0, 0, 0, or a position near the middle of an input that is far "
                 "away from it. Flags and output always use the coordinates of the input"},
    {"*up, up_source, up_reason, view*",
     "the up axis; flag, format or auto; why auto (stability, terrain, geographic or camera, else "
     "null); the standard view, if any"},
    {"*inside_out*", "true if a closed surface is inside out: its triangles are clockwise seen "
                     "from outside, which pictures do not show; null if the surface is open"},
    {"*triangles_drawn*", "triangles that are visible in at least one sample"},
    {"*hidden*", "share of the object's area in the other triangles"},
    {"*covered_pixels, pixel_bounds*",
     "pixels that show the object; x0, y0, x1, y1, ends excluded"},
    {"*overdraw*", "how often large triangles cover the picture; see *--max-overdraw*"},
    {"*layers_dropped*", "transparent layers that were omitted at samples with more than 256, or "
                         "with at least 32 if *--max-overdraw* allows no more"},
    {"*cuts*", "the planes of *--clip* and *--section* that cut it, _X_,_Y_,_Z_,_D_ each"},
    {"*filled*", "true when the cuts are filled"},
    {"*near_white, near_black*",
     "shares of those pixels whose channels are all at least 250, or at most 5"},
    {"*like_ground*", "share of those pixels whose channels all are within 5 of the background's; "
                      "null without a background"},
    {"*contrast*",
     "ratio of the mean luminances, each plus 0.05, of those pixels and of the background, the "
     "larger divided by the smaller, from 1 to 21 (as in WCAG 2); null without a background"},
    {"*camera*",
     "*position*, *focal_point*, *view_up*, *view_angle*, *orthographic_height* (0: perspective)"},
    {"*intrinsics*", "of *--camera-intrinsics*, if it has an effect"},
    {"*callouts*",
     "with *--callouts*, the parts list: *number*, *name*, *count* of equal parts, *part*, the "
     "first of them, from 1, *point*, the pixel where the leader starts or null, *balloon*"},
    {"*pixels_per_unit*", "scale of a parallel projection; null in perspective"},
    {"*lobe, equation, viewer, look, occlusion, ground, shadow, lights, area_lights, samples, "
     "threads, isa*",
     "as used"},
    {"*seconds*", "*start* (processor time before loading), *load* (of which *read* and *build*), "
                  "*transform*, *draw*, *encode*, *write*, *total* (from *load* on)"},
    {"*hash, hash_algorithm*",
     "XXH64 of the pixel bytes, 16 hexadecimal digits: the same on every machine"},
    {"*blank*", "true if the picture, or a cell, shows nothing or has only one colour"},
    {"*legible*",
     "false if the picture, or a cell, is blank, nearly black or like its background, or shows the "
     "object as a speck; a warning says which, and names a flag that helps"},
    {"*reference*", "with *--reference*: *input*, *width*, *height*, *passes*, and, if the sizes "
                    "are the same, the other numbers of *burnish compare --json*"},
    {"*warnings*", "lines, also with *--quiet*"},
    {"*frames, fps, animation_seconds*",
     "of a turntable; the other values and the hash are of the first frame"},
    {"*planes*", "for each *--plane*: *plane*, *output*, and for depth *low* and *high*"},
    {"*cells*", "of a sheet: *row*, *column*, *view*, *width*, *height*, *blank*, *hash*, and the "
                "values that depend on the view or lobe"},
    {NULL, NULL},
};

const cli_section render_sections[] = {
    {.heading = "MATERIALS",
     .text = "The presets of *--material*. Area lights and environments use the roughness, other "
             "lights ks and n. *--specular* and *--exponent* replace all of them.",
     .each_term = each_material},
    {.heading = "LOOKS",
     .text = "The presets of *--look*. Surfaces without a colour have the grey of the look.",
     .terms = look_terms},
    {.heading = "LIGHTS",
     .text = "_SPEC_ is _KIND_:_X_,_Y_,_Z_[:_INTENSITY_[:_COLOR_]] with an intensity from 0 to "
             "1000 (default 1) and a colour (default white). Only lights of files fall off, and "
             "only one light casts a shadow, with *--shadow*.",
     .terms = light_terms,
     .closing = "For example *--light=directional:-1,1,2:0.8:#fff2e0* or "
                "*--light=rect:-2,1.5,1:1.5,1:distant:4*."},
    {.heading = "FORMATS",
     .text = "The pixels have the same bits on every machine, also in PNG and lossless WebP. The "
             "bytes of PNG, JPEG and WebP files, and the loss of JPEG and lossy WebP, depend on "
             "the libraries that write them. JPEG, WebP and EXR are optional parts of the program.",
     .terms = format_terms},
    {.heading = "PLANES",
     .text = "The formats of *--plane*, by file extension. Rows start at the top. Triangles have "
             "the numbers of burnish's order, which is the same in every picture of a file.",
     .terms = plane_terms},
    {.heading = "JSON OUTPUT",
     .text =
         "One object for each input, in one line each if there are several inputs. An input that "
         "can not be drawn has *burnish*, *input*, *output*, *status*, *code*, *error*, *seconds*, "
         "*hash* and *warnings*; a wrong flag, or a limit that ends the process of a single input, "
         "prints none. Numbers read back as exactly the values that were used. The object of a "
         "single input is printed before the picture replaces an "
         "older one: if printing fails, the older picture stays.",
     .terms = json_terms},
    {.heading = "IN PLACE OF F3D",
     .text = "The long options of *f3d* are accepted: those with another name here are translated, "
             "and those that burnish has nothing like are warnings, also with *--strict*. Run "
             "through a link named "
             "*f3d*, the program takes its letters, too. docs/pictures.md lists all of them."},
    {.heading = NULL},
};
