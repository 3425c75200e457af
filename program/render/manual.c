/* What the man page says of `burnish render` beside its flags. */
#include <stdio.h>

#include "render/manual.h"
#include "render/values.h"

static void each_material(cli_take_term *take) {
    for (size_t i = 0; render_preset_words[i].name; ++i) {
        const render_preset *preset = &render_presets[i];
        char tag[40], text[200];
        snprintf(tag, sizeof tag, "*%s*", preset->name);
        snprintf(text, sizeof text, "%s (ks %g, n %g%s).", preset->what, (double)preset->specular,
                 (double)preset->exponent, preset->tint > 0 ? ", in the surface's colour" : "");
        take(tag, text);
    }
}

static const cli_term look_terms[] = {
    {"*studio*", "key, fill and rim light on a light grey ground, ambient occlusion: for web pages "
                 "and thumbnails. In standard views along an axis, *--edges*, thin and soft: there "
                 "a step has the colour of what is behind it."},
    {"*plain*", "the same lights, brighter, on white, without occlusion: the fastest."},
    {"*clay*", "every surface matt and warm, strong occlusion: for shapes. Edges as *studio*."},
    {"*technical*", "edges over light, matt surfaces: *--look=plain --edges "
                    "--light=directional:-0.45,0.75,0.85:0.5 --ambient=0.36 --specular=0*, on a "
                    "light grey."},
    {"*drawing*", "edges alone, as SVG where the output ends in *.svg*: *--look=plain --edges "
                  "--color=white --specular=0 --light=none --ambient=1*."},
    {"*lobes*",
     "highlights on dark surfaces, which *--exponent*, *--lobe* and *--equation* change: "
     "*--look=plain --light=directional:-0.55,0.75,0.85 --specular=0.9*, on a dark "
     "grey."},
    {NULL, NULL},
};

static const cli_term light_terms[] = {
    {"*directional*", "from the direction _X_,_Y_,_Z_ as the camera sees it: x to the right, y "
                      "up, z toward the viewer."},
    {"*point*", "at that position as the camera sees it; the unit is the distance from the "
                "camera to the focal point."},
    {"*world-directional*, *world-point*", "the same in the scene's coordinates."},
    {"*file*", "the input's own, which glTF may have (KHR_lights_punctual), scaled together so "
               "that a white surface in the middle of the object that faces them is white. "
               "Spot lights shine to all sides."},
    {"*none*", "takes away the default rig and every light given before."},
    {NULL, NULL},
};

static const cli_term format_terms[] = {
    {"*.png*", "8 bits per channel, sRGB, with alpha where the background is transparent."},
    {"*.jpg*, *.jpeg*", "without alpha: *--no-background* is refused. Colour is not subsampled."},
    {"*.webp*", "without loss, or with *--quality*; alpha as in PNG; at most 16383 pixels a side."},
    {"*.svg*",
     "lines and areas of one colour, with *--look=drawing*: edges, surfaces whose colour is "
     "not the background's, cut faces with their hatching, annotations; sheets, too. "
     "Letters are paths, their text is in *aria-label*. Flags of light and shading are "
     "refused. Sizes are pixels, or millimetres with *--dpi*."},
    {"*.exr*", "32 bits per channel: *R*, *G*, *B* (linear, alpha multiplied in), *A*, *Z*, *N.X*, "
               "*N.Y*, *N.Z*, *id*, *material* and *coverage*, as in *PLANES*. One picture, no "
               "sheet."},
    {"*.npy*", "linear RGBA, 32-bit floats of shape (height, width, 4), alpha not multiplied in. "
               "One picture, no sheet."},
    {NULL, NULL},
};

static const cli_term plane_terms[] = {
    {"*.npy*", "*depth*: float32, infinity where nothing shows. *normal*: float32, x, y, z. "
               "*triangle*, *material*: int32, -1 for none. *coverage*: uint8, 0 to 255. *color*: "
               "as *--output*."},
    {"*.exr*", "the channels that *--output* would have; none of a triangle or a material is "
               "4294967295."},
    {"*.png*",
     "*depth*: 16 bits, 0 where nothing shows, else *low* + (value - 1) / 65534 x (*high* "
     "- *low*), which are in the JSON report. *normal*: 16 bits per channel, 2 x value / "
     "65535 - 1; 0, 0, 0 where nothing shows. *triangle*, *material*: 65536 R + 256 G + "
     "B - 1, up to 16777214. *coverage*: 16 bits. Not *color*. None says sRGB."},
    {NULL, NULL},
};

