"""Mesh, read and write of the Python package."""

import gc
import weakref

import numpy as np

import winslow
from support import ASSETS, DATA, PackageTest, cube, main, ring, ring_arrays


class Reading(PackageTest):
    def test_mesh_of_a_file(self):
        mesh = winslow.read(ASSETS / "naca0012.su2")
        self.assertEqual((mesh.kind, mesh.dimension, mesh.cell_dimension), ("plane", 2, 2))
        self.assertEqual((mesh.node_count, mesh.element_count), (4774, 9388))
        self.assertEqual(mesh.points.shape, (4774, 2))
        self.assertEqual(mesh.cells["triangle"].shape, (9388, 3))
        self.assertEqual({name: len(nodes) for name, nodes in mesh.markers.items()}, {"airfoil": 108, "farfield": 52})
        self.assertEqual(mesh.faces["airfoil"]["line"].shape, (108, 2))
        for text in ("4774 nodes", "9388 triangles", "airfoil (108 nodes)", "plane mesh"):
            self.assertIn(text, repr(mesh))

    def test_numbers_are_those_of_the_file(self):
        lines = iter((ASSETS / "coarse" / "naca0012.su2").read_text().splitlines())
        for line in lines:
            if line.startswith("NPOIN"):
                break
        mesh = winslow.read(ASSETS / "coarse" / "naca0012.su2")
        expected = np.array([[float(word) for word in next(lines).split()[:2]] for _ in range(mesh.node_count)])
        self.assert_same(mesh.points, expected)

    def test_errors_say_where(self):
        path = self.folder / "bad.su2"
        path.write_text("NDIME= 2\nNELEM= 1\n5 0 1 x\n")
        with self.assertRaises(winslow.InputError) as raised:
            winslow.read(path)
        self.assertEqual((raised.exception.file, raised.exception.line), (str(path), 3))
        self.assertIsInstance(raised.exception, OSError)
        with self.assertRaises(winslow.InputError) as raised:
            winslow.read(self.folder / "none.su2")
        self.assertEqual(raised.exception.file, str(self.folder / "none.su2"))
        with self.assertRaisesRegex(winslow.UsageError, "zone"):
            winslow.read(ASSETS / "naca0012.su2", zone=7)

    def test_errors_of_binary_files(self):
        path = self.folder / "cut.msh"
        path.write_bytes((DATA / "square_41b.msh").read_bytes()[:200])
        with self.assertRaises(winslow.InputError) as raised:
            winslow.read(path)
        self.assertEqual(raised.exception.file, str(path))
        self.assertTrue(raised.exception.byte or raised.exception.line, str(raised.exception))

    def test_a_file_that_is_no_sound_mesh(self):
        path = self.folder / "twice.su2"
        path.write_text("NDIME= 2\nNELEM= 2\n5 0 1 2\n5 0 1 2\nNPOIN= 3\n0 0\n1 0\n0 1\nNMARK= 0\n")
        with self.assertRaisesRegex(winslow.InputError, "option repair mends it"):
            winslow.read(path)
        shown = winslow.read(path, show=True)
        self.assertEqual(winslow.quality(path)["elements"], shown.element_count)
        with self.assertRaisesRegex(winslow.UsageError, "repair=True"):
            winslow.smooth(shown)
        self.assertEqual(winslow.read(path, repair=True).element_count, 1)

    def test_warnings_are_issued_and_kept(self):
        path = self.folder / "loose.su2"
        path.write_text("NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 4\n0 0\n1 0\n0 1\n5 5\nNMARK= 1\nMARKER_TAG= wall\n"
                        "MARKER_ELEMS= 3\n3 0 1\n3 1 2\n3 2 0\n")
        with self.assertWarns(winslow.MeshWarning):
            mesh = winslow.read(path)
        self.assertTrue(mesh.warnings)
        self.assertIn(str(path), mesh.warnings[0])

    def test_a_volume_mesh_with_regions(self):
        mesh = winslow.read(DATA / "square_41.msh")
        self.assertEqual(list(mesh.regions), ["domain"])
        self.assertEqual(sorted(mesh.regions["domain"]), list(range(mesh.element_count)))
        both = np.concatenate([mesh.element_ids["triangle"], mesh.element_ids["quad"]])
        self.assertEqual(sorted(both), list(range(mesh.element_count)))


