// burnish-import-draco: the streams of KHR_draco_mesh_compression through libdraco. In C++, like its interface.
// It receives streams and writes values, not a mesh: docs/importers.md, "Draco's streams".
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "importer.h"
#include "base/bytes.h"

extern "C" const char importer_name[] = "burnish-import-draco";

extern "C" void importer_prepare(void) {}

namespace {

constexpr char magic[] = "\x89" "BDA\r\n\x1a\n";

// The componentType of glTF; 0 for other types.
uint32_t component_of(draco::DataType type) {
    switch (type) {
    case draco::DT_INT8:
        return 5120;
    case draco::DT_UINT8:
        return 5121;
    case draco::DT_INT16:
        return 5122;
    case draco::DT_UINT16:
        return 5123;
    case draco::DT_UINT32:
        return 5125;
    case draco::DT_FLOAT32:
        return 5126;
    default:
        return 0;
    }
}

// Components in little-endian order.
void put_components(uint8_t *bytes, size_t count, size_t size) {
    const uint16_t one = 1;
    if (*reinterpret_cast<const uint8_t *>(&one) == 0) {
        for (size_t i = 0; i < count; ++i) {
            std::reverse(bytes + i * size, bytes + (i + 1) * size);
        }
    }
    importer_put_padded(bytes, count * size);
}

void put_attribute(const draco::PointAttribute &attribute, uint32_t component, uint32_t points) {
    const size_t width = static_cast<size_t>(attribute.num_components());
    const size_t size = static_cast<size_t>(draco::DataTypeLength(attribute.data_type()));
    const size_t stride = static_cast<size_t>(attribute.byte_stride());
    std::vector<uint8_t> bytes(points * width * size);
    for (uint32_t i = 0; i < points; ++i) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(i));
        if (value.value() < attribute.size() && stride >= width * size) {
            memcpy(&bytes[i * width * size], attribute.GetAddress(value), width * size);
        }
    }
    importer_put_word(attribute.unique_id());
    importer_put_word(component);
    importer_put_word(static_cast<uint32_t>(width));
    put_components(bytes.data(), points * width, size);
}

void put_mesh(const draco::Mesh &mesh) {
    std::vector<const draco::PointAttribute *> attributes;
    for (int32_t i = 0; i < mesh.num_attributes() && attributes.size() < 32; ++i) {
        const draco::PointAttribute *attribute = mesh.attribute(i);
        if (component_of(attribute->data_type()) != 0 && attribute->num_components() >= 1 && attribute->num_components() <= 16) {
            attributes.push_back(attribute);
        }
    }
    importer_put_word(mesh.num_points());
    importer_put_word(mesh.num_faces());
    importer_put_word(static_cast<uint32_t>(attributes.size()));
    for (const draco::PointAttribute *attribute : attributes) {
        put_attribute(*attribute, component_of(attribute->data_type()), mesh.num_points());
    }
    for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i) {
        for (const draco::PointIndex &corner : mesh.face(i)) {
            importer_put_word(corner.value());
        }
    }
}

// If decoding fails, all outputs are empty.
void put_stream(const uint8_t *bytes, size_t size) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char *>(bytes), size);
    const auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
    if (type.ok() && type.value() == draco::TRIANGULAR_MESH) {
        draco::Decoder decoder;
        auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
        if (mesh.ok()) {
            put_mesh(*mesh.value());
            return;
        }
    }
    for (int i = 0; i < 3; ++i) {
        importer_put_word(0);
    }
}

} // namespace

extern "C" void importer_import(importer_input *input, importer_mesh *) {
    const uint8_t *next = input->bytes, *end = next + input->size;
    try {
        importer_put(magic, 8);
        while (end - next >= 4) {
            const size_t size = burnish_load32(next), padded = (size + 3) & ~size_t{3};
            if (padded > static_cast<size_t>(end - next - 4)) {
                break;
            }
            put_stream(next + 4, size);
            next += 4 + padded;
        }
    } catch (const std::bad_alloc &) {
        importer_fail(BURNISH_BMS_MEMORY_ERROR, "out of memory");
    } catch (...) {
        importer_fail(BURNISH_BMS_FORMAT_ERROR, "libdraco gives up");
    }
    importer_finish();
}
