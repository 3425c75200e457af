/* The environment "room". */
#ifndef BURNISH_ENVIRONMENT_ROOM_H
#define BURNISH_ENVIRONMENT_ROOM_H

/* Fills an equirectangular image of 3 width height floats. */
void burnish_room_fill(int width, int height, float *rgb);

#endif
