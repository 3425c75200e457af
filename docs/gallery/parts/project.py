"""A print project of two plates, with and without the slicer's files. Usage: project.py PROJECT.3mf BARE.3mf"""

import math
import sys
import zipfile

TURN = 2 * math.pi
RING = [(30, TURN * i / 96) for i in range(96)]
STAR = [((19, 8.5)[i % 2], TURN * (i + 2.5) / 10) for i in range(10)]
HOLE, PIT, BLOCK = ([(radius, TURN * (i + 0.5) / n) for i in range(n)] for radius, n in ((3.5, 48), (5, 6), (16, 4)))
VOLUMES = (  # kind, corners as radius and angle around a point, heights
    ("ModelPart", RING, (0, 0), (0, 5)), ("ModelPart", STAR, (0, 0), (5, 8)), ("NegativeVolume", HOLE, (0, 24), (-1, 6)),
    ("NegativeVolume", PIT, (0, 0), (4, 9)), ("ParameterModifier", BLOCK, (22, -22), (-1, 12)),
)  # fmt: skip

vertices, triangles, volumes = [], [], []
for kind, corners, at, heights in VOLUMES:
    first, count, start = len(vertices), len(corners), len(triangles)
    vertices += [(at[0] + r * math.cos(a), at[1] + r * math.sin(a), z) for z in heights for r, a in [(0, 0), *corners]]
    for i in range(count):
        a, b = first + 1 + i, first + 1 + (i + 1) % count
        c, d = a + count + 1, b + count + 1
        triangles += [(first, b, a), (a, b, d), (a, d, c), (first + count + 1, c, d)]
    volumes.append(f'<volume firstid="{start}" lastid="{len(triangles) - 1}"><metadata key="volume_type" value="{kind}"/></volume>')
mesh = "<vertices>" + "".join('<vertex x="%.9g" y="%.9g" z="%.9g"/>' % vertex for vertex in vertices) + "</vertices><triangles>"
mesh += "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % triangle for triangle in triangles) + "</triangles>"
items = "".join(f'<item objectid="1" transform="1 0 0 0 1 0 0 0 1 {x} 100 0"/>' for x in (100, 450))
model = f'<resources><object id="1"><mesh>{mesh}</mesh></object></resources><build>{items}</build>'
settings = {
    "Slic3r_PE_model.config": f'<config><object id="1">{"".join(volumes)}</object></config>',
    "Slic3r_PE.config": ";\n; filament_colour = #E8590C;#FFFFFF\n; bed_shape = 0x0,250x0,250x210,0x210\n; layer_height = 0.2\n",
    "Prusa_Slicer_custom_gcode_per_print_z.xml": '<custom_gcodes><code print_z="5.2" type="2" extruder="2"/></custom_gcodes>',
}
for name, files in zip(sys.argv[1:], (settings, {})):
    with zipfile.ZipFile(name, "w") as archive:
        archive.writestr("3D/3dmodel.model", f'<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">{model}</model>')
        for part, text in files.items():
            archive.writestr(f"Metadata/{part}", text)
