/* The highlight without pow: a column of values beside pow's, the time of both, and a boundary read from
 * program memory. Open the Serial Monitor at 115200 baud. */
#include <burnish.h>

#include "boundary.h" /* burnish lobe boundary --lobe=shift7 --exponents=1-64 --bits=0 --as=progmem -o boundary.h */

static const uint8_t exponent = 32;
static volatile uint16_t cosine, highlight;
static volatile float from, power;

void setup() {
    Serial.begin(115200);
    Serial.println(F("cosine  burnish  pow"));
    for (uint8_t i = 0; i <= 16; ++i) {
        cosine = (uint16_t)(0x8000u - i * 0x100u); /* UQ1.15 */
        Serial.print(cosine / 32768.0, 4);
        Serial.print(F("  "));
        Serial.print(burnish_shift7_q15(exponent, cosine) / 65536.0, 4);
        Serial.print(F("   "));
        Serial.println(pow(cosine / 32768.0, exponent), 4);
    }
    Serial.print(F("dark up to a cosine of "));
    Serial.println(burnish_boundary_at(exponent - 1) / 32768.0, 4);

    cosine = 0x7E00;
    from = 0.984375;
    unsigned long start = micros();
    for (uint16_t i = 0; i < 1000; ++i) {
        highlight = burnish_shift7_q15(exponent, cosine);
    }
    Serial.print(F("microseconds: "));
    Serial.print((micros() - start) / 1000.0);
    start = micros();
    for (uint16_t i = 0; i < 1000; ++i) {
        power = pow(from, exponent);
    }
    Serial.print(F(", pow "));
    Serial.println((micros() - start) / 1000.0);
    Serial.write('\f');
}

void loop() {}
