/* Colours and instruction sets as values of flags. */
#include "cli/colors.h"

#include <string.h>
#include <strings.h>

const char cli_color_forms[] = "a colour: #rgb, #rrggbb, r,g,b from 0 to 1, or a name";

typedef struct named_color {
    const char *name;
    int32_t rgb;
} named_color;

/* CSS values, except for strong primaries, which are toned down to look like paint. */
/* clang-format off */
#define OWN_COLORS(X) \
    X(silver, 0xc0c0c0) X(grey, 0x808080) X(gray, 0x808080) X(black, 0x000000) \
    X(red, 0xcc2c28) X(orange, 0xec8024) X(yellow, 0xf0c830) X(green, 0x389448) \
    X(teal, 0x1c8488) X(blue, 0x2c60c0) X(navy, 0x18285c) X(purple, 0x744098) \
    X(brown, 0x7c5030) X(gold, 0xd8a440) X(copper, 0xc8704c) X(ivory, 0xf4ecd8)
/* clang-format on */
#define COLOR(name, rgb) {#name, rgb},
static const named_color own_colors[] = {{"white", 0xffffff}, OWN_COLORS(COLOR)};

/* The other names of CSS Color Module Level 4, section 6.1. */
static const named_color css_colors[] = {{"aliceblue", 0xf0f8ff},
                                         {"antiquewhite", 0xfaebd7},
                                         {"aqua", 0x00ffff},
                                         {"aquamarine", 0x7fffd4},
                                         {"azure", 0xf0ffff},
                                         {"beige", 0xf5f5dc},
                                         {"bisque", 0xffe4c4},
                                         {"blanchedalmond", 0xffebcd},
                                         {"blueviolet", 0x8a2be2},
                                         {"burlywood", 0xdeb887},
                                         {"cadetblue", 0x5f9ea0},
                                         {"chartreuse", 0x7fff00},
                                         {"chocolate", 0xd2691e},
                                         {"coral", 0xff7f50},
                                         {"cornflowerblue", 0x6495ed},
                                         {"cornsilk", 0xfff8dc},
                                         {"crimson", 0xdc143c},
                                         {"cyan", 0x00ffff},
                                         {"darkblue", 0x00008b},
                                         {"darkcyan", 0x008b8b},
                                         {"darkgoldenrod", 0xb8860b},
                                         {"darkgray", 0xa9a9a9},
                                         {"darkgreen", 0x006400},
                                         {"darkgrey", 0xa9a9a9},
                                         {"darkkhaki", 0xbdb76b},
                                         {"darkmagenta", 0x8b008b},
                                         {"darkolivegreen", 0x556b2f},
                                         {"darkorange", 0xff8c00},
                                         {"darkorchid", 0x9932cc},
                                         {"darkred", 0x8b0000},
                                         {"darksalmon", 0xe9967a},
                                         {"darkseagreen", 0x8fbc8f},
                                         {"darkslateblue", 0x483d8b},
                                         {"darkslategray", 0x2f4f4f},
                                         {"darkslategrey", 0x2f4f4f},
                                         {"darkturquoise", 0x00ced1},
                                         {"darkviolet", 0x9400d3},
                                         {"deeppink", 0xff1493},
                                         {"deepskyblue", 0x00bfff},
                                         {"dimgray", 0x696969},
                                         {"dimgrey", 0x696969},
                                         {"dodgerblue", 0x1e90ff},
                                         {"firebrick", 0xb22222},
                                         {"floralwhite", 0xfffaf0},
                                         {"forestgreen", 0x228b22},
                                         {"fuchsia", 0xff00ff},
                                         {"gainsboro", 0xdcdcdc},
                                         {"ghostwhite", 0xf8f8ff},
                                         {"goldenrod", 0xdaa520},
                                         {"greenyellow", 0xadff2f},
                                         {"honeydew", 0xf0fff0},
                                         {"hotpink", 0xff69b4},
                                         {"indianred", 0xcd5c5c},
                                         {"indigo", 0x4b0082},
                                         {"khaki", 0xf0e68c},
                                         {"lavender", 0xe6e6fa},
                                         {"lavenderblush", 0xfff0f5},
                                         {"lawngreen", 0x7cfc00},
                                         {"lemonchiffon", 0xfffacd},
                                         {"lightblue", 0xadd8e6},
                                         {"lightcoral", 0xf08080},
                                         {"lightcyan", 0xe0ffff},
                                         {"lightgoldenrodyellow", 0xfafad2},
                                         {"lightgray", 0xd3d3d3},
                                         {"lightgreen", 0x90ee90},
                                         {"lightgrey", 0xd3d3d3},
                                         {"lightpink", 0xffb6c1},
                                         {"lightsalmon", 0xffa07a},
                                         {"lightseagreen", 0x20b2aa},
                                         {"lightskyblue", 0x87cefa},
                                         {"lightslategray", 0x778899},
                                         {"lightslategrey", 0x778899},
                                         {"lightsteelblue", 0xb0c4de},
                                         {"lightyellow", 0xffffe0},
                                         {"lime", 0x00ff00},
                                         {"limegreen", 0x32cd32},
                                         {"linen", 0xfaf0e6},
                                         {"magenta", 0xff00ff},
                                         {"maroon", 0x800000},
                                         {"mediumaquamarine", 0x66cdaa},
                                         {"mediumblue", 0x0000cd},
                                         {"mediumorchid", 0xba55d3},
                                         {"mediumpurple", 0x9370db},
                                         {"mediumseagreen", 0x3cb371},
                                         {"mediumslateblue", 0x7b68ee},
                                         {"mediumspringgreen", 0x00fa9a},
                                         {"mediumturquoise", 0x48d1cc},
                                         {"mediumvioletred", 0xc71585},
                                         {"midnightblue", 0x191970},
                                         {"mintcream", 0xf5fffa},
                                         {"mistyrose", 0xffe4e1},
                                         {"moccasin", 0xffe4b5},
                                         {"navajowhite", 0xffdead},
                                         {"oldlace", 0xfdf5e6},
                                         {"olive", 0x808000},
                                         {"olivedrab", 0x6b8e23},
                                         {"orangered", 0xff4500},
                                         {"orchid", 0xda70d6},
                                         {"palegoldenrod", 0xeee8aa},
                                         {"palegreen", 0x98fb98},
                                         {"paleturquoise", 0xafeeee},
                                         {"palevioletred", 0xdb7093},
                                         {"papayawhip", 0xffefd5},
                                         {"peachpuff", 0xffdab9},
                                         {"peru", 0xcd853f},
                                         {"pink", 0xffc0cb},
                                         {"plum", 0xdda0dd},
                                         {"powderblue", 0xb0e0e6},
                                         {"rebeccapurple", 0x663399},
                                         {"rosybrown", 0xbc8f8f},
                                         {"royalblue", 0x4169e1},
                                         {"saddlebrown", 0x8b4513},
                                         {"salmon", 0xfa8072},
                                         {"sandybrown", 0xf4a460},
                                         {"seagreen", 0x2e8b57},
                                         {"seashell", 0xfff5ee},
                                         {"sienna", 0xa0522d},
                                         {"skyblue", 0x87ceeb},
                                         {"slateblue", 0x6a5acd},
                                         {"slategray", 0x708090},
                                         {"slategrey", 0x708090},
                                         {"snow", 0xfffafa},
                                         {"springgreen", 0x00ff7f},
                                         {"steelblue", 0x4682b4},
                                         {"tan", 0xd2b48c},
                                         {"thistle", 0xd8bfd8},
                                         {"tomato", 0xff6347},
                                         {"turquoise", 0x40e0d0},
                                         {"violet", 0xee82ee},
                                         {"wheat", 0xf5deb3},
                                         {"whitesmoke", 0xf5f5f5},
                                         {"yellowgreen", 0x9acd32}};

