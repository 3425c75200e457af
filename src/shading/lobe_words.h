/* The one table of lobe words, as theory.h reads it: with the lobes that only it knows. */
#ifndef BURNISH_SHADING_LOBE_WORDS_H
#define BURNISH_SHADING_LOBE_WORDS_H

#include "burnish/shading.h"

/* burnish_lobe_spec_parse for every lobe of the table. */
burnish_status burnish_lobe_words_parse(const char *text, burnish_lobe_spec *lobe,
                                        burnish_error *error);

#endif
