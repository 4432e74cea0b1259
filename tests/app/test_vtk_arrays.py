"""Arrays, cells and regions of VTK files: what comes in goes out."""

import math
import struct
import subprocess
import unittest

from support import INPUT, USAGE, ProgramTest
from vtk_files import VtuReader, VtuWriter, array, read_legacy

CELLS = 5
INSIDE = '\n<InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2"><Value index="0">0</Value>' \
         '</InformationKey>\n'


def square(lines=False, mixed=False):
    """A square of shaken triangles, its lower part another material. With `lines`, its lower side, a polyline
    and a vertex are cells of their own between the triangles."""
    def node(i, j):
        return j * (CELLS + 1) + i

    points, cells, types, material = [], [], [], []
    for j in range(CELLS + 1):
        for i in range(CELLS + 1):
            inside = 0 < i < CELLS and 0 < j < CELLS
            shake = 0.25 / CELLS * math.sin(7 * i + 3 * j) if inside else 0
            points += [i / CELLS + shake, j / CELLS + (0 if j == 2 else shake), 0]
    if lines:
        cells += [[node(0, 0)], [node(i, CELLS) for i in range(CELLS + 1)]]
        types += [1, 4]
        material += [0, 0]
    for j in range(CELLS):
        for i in range(CELLS):
            a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
            if mixed and i < 2:
                corners = [[a, b, d, c]] if i == 0 else [[a, b, c, d]]
                types += [8] if i == 0 else [7]
            else:
                corners = [[a, b, c], [a, c, d]]
                types += [5, 5]
            cells += corners
            material += [int(j >= 2)] * len(corners)
        if lines:
            cells.append([node(j, 0), node(j + 1, 0)])
            types.append(3)
            material.append(0)
    offsets = []
    for cell in cells:
        offsets.append((offsets[-1] if offsets else 0) + len(cell))
    return {"points": points, "connectivity": [n for c in cells for n in c], "offsets": offsets, "types": types,
            "point": [], "cell": [], "field": [], "material": material}


def block():
    """A bar of shaken cubes, half of them wedges, in two materials."""
    def node(i, j, k):
        return (k * 4 + j) * 4 + i

    points, cells, types, material = [], [], [], []
    for k in range(4):
        for j in range(4):
            for i in range(4):
                shake = 0.12 * math.sin(5 * i + 3 * j + 7 * k) if 0 < min(i, j, k) and max(i, j, k) < 3 else 0
                points += [i + shake, j + shake, k - shake]
    for k in range(3):
        for j in range(3):
            for i in range(3):
                low = [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]
                high = [n + 16 for n in low]
                if i == 1:
                    cells += [[low[0], low[2], low[1], high[0], high[2], high[1]],
                              [low[0], low[3], low[2], high[0], high[3], high[2]]]
                    types += [13, 13]
                else:
                    cells.append(low + high)
                    types.append(12)
                material += [7 if i == 0 else 3] * (2 if i == 1 else 1)
    offsets = []
    for cell in cells:
        offsets.append((offsets[-1] if offsets else 0) + len(cell))
    return {"points": points, "connectivity": [n for c in cells for n in c], "offsets": offsets, "types": types,
            "point": [], "cell": [], "field": [], "material": material}


def vectors(grid, kind, components, name):
    nodes = len(grid["points"]) // 3
    return array(name, kind, [math.sin(k * 1.7) * 10 ** (k % 40 - 20) for k in range(nodes * components)], components)


def numbered(grid, name, kind="Int64", factor=1):
    return array(name, kind, [factor * k for k in range(len(grid["types"]))])


def grid_with(grid, point=(), cell=(), field=()):
    return {**grid, "point": list(point), "cell": list(cell), "field": list(field)}


