/* Stands in for the Pico SDK's header of this name: what the example calls, declared as there. */
#include "pico/stdlib.h"

typedef struct spi_inst spi_inst_t;
extern spi_inst_t *const stand_in_spi;
#define spi0 stand_in_spi

uint spi_init(spi_inst_t *spi, uint baudrate);
int spi_write_blocking(spi_inst_t *spi, const uint8_t *src, size_t len);
