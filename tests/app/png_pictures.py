"""Pictures that the program draws, read without any library."""
import struct
import zlib

# Without a display, whatever the machine that runs the tests has.
HEADLESS = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}


def read_png(path):
    """Width, height and rows of RGB tuples of an 8-bit RGB or RGBA picture."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    position, packed = 8, b""
    while position < len(data):
        length, kind = struct.unpack(">I4s", data[position:position + 8])
        body = data[position + 8:position + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        position += 12 + length
    assert depth == 8 and color in (2, 6)
    size = 3 if color == 2 else 4
    raw, previous, rows = zlib.decompress(packed), bytes(width * size), []
    for y in range(height):
        start = y * (width * size + 1)
        previous = unfilter(raw[start], raw[start + 1:start + 1 + width * size], previous, size)
        rows.append([tuple(previous[k:k + 3]) for k in range(0, len(previous), size)])
    return width, height, rows


def unfilter(kind, line, above, size):
    out = bytearray(line)
    for k, value in enumerate(line):
        left = out[k - size] if k >= size else 0
        corner = above[k - size] if k >= size else 0
        guess = left + above[k] - corner
        paeth = min((left, above[k], corner), key=lambda v: abs(guess - v))
        out[k] = (value + (0, left, above[k], (left + above[k]) // 2, paeth)[kind]) & 255
    return bytes(out)