static const cli_term json_terms[] = {
    {"*burnish*", "the version"},
    {"*input, format, output*", "*output* is null when nothing is written"},
    {"*width, height*", "of the picture, in pixels"},
    {"*rows*", "with *--rows*: the first row and how many; *height* is their number, too, and "
               "*pixel_bounds* counts from the whole picture's first row"},
    {"*triangles, vertices, materials, textures, exponents*",
     "of the mesh as it is drawn. A position with two normals is two vertices here; the command "
     "info counts it once"},
    {"*points, lines*", "of an input without faces: each is drawn as a small solid"},
    {"*bounding_box, unit*",
     "*min* and *max* of the object, of points and lines without the solids "
     "that stand for them; millimeter or the like where the input says it "
     "(3MF, glTF), else null"},
    {"*origin*", "what is subtracted from coordinates, in double precision, before they are "
                 "rounded to single precision: 0, 0, 0, or where the input is far from there, near "
                 "its middle. What is printed and what flags say are the input's own coordinates"},
    {"*up, up_source, view*",
     "the up axis; who says so: flag, format or auto; the standard view where one was asked "
     "for"},
    {"*triangles_drawn*", "triangles that own at least one sample"},
    {"*hidden*", "share of the object's area that belongs to the other triangles"},
    {"*covered_pixels, pixel_bounds*",
     "pixels that show the object; x0, y0, x1, y1, ends excluded"},
    {"*overdraw*", "how often large triangles cover the picture: what *--max-overdraw* limits"},
    {"*layers_dropped*", "transparent layers of samples that were left out: beyond 256, or 32 "
                         "and more where *--max-overdraw* allows no more"},
    {"*cuts*", "the planes of *--clip* that cut something off, _X_,_Y_,_Z_,_D_ each"},
    {"*filled*", "true when the cuts are filled"},
    {"*near_white, near_black*",
     "shares of those pixels whose channels are all at least 250, or at most 5"},
    {"*like_ground*", "share of those pixels whose channels all are within 5 of the background's; "
                      "null without a background"},
    {"*contrast*", "ratio of the mean luminances, each plus 0.05, of those pixels and of the "
                   "background, the larger by the smaller, from 1 to 21 (as WCAG 2 has it); null "
                   "without a background"},
    {"*camera*", "*position*, *focal_point*, *view_up*, *view_angle*, *orthographic_height* "
                 "(0: perspective)"},
    {"*pixels_per_unit*", "scale of a parallel projection; null in perspective"},
    {"*lobe, equation, viewer, look, occlusion, ground, shadow, lights, samples, threads, isa*",
     "as used"},
    {"*seconds*", "*start* (processor time before loading), *load* (of which *read* and "
                  "*build*), *transform*, *draw*, *encode*, *write*, *total* (from *load* on)"},
    {"*hash, hash_algorithm*",
     "XXH64 of the pixel bytes, 16 hexadecimal digits: the same on every machine"},
    {"*blank*", "true when the picture, or a cell, shows nothing or is of one colour"},
    {"*reference*", "with *--reference*: *input*, *width*, *height*, *passes*, and where the sizes "
                    "are the same the other numbers of *burnish compare --json*"},
    {"*warnings*", "lines, also with *--quiet*"},
    {"*frames, fps*", "of a turntable; the other facts and the hash are the first frame's"},
    {"*planes*", "of each *--plane*: *plane*, *output*; of depth also *low* and *high*"},
    {"*cells*", "of a sheet: *row*, *column*, *view*, *width*, *height*, *blank*, *hash*, and "
                "what depends on view or lobe"},
    {NULL, NULL},
};

const cli_section render_sections[] = {
    {.heading = "MATERIALS",
     .text =
         "The names of *--material* and what they set. *--specular* and *--exponent* change the "
         "strength and the exponent further.",
     .each_term = each_material},
    {.heading = "LOOKS",
     .text = "The names of *--look*. Surfaces without a colour of their own get the look's grey.",
     .terms = look_terms},
    {.heading = "LIGHTS",
     .text =
         "_SPEC_ is _KIND_:_X_,_Y_,_Z_[:_INTENSITY_[:_COLOR_]] with an intensity from 0 to "
         "1000, 1 when left out, and a colour, white when left out. Lights have no falloff, and "
         "only the first casts a shadow, with *--shadow*.",
     .terms = light_terms,
     .closing = "For example *--light=directional:-1,1,2:0.8:#fff2e0*."},
    {.heading = "FORMATS",
     .text = "The pixels are the same bits on every machine, and so is what PNG and lossless WebP "
             "hold. The bytes of PNG, JPEG and WebP, and what JPEG and lossy WebP lose, depend on "
             "the libraries that write them. JPEG, WebP and EXR are optional parts of the program.",
     .terms = format_terms},
    {.heading = "PLANES",
     .text = "What *--plane* writes, by the ending of its file. Rows run from the top. Triangles "
             "are numbered as burnish orders them: the same in every picture of a file.",
     .terms = plane_terms},
    {.heading = "JSON OUTPUT",
     .text = "One object. Numbers read back as exactly the values that were used. It is printed "
             "before the picture replaces an older one, so that a report that can't be printed "
             "leaves the older picture.",
     .terms = json_terms},
    {.heading = NULL},
};
