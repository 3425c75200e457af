/* Members of objects, with messages that name them. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_VALUES_H
#define BURNISH_MESH_READ_GLTF_GLTF_VALUES_H

#include "mesh/read/gltf/gltf.h"

/* Fails with "NAME:LINE: PATH: ..."; value NONE: without a location. The first failure is kept. If
 * the file is read leniently, anything but a limit becomes a note, and the status is unchanged.
 * Returns 0. */
__attribute__((format(printf, 4, 5))) int burnish_gltf_fail(burnish_gltf *gltf,
                                                            burnish_status status, uint32_t value,
                                                            const char *format, ...);

/* Notes what was ignored, in the same form. */
__attribute__((format(printf, 4, 5))) void burnish_gltf_note(burnish_gltf *gltf,
                                                             burnish_warning_group *group,
                                                             uint32_t value, const char *format,
                                                             ...);

/* Adopts a failure of the memory. Returns 1 if nothing has failed. */
int burnish_gltf_is_fine(burnish_gltf *gltf);

/* The member of an object; NONE if it is missing. A member of another kind fails. */
uint32_t burnish_gltf_object(burnish_gltf *gltf, uint32_t object, const char *key);
uint32_t burnish_gltf_array(burnish_gltf *gltf, uint32_t object, const char *key);

/* object.extensions.NAME */
uint32_t burnish_gltf_extension(burnish_gltf *gltf, uint32_t object, const char *name);

/* A whole number of [0, most]. */
uint64_t burnish_gltf_whole(burnish_gltf *gltf, uint32_t object, const char *key,
                            uint64_t otherwise, uint64_t most);
double burnish_gltf_number(burnish_gltf *gltf, uint32_t object, const char *key, double otherwise);

/* `count` numbers, unchanged if the member is missing. Returns whether it is present. */
int burnish_gltf_numbers(burnish_gltf *gltf, uint32_t object, const char *key, int count,
                         double *numbers);
int burnish_gltf_flag(burnish_gltf *gltf, uint32_t object, const char *key, int otherwise);

/* The number of an item of a list; NONE if the member is missing, or on failure. */
uint32_t burnish_gltf_reference(burnish_gltf *gltf, uint32_t object, const char *key,
                                burnish_gltf_list list);

/* The same of a value that must be one. */
uint32_t burnish_gltf_item(burnish_gltf *gltf, uint32_t value, burnish_gltf_list list);

/* The JSON values of an array's items, `count` of them; NULL for none, and on failure. */
uint32_t *burnish_gltf_items(burnish_gltf *gltf, uint32_t array, size_t *count);

#endif
