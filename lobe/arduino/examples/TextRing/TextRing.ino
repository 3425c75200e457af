/* A shaded ring that turns in a terminal: no display needed, any board. Open the serial port at 115200
 * baud in a terminal that knows ANSI sequences (screen, minicom, PuTTY); Arduino's Serial Monitor shows
 * the frames one below the other. */
#include <burnish.h>

enum { WIDTH = 64, ROWS = 32 }; /* characters, twice as high as wide */

static const char ramp[] = " .:-=+*#%@";
static burnish_ring ring;
static int16_t to_light[3], half[3];
static uint8_t depth[WIDTH * 2], greys[WIDTH * 2]; /* two rows of pixels are one of characters */
static uint8_t frame;

/* Ambient, diffuse and highlight of one channel, as a byte. */
static void pixel(void *, uint8_t x, uint8_t y, const int16_t normal[3]) {
    const uint16_t lit = burnish_q15_cosine(burnish_q15_dot(normal, to_light));
    uint16_t grey = 0x0E00;
    if (lit) {
        grey = burnish_q15_accumulate(grey, 0x4000, burnish_q15_weight(lit));
        grey = burnish_q15_accumulate(grey, 0x5000, burnish_shift7_q15(24, burnish_q15_cosine(burnish_q15_dot(normal, half))));
    }
    greys[y * WIDTH + x] = burnish_q15_code(grey, 255);
}

void setup() {
    const int32_t lamp[3] = {-14000, 17000, 18000};
    const int16_t to_viewer[3] = {0, 0, 0x7FFF};
    Serial.begin(115200);
    burnish_q15_normalize(lamp, to_light);
    burnish_q15_half(to_light, to_viewer, half);
    burnish_ring_create(&ring, WIDTH * 8, ROWS * 16, 21 * 16, 9 * 16);
}

void loop() {
    burnish_strip strip = {depth, WIDTH, 2, 0, pixel, 0};
    burnish_ring_turn(&ring, frame * 1024u, frame * 512u + 6000u);
    ++frame;
    Serial.print(F("\x1b[H")); /* to the upper left */
    for (uint8_t row = 0; row < ROWS; ++row) {
        memset(greys, 0, sizeof greys);
        strip.top = 2 * row;
        burnish_strip_clear(&strip);
        burnish_ring_draw(&ring, &strip);
        for (uint8_t x = 0; x < WIDTH; ++x) {
            const uint16_t both = greys[x] + greys[WIDTH + x];
            Serial.write(ramp[both * (sizeof ramp - 2) / 510]);
        }
        Serial.println();
    }
    Serial.write('\f'); /* the frame's end */
}
