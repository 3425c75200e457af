// burnish-import-occt: STEP, IGES and BREP through Open CASCADE, tessellated. In C++, like its interface.
#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Bnd_Box.hxx>
#include <Geom_Surface.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESControl_Controller.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <NCollection_DataMap.hxx>
#include <Poly_Triangulation.hxx>
#include <Quantity_ColorRGBA.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <istream>
#include <new>
#include <streambuf>
#include <string>
#include <unordered_map>
#include <vector>

#include "importer.h"

extern "C" const char importer_name[] = "burnish-import-occt";

namespace {

constexpr double deflection_share = 1.0 / 2000;  // of the box's diagonal, between surface and triangles
constexpr double deflection_angle = 0.25;        // radians between neighbouring triangles
constexpr int depth_max = 200;                   // of assemblies
constexpr uint32_t materials_max = 65536;

// ---- The input ----

const importer_input *file;
constexpr char file_name[] = "input";

class memory_buffer : public std::streambuf {
public:
    memory_buffer(const uint8_t *bytes, size_t size) {
        char *first = const_cast<char *>(reinterpret_cast<const char *>(bytes));
        setg(first, first, first + size);
    }

protected:
    pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
        char *base = from == std::ios_base::beg ? eback() : from == std::ios_base::cur ? gptr() : egptr();
        if (offset < eback() - base || offset > egptr() - base) {
            return pos_type(off_type(-1));
        }
        setg(eback(), base + offset, egptr());
        return gptr() - eback();
    }
    pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
        return seekoff(off_type(position), std::ios_base::beg, mode);
    }
};

bool begins(const char *text) {
    const size_t size = strlen(text);
    for (size_t at = 0; at + size <= file->size && at < 4; ++at) {
        if (memcmp(file->bytes + at, text, size) == 0) {
            return true;
        }
    }
    return false;
}

// ---- Scenes ----

using color = Quantity_ColorRGBA;

// A face to be drawn, with its placement and colour.
struct drawn_face {
    TopoDS_Face face;
    gp_Trsf place;
    uint32_t material, part;
};

struct color_of {
    bool is_there;
    color value;
};

struct scene {
    importer_mesh *mesh;
    std::vector<drawn_face> faces;
    std::vector<importer_material> materials;
    std::unordered_map<uint64_t, uint32_t> numbers; // of materials by their colour
    std::vector<std::string> parts;                 // names of products, at each place; of each of their solids
    Handle(XCAFDoc_ShapeTool) shapes;
    Handle(XCAFDoc_ColorTool) colors;
};

uint64_t key_of(const color &c) {
    const Quantity_Color &rgb = c.GetRGB();
    const double parts[4] = {rgb.Red(), rgb.Green(), rgb.Blue(), c.Alpha()};
    uint64_t key = 0;
    for (double part : parts) {
        key = key << 16 | static_cast<uint64_t>(part > 0 ? part < 1 ? part * 65535 : 65535 : 0);
    }
    return key;
}

// The material of a colour, which is linear light; number 0, burnish's grey, without a colour.
uint32_t material_of(scene &s, const color_of &c) {
    if (!c.is_there) {
        return 0;
    }
    const auto known = s.numbers.find(key_of(c.value));
    if (known != s.numbers.end()) {
        return known->second;
    }
    if (s.materials.size() == materials_max) {
        return 0;
    }
    importer_material material = importer_default_material();
    const Quantity_Color &rgb = c.value.GetRGB();
    const double parts[3] = {rgb.Red(), rgb.Green(), rgb.Blue()};
    for (int i = 0; i < 3; ++i) {
        material.diffuse[i] = material.ambient[i] = static_cast<float>(parts[i]);
    }
    material.opacity = c.value.Alpha() > 0 ? c.value.Alpha() : 1;
    const uint32_t number = static_cast<uint32_t>(s.materials.size());
    s.materials.push_back(material);
    s.numbers[key_of(c.value)] = number;
    return number;
}

// A label's own colour, or its surface colour if there is one.
color_of find_color(const scene &s, const TDF_Label &label) {
    color_of found = {false, color()};
    found.is_there = s.colors->GetColor(label, XCAFDoc_ColorSurf, found.value) ||
                     s.colors->GetColor(label, XCAFDoc_ColorGen, found.value);
    return found;
}

using face_colors = NCollection_DataMap<TopoDS_Shape, color_of, TopTools_ShapeMapHasher>;

