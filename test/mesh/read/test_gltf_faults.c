/* glTF that is compressed, broken or damaged. */
#include "gltf_input.h"

/* ---- Compressed views ---- */

/* Raw differences of every byte of three gltf_triangle, the first of 0; the tail holds that 0. */
static void put_packed_positions(byte_list *list) {
    uint8_t bytes[36];
    memcpy(bytes, gltf_triangle, sizeof bytes); /* of a little-endian machine */
    put_bits(list, 0xA0, 1, 0);
    for (size_t k = 0; k < 12; ++k) {
        put_bits(list, 3, 1, 0);
        for (size_t i = 0; i < 16; ++i) {
            const int8_t delta =
                (int8_t)(i < 1 || i > 2 ? 0 : bytes[12 * i + k] - bytes[12 * i - 12 + k]);
            put_bits(list, (uint8_t)((uint8_t)delta << 1 ^ (delta < 0 ? 255 : 0)), 1, 0);
        }
    }
    for (int i = 0; i < 32; ++i) {
        put_bits(list, 0, 1, 0);
    }
}

static const struct {
    const char *view, *message;
} packed_views[] = {
    {"$packed(1,237,18,'mode':'TRIANGLES','byteStride':2,'count':3)", NULL},
    {"$packed(1,237,18,'mode':'TRIANGLES','byteStride':3,'count':3)",
     "byteStride of indices must be 2 or 4"},
    {"$packed(1,237,18,'mode':'TRIANGLES','byteStride':2,'count':4)",
     "count of TRIANGLES must be a multiple of 3"},
    {"$packed(1,237,18,'mode':'TRIANGLES','byteStride':2)", "it has no elements"},
    {"$packed(1,237,18,'mode':'INDICES','filter':'EXPONENTIAL','byteStride':4,'count':3)",
     "only ATTRIBUTES can have a filter"},
    {"$packed(1,237,18,'mode':'ATTRIBUTES','byteStride':6,'count':3)",
     "byteStride of ATTRIBUTES must be a multiple of 4 up to 256"},
    {"$packed(1,237,18,'mode':'ATTRIBUTES','filter':'QUATERNION','byteStride':12,'count':3)",
     "byteStride of OCTAHEDRAL and COLOR must be 4 or 8, of QUATERNION 8"},
    {"$packed(1,237,18,'mode':'SOME','byteStride':2,'count':3)",
     "its mode is unknown; export the file without meshopt's compression"},
    {"$packed(1,237,18,'mode':'ATTRIBUTES','filter':'X','byteStride':4,'count':3)",
     "its filter is unknown; export the file without meshopt's compression"},
    {"$packed(1,237,17,'mode':'TRIANGLES','byteStride':2,'count':3)",
     "its 17 bytes are no 3 elements compressed as TRIANGLES; the file is damaged"},
    {"$packed(1,237,99,'mode':'TRIANGLES','byteStride':2,'count':3)",
     "reaches to byte 336 of a buffer of 256"},
    {"$packed(1,237,18,'mode':'ATTRIBUTES','byteStride':256,'count':4000000)",
     "compressed buffer views unpack to 1024000036 bytes, of a file of "}};

/* A triangle and its indices, with a buffer without bytes. Any damage ends with a mesh or an error.
 */
static void test_compressed_views(void) {
    static const char head[] =
        "$head'extensionsRequired':['EXT_meshopt_compression'],'buffers':[{'byteLength':255},"
        "{'byteLength':99}],'bufferViews':[$packed(1,0,237,'mode':'ATTRIBUTES','byteStride':12,"
        "'count':3),%s],'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5123,3,SCALAR)],"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}],$node}";
    byte_list binary = {.size = 0};
    put_packed_positions(&binary);
    put_bits(&binary, 0xE1, 1, 0);
    put_bits(&binary, 0xF0, 1, 0);
    for (int i = 0; i < 16; ++i) {
        put_bits(&binary, 0, 1, 0);
    }
    char text[1500];
    for (size_t i = 0; i < sizeof packed_views / sizeof *packed_views; ++i) {
        snprintf(text, sizeof text, head, packed_views[i].view);
        CHECK((read_glb(text, &binary) == BURNISH_STATUS_OK) == !packed_views[i].message, "%s",
              fault.text);
        CHECK(!packed_views[i].message || strstr(fault.text, packed_views[i].message), "%s",
              fault.text);
        if (!packed_views[i].message && CHECK1(got.triangle_count == 1)) {
            CHECK1(corner_is(0, 0, 0, 0, 0) && corner_is(0, 1, 1, 0, 0) &&
                   corner_is(0, 2, 0, 2, 0));
        }
    }
    snprintf(text, sizeof text, head, packed_views[0].view);
    for (char *at = text; (at = strstr(at, "EXT_meshopt"));) { /* the extension's later name */
        memcpy(at, "KHR", 3);
    }
    CHECK(read_glb(text, &binary) == BURNISH_STATUS_OK && got.triangle_count == 1 &&
              got.warning_count == 0,
          "%s", fault.text);
    for (size_t bit = 0; bit < 8 * binary.size; ++bit) {
        binary.bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
        const burnish_status status = read_glb(text, &binary);
        CHECK1(status == BURNISH_STATUS_OK || status == BURNISH_STATUS_FORMAT);
        binary.bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
}