def variants():
    """Name, writer and grid of the files that programs write."""
    g, m, b = square(), square(lines=True, mixed=True), block()
    material = g["material"]
    ends = array("limits", "Float64", [0.1] * len(material))
    every = []
    for kind, low, high in (("Int8", -128, 127), ("UInt8", 0, 255), ("Int16", -32768, 32767), ("UInt16", 0, 65535),
                            ("Int32", -2 ** 31, 2 ** 31 - 1), ("UInt32", 0, 2 ** 32 - 1),
                            ("Int64", -2 ** 63, 2 ** 63 - 1), ("UInt64", 0, 2 ** 64 - 1)):
        every.append(array(kind, kind, [low if k % 2 else high for k in range(len(material))]))
    special = [float("nan"), float("inf"), -float("inf"), -0.0, 5e-324, 1.7976931348623157e308]
    odd = array("special", "Float64", (special * len(material))[:len(material)])
    odd_single = array("single", "Float32", ([float("nan"), -0.0, 1e-45, 3.4028234663852886e38, float("-inf")]
                                             * len(material))[:len(material)])
    gauss = array("IntegrationPointMetaData", "Int8", [ord(c) for c in '{"integration_point_arrays":[]}'])
    text = ("title", "String", 1, "Rock & sand <of> ".encode() + b"\0" + "Größe".encode() + b"\0")
    return [
        ("FEniCS mesh function, text", VtuWriter(ids="UInt32"),
         grid_with(g, cell=[array("f", "UInt32", material)])),
        ("FEniCS function, base64 zlib",
         VtuWriter("binary", True, ids="UInt32", attributes={"point": {"Vectors": "u"}}),
         grid_with(g, [vectors(g, "Float64", 3, "u")], [array("subdomains", "UInt64", material)])),
        ("DOLFINx, Float32", VtuWriter("binary", points="Float32", ids="Int32"),
         grid_with(g, [vectors(g, "Float32", 1, "p")], [array("cell_tags", "Int32", material)])),
        ("OpenGeoSys, appended raw", VtuWriter("raw", header="UInt64", version="1.0"),
         grid_with(g, [vectors(g, "Float64", 2, "displacement"), array("bulk_node_ids", "UInt64",
                                                                       list(range(len(g["points"]) // 3)))],
                   [array("MaterialIDs", "Int32", material), vectors({"points": [0] * 3 * len(material)}, "Float64", 4,
                                                                     "sigma")], [gauss])),
        ("OpenGeoSys, appended base64 zlib", VtuWriter("base64", True, version="0.1"),
         grid_with(g, [], [array("MaterialIDs", "Int32", material)], [gauss])),
        ("OpenGeoSys of old", VtuWriter(), grid_with(g, [], [array("MaterialID", "Int32", material)])),
        ("ParaView, appended raw zlib", VtuWriter("raw", True, "UInt64", version="2.2", block=64,
                                                  inside={"velocity": INSIDE}, before="<!-- from ParaView -->\n",
                                                  attributes={"point": {"Scalars": "p", "Vectors": "velocity"},
                                                              "cell": {"GlobalIds": "ids"}}),
         grid_with(g, [vectors(g, "Float64", 1, "p"), vectors(g, "Float64", 3, "velocity")],
                   [array("material", "Float64", material), numbered(g, "ids")],
                   [array("TimeValue", "Float64", [0.1]), text])),
        ("ParaView, text", VtuWriter("ascii", version="1.0", inside={"velocity": INSIDE}),
         grid_with(g, [vectors(g, "Float32", 3, "velocity")], [array("region", "Int16", material)],
                   [text, array("CYCLE", "Int32", [7])])),
        ("ParaView, appended base64", VtuWriter("base64", header="UInt64"),
         grid_with(g, [vectors(g, "Float64", 9, "gradient")], [array("attribute", "Int32", material), ends])),
        ("VTK on another machine, appended raw", VtuWriter("raw", big=True),
         grid_with(g, [vectors(g, "Float32", 3, "u")], [array("materials", "Int16", material), *every])),
        ("VTK on another machine, base64 zlib", VtuWriter("binary", True, "UInt64", big=True, block=100),
         grid_with(g, [vectors(g, "Float64", 3, "u")], [array("MaterialIDs", "Int64", material), *every])),
        ("every type of integer, text", VtuWriter(), grid_with(g, [], every)),
        ("every type of integer, raw", VtuWriter("raw"), grid_with(g, [], every)),
        ("numbers that are none, raw", VtuWriter("raw"), grid_with(g, [], [odd, odd_single])),
        ("numbers that are none, base64", VtuWriter("binary"), grid_with(g, [], [odd_single, odd])),
        ("meshio, gmsh:physical", VtuWriter("binary", True, "UInt32", ids="Int64", types="Int64"),
         grid_with(m, [], [array("gmsh:physical", "Int64", [k + 1 for k in m["material"]]),
                           array("gmsh:geometrical", "Int64", [k + 5 for k in m["material"]])])),
        ("meshio, medit:ref, text", VtuWriter(types="Int32"),
         grid_with(m, [vectors(m, "Float64", 1, "medit:ref")], [array("medit:ref", "Int64", m["material"])])),
        ("polylines, pixels and polygons, raw", VtuWriter("raw", True, ids="Int32"),
         grid_with(m, [vectors(m, "Float64", 3, "v")],
                   [array("region", "Int32", m["material"]), numbered(m, "order")])),
        ("names that need care", VtuWriter(),
         grid_with(g, [vectors(g, "Float64", 1, 'a "quoted" & <tagged> name'), vectors(g, "Float64", 1, "")],
                   [numbered(g, "Größe [m/s]"), numbered(g, "same"), numbered(g, "same", "UInt8")])),
        ("wedges and hexahedra, raw", VtuWriter("raw", header="UInt64"),
         grid_with(b, [vectors(b, "Float64", 3, "U")], [array("MaterialIDs", "Int32", b["material"]),
                                                        numbered(b, "cells", "UInt16")])),
        ("wedges and hexahedra, text", VtuWriter(),
         grid_with(b, [vectors(b, "Float32", 6, "stress")], [array("CellEntityIds", "Int32", b["material"])])),
        ("no regions, an empty array", VtuWriter("raw"), grid_with(g, [], [], [array("nothing", "Float64", [])])),
    ]


class Arrays(ProgramTest):
    def compare(self, before, after):
        for part in ("point", "cell", "field", "connectivity", "offsets", "types"):
            self.assertEqual(after[part], before[part], part)
        for part in ("point active", "cell active"):
            self.assertEqual(after[part], before[part])
        self.assertEqual(len(after["points"][3]), 24 * before_nodes(before))

    def test_files_of_many_programs_keep_every_array_byte_for_byte(self):
        for name, writer, grid in variants():
            for flags in ([], ["--ascii"], ["--binary"]):
                if "none" in name and flags == ["--ascii"]:
                    continue  # text says nan without its bits
                with self.subTest(name, flags=flags):
                    writer.write(self.path("in.vtu"), grid)
                    before = VtuReader(self.path("in.vtu")).grid()
                    run = self.winslow("smooth", "in.vtu", "-o", "out.vtu", *flags)
                    self.assertNotIn("not written", run.stderr)
                    self.assertNotIn("not kept", run.stderr)
                    after = VtuReader(self.path("out.vtu")).grid()
                    self.compare(before, after)
                    self.assertNotEqual(after["points"], before["points"])
                    # The reader of this test is checked, too: the arrays are those that were meant.
                    self.assertEqual([a[:3] for a in before["cell"]], [a[:3] for a in grid["cell"]])
                    self.assertEqual(before["point"] + before["cell"] + before["field"],
                                     grid["point"] + grid["cell"] + grid["field"])

    def test_information_keys_stay_with_their_arrays(self):
        name, writer, grid = next(v for v in variants() if v[0].startswith("ParaView, appended raw"))
        writer.write(self.path("in.vtu"), grid)
        self.winslow("smooth", "in.vtu", "-o", "out.vtu")
        text = self.path("out.vtu").read_bytes()
        self.assertEqual(text.count(b"<InformationKey"), 1, name)
        self.assertIn(b'length="2"', text)

    def test_meshio_reads_the_same_arrays_before_and_after(self):
        from_debian = "/usr/bin/python3"
        script = ("import sys, meshio, numpy\n"
                  "a, b = meshio.read('in.vtu'), meshio.read('out.vtu')\n"
                  "for part in ('point_data', 'cell_data'):\n"
                  "    x, y = getattr(a, part), getattr(b, part)\n"
                  "    assert list(x) == list(y), (list(x), list(y))\n"
                  "    for k in x:\n"
                  "        for p, q in zip(*[[v] if part == 'point_data' else v for v in (x[k], y[k])]):\n"
                  "            assert p.dtype == q.dtype and p.shape == q.shape and p.tobytes() == q.tobytes(), k\n"
                  "assert [c.type for c in a.cells] == [c.type for c in b.cells]\n")
        found = subprocess.run([from_debian, "-c", "import meshio"], capture_output=True, check=False)
        if found.returncode != 0:
            self.skipTest("needs meshio")
        write = ("import meshio, numpy\n"
                 "n = numpy.arange(36.).reshape(-1, 1)\n"
                 "p = numpy.hstack([n % 6, n // 6, 0 * n])\n"
                 "p[14, 0] += .3\n"
                 "q = [[j * 6 + i, j * 6 + i + 1, j * 6 + i + 7, j * 6 + i + 6] for j in range(5) for i in range(5)]\n"
                 "mesh = meshio.Mesh(p, [('quad', q[:10]), ('triangle', [t for c in q[10:] for t in (c[:3], "
                 "[c[0], c[2], c[3]])])],\n"
                 "    point_data={'v': numpy.random.rand(36, 3), 's': numpy.arange(36, dtype='float32')},\n"
                 "    cell_data={'material': [numpy.ones(10, int), numpy.full(30, 2)], 'T': [numpy.random.rand(10), "
                 "numpy.random.rand(30)]})\n"
                 "mesh.write('in.vtu', binary=BINARY)\n")
        for binary in (True, False):
            with self.subTest(binary=binary):
                subprocess.run([from_debian, "-c", write.replace("BINARY", str(binary))], cwd=self.folder, check=True)
                run = self.winslow("smooth", "in.vtu", "-o", "out.vtu")
                self.assertIn("2 regions, by the cell array material", run.stdout)
                subprocess.run([from_debian, "-c", script], cwd=self.folder, check=True)

    def test_data_that_a_format_cannot_hold_are_named(self):
        grid = grid_with(square(), [vectors(square(), "Float64", 3, "U")], [array("p", "Float64", [0.5] * 50)])
        VtuWriter("raw").write(self.path("in.vtu"), grid)
        run = self.winslow("convert", "in.vtu", "out.su2")
        self.assertIn("out.su2: data on points, cells and the field are not written: U, p", run.stderr)
        self.assertEqual(self.winslow("quality", "in.vtu").stderr.count("not written"), 0)

    def test_damaged_arrays_are_refused_with_their_place(self):
        grid = grid_with(square(), [], [array("T", "Float64", [1.5] * 50)])
        VtuWriter().write(self.path("in.vtu"), grid)
        text = self.path("in.vtu").read_text()
        for wrong, said in (("1.5 1.5 x.5", "found 'x.5', expected a value of the type Float64 in array 'T'"),
                            ("1.5 1.5", "found 49 values in array 'T', expected 50 times 1")):
            self.path("bad.vtu").write_text(text.replace("1.5 1.5 1.5", wrong, 1))
            self.assertIn(said, self.winslow("quality", "bad.vtu", code=INPUT).stderr)


def before_nodes(grid):
    return len(grid["points"][3]) // 3 // (4 if grid["points"][1] == "Float32" else 8)


LEGACY_DATA = """CELL_DATA {cells}
SCALARS CellEntityIds int 1
LOOKUP_TABLE default
{ids}
FIELD attributes 2
T%20of%20cells 2 {cells} double
{pairs}
METADATA
INFORMATION 1
NAME L2_NORM_RANGE LOCATION vtkDataArray
DATA 2 0 1

names 1 {cells} string
{names}
POINT_DATA 36
VECTORS velocity float
{vectors}
LOOKUP_TABLE mine 2
0 0 0 1
1 1 0.5 1
NORMALS n float
{vectors}
TENSORS grad double
{tensors}
TEXTURE_COORDINATES tc 2 float
{pairs36}
COLOR_SCALARS colours 3
{colours}
GLOBAL_IDS ids vtkIdType
{points}
"""


class LegacyFiles(ProgramTest):
    def write(self, name):
        grid = square()
        lines = ["# vtk DataFile Version 4.2", "of a test", "ASCII", "DATASET UNSTRUCTURED_GRID", "POINTS 36 double"]
        lines += [" ".join(map(repr, grid["points"][k:k + 3])) for k in range(0, 108, 3)]
        lines.append("CELLS 50 200")
        lines += ["3 " + " ".join(map(str, grid["connectivity"][k:k + 3])) for k in range(0, 150, 3)]
        lines += ["CELL_TYPES 50", *["5"] * 50]
        numbers = [f"{math.sin(k):.17g}" for k in range(400)]
        lines.append(LEGACY_DATA.format(
            cells=50, ids="\n".join(str(k + 1) for k in grid["material"]),
            pairs="\n".join(numbers[:100]), names="\n".join(f"cell%20{k}" for k in range(50)),
            vectors="\n".join(numbers[:108]), tensors="\n".join(numbers[:324]), pairs36="\n".join(numbers[:72]),
            colours="\n".join(["0.25 0.5 1"] * 36), points="\n".join(map(str, range(36)))))
        self.path(name).write_text("\n".join(lines))

    def test_attributes_fields_metadata_and_lookup_tables_come_back(self):
        self.write("in.vtk")
        before = read_legacy(self.path("in.vtk"))
        run = self.winslow("smooth", "in.vtk", "-o", "out.vtk")
        self.assertIn("2 regions, by the cell array CellEntityIds", run.stdout)
        after = read_legacy(self.path("out.vtk"))
        for part in ("cell", "point", "cells", "types", "keywords"):
            self.assertEqual(after[part], before[part], part)
        self.assertIn("DATA 2 0 1\n\n", self.path("out.vtk").read_text())
        self.winslow("smooth", "in.vtk", "-o", "binary.vtk", "--binary")
        binary = read_legacy(self.path("binary.vtk"))
        colours = {"mine", "colours"}  # bytes in binary files
        for part in ("cell", "point"):
            self.assertEqual([a for a in binary[part] if a[0] not in colours],
                             [a for a in before[part] if a[0] not in colours])
        self.assertEqual([a[3] for a in binary["point"] if a[0] == "colours"], [bytes([64, 128, 255] * 36)])
        self.winslow("smooth", "binary.vtk", "-o", "again.vtk")
        self.assertEqual(read_legacy(self.path("again.vtk"))["point"], binary["point"])

    def test_arrays_cross_from_one_format_to_the_other(self):
        self.write("in.vtk")
        before = read_legacy(self.path("in.vtk"))
        run = self.winslow("convert", "in.vtk", "out.vtu")
        self.assertIn('the lookup table "mine" is not written', run.stderr)
        after = VtuReader(self.path("out.vtu")).grid()
        self.assertEqual(after["cell"], before["cell"])
        self.assertEqual(after["point"], [a for a in before["point"] if a[0] != "mine"])
        self.winslow("convert", "out.vtu", "back.vtk")
        back = read_legacy(self.path("back.vtk"))
        self.assertEqual(back["cell"], before["cell"])
        self.assertEqual(back["point"], after["point"])


class Regions(ProgramTest):
    def interfaces(self, arrays, *flags, writer=None):
        """The word about interfaces of a run on a square with such cell arrays."""
        (writer or VtuWriter()).write(self.path("in.vtu"), grid_with(square(), [], arrays))
        run = self.winslow("smooth", "in.vtu", "-o", "out.vtu", *flags)
        before, after = (VtuReader(self.path(n)).grid()["points"] for n in ("in.vtu", "out.vtu"))
        x = struct.unpack("<108d", before[3]), struct.unpack("<108d", after[3])
        held = [x[0][3 * k:3 * k + 3] == x[1][3 * k:3 * k + 3] for k in range(13, 17)]
        return run.stdout, all(held)

    def test_the_arrays_of_many_programs_hold_the_nodes_in_which_regions_meet(self):
        material = square()["material"]
        for name, kind in (("MaterialID", "Int32"), ("MaterialIDs", "Int64"), ("medit:ref", "Int64"),
                           ("gmsh:physical", "Int32"), ("gmsh:geometrical", "Int64"), ("CellEntityIds", "Int32"),
                           ("material", "Float64"), ("attribute", "Int32"), ("subdomains", "UInt64"), ("f", "UInt32"),
                           ("region", "Int8"), ("Regions", "UInt8")):
            with self.subTest(name):
                said, held = self.interfaces([array("T", "Float64", [0.5] * 50), array(name, kind, material)])
                self.assertTrue(held)
                self.assertIn("holds 4 nodes in which the regions", said)
                self.assertIn(f"by the cell array {name}", said)

    def test_numbers_that_are_no_regions_are_left_alone(self):
        material = square()["material"]
        for entry in (array("T", "Int32", material), array("material", "Float64", [k + 0.5 for k in material]),
                      array("f", "Float64", material), array("region", "Int32", material * 2, 2)):
            with self.subTest(entry[0]):
                said, held = self.interfaces([entry])
                self.assertFalse(held)
                self.assertNotIn("cell array", said)

    def test_groups_come_before_the_geometry(self):
        material = square()["material"]
        said, held = self.interfaces([array("gmsh:geometrical", "Int32", range(1, 51)),
                                      array("gmsh:physical", "Int32", [9] * 50)])
        self.assertFalse(held)
        self.assertIn("1 region, by the cell array gmsh:physical", said)
        said, held = self.interfaces([array("gmsh:physical", "Int32", [0] * 50),
                                      array("gmsh:geometrical", "Int32", [k + 1 for k in material])])
        self.assertTrue(held)
        self.assertIn("2 regions, by the cell array gmsh:geometrical", said)

    def test_an_option_names_another_array(self):
        material = square()["material"]
        arrays = [array("MaterialIDs", "Int32", [0] * 50), array("rock type", "Int16", material),
                  array("T", "Float64", [0.5] * 50)]
        self.assertFalse(self.interfaces(arrays)[1])
        said, held = self.interfaces(arrays, "--regions", "rock type", "--report", "r.json", "--save-recipe", "c.json")
        self.assertTrue(held)
        self.assertIn("2 regions, by the cell array rock type", said)
        self.assertEqual(self.json("r.json")["regions_array"], "rock type")
        self.assertEqual(self.json("r.json")["regions"],
                         [{"name": "region_0", "elements": 20}, {"name": "region_1", "elements": 30}])
        self.assertEqual(self.json("c.json")["regions"], "rock type")
        first = self.path("out.vtu").read_bytes()
        self.winslow("replay", "c.json", "-o", "again.vtu")
        self.assertEqual(self.path("again.vtu").read_bytes(), first)
        for name, code, word in (("none", USAGE, "the file has MaterialIDs, rock type, T"),
                                 ("T", INPUT, 'no integer in cell array "T" for this cell')):
            run = self.winslow("smooth", "in.vtu", "-o", "b.vtu", "--regions", name, code=code)
            self.assertIn(word, run.stderr)
        self.ring()
        run = self.winslow("quality", "ring.su2", "--regions", "x", code=USAGE)
        self.assertIn("SU2 files hold no arrays that could be regions", run.stderr)

    def test_regions_reach_other_formats(self):
        VtuWriter().write(self.path("in.vtu"), grid_with(square(), [], [array("MaterialIDs", "Int32",
                                                                             [k + 1 for k in square()["material"]])]))
        self.winslow("convert", "in.vtu", "out.msh")
        self.assertEqual(self.path("out.msh").read_text().count('"region_'), 2)


if __name__ == "__main__":
    unittest.main()
