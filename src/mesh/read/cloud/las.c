/* LAS 1.0 to 1.4 (ASPRS, "LAS Specification", R15): points of LiDAR in records of one size, whole
 * coordinates with a scale and an offset. A file without colours shows its classes, or else its
 * intensities. LAZ packs the records in a way of its own, and is refused. */
#include "base/bytes.h"
#include "mesh/read/io/streaming.h"
#include "mesh/read/ply/ply_binary.h"

/* Offsets in the header, and its least size. */
enum {
    MINOR = 25,
    POINTS_AT = 96,
    FORMAT = 104,
    RECORD_SIZE = 105,
    COUNT = 107,
    SCALE = 131,
    HEAD_SIZE = 227,
    LONG_COUNT = 247
};
enum {
    FORMATS = 11,
    INTENSITY = 12, /* offset in a record */
    SAMPLES = 1024,
    LEAST_CLASS = 2, /* 0 and 1 are not classified */
    USED = 38        /* bytes of a record that may be read */
};

/* A record of a format: its least size, and the offsets of the class and of red. */
static const struct {
    uint8_t size, class_at, color_at;
} records[FORMATS] = {{20, 15, 0},  {28, 15, 0},  {26, 15, 20}, {34, 15, 28},
                      {57, 15, 0},  {63, 15, 28}, {30, 16, 0},  {36, 16, 30},
                      {38, 16, 30}, {59, 16, 0},  {67, 16, 30}};

typedef struct las_file {
    burnish_reader *reader;
    unsigned format;
    size_t record_size, points_at;
    uint64_t count;
    burnish_ply_header header;
    size_t described; /* bytes of a record that have a property */
} las_file;

/* What a sample of the records holds. */
typedef struct las_sample {
    unsigned most_color, classes; /* bits 1 << class */
    unsigned intensities[2];
} las_sample;

static burnish_status las_fail(burnish_reader *reader, const char *text) {
    return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL, "%s", text);
}

static double load_double(const uint8_t *p) {
    return burnish_ply_load(p, BURNISH_PLY_FLOAT64, 0);
}

static burnish_status read_las_head(las_file *las) {
    burnish_reader *reader = las->reader;
    const uint8_t *head = reader->input->bytes;
    if (burnish_reader_head(reader) < HEAD_SIZE) {
        return las_fail(reader, "the file ends within its header; the file is truncated");
    }
    las->format = head[FORMAT] & 63u;
    las->record_size = burnish_load16(head + RECORD_SIZE);
    las->points_at = burnish_load32(head + POINTS_AT);
    las->count = burnish_load32(head + COUNT);
    if (las->count == 0 && head[MINOR] >= 4 && burnish_reader_head(reader) >= LONG_COUNT + 8) {
        las->count = burnish_load64(head + LONG_COUNT);
    }
    if (head[FORMAT] & 0xC0) {
        return las_fail(reader, "LAZ, packed LAS, which burnish can't read; convert it to LAS, for "
                                "example with pdal translate or las2las");
    }
    if (las->format >= FORMATS || las->record_size < records[las->format].size) {
        return burnish_reader_fail(
            reader, BURNISH_STATUS_FORMAT, NULL,
            "records of point format %u with %zu bytes do not exist; export the file again",
            las->format, las->record_size);
    }
    if (las->points_at < HEAD_SIZE || las->points_at > reader->input->size) {
        return las_fail(reader, "the points are outside the file; the file is truncated");
    }
    const uint64_t room = (reader->input->size - las->points_at) / las->record_size;
    if (las->count > room) {
        burnish_reader_warn(reader, NULL, "%llu of %llu points are there; the file is truncated",
                            (unsigned long long)room, (unsigned long long)las->count);
        las->count = room;
    }
    if (las->count == 0) {
        return las_fail(reader, "the file has no points; export it again");
    }
    for (int k = 0; k < 3; ++k) {
        las->header.scale[k] = load_double(head + SCALE + 8 * k);
        las->header.offset[k] = load_double(head + SCALE + 24 + 8 * k);
        float unused;
        if (!(las->header.scale[k] != 0) ||
            !burnish_double_to_float(las->header.scale[k], &unused) ||
            !burnish_double_to_float(las->header.offset[k], &unused)) {
            return las_fail(reader, "a scale is 0 or not finite; export the file again");
        }
    }
    return BURNISH_STATUS_OK;
}

