"""Writes SU2 mesh files."""
KIND = {3: 5, 4: 9}


def write_su2(path, xyz, elements, marks):
    out = ["NDIME= 2", f"NELEM= {len(elements)}"]
    out += [f"{KIND[len(e)]} {' '.join(map(str, e))} {k}" for k, e in enumerate(elements)]
    out.append(f"NPOIN= {len(xyz)}")
    out += [f"{x:.17g} {y:.17g} {k}" for k, (x, y) in enumerate(xyz)]
    out.append(f"NMARK= {len(marks)}")
    for name, edges in marks.items():
        out += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(edges)}"]
        out += [f"3 {a} {b}" for a, b in edges]
    path.write_text("\n".join(out) + "\n")