static int32_t find_name(const named_color *colors, size_t count, const char *name, size_t length) {
    for (size_t i = 0; i < count; ++i) {
        if (strlen(colors[i].name) == length && strncasecmp(colors[i].name, name, length) == 0) {
            return colors[i].rgb;
        }
    }
    return -1;
}

/* The colour of a name as 0xrrggbb; -1: unknown. Upper and lower case are the same. */
static int32_t find_color(const char *name, size_t length) {
    const int32_t own = find_name(own_colors, sizeof own_colors / sizeof *own_colors, name, length);
    return own >= 0 ? own
                    : find_name(css_colors, sizeof css_colors / sizeof *css_colors, name, length);
}

#define NAME(name, rgb) ", " #name
const cli_section cli_color_section = {
    .heading = "COLOURS",
    .text = "_COLOR_ is *#rgb* or *#rrggbb* in hexadecimal, *r,g,b* with sRGB values from 0 to 1, "
            "or a name of CSS, such as *lightgrey* or *steelblue*. These names are burnish's own "
            "or have softer values than in CSS: white" OWN_COLORS(NAME) ".",
};

static int hex_digit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    c = (char)(c | 32);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* #rgb and #rrggbb. */
static int read_hex_color(const char *text, size_t length, float srgb[3]) {
    size_t each = length == 4 ? 1 : 2;
    if (length != 4 && length != 7) {
        return 0;
    }
    for (size_t i = 0; i < 3; ++i) {
        int high = hex_digit(text[1 + each * i]);
        int low = hex_digit(text[each * (i + 1)]);
        if (high < 0 || low < 0) {
            return 0;
        }
        srgb[i] = (float)(16 * high + low) / 255.0F;
    }
    return 1;
}

int cli_read_color(const char *text, size_t length, float srgb[3]) {
    double values[3];
    if (length > 0 && text[0] == '#') {
        return read_hex_color(text, length, srgb);
    }
    const int32_t named = find_color(text, length);
    if (named >= 0) {
        for (int k = 0; k < 3; ++k) {
            srgb[k] = (float)(named >> (16 - 8 * k) & 255) / 255.0F;
        }
        return 1;
    }
    if (!cli_read_reals(text, length, values, 3)) {
        return 0;
    }
    for (size_t k = 0; k < 3; ++k) {
        if (!(values[k] >= 0 && values[k] <= 1)) {
            return 0;
        }
        srgb[k] = (float)values[k];
    }
    return 1;
}

burnish_status cli_flag_color(const cli_flag *flag, const char *text, void *target,
                              burnish_error *error) {
    cli_color *color = target;
    float srgb[3];
    if (!cli_read_color(text, strlen(text), srgb)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: \"%.60s\" is not %s", flag->name,
                        text, cli_color_forms);
    }
    color->given = 1;
    memcpy(color->srgb, srgb, sizeof srgb);
    return BURNISH_STATUS_OK;
}

uint8_t cli_color_code(float srgb) {
    return (uint8_t)(srgb * 255.0F + 0.5F);
}

burnish_status cli_choose_isa(const char *name, burnish_isa *isa, burnish_error *error) {
    burnish_error reason;
    burnish_status status = burnish_isa_choose(name, isa, &reason);
    if (status == BURNISH_STATUS_OK) {
        return status;
    }
    int is_variable = strncmp(reason.text, BURNISH_ISA_VARIABLE, strlen(BURNISH_ISA_VARIABLE)) == 0;
    return cli_fail(error, status, "%s%s", is_variable ? "" : "--isa: ", reason.text);
}