/* Looks at records evenly over the file. */
static burnish_status take_las_sample(const las_file *las, las_sample *sample) {
    const burnish_reader *reader = las->reader;
    const uint64_t step = (las->count / SAMPLES + 1) | 1; /* classes may alternate */
    const size_t size = las->record_size < USED ? las->record_size : USED;
    const unsigned color_at = records[las->format].color_at;
    uint8_t buffer[USED];
    *sample = (las_sample){.intensities = {UINT16_MAX, 0}};
    for (uint64_t i = 0; i < las->count; i += step) {
        const uint8_t *p = burnish_reader_peek(
            reader, las->points_at + (size_t)i * las->record_size, size, buffer);
        if (!p) {
            return burnish_stop_streaming(las->reader);
        }
        const unsigned intensity = burnish_load16(p + INTENSITY);
        sample->intensities[0] =
            intensity < sample->intensities[0] ? intensity : sample->intensities[0];
        sample->intensities[1] =
            intensity > sample->intensities[1] ? intensity : sample->intensities[1];
        sample->classes |= 1u << (p[records[las->format].class_at] & 31);
        for (int k = 0; k < 3 && color_at > 0; ++k) {
            const unsigned color = burnish_load16(p + color_at + 2 * k);
            sample->most_color = color > sample->most_color ? color : sample->most_color;
        }
    }
    return BURNISH_STATUS_OK;
}

/* Describes bytes up to an offset that have no meaning. */
static burnish_status skip_to(las_file *las, size_t at) {
    burnish_ply_property gap = {.role = BURNISH_PLY_OTHER, .name = {las->header.body, 0}};
    burnish_status status = BURNISH_STATUS_OK;
    while (las->described < at && status == BURNISH_STATUS_OK) {
        gap.type = at - las->described >= 8 ? BURNISH_PLY_UINT64 : BURNISH_PLY_UINT8;
        las->described += burnish_ply_type_size(gap.type);
        status = burnish_ply_add_property(las->reader, &las->header, gap);
    }
    return status;
}

static burnish_status describe_las_records(las_file *las) {
    const size_t class_at = records[las->format].class_at, red = records[las->format].color_at;
    las_sample sample;
    burnish_status status = take_las_sample(las, &sample);
    const unsigned known = sample.classes >> LEAST_CLASS;
    const int has_colors = sample.most_color > 0, has_classes = (known & (known - 1)) != 0;
    las->header.tint = has_colors                                      ? BURNISH_PLY_NO_TINT
                       : has_classes                                   ? BURNISH_PLY_CLASSES
                       : sample.intensities[1] > sample.intensities[0] ? BURNISH_PLY_GREY
                                                                       : BURNISH_PLY_NO_TINT;
    /* some programs write 8 bits */
    const burnish_ply_type color = sample.most_color < 256 ? BURNISH_PLY_UINT8 : BURNISH_PLY_UINT16;
    const burnish_ply_role of_class =
        las->header.tint == BURNISH_PLY_CLASSES ? BURNISH_PLY_S : BURNISH_PLY_OTHER;
    const burnish_ply_role of_intensity =
        las->header.tint == BURNISH_PLY_GREY ? BURNISH_PLY_S : BURNISH_PLY_OTHER;
    const struct {
        size_t at;
        const char *name;
        burnish_ply_type type;
        burnish_ply_role role;
    } columns[] = {{0, "x", BURNISH_PLY_INT32, BURNISH_PLY_X},
                   {4, "y", BURNISH_PLY_INT32, BURNISH_PLY_Y},
                   {8, "z", BURNISH_PLY_INT32, BURNISH_PLY_Z},
                   {INTENSITY, "intensity", BURNISH_PLY_UINT16, of_intensity},
                   {class_at, "classification", BURNISH_PLY_UINT8, of_class},
                   {red, "red", color, BURNISH_PLY_RED},
                   {red + 2, "green", color, BURNISH_PLY_GREEN},
                   {red + 4, "blue", color, BURNISH_PLY_BLUE}};
    for (int i = 0; i < (has_colors ? 8 : 5) && status == BURNISH_STATUS_OK; ++i) {
        const burnish_ply_property property = {
            .type = columns[i].type,
            .role = columns[i].role,
            .name = {(const uint8_t *)columns[i].name, strlen(columns[i].name)}};
        status = skip_to(las, columns[i].at);
        las->described += burnish_ply_type_size(property.type);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_ply_add_property(las->reader, &las->header, property);
        }
    }
    return status == BURNISH_STATUS_OK ? skip_to(las, las->record_size) : status;
}

static burnish_status las_read(burnish_reader *reader) {
    las_file las = {.reader = reader};
    reader->is_binary = 1;
    burnish_status status = read_las_head(&las);
    if (status == BURNISH_STATUS_OK) {
        las.header.encoding = BURNISH_PLY_LITTLE_ENDIAN;
        las.header.body = reader->input->bytes + las.points_at;
        status =
            burnish_ply_add_element(reader, &las.header,
                                    (burnish_ply_element){.name = {(const uint8_t *)"points", 6},
                                                          .kind = BURNISH_PLY_ELEMENT_VERTEX,
                                                          .count = las.count,
                                                          .at = reader->input->bytes});
    }
    if (status == BURNISH_STATUS_OK) {
        status = describe_las_records(&las);
    }
    return burnish_ply_read_described(reader, &las.header, status);
}

/* Certain by its first bytes. */
static int las_recognise(const uint8_t *bytes, size_t size) {
    return size >= 4 && memcmp(bytes, "LASF", 4) == 0 ? 2 : 0;
}

const burnish_format_reader burnish_reader_las = {
    .recognise = las_recognise, .read = las_read, .can_stream = 1};