class Writing(PackageTest):
    def test_only_coordinates_change(self):
        text = ("% a comment\nNDIME= 2\nNELEM= 1\n5  0 1 2   0\nUNKNOWN= 7\nNPOIN= 3\n0 0 0\n1 0 1\n0 1 2\n"
                "NMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 3\n3 0 1\n3 1 2\n3 2 0\n")
        (self.folder / "source.su2").write_text(text)
        mesh = winslow.read(self.folder / "source.su2")
        self.assertEqual(winslow.write(mesh.with_points([[0, 0], [1.5, 0], [0, 1]]), self.folder / "moved.su2"), [])
        self.assertEqual((self.folder / "moved.su2").read_text().split(),
                         text.replace("1 0 1\n", "1.5 0 1\n").split())

    def test_the_input_is_not_written_over(self):
        path = self.folder / "ring.su2"
        winslow.write(ring(), path)
        mesh, before = winslow.read(path), path.read_bytes()
        with self.assertRaisesRegex(winslow.UsageError, "overwrite=True"):
            winslow.write(mesh.with_points(2 * mesh.points), path)
        self.assertEqual(path.read_bytes(), before)
        winslow.write(mesh.with_points(2 * mesh.points), path, overwrite=True)
        self.assert_same(winslow.read(path).points, 2 * mesh.points)

    def test_bad_targets(self):
        with self.assertRaisesRegex(winslow.UsageError, "unknown file format"):
            winslow.write(ring(), self.folder / "a.xyz")
        with self.assertRaises(winslow.OutputError) as raised:
            winslow.write(ring(), self.folder / "none" / "a.su2")
        self.assertIsInstance(raised.exception, OSError)

    def test_convert_to_every_text_format_and_back(self):
        mesh = ring()
        for name in ("a.msh", "a.vtu", "a.vtk", "a.cgns", "a.mesh"):
            with self.subTest(name):
                winslow.write(mesh, self.folder / name)
                winslow.convert(self.folder / name, self.folder / f"{name}.su2")
                back = winslow.read(self.folder / f"{name}.su2")
                self.assert_same(back.points, mesh.points)
                self.assertEqual(list(back.markers), ["body", "farfield"])