// Colours of solids, shells and faces within a part. Face colours come last and take precedence.
void find_face_colors(const scene &s, const TDF_Label &label, face_colors &colors) {
    TDF_LabelSequence parts;
    XCAFDoc_ShapeTool::GetSubShapes(label, parts);
    for (int pass = 0; pass < 2; ++pass) {
        for (int i = 1; i <= parts.Length(); ++i) {
            const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(parts.Value(i));
            const color_of own = find_color(s, parts.Value(i));
            if (shape.IsNull() || !own.is_there || (shape.ShapeType() == TopAbs_FACE) != (pass == 1)) {
                continue;
            }
            for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
                colors.Bind(at.Current(), own);
            }
        }
    }
}

// The name of a label in UTF-8; "" without one.
std::string name_of(const TDF_Label &label) {
    Handle(TDataStd_Name) name;
    return label.FindAttribute(TDataStd_Name::GetID(), name) ? TCollection_AsciiString(name->Get()).ToCString() : "";
}

void add_shape(scene &s, const TopoDS_Shape &shape, const gp_Trsf &place, const color_of &inherited,
               const face_colors &colors, const std::string &name) {
    NCollection_DataMap<TopoDS_Shape, int, TopTools_ShapeMapHasher> solids; // of faces
    int count = 0, last = -1;
    for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next(), ++count) {
        for (TopExp_Explorer at(solid.Current(), TopAbs_FACE); at.More(); at.Next()) {
            solids.Bind(at.Current(), count);
        }
    }
    for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
        const color_of *own = colors.Seek(at.Current());
        const int *solid = solids.Seek(at.Current());
        if ((solid ? *solid : count) != last) {
            last = solid ? *solid : count;
            s.parts.push_back(name);
        }
        s.faces.push_back({TopoDS::Face(at.Current()), place, material_of(s, own ? *own : inherited),
                           static_cast<uint32_t>(s.parts.size() - 1)});
    }
}

// A part, an assembly, or an instance of one in another. Outer colours count
// less, but the colour of an instance counts more than the part's own.
void add_label(scene &s, const TDF_Label &label, const gp_Trsf &place, const color_of &inherited, int depth) {
    if (depth > depth_max) {
        importer_fail(BURNISH_BMS_LIMIT_ERROR, "its assemblies are nested deeper than 200");
    }
    if (XCAFDoc_ShapeTool::IsAssembly(label)) {
        const color_of own = find_color(s, label);
        TDF_LabelSequence parts;
        XCAFDoc_ShapeTool::GetComponents(label, parts);
        for (int i = 1; i <= parts.Length(); ++i) {
            add_label(s, parts.Value(i), place, own.is_there ? own : inherited, depth + 1);
        }
        return;
    }
    TDF_Label part;
    if (XCAFDoc_ShapeTool::GetReferredShape(label, part)) {
        const gp_Trsf moved = place * XCAFDoc_ShapeTool::GetLocation(label).Transformation();
        const color_of here = find_color(s, label), own = find_color(s, part);
        add_label(s, part, moved, here.is_there ? here : own.is_there ? own : inherited, depth + 1);
        return;
    }
    face_colors colors;
    find_face_colors(s, label, colors);
    const color_of own = find_color(s, label);
    add_shape(s, XCAFDoc_ShapeTool::GetShape(label), place,
              inherited.is_there && depth > 0 ? inherited : own, colors, name_of(label));
}

// Distances in proportion to the whole; the angle keeps small round parts round.
void tessellate(const std::vector<TopoDS_Shape> &shapes) {
    Bnd_Box box;
    for (const TopoDS_Shape &shape : shapes) {
        BRepBndLib::Add(shape, box, Standard_False);
    }
    if (box.IsVoid()) {
        importer_fail(BURNISH_BMS_FORMAT_ERROR, "no surfaces; export solids or faces");
    }
    const double diagonal = std::sqrt(box.SquareExtent());
    for (const TopoDS_Shape &shape : shapes) {
        BRepMesh_IncrementalMesh(shape, diagonal > 0 ? diagonal * deflection_share : 1, Standard_False,
                                 deflection_angle, Standard_False);
    }
}

// ---- Triangles ----

Handle(Poly_Triangulation) triangles_of(const drawn_face &drawn, TopLoc_Location &location) {
    return BRep_Tool::Triangulation(drawn.face, location);
}

// The surface's normal at a node; 0 if it is undefined and must be generated.
void put_normal(const Handle(Geom_Surface) & surface, const gp_Pnt2d &at, const gp_Trsf &place, bool is_turned,
                float *to) {
    gp_Pnt point;
    gp_Vec along_u, along_v;
    surface->D1(at.X(), at.Y(), point, along_u, along_v);
    gp_Vec normal = along_u.Crossed(along_v);
    if (!(normal.SquareMagnitude() > 1e-24 * along_u.SquareMagnitude() * along_v.SquareMagnitude()) ||
        !(normal.SquareMagnitude() > 0)) {
        return;
    }
    normal.Normalize();
    normal.Transform(place);
    const double sign = is_turned ? -1 : 1;
    to[0] = static_cast<float>(sign * normal.X());
    to[1] = static_cast<float>(sign * normal.Y());
    to[2] = static_cast<float>(sign * normal.Z());
}

