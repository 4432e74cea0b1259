"""VTK files, read and written without the program: what its files are compared with.

An array is (name, type, components, bytes): the bytes are little-endian, whatever the file is. A grid is a dict of
points, connectivity, offsets and types, and of the lists of arrays point, cell and field.
"""

import base64
import re
import struct
import xml.etree.ElementTree as ElementTree
import zlib

CODES = {"Int8": "b", "UInt8": "B", "Int16": "h", "UInt16": "H", "Int32": "i", "UInt32": "I", "Int64": "q",
         "UInt64": "Q", "Float32": "f", "Float64": "d", "String": "b"}
LEGACY = {"char": "Int8", "signed_char": "Int8", "unsigned_char": "UInt8", "short": "Int16",
          "unsigned_short": "UInt16", "int": "Int32", "vtkIdType": "Int32", "unsigned_int": "UInt32",
          "vtktypeint64": "Int64", "long": "Int64", "vtktypeuint64": "UInt64", "unsigned_long": "UInt64",
          "float": "Float32", "double": "Float64"}


def array(name, kind, values, components=1):
    return name, kind, components, struct.pack(f"<{len(values)}{CODES[kind]}", *values)


def values_of(entry):
    kind, data = entry[1], entry[3]
    return struct.unpack(f"<{len(data) // struct.calcsize(CODES[kind])}{CODES[kind]}", data)


def swapped(data, width):
    return b"".join(data[k:k + width][::-1] for k in range(0, len(data), width))