class Arrays(PackageTest):
    def test_points_are_a_view_without_a_copy(self):
        mesh = ring()
        address = mesh.points.__array_interface__["data"]
        self.assertEqual(address, mesh.points.__array_interface__["data"])
        self.assertTrue(address[1], "read-only")
        self.assertFalse(mesh.points.flags.owndata)
        self.assertIs(mesh.points.base, mesh)
        with self.assertRaises(ValueError):
            mesh.points[0, 0] = 1
        copy = mesh.copy_points()
        self.assertTrue(copy.flags.writeable)
        self.assertNotEqual(copy.__array_interface__["data"][0], address[0])
        copy[:] = 0
        self.assertNotEqual(mesh.points[0, 0], 0)

    def test_an_array_keeps_its_mesh_alive(self):
        points = ring().points
        gc.collect()
        self.assert_same(points, ring_arrays()[0])

    def test_with_points(self):
        mesh = ring()
        moved = mesh.with_points(mesh.points + 1)
        self.assertTrue(moved.has_connectivity_of(mesh))
        self.assertFalse(ring().has_connectivity_of(mesh))
        self.assert_same(moved.points, mesh.points + 1)
        self.assert_same(mesh.points, ring_arrays()[0])
        self.assert_same(mesh.with_points(np.asfortranarray(mesh.points)).points, mesh.points)
        short = mesh.points.astype(np.float32)
        self.assert_same(mesh.with_points(short).points, short.astype(float))
        for wrong, text in ((mesh.points[:5], "shape"), (np.zeros((mesh.node_count, 3)), "shape"), ("abc", "str"),
                            (np.full_like(mesh.points, np.nan), "not finite")):
            with self.assertRaisesRegex(winslow.UsageError, text):
                mesh.with_points(wrong)

    def test_a_mesh_from_arrays(self):
        points, cells, markers = ring_arrays()
        mesh = winslow.Mesh(points, cells, markers)
        self.assert_same(mesh.points, points)
        self.assert_same(mesh.cells["triangle"], cells["triangle"].astype(np.int32))
        self.assert_same(mesh.faces["body"]["line"], markers["body"].astype(np.int32))
        self.assertIsNone(mesh.path)
        self.assertEqual(mesh.warnings, [])

    def test_a_volume_mesh_from_arrays(self):
        mesh = cube()
        self.assertEqual((mesh.kind, mesh.node_count, mesh.element_count), ("volume", 64, 27))
        self.assertEqual(mesh.faces["bottom"]["quad"].shape, (9, 4))
        self.assertEqual(len(mesh.markers["bottom"]), 16)

    def test_polygons_and_polyhedra(self):
        points = np.array([[0, 0], [1, 0], [2, 0], [2, 1], [1, 1.5], [0, 1.0]])
        mesh = winslow.Mesh(points, [("polygon", [[0, 1, 4, 5, ][:4], [1, 2, 3, 4]])])
        self.assertEqual(mesh.element_count, 2)
        tetra = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
        faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
        mesh = winslow.Mesh(tetra, [("polyhedron4", [faces])])
        cells, offsets, nodes = mesh.cells["polyhedron"]
        self.assertEqual((list(cells), list(offsets)), ([0, 4], [0, 3, 6, 9, 12]))
        self.assertEqual({frozenset(nodes[a:a + 3]) for a in range(0, 12, 3)}, {frozenset(f) for f in faces})
        again = winslow.Mesh(tetra, {"polyhedron": (cells, offsets, nodes)})
        self.assertEqual(again.element_count, 1)

    def test_arrays_that_are_no_mesh(self):
        points = [[0, 0], [1, 0], [1, 1], [0, 1.0]]
        with self.assertRaises(winslow.MeshError) as raised:
            winslow.Mesh(points, {"triangle": [[0, 1, 2], [0, 2, 9]]})
        self.assertEqual((raised.exception.elements, raised.exception.index), ([1], 1))
        self.assertIsInstance(raised.exception, ValueError)
        with self.assertRaises(winslow.MeshError) as raised:
            winslow.Mesh([[0, 0], [1, 0], [np.nan, 1]], {"triangle": [[0, 1, 2]]})
        self.assertEqual(raised.exception.nodes, [2])
        for arguments, text in (((points, {"triangle": [[0, 1]]}), "elements, 3"),
                                ((points, {"triangle": [[0.5, 1, 2]]}), "whole numbers"),
                                ((points, {"triangle6": [[0] * 6]}), "first order"),
                                ((points, 5), None),
                                (([0, 1, 2], {"triangle": [[0, 1, 2]]}), "shape"),
                                ((points, {"triangle": [[0, 1, 2**40]]}), "too large"),
                                ((points, {"polygon": (np.array([0, 9]), np.array([0, 1, 2]))}), "offsets"),
                                ((points, {"triangle": [[0, 1, 2]]}, None, {"a": [7]}), "element 7")):
            with self.subTest(arguments):
                with self.assertRaisesRegex((winslow.UsageError, TypeError), text or ""):
                    winslow.Mesh(*arguments)

    def test_a_mesh_is_freed(self):
        mesh = ring()
        mesh.cells, mesh.markers, mesh.faces
        array = mesh.points
        gone = weakref.ref(array)
        del mesh, array
        gc.collect()
        self.assertIsNone(gone())


if __name__ == "__main__":
    main()
