/* The shaders of llvmpipe.c, in parts that link_program puts together. */
#ifndef BURNISH_BENCH_PEERS_LLVMPIPE_SHADERS_H
#define BURNISH_BENCH_PEERS_LLVMPIPE_SHADERS_H

/* Macros precede both shaders: COLORED (a colour per vertex) and COLOR (float if all is grey, else
 * vec3). */
static const char vertex_main[] = "layout(location = 0) in vec3 position;\n"
                                  "layout(location = 1) in vec3 normal;\n"
                                  "layout(location = 2) in vec3 vertex_color;\n"
                                  "uniform mat4 to_clip;\n"
                                  "out vec3 n;\n"
                                  "#ifdef COLORED\n"
                                  "out vec3 tint;\n"
                                  "#endif\n"
                                  "void main() {\n"
                                  "    n = normal;\n"
                                  "#ifdef COLORED\n"
                                  "    tint = vertex_color;\n"
                                  "#endif\n"
                                  "    gl_Position = to_clip * vec4(position, 1.0);\n"
                                  "}\n";

/* `float lobe(float c)` comes between the two parts. */
static const char fragment_head[] = "in vec3 n;\n"
                                    "#ifdef COLORED\n"
                                    "in vec3 tint;\n"
                                    "#else\n"
                                    "const float tint = 1.0;\n"
                                    "#endif\n"
                                    "layout(location = 0) uniform COLOR diffuse;\n"
                                    "uniform vec3 light, halfway;\n"
                                    "uniform float ambient, specular, exponent, zeta;\n"
                                    "out vec4 color;\n";
static const char fragment_one_sided[] = "vec3 facing() { return normalize(n); }\n";
static const char fragment_two_sided[] =
    "vec3 facing() { return normalize(gl_FrontFacing ? n : -n); }\n";
static const char fragment_main[] =
    "void main() {\n"
    "    vec3 unit = facing();\n"
    "    float n_dot_l = max(dot(unit, light), 0.0);\n"
    "    float shine = n_dot_l > 0.0 ? lobe(dot(unit, halfway)) : 0.0;\n"
    "    COLOR value = COLOR(ambient * tint);\n"
    "    value += diffuse * tint * n_dot_l + specular * shine;\n"
    "    color = vec4(vec3(value), 1.0);\n"
    "}\n";
static const char lobe_power[] = "float lobe(float c) { return pow(max(c, 0.0), exponent); }\n";
static const char lobe_family[] =
    "float lobe(float c) { float u = max(1.0 + zeta * (c - 1.0), 0.0); return u * u; }\n";
static const char lobe_schlick[] =
    "float lobe(float c) { c = max(c, 0.0); return c / (exponent - exponent * c + c); }\n";

#endif
