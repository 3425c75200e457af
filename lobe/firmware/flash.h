/* Constants in program memory: AVR needs an attribute and a special load instruction for them,
 * elsewhere they are ordinary. */
#ifndef BURNISH_FIRMWARE_FLASH_H
#define BURNISH_FIRMWARE_FLASH_H

#include <stdint.h>

#ifdef __AVR__
#include <avr/pgmspace.h>
#define FLASH PROGMEM
#define FLASH_INT8(place) ((int8_t)pgm_read_byte(place))
#define FLASH_INT16(place) ((int16_t)pgm_read_word(place))
#else
#define FLASH
#define FLASH_INT8(place) (*(place))
#define FLASH_INT16(place) (*(place))
#endif

#endif