static const struct {
    const char *json, *message;
} faults[] = {
    {"{}", "mesh.gltf:1: the JSON has no \"asset\"; this is not glTF 2.0"},
    {"[]", "mesh.gltf:1: the JSON has no \"asset\"; this is not glTF 2.0"},
    {"{'asset':{'version':'1.0'}}",
     "mesh.gltf:1: asset: version \"1.0\" is not supported; convert the file to glTF 2.0"},
    {"{'asset':{}}",
     "mesh.gltf:1: asset: no version, as in glTF 1.0; convert the file to glTF 2.0"},
    {"{'asset':{'version':'2.0'}}", "mesh.gltf: no triangles; export the scene's meshes"},
    {"$head'extensionsRequired':['ACME_x']}",
     "mesh.gltf:1: extensionsRequired[0]: the file can't be drawn without the extension "
     "ACME_x, which is not supported; export it without"},
    {"$head'nodes':{}}", "mesh.gltf:1: nodes: expected an array, found {"},
    {"$head'nodes':[{'mesh':0}]}",
     "mesh.gltf:1: nodes[0].mesh: 0 is not in meshes, of which there are 0"},
    {"$head$triangle,'nodes':[{'mesh':-1}]}",
     "mesh.gltf:1: nodes[0].mesh: expected a whole number from 0 to 4194304, found -1"},
    {"$head$triangle,'nodes':[{'mesh':0,'scale':[1,2]}]}",
     "mesh.gltf:1: nodes[0].scale: expected 3 numbers in [], found ["},
    {"$head$triangle,'nodes':[{'children':[1]},{'children':[1]}]}",
     "mesh.gltf:1: nodes[1].children[0]: nodes[1] has two parents, or is its own; nodes must "
     "form a tree"},
    {"$head$triangle,'nodes':[{'children':[1]},{'children':[0]},{'mesh':0}]}",
     "mesh.gltf:1: nodes: 2 nodes are their own ancestors; nodes must form a tree"},
    {"$head$triangle,'nodes':[{'mesh':0,'scale':[1e38,1,1],'translation':[1e39,0,"
     "0]}]}",
     "mesh.gltf:1: accessors[0]: position 0 is not finite, or beyond 3.4e38; repair the mesh"},
    {"$head$buffer(36),'bufferViews':[$view(0,36)],'accessors':["
     "$accessor(0,5126,3,VEC3)],$mesh('POSITION':0),$node}",
     "mesh.gltf:1: buffers[0]: has no uri, and the binary chunk is missing; export the "
     "file again"},
    {"$head'buffers':[{'byteLength':37,'uri':'data:;base64,AAAA'}],"
     "'bufferViews':[$view(0,36)],'accessors':[$accessor(0,5126,3,VEC3)],"
     "$mesh('POSITION':0),$node}",
     "mesh.gltf:1: buffers[0]: has 3 bytes where byteLength is 37; the file is truncated"},
    {"$head'buffers':[{'byteLength':3,'uri':'data:;base64,AA*A'}],"
     "'bufferViews':[$view(0,36)],'accessors':[$accessor(0,5126,3,VEC3)],"
     "$mesh('POSITION':0),$node}",
     "mesh.gltf:1: buffers[0].uri: its base64 data contains an invalid character; the file "
     "is damaged"},
    {"$head'buffers':[{'byteLength':3,'uri':'a.bin'}],'bufferViews':["
     "$view(0,36)],'accessors':[$accessor(0,5126,3,VEC3)],$mesh('POSITION':0),"
     "$node}",
     "mesh.gltf:1: buffers[0].uri: names the file a.bin, but the input has no folder; give its "
     "path, or convert it to GLB"},
    {"$head'buffers':[$triangle_buffer],'bufferViews':[$view(4,36)],"
     "'accessors':[$accessor(0,5126,3,VEC3)],$mesh('POSITION':0),$node}",
     "mesh.gltf:1: bufferViews[0]: reaches to byte 40 of a buffer of 36"},
    {"$head'buffers':[$triangle_buffer],'bufferViews':[$view(0,36)],"
     "'accessors':[$accessor(0,5126,4,VEC3)],$mesh('POSITION':0),$node}",
     "mesh.gltf:1: accessors[0]: 4 elements do not fit into bufferViews[0] of 36 bytes; the "
     "file is damaged"},
    {"$head'buffers':[$triangle_buffer],'bufferViews':[{'buffer':0,"
     "'byteLength':36,'byteStride':4}],'accessors':[$accessor(0,5126,3,VEC3)],"
     "$mesh('POSITION':0),$node}",
     "mesh.gltf:1: accessors[0]: its elements have 12 bytes, but are 4 apart in "
     "bufferViews[0]"},
    {"$head'accessors':[{'componentType':5126,'count':1000000000,'type':'VEC3'}],"
     "$mesh('POSITION':0),$node}",
     "mesh.gltf:1: accessors[0]: sparse accessors unpack to 12000000000 bytes, of a file of "
     "176; write them in full"},
    {"$head$triangle_accessors,'meshes':[{'primitives':[{'indices':0,"
     "'attributes':{'POSITION':0}}]}],$node}",
     "mesh.gltf:1: meshes[0].primitives[0].indices: accessors[0] has the wrong type for this "
     "use"},
};

/* ---- Faults ---- */

static void test_faults(void) {
    for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
        CHECK(read_gltf(faults[i].json) != BURNISH_STATUS_OK, "%zu", i);
        CHECK_TEXT(fault.text, faults[i].message);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_compressed_views());
    RUN(test_faults());
    return test_end("gltf_faults");
}
