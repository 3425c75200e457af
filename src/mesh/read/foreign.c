/* Recognises unsupported files by their first bytes. */
#include "mesh/read/read.h"

#include <string.h>

#include "mesh/read/io/lexer.h"

typedef struct foreign_row {
    const char *first; /* bytes at `offset` */
    size_t offset;
    const char *what;
} foreign_row;

/* If two rows match, the first counts. */
static const foreign_row rows[] = {
    {"ISO-10303-21", 0, "a STEP file"},
    {"Kaydara FBX Binary", 0, "an FBX file"},
    {"; FBX ", 0, "an FBX file"},
    {"BLENDER", 0, "a Blender file"},
    {"#VRML", 0, "a VRML file"},
    {"#X3D", 0, "an X3D file"},
    {"DBRep_DrawableShape", 0, "a BREP file"},
    {"CASCADE Topology", 0, "a BREP file"},
    {"# vtk DataFile", 0, "a VTK file"},
    {"ncols", 0, "an ESRI ASCII grid"},
    {"ASTM-E57", 0, "an E57 point cloud"},
    {"xof 0", 0, "a DirectX .x file"},
    {"LWO2", 8, "a LightWave object"},
    {"LWOB", 8, "a LightWave object"},
    {"$MeshFormat", 0, "a Gmsh file"},
    {"MeshVersionFormatted", 0, "a Medit mesh"},
    {"PXR-USDC", 0, "a USD file"},
    {"#usda", 0, "a USD file"},
    {"AC10", 0, "a DWG drawing"},
    {"glTF", 0, "a binary glTF file"},
    {"7z\274\257", 0, "a 7-Zip archive"},
    {"\375"
     "7zXZ",
     0, "a file packed by xz"},
    {"BZh", 0, "a file packed by bzip2"},
    {"(\265/\375", 0, "a file packed by zstd"},
    {"\211PNG", 0, "a PNG picture"},
    {"\377\330\377", 0, "a JPEG picture"},
    {"%PDF", 0, "a PDF document"},
    {"II*", 0, "a TIFF picture"},
    {"WEBP", 8, "a WebP picture"},
    {"\211HDF\r\n", 0, "an HDF5 file"},
    {"\223NUMPY", 0, "an array of NumPy"},
    {"\320\317\021\340\241\261\032\341", 0,
     "an OLE file, as SolidWorks, Inventor and Office write them"},
    {"Rar!\032\007", 0, "a RAR archive"},
    {"ustar", 257, "a tar archive"},
    {"<!DOCTYPE html", 0, "a web page"},
    {"<html", 0, "a web page"},
};

static int begins_with(const uint8_t *bytes, size_t size, size_t offset, const char *first) {
    const size_t length = strlen(first);
    return size >= offset + length && memcmp(bytes + offset, first, length) == 0;
}

/* XML is recognised by its first elements. */
static const char *describe_xml(const uint8_t *bytes, size_t size) {
    static const foreign_row elements[] = {
        {"<COLLADA", 0, "a COLLADA file"}, {"<X3D", 0, "an X3D file"},
        {"<amf", 0, "an AMF file"},        {"<VTKFile", 0, "a VTK file"},
        {"<html", 0, "a web page"},        {"<svg", 0, "an SVG picture"}};
    enum { LOOKED_AT = 4096 };
    for (size_t i = 0; i < size && i < LOOKED_AT; ++i) {
        for (size_t k = 0; bytes[i] == '<' && k < sizeof elements / sizeof *elements; ++k) {
            if (begins_with(bytes, size, i, elements[k].first)) {
                return elements[k].what;
            }
        }
    }
    return "an XML file";
}

static const char *describe_extension(const char *name) {
    static const struct {
        const char *extension, *what;
    } extensions[] = {{".igs", "an IGES file"},    {".iges", "an IGES file"},
                      {".3ds", "a 3DS file"},      {".dxf", "a DXF drawing"},
                      {".stp", "a STEP file"},     {".step", "a STEP file"},
                      {".max", "a 3ds Max file"},  {".c4d", "a Cinema 4D file"},
                      {".skp", "a SketchUp file"}, {".scad", "an OpenSCAD program"}};
    const size_t length = name ? strlen(name) : 0;
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; ++i) {
        const size_t size = strlen(extensions[i].extension);
        if (length >= size &&
            burnish_bytes_are_caseless((const uint8_t *)name + length - size,
                                       (const uint8_t *)extensions[i].extension, size)) {
            return extensions[i].what;
        }
    }
    return NULL;
}

const char *burnish_describe_foreign(const uint8_t *bytes, size_t size, const char *name) {
    size_t start = begins_with(bytes, size, 0, "\357\273\277") ? 3 : 0;
    while (start < size &&
           (bytes[start] == ' ' || (bytes[start] >= '\t' && bytes[start] <= '\r'))) {
        ++start;
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        if (begins_with(bytes, size, start + rows[i].offset, rows[i].first)) {
            return rows[i].what;
        }
    }
    return begins_with(bytes, size, start, "<?xml") ? describe_xml(bytes, size)
                                                    : describe_extension(name);
}

int burnish_is_lfs_pointer(const uint8_t *bytes, size_t size) {
    return begins_with(bytes, size, 0, "version https://git-lfs.github.com/spec/");
}
