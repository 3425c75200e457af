"""scripts/tables and docs/site/headers.py on small fixed inputs: what they write and refuse, and that a refusal leaves the page as it was.

Usage: tables.py SOURCE_DIR
"""
import glob
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
SOURCE = os.path.abspath(sys.argv.pop(1))
sys.path[:0] = [os.path.join(SOURCE, folder) for folder in ("scripts/tables", "docs/site")]

import drawings
import headers
import machine_code
import measurements
import page
import rtl

PAGE = "Text | with a bar\n\n<!-- table: made -->\n\n| unit | cells | blocks |\n| --- | ---: | ---: |\n| a | {} | 0 |\n\n<!-- end of table -->\n"


def temporary(text):
    with tempfile.NamedTemporaryFile("w", suffix=".txt", delete=False) as file:
        file.write(text)
    return file.name


class Tables(unittest.TestCase):
    def refuses(self, message, function, *arguments, **options):
        with self.assertRaises(page.Refused) as caught:
            function(*arguments, **options)
        self.assertIn(message, str(caught.exception))

    def test_check(self):
        for good in ("12", "0.01", "1 / 0 / 0", "-", "10 (9 to 11)", "infinite sum"):
            page.check("good.md", PAGE.format(good), ["blocks"])
        for bad in ("0", "0.00", "-0", "", "nan", "-nan", "inf", "nan (1 to 2)"):
            message = f"bad.md: line 7: row a, column cells: expected a number above 0, found \"{bad}\""
            self.refuses(message, page.check, "bad.md", PAGE.format(bad), ["blocks"])
        self.refuses("column blocks", page.check, "bad.md", PAGE.format(3))
        page.check("good.md", PAGE.format(""), ["blocks"], empty=True)
        self.refuses("bad.md: line 3: expected rows below the heading", page.check, "bad.md", "| a | b |\n| - | - |\n\n")
        self.refuses("line 3: expected 2 cells as in the heading, found 3", page.check, "bad.md", "| a | b |\n| - | - |\n| 1 | 2 | 3 |\n")
        self.refuses("expected a table, found none", page.check, "bad.md", "text\n")

    def test_fill(self):
        name = temporary(PAGE.format(1))
        made = {"made": page.table("unit|cells|blocks", [["a", 2, 0]])}
        page.fill(name, made, ["blocks"])
        self.assertEqual(page.read(name), PAGE.format(2))
        self.refuses("found \"0\"", page.fill, name, {"made": page.table("unit|cells|blocks", [["a", 0, 0]])}, ["blocks"])
        self.refuses("no table made was made", page.fill, name, {})
        self.refuses('expected a line "<!-- table: other -->"', page.fill, name, {**made, "other": []})
        page.fill(name, {}, ["blocks"], keep=True)
        self.assertEqual(page.read(name), PAGE.format(2))
        self.refuses("has no line", page.filled, temporary("<!-- table: made -->\n"), {"made": []})
        os.remove(name)

    def test_pages(self):
        for name, exceptions in (("hardware", ["MAC", "RAM"]), ("firmware", ["exact 1 - cosine in UQ0.24"]), ("performance", [])):
            page.check(name, page.read(f"{SOURCE}/docs/{name}.md"), exceptions)
        page.check("frames", page.read(f"{SOURCE}/docs/frames.md"), empty=True)

    def test_grid(self):
        cells = [("a", "x", "1"), ("b", "x", "2"), ("b", "y", "3")]
        self.assertEqual(page.grid("of", cells, "%.1f", "`%s`"), ["| of | `a` | `b` |", "| --- | ---: | ---: |", "| x | 1.0 | 2.0 |", "| y | | 3.0 |"])

    def test_kernels(self):
        rows = ["isa,section,name,label,nanoseconds,cycles,ratio", "run,machine,rounds,3,,,", 'sse2,lobe.l1,lobe,"the lobe, m = 2",0.15,,', "sse2,lobe.l1,copy,copy,0.07,,2",
                "avx2,lobe.l1,lobe,the lobe,0.07,,", "code,scalar.latency,a,f,3.01,7.84,1", "code,scalar.throughput,a,f,0.33,0.87,1", "code,scalar.latency,schlick,g,6,16,2"]
        kernels = measurements.Kernels(temporary("\n".join(rows)))
        self.assertEqual(kernels.contenders("lobe.l1", "%.3f")[0], "| f(c) | avx2 | x lobe | sse2 | x lobe |")
        self.assertEqual(kernels.contenders("lobe.l1", "%.3f")[3], "| copy | – | – | 0.070 | 0.5 |")
        self.assertEqual(kernels.scalar("scalar", "x lobe")[2], "| `f` | 3.01 | 7.8 | 1 | 0.33 | 0.87 | 1 |")

    def test_frames(self):
        scenes = f"rods: 200 cylinders\n{measurements.SETUPS[0]}\nrods 18400 1 1 13.62 37.5 2.77 1 1 1\nby medians: geometric mean 6.02, least 2.58, rest\n"
        lines = measurements.shapes(scenes)
        self.assertEqual(lines[2], "| rods: 200 cylinders | 18400 | 13.6 | 37.5 | 2.77 | – | – | – | – |")
        self.assertEqual(lines[4], "| least | | | | 2.58 | – | – | – | – |")
        lines = measurements.parts("256,256 240 8 12 2048 1 1024 /p/a b.stl\n", temporary("a b.stl\tgithub.com/o/r\tcommit\tp.stl\n"))
        self.assertEqual(lines[2:], ["| o/r: p.stl, 256x256 | 240 | 8.0 | 30.0 | 12.0 | 20.0 | 2.0 | 1.0 | 2.0 |", "| geometric mean of 1, 256x256 | | | 30.0 | | 20.0 | | | 2.0 |"])

    def test_instructions(self):
        listing = "00000010 <count_w>:\n  10:\tmul.w r0, r1\n  14:\tadds\tr0, r1\n  18:\tbx\tlr\n00000020 <main>:\n  20:\tnop\n"
        trace = "".join(f"Trace 0: 0x7f [0/{at:08x}/0/0]\n" for at in (0x20, 0x10, 0x14, 0x18, 0x20))
        self.assertEqual(machine_code.instructions(listing, trace, machine_code.MACHINES["m0"][3]), {"w": [1, 1, 0, 0, 0, 2]})

    def test_wrap(self):
        text = rtl.wrap("unit", "ROWS=2", "enable a:4 reset", "b:3", "narrow")
        self.assertIn("unit #(.ROWS(2)) unit(.clk(clk), .enable(1), .a(in[3:0]), .reset(0), .b(value[2:0]));", text)
        self.assertEqual(rtl.count_cells(temporary("  SB_LUT4   12\n  SB_DFFE 3\n  SB_DFF 4\n"), "SB_DFF.*"), 7)

    def test_wave(self):
        names = "".join(f"$var wire 1 {code} {name} $end\n" for code, name in zip("abcdefg", drawings.SIGNALS))
        changes = drawings.read_dump(names + "#0\n0a\n" + "".join(f"1{code}\n" for code in "bcef") + "b1010 d\nbx g\n#40\n1a\n")
        self.assertEqual(changes["s_angle"], [(0, 10)])
        self.assertEqual(drawings.draw_line(changes["clk"], 50), f'<path d="M92,50H110L114,28H852" fill="none" stroke="{drawings.INK}" stroke-width="1.5"/>')
        self.assertIn(">000A</text>", drawings.draw_bus(changes, "s_angle", 50)[1])

    def test_headers(self):
        text = "/* What it holds.\n *   kind  a sum\n */\ntypedef struct shape {\n    /* above */\n    int a;\n    int kind;\n    float b; /* beside; {x} */\n} shape;\n"
        entry = headers.items_of("#ifndef A_H\n#define A_H\n#ifdef X\nint hidden;\n#endif\n" + text + "#endif\n")[0]
        self.assertEqual(entry.lines, ["What it holds.", "  kind  a sum"])
        self.assertEqual(headers.name_of(entry.declarations[0]), ("shape", "struct"))
        self.assertEqual(headers.members_of(entry.declarations[0], {}), [["int a", ["above"]], ["int kind", None], ["float b", ["beside; {x}"]]])
        self.assertEqual(headers.rows_of('#define L(X) \\\n X(OK, 0, "a, b") \\\n X(NO, (1), "c")'), [["OK", "0", '"a, b"'], ["NO", "(1)", '"c"']])
        self.assertEqual(headers.name_of("typedef uint32_t shape_flags; /* a sum of: */"), ("shape_flags", "type"))
        reference = headers.Reference(glob.glob(f"{SOURCE}/include/burnish/*.h"))
        self.assertGreater(sum(reference.page(header).count("\n### ") for header in reference.headers), 150)
        self.assertEqual(headers.signature("BURNISH_API int f( int a );"), "int f(int a );")


unittest.main(verbosity=0)