bool has_area(const importer_mesh &mesh, uint64_t triangle) {
    double edges[2][3];
    for (size_t k = 0; k < 6; ++k) {
        const uint32_t *corners = mesh.indices + 3 * triangle;
        edges[k / 3][k % 3] = static_cast<double>(mesh.positions[3 * static_cast<size_t>(corners[1 + k / 3]) + k % 3]) -
                              static_cast<double>(mesh.positions[3 * static_cast<size_t>(corners[0]) + k % 3]);
    }
    for (size_t k = 0; k < 3; ++k) {
        const size_t a = (k + 1) % 3, b = (k + 2) % 3;
        if (edges[0][a] * edges[1][b] != edges[0][b] * edges[1][a]) {
            return true;
        }
    }
    return false;
}

void draw_face(scene &s, const drawn_face &drawn, uint64_t &vertices, uint64_t &triangles) {
    TopLoc_Location location, of_surface;
    const Handle(Poly_Triangulation) net = triangles_of(drawn, location);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(drawn.face, of_surface);
    if (net.IsNull()) {
        return;
    }
    const gp_Trsf place = drawn.place * location.Transformation();
    // the transformation also mirrors vectors, and mirroring reverses triangles
    const bool is_reversed = drawn.face.Orientation() == TopAbs_REVERSED, is_mirrored = place.IsNegative();
    for (int i = 1; i <= net->NbNodes(); ++i) {
        const gp_Pnt point = net->Node(i).Transformed(place);
        float *to = s.mesh->positions + 3 * (vertices + static_cast<uint64_t>(i) - 1);
        to[0] = static_cast<float>(point.X());
        to[1] = static_cast<float>(point.Y());
        to[2] = static_cast<float>(point.Z());
        if (!std::isfinite(to[0]) || !std::isfinite(to[1]) || !std::isfinite(to[2])) {
            to[0] = to[1] = to[2] = 0;
            importer_warn(s.mesh, "positions that are not finite are 0");
        }
        if (net->HasUVNodes() && !surface.IsNull()) {
            put_normal(surface, net->UVNode(i), place, is_reversed,
                       s.mesh->normals + 3 * (vertices + static_cast<uint64_t>(i) - 1));
        }
    }
    for (int i = 1; i <= net->NbTriangles(); ++i) {
        int corners[3];
        net->Triangle(i).Get(corners[0], corners[1], corners[2]);
        for (int k = 0; k < 3; ++k) {
            const int corner = is_reversed != is_mirrored && k > 0 ? 3 - k : k;
            s.mesh->indices[3 * triangles + static_cast<uint64_t>(k)] =
                static_cast<uint32_t>(vertices + static_cast<uint64_t>(corners[corner]) - 1);
        }
        s.mesh->triangle_materials[triangles] = drawn.material;
        triangles += has_area(*s.mesh, triangles) ? 1 : 0; // poles have such triangles; this is not an error of the file
    }
    vertices += static_cast<uint64_t>(net->NbNodes());
}

void draw(scene &s) {
    uint64_t vertices = 0, triangles = 0, listed = 0;
    size_t missing = 0;
    for (const drawn_face &drawn : s.faces) {
        TopLoc_Location location;
        const Handle(Poly_Triangulation) net = triangles_of(drawn, location);
        missing += net.IsNull() ? 1 : 0;
        s.mesh->vertex_count += net.IsNull() ? 0 : static_cast<uint64_t>(net->NbNodes());
        s.mesh->triangle_count += net.IsNull() ? 0 : static_cast<uint64_t>(net->NbTriangles());
    }
    if (missing > 0) {
        char line[100];
        snprintf(line, sizeof line, "%zu of %zu faces could not be triangulated", missing, s.faces.size());
        importer_warn(s.mesh, line);
    }
    if (s.mesh->triangle_count == 0) {
        importer_fail(BURNISH_BMS_FORMAT_ERROR, "no surfaces; export solids or faces");
    }
    s.mesh->parts = BURNISH_BMS_NORMALS | BURNISH_BMS_TRIANGLE_MATERIALS;
    importer_allocate(s.mesh);
    for (size_t i = 0; i < s.faces.size(); ++i) {
        draw_face(s, s.faces[i], vertices, triangles);
        if (i + 1 == s.faces.size() || s.faces[i + 1].part != s.faces[i].part) {
            importer_add_part(s.mesh, s.parts[s.faces[i].part].c_str(), triangles - listed);
            listed = triangles;
        }
    }
    s.mesh->triangle_count = triangles;
    if (triangles == 0) {
        importer_fail(BURNISH_BMS_FORMAT_ERROR, "no surfaces; export solids or faces");
    }
    s.mesh->material_count = static_cast<uint32_t>(s.materials.size());
    s.mesh->materials = static_cast<importer_material *>(importer_zeroed(s.materials.size(), sizeof(importer_material)));
    memcpy(static_cast<void *>(s.mesh->materials), s.materials.data(), s.materials.size() * sizeof(importer_material));
}