class VtuWriter:
    """How a program writes a VTU file. style: ascii, binary (inline base64), raw or base64 (appended)."""

    def __init__(self, style="ascii", zipped=False, header="UInt32", big=False, version="0.1", block=32768,
                 attributes=None, ids="Int64", types="UInt8", points="Float64", before="", inside=None):
        self.style, self.zipped, self.header, self.big = style, zipped, header, big
        self.version, self.block, self.attributes = version, block, attributes or {}
        self.ids, self.types, self.points, self.before = ids, types, points, before
        self.inside = inside or {}
        self.appended = b""

    def number(self, *values):
        return struct.pack(("> " if self.big else "<").strip() + str(len(values)) +
                           ("Q" if self.header == "UInt64" else "I"), *values)

    def encoded(self, data):
        """Header and data of an array: as bytes, and as VTK encodes them in base64, one after the other."""
        if not self.zipped:
            head = self.number(len(data))
            return head + data, base64.b64encode(head + data)
        blocks = [data[k:k + self.block] for k in range(0, len(data), self.block)]
        packed = [zlib.compress(b) for b in blocks]
        last = len(blocks[-1]) if blocks and len(blocks[-1]) < self.block else 0
        head = self.number(len(blocks), self.block, last, *map(len, packed))
        return head + b"".join(packed), base64.b64encode(head) + base64.b64encode(b"".join(packed))

    def array(self, name, kind, components, data, more=""):
        from xml.sax.saxutils import quoteattr
        text = f'<DataArray type="{kind}" Name={quoteattr(name)}'
        text = text.replace("<DataArray", "<Array") if kind == "String" else text
        end = "</Array>" if kind == "String" else "</DataArray>"
        if components != 1:
            text += f' NumberOfComponents="{components}"'
        text += more
        inside = self.inside.get(name, "")
        if self.style == "ascii":
            words = " ".join(repr(v) if kind != "Float32" else f"{v:.9g}" for v in values_of((name, kind, 1, data)))
            return f'{text} format="ascii">\n{words}\n{inside}{end}\n'.encode()
        if self.big:
            data = swapped(data, struct.calcsize(CODES[kind]))
        raw, letters = self.encoded(data)
        if self.style == "binary":
            return f'{text} format="binary">\n'.encode() + letters + f"\n{inside}{end}\n".encode()
        offset = len(self.appended)
        self.appended += raw if self.style == "raw" else letters
        return f'{text} format="appended" offset="{offset}">{inside}{end}\n'.encode()

    def write(self, path, grid):
        from xml.sax.saxutils import quoteattr
        self.appended = b""
        order = "BigEndian" if self.big else "LittleEndian"
        head = (f'<?xml version="1.0"?>\n{self.before}<VTKFile type="UnstructuredGrid" version="{self.version}" '
                f'byte_order="{order}" header_type="{self.header}"')
        if self.zipped:
            head += ' compressor="vtkZLibDataCompressor"'
        out = head.encode() + b">\n<UnstructuredGrid>\n"
        if grid["field"]:
            out += b"<FieldData>\n"
            for name, kind, components, data in grid["field"]:
                tuples = (data.count(0) if kind == "String" else
                          len(data) // struct.calcsize(CODES[kind]) // max(1, components))
                out += self.array(name, kind, components, data, f' NumberOfTuples="{tuples}"')
            out += b"</FieldData>\n"
        nodes, cells = len(grid["points"]) // 3, len(grid["types"])
        out += f'<Piece NumberOfPoints="{nodes}" NumberOfCells="{cells}">\n'.encode()
        for part in ("point", "cell"):
            active = "".join(f" {k}={quoteattr(v)}" for k, v in self.attributes.get(part, {}).items())
            out += f"<{part.capitalize()}Data{active}>\n".encode()
            for entry in grid[part]:
                out += self.array(*entry)
            out += f"</{part.capitalize()}Data>\n".encode()
        out += b"<Points>\n" + self.array(*array("Points", self.points, grid["points"], 3)) + b"</Points>\n<Cells>\n"
        out += self.array(*array("connectivity", self.ids, grid["connectivity"]))
        out += self.array(*array("offsets", self.ids, grid["offsets"]))
        out += self.array(*array("types", self.types, grid["types"]))
        out += b"</Cells>\n</Piece>\n</UnstructuredGrid>\n"
        if self.appended:
            encoding = "raw" if self.style == "raw" else "base64"
            out += f'<AppendedData encoding="{encoding}">\n_'.encode() + self.appended + b"\n</AppendedData>\n"
        path.write_bytes(out + b"</VTKFile>\n")


class VtuReader:
    """The arrays of a VTU file, whatever its encoding."""

    def __init__(self, path):
        text, self.data, self.letters = path.read_bytes(), b"", False
        tag = text.find(b"<AppendedData")
        if tag >= 0:
            mark = text.index(b"_", text.index(b">", tag))
            self.letters = b"base64" in text[tag:mark]
            self.data = text[mark + 1:]
            text = text[:tag] + b"</VTKFile>"
        root = ElementTree.fromstring(text)
        self.prefix = ">" if root.get("byte_order") == "BigEndian" else "<"
        self.head = "Q" if root.get("header_type") == "UInt64" else "I"
        self.zipped = root.get("compressor") == "vtkZLibDataCompressor"
        grid = root.find("UnstructuredGrid")
        self.piece = grid.find("Piece")
        self.field_elements = [e for parent in (grid.find("FieldData"), self.piece.find("FieldData"))
                               if parent is not None for e in parent]

    def numbers(self, data, first, count):
        width = struct.calcsize(self.head)
        return struct.unpack(self.prefix + str(count) + self.head, data[first:first + count * width])

    def decoded(self, data, letters):
        width = struct.calcsize(self.head)
        if letters:
            pieces = re.findall(rb"[A-Za-z0-9+/]+={0,2}", re.sub(rb"\s", b"", data))
            whole = b""
            for piece in pieces:
                usable = piece[:len(piece) // 4 * 4]
                whole += base64.b64decode(usable)
            data = whole
        if not self.zipped:
            size = self.numbers(data, 0, 1)[0]
            return data[width:width + size]
        count = self.numbers(data, 0, 1)[0]
        sizes = self.numbers(data, 3 * width, count)
        out, first = b"", (3 + count) * width
        for size in sizes:
            out += zlib.decompress(data[first:first + size])
            first += size
        return out

    def bytes_of(self, element):
        kind = element.get("type")
        style = element.get("format", "ascii")
        if style == "ascii":
            words = (element.text or "").split()
            values = [float(w) if kind.startswith("Float") else int(w) for w in words]
            return struct.pack(f"<{len(values)}{CODES[kind]}", *values)
        if style == "binary":
            data = self.decoded((element.text or "").encode(), True)
        else:
            data = self.decoded(self.data[int(element.get("offset")):], self.letters)
        width = struct.calcsize(CODES[kind])
        return swapped(data, width) if self.prefix == ">" else data

    def entry(self, element):
        return (element.get("Name"), element.get("type"), int(element.get("NumberOfComponents", "1")),
                self.bytes_of(element))

    def grid(self):
        cells = {e.get("Name"): e for e in self.piece.find("Cells")}
        result = {name: self.entry(cells[name]) for name in ("connectivity", "offsets", "types")}
        result["points"] = self.entry(self.piece.find("Points")[0])
        for key, parent in (("point", self.piece.find("PointData")), ("cell", self.piece.find("CellData"))):
            elements = [] if parent is None else [e for e in parent if e.tag in ("DataArray", "Array")]
            result[key] = [self.entry(e) for e in elements]
            result[key + " active"] = {} if parent is None else dict(parent.attrib)
        result["field"] = [self.entry(e) for e in self.field_elements]
        return result


def read_legacy(path):
    """The arrays of a legacy file of unstructured cells, as written by the program (version 3.0)."""
    text = path.read_bytes()
    position = 0
    result = {"point": [], "cell": [], "field": [], "keywords": []}

    def line():
        nonlocal position
        end = text.index(b"\n", position)
        found, position = text[position:end], end + 1
        return found.decode()

    def values(kind, count):
        nonlocal position
        code = CODES[kind]
        if binary:
            size = count * struct.calcsize(code)
            data, position = swapped(text[position:position + size], struct.calcsize(code)), position + size + 1
            return data
        words = []
        while len(words) < count:
            words += line().split()
        return struct.pack(f"<{count}{code}", *[float(w) if code in "fd" else int(w) for w in words])

    def strings(count):
        nonlocal position
        found = b""
        for _ in range(count):
            if not binary:
                found += unescaped(line()).encode() + b"\0"
                continue
            size = struct.unpack(">Q", text[position:position + 8])[0]
            found += text[position + 8:position + 8 + size] + b"\0"
            position += 8 + size
        position += 1 if binary else 0
        return found

    def unescaped(name):
        return re.sub("%([0-9A-F]{2})", lambda m: chr(int(m.group(1), 16)), name)

    def entry(name, word, components, count):
        name = unescaped(name)
        if word == "string":
            return name, "String", components, strings(count)
        return name, LEGACY[word], components, values(LEGACY[word], count)

    line(), line()
    binary = line() == "BINARY"
    line()
    place, tuples = "field", 0
    while position < len(text):
        words = line().split()
        if not words:
            continue
        result["keywords"].append(words[0])
        if words[0] == "POINTS":
            result["points"] = entry("Points", words[2], 3, 3 * int(words[1]))
        elif words[0] == "CELLS":
            result["cells"] = values("Int32", int(words[2]))
        elif words[0] == "CELL_TYPES":
            result["types"] = values("Int32", int(words[1]))
        elif words[0] in ("POINT_DATA", "CELL_DATA"):
            place, tuples = words[0][:-5].lower(), int(words[1])
        elif words[0] == "FIELD":
            for _ in range(int(words[2])):
                head = line().split()
                while head[0] == "METADATA":
                    while line():
                        pass
                    head = line().split()
                result[place].append(entry(head[0], head[3], int(head[1]), int(head[1]) * int(head[2])))
        elif words[0] == "METADATA":
            while line():
                pass
        elif words[0] == "LOOKUP_TABLE":
            kind = "unsigned_char" if binary else "float"
            result[place].append(entry(words[1], kind, 4, 4 * int(words[2])))
        elif words[0] == "COLOR_SCALARS":
            kind, components = "unsigned_char" if binary else "float", int(words[2])
            result[place].append(entry(words[1], kind, components, components * tuples))
        elif words[0] == "TEXTURE_COORDINATES":
            result[place].append(entry(words[1], words[3], int(words[2]), int(words[2]) * tuples))
        else:
            components = {"SCALARS": 1, "VECTORS": 3, "NORMALS": 3, "TENSORS": 9, "TENSORS6": 6,
                          "GLOBAL_IDS": 1, "PEDIGREE_IDS": 1}[words[0]]
            if words[0] == "SCALARS":
                components = int(words[3]) if len(words) > 3 else 1
                line()  # LOOKUP_TABLE
            result[place].append(entry(words[1], words[2], components, components * tuples))
    return result
