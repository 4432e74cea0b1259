"""Meshes of meshio and of pyvista, and plain arrays: there and back.

pyvista is no package of Debian. `Grid` stands in for `pyvista.UnstructuredGrid`: it has the same constructor
and attributes, with the arrays of VTK's layout.
"""

import pickle

import meshio
import numpy as np

import winslow
from winslow.foreign import vtk_arrays
from support import DATA, PackageTest, cube, main, ring, ring_arrays


class Grid:
    """Stands in for pyvista.UnstructuredGrid."""

    def __init__(self, cells, celltypes, points):
        self.cells, self.celltypes, self.points = np.asarray(cells), np.asarray(celltypes), np.asarray(points)
        self.point_data, self.cell_data, self.field_data = {}, {}, {}


class Meshio(PackageTest):
    def assert_meshio(self, a, b):
        self.assert_same(a.points, b.points)
        self.assertEqual([c.type for c in a.cells], [c.type for c in b.cells])
        for c, d in zip(a.cells, b.cells):
            if c.type.startswith("polyhedron"):
                self.assertEqual([list(map(list, cell)) for cell in c.data], [list(map(list, cell)) for cell in d.data])
            else:
                self.assert_same(c.data, d.data)
        for name in ("point_data", "cell_data", "field_data", "cell_sets", "point_sets"):
            one, other = getattr(a, name), getattr(b, name)
            self.assertEqual(list(one), list(other), name)
            for key in one:
                parts = zip(one[key], other[key]) if name in ("cell_data", "cell_sets") else [(one[key], other[key])]
                for p, q in parts:
                    self.assert_same(p, q)

    def meshio_ring(self):
        points, cells, edges = ring_arrays()
        random = np.random.default_rng(2)
        triangles = cells["triangle"].copy()
        triangles[::3] = triangles[::3, [0, 2, 1]]  # turned the other way
        half = len(triangles) // 2
        blocks = [("triangle", triangles[:half]), ("line", edges["body"]), ("triangle", triangles[half:]),
                  ("line", edges["farfield"])]
        sets = {"body": [np.zeros(0, int), np.arange(24), np.zeros(0, int), np.zeros(0, int)],
                "farfield": [np.zeros(0, int), np.zeros(0, int), np.zeros(0, int), np.arange(24)],
                "inner": [np.arange(half), np.zeros(0, int), np.zeros(0, int), np.zeros(0, int)],
                "some": [np.array([1, 5]), np.zeros(0, int), np.array([2]), np.array([3])]}
        return meshio.Mesh(np.column_stack([points, np.full(len(points), 2.5)]), blocks,
                           point_data={"p": random.random(len(points)), "v": random.random((len(points), 3))},
                           cell_data={"t": [random.random(len(c)) for _, c in blocks]}, cell_sets=sets)

    def test_round_trip(self):
        given = self.meshio_ring()
        mesh = winslow.from_meshio(given)
        self.assertEqual((mesh.kind, list(mesh.markers)), ("plane", ["body", "farfield", "some"]))
        self.assertEqual(list(mesh.regions), ["inner"])  # "some" overlaps it, so it is a set alone
        self.assert_meshio(mesh.to_meshio(), given)

    def test_round_trip_of_a_motion(self):
        given = self.meshio_ring()
        result = winslow.move(given, "body", rotate=30)
        back = result.mesh.to_meshio()
        self.assert_same(back.points[:, :2], result.mesh.points)
        self.assert_same(back.points[:, 2], given.points[:, 2])
        given.points = back.points
        self.assert_meshio(back, given)

    def test_files_of_meshio(self):
        for name in ("square_41.msh", "square_22.msh", "square.vtu", "square.vtk", "periodic_41.msh"):
            with self.subTest(name):
                given = meshio.read(DATA / name)
                mesh = winslow.from_meshio(given)
                own = winslow.read(DATA / name)
                self.assert_same(mesh.points, own.points)
                self.assertEqual(mesh.element_count, own.element_count)
                self.assert_meshio(mesh.to_meshio(), given)
        self.assertEqual(set(winslow.from_meshio(meshio.read(DATA / "square_41.msh")).markers), {"lower", "upper"})

    def test_from_winslow_alone(self):
        for mesh in (ring(), cube(), winslow.read(DATA / "square_41.msh")):
            back = winslow.from_meshio(mesh.to_meshio())
            self.assert_same(back.points, mesh.points)
            self.assertEqual(list(back.markers), list(mesh.markers))
            self.assertEqual(list(back.regions), list(mesh.regions))
            for name in mesh.markers:
                self.assert_same(back.markers[name], mesh.markers[name])
            for kind in mesh.cells:
                self.assert_same(back.cells[kind], mesh.cells[kind])
                self.assert_same(back.element_ids[kind], mesh.element_ids[kind])

    def test_what_meshio_writes_is_read(self):
        mesh = cube()
        mesh.to_meshio().write(self.folder / "cube.vtu")
        back = winslow.read(self.folder / "cube.vtu")
        self.assert_same(back.points, mesh.points)
        self.assertEqual(back.element_count, 27)

    def test_polyhedra_and_polygons(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
        faces = [np.array(f) for f in ([0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3])]
        given = meshio.Mesh(points, [("polyhedron4", [faces])])
        mesh = winslow.from_meshio(given)
        self.assertEqual(list(mesh.cells), ["polyhedron"])
        self.assert_meshio(mesh.to_meshio(), given)
        flat = np.array([[0, 0], [1, 0], [1.3, 1], [0.5, 1.6], [-0.3, 1.0]])
        given = meshio.Mesh(flat, [("polygon", np.array([[0, 1, 2, 3, 4]]))])
        mesh = winslow.from_meshio(given)
        self.assertEqual(list(mesh.cells), ["polygon"])
        self.assert_meshio(mesh.to_meshio(), given)

    def test_second_order_is_refused(self):
        given = meshio.Mesh(np.zeros((6, 2)), [("triangle6", np.arange(6).reshape(1, 6))])
        with self.assertRaisesRegex(winslow.UsageError, "first order"):
            winslow.from_meshio(given)


class Arrays(PackageTest):
    def test_pickle(self):
        foreign = winslow.from_meshio(meshio.read(DATA / "square.vtu"))
        for mesh in (ring(), cube(), winslow.read(DATA / "square_41.msh"), foreign):
            back = pickle.loads(pickle.dumps(mesh))
            self.assert_same(back.points, mesh.points)
            self.assertEqual(repr(back), repr(mesh))
            for kind in mesh.cells:
                self.assert_same(back.cells[kind], mesh.cells[kind])
                self.assert_same(back.element_ids[kind], mesh.element_ids[kind])

    def test_points_cells_and_sets(self):
        points, cells, edges = ring_arrays()
        blocks = [("triangle", cells["triangle"]), ("line", np.concatenate(list(edges.values())))]
        sets = {"body": [None, np.arange(24)], "farfield": [None, np.arange(24, 48)]}
        result = winslow.move((points, blocks, sets), "body", rotate=10)
        self.assert_same(result.mesh.points, winslow.move(ring(), "body", rotate=10).mesh.points)
        with self.assertRaisesRegex(winslow.UsageError, "beyond the 48 cells"):
            winslow.Mesh(points, blocks, {"body": [None, np.array([48])]})

    def test_markers_in_several_forms(self):
        points, cells, edges = ring_arrays()
        for form in (edges["body"], edges["body"].tolist(), [edges["body"][:5], edges["body"][5:]],
                     {"line": edges["body"]}):
            mesh = winslow.Mesh(points, cells, {"body": form, "farfield": edges["farfield"]})
            self.assert_same(mesh.faces["body"]["line"], ring().faces["body"]["line"])


class Pyvista(PackageTest):
    def grid(self):
        """Triangles, quadrilaterals of VTK's type pixel, and lines with markers as winslow writes them."""
        points = np.array([[i, j, 0] for j in range(3) for i in range(3)], float) / 2
        cells = [3, 0, 1, 4, 3, 0, 4, 3, 4, 1, 2, 4, 5, 4, 3, 4, 7, 6, 4, 4, 5, 8, 7, 2, 0, 1, 2, 1, 2, 2, 6, 3]
        grid = Grid(cells, np.array([5, 5, 8, 9, 9, 3, 3, 3], np.uint8), points)
        grid.cell_data["marker"] = np.array([0, 0, 0, 0, 0, 7, 7, 9])
        grid.cell_data["region"] = np.array([1, 1, 2, 2, 2, 0, 0, 0])
        grid.cell_data["heat"] = np.linspace(0, 1, 8)
        grid.point_data["p"] = np.arange(9.0)
        grid.field_data.update({"marker:low": np.array([7]), "region:a": np.array([1])})
        return grid

    def test_markers_and_regions(self):
        mesh = winslow.from_pyvista(self.grid())
        self.assertEqual((mesh.node_count, mesh.element_count, mesh.kind), (9, 5, "plane"))
        self.assertEqual({name: list(nodes) for name, nodes in mesh.markers.items()},
                         {"low": [0, 1, 2], "marker_9": [3, 6]})
        self.assertEqual({name: list(ids) for name, ids in mesh.regions.items()}, {"a": [0, 1], "region_2": [2, 3, 4]})
        self.assertEqual(winslow.quality(mesh).inverted, 0)

    def test_round_trip(self):
        given = self.grid()
        back = winslow.from_pyvista(given).to_pyvista()
        self.assertIsInstance(back, Grid)
        for name in ("cells", "celltypes", "points"):
            self.assert_same(getattr(back, name), getattr(given, name))
        for name in ("point_data", "cell_data", "field_data"):
            self.assertEqual(list(getattr(back, name)), list(getattr(given, name)))
            for key, value in getattr(given, name).items():
                self.assert_same(getattr(back, name)[key], value)

    def test_commands_take_grids(self):
        given = self.grid()
        given.points[4, :2] += 0.1
        result = winslow.smooth(given, interfaces="free")
        back = result.mesh.to_pyvista()
        self.assert_same(back.points[:, :2], result.mesh.points)
        self.assert_same(back.points[:, 2], given.points[:, 2])
        self.assertNotEqual(back.points[4, 0], given.points[4, 0])

    def test_volumes_in_vtk_layout(self):
        tetra = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
        stream = [16 + 1, 4, 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3]
        given = Grid(stream, [42], tetra)
        mesh = winslow.from_pyvista(given)
        self.assertEqual(list(mesh.cells), ["polyhedron"])
        self.assert_same(mesh.to_pyvista().cells, given.cells)
        mesh = cube(2)
        cells, types, points = vtk_arrays(mesh)
        self.assertEqual(set(types), {12})
        back = winslow.from_pyvista(Grid(cells, types, points))
        self.assert_same(back.cells["hexahedron"], mesh.cells["hexahedron"])

    def test_a_stream_that_is_none(self):
        for cells, types in (([3, 0, 1], [5]), ([4, 0, 1, 2, 3], [5]), ([7, 0, 1, 2], [7])):
            with self.assertRaisesRegex(winslow.UsageError, "VTK's layout"):
                winslow.from_pyvista(Grid(cells, types, np.eye(3)))

    def test_polygons(self):
        flat = np.array([[0, 0, 0], [1, 0, 0], [1.3, 1, 0], [0.5, 1.6, 0], [-0.3, 1, 0], [0.5, -1, 0]])
        given = Grid([5, 0, 1, 2, 3, 4, 3, 0, 5, 1], [7, 5], flat)
        mesh = winslow.from_pyvista(given)
        self.assertEqual(sorted(mesh.cells), ["polygon", "triangle"])
        cells, types, _ = vtk_arrays(mesh)
        self.assertEqual((list(cells), list(types)), (list(given.cells), list(given.celltypes)))

    def test_other_types_are_refused(self):
        with self.assertRaisesRegex(winslow.UsageError, "type 22"):
            winslow.from_pyvista(Grid([6, 0, 1, 2, 3, 4, 5], [22], np.zeros((6, 3))))


if __name__ == "__main__":
    main()