// ---- Formats ----

[[noreturn]] void fail_reading(const char *format) {
    char line[100];
    snprintf(line, sizeof line, "Open CASCADE can't read it as %s; repair the file, or export it again", format);
    importer_fail(BURNISH_BMS_FORMAT_ERROR, line);
}

template <class reader_type> void transfer(scene &s, reader_type &reader, const char *format) {
    Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
    reader.SetColorMode(Standard_True);
    reader.SetNameMode(Standard_True);
    reader.SetLayerMode(Standard_False);
    if (!reader.Transfer(document)) {
        fail_reading(format);
    }
    s.shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    s.colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
    TDF_LabelSequence labels;
    std::vector<TopoDS_Shape> shapes;
    s.shapes->GetFreeShapes(labels);
    for (int i = 1; i <= labels.Length(); ++i) {
        shapes.push_back(XCAFDoc_ShapeTool::GetShape(labels.Value(i)));
    }
    tessellate(shapes);
    for (int i = 1; i <= labels.Length(); ++i) {
        add_label(s, labels.Value(i), gp_Trsf(), {false, color()}, 0);
    }
}

void read_step(scene &s) {
    memory_buffer buffer(file->bytes, file->size);
    std::istream stream(&buffer);
    STEPCAFControl_Reader reader;
    if (reader.ChangeReader().ReadStream(file_name, stream) != IFSelect_RetDone) {
        fail_reading("STEP");
    }
    transfer(s, reader, "STEP");
}

// Open CASCADE reads only by file name, with fopen, which is replaced below.
void read_iges(scene &s) {
    IGESCAFControl_Reader reader;
    if (reader.ReadFile(file_name) != IFSelect_RetDone) {
        fail_reading("IGES");
    }
    transfer(s, reader, "IGES");
}

void read_brep(scene &s) {
    memory_buffer buffer(file->bytes, file->size);
    std::istream stream(&buffer);
    TopoDS_Shape shape;
    if (begins("Open CASCADE Topology V") || begins("\nOpen CASCADE Topology V")) {
        BinTools::Read(shape, stream);
    } else {
        BRepTools::Read(shape, stream, BRep_Builder());
    }
    if (shape.IsNull()) {
        fail_reading("BREP");
    }
    tessellate({shape});
    add_shape(s, shape, gp_Trsf(), {false, color()}, face_colors(), "");
}

} // namespace

// Open CASCADE opens files itself; only the input exists.
extern "C" FILE *fopen(const char *name, const char *) {
    if (file && strcmp(name, file_name) == 0) {
        return fmemopen(const_cast<uint8_t *>(file->bytes), file->size, "rb");
    }
    errno = ENOENT;
    return nullptr;
}

extern "C" void importer_prepare(void) {
    STEPCAFControl_Controller::Init();
    IGESControl_Controller::Init();
    Message::DefaultMessenger()->ChangePrinters().Clear();
}

extern "C" void importer_import(importer_input *input, importer_mesh *mesh) {
    importer_unpack(input);
    scene s;
    s.mesh = mesh;
    s.materials.push_back(importer_default_material());
    file = input;
    mesh->up[2] = 1;
    mesh->unit = 0.001f; // what it reads is turned into millimetres
    try {
        if (strncmp(input->extension, "b", 1) == 0) {
            read_brep(s);
        } else if (strncmp(input->extension, "i", 1) == 0) {
            read_iges(s);
        } else {
            read_step(s);
        }
        draw(s);
    } catch (const Standard_Failure &failure) {
        const char *text = failure.GetMessageString();
        importer_fail(BURNISH_BMS_FORMAT_ERROR, text && *text ? text : "Open CASCADE gave up; repair the file");
    } catch (const std::bad_alloc &) {
        importer_fail(BURNISH_BMS_MEMORY_ERROR, "out of memory");
    } catch (const std::exception &failure) {
        importer_fail(BURNISH_BMS_FORMAT_ERROR, failure.what());
    }
}
