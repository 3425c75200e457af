"""Readers of what burnish writes for other programs, from the formats' specifications alone: NPY, PNG, EXR, GIF, Y4M. Nothing but
Python's own modules, so that no library can share a mistake with the one that wrote."""
import ast
import pathlib
import struct
import zlib

checks = []


def check(truth, text):
    """Ends the program unless it holds."""
    checks.append(text)
    if not truth:
        raise SystemExit(text)


def npy(path):
    """(shape, flat list) of an array."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x93NUMPY\x01\x00", "magic"
    (length,) = struct.unpack("<H", data[8:10])
    assert (10 + length) % 64 == 0 and data[9 + length] == 10, "header's size"
    head = ast.literal_eval(data[10:10 + length].decode("latin1"))
    assert set(head) == {"descr", "fortran_order", "shape"} and head["fortran_order"] is False
    code, size = {"<f4": ("f", 4), "<i4": ("i", 4), "|u1": ("B", 1)}[head["descr"]]
    count = 1
    for side in head["shape"]:
        count *= side
    assert len(data) == 10 + length + count * size, "file's size"
    return head["shape"], list(struct.unpack("<%d%s" % (count, code), data[10 + length:]))


def chunks(data):
    """(type, bytes) of each chunk of a PNG, CRCs checked."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "signature"
    at = 8
    while at < len(data):
        (size,) = struct.unpack(">I", data[at:at + 4])
        kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        (crc,) = struct.unpack(">I", data[at + 8 + size:at + 12 + size])
        assert crc == zlib.crc32(kind + body), "CRC of %s" % kind
        yield kind.decode(), body
        at += 12 + size


def unfilter(packed, width, height, channels, depth):
    """Samples of a PNG's image data, filters none and up only, which burnish uses."""
    raw = zlib.decompress(packed)
    row = width * channels * depth // 8
    above, out = bytes(row), []
    for y in range(height):
        kind, line = raw[y * (row + 1)], raw[y * (row + 1) + 1:(y + 1) * (row + 1)]
        assert kind in (0, 2), "filter %d" % kind
        above = bytes((a + b) & 255 for a, b in zip(line, above)) if kind else line
        out.append(above)
    flat = b"".join(out)
    return list(flat) if depth == 8 else list(struct.unpack(">%dH" % (len(flat) // 2), flat))


def png(path):
    """(width, height, channels, depth, samples, types of the chunks)."""
    found = list(chunks(pathlib.Path(path).read_bytes()))
    width, height, depth, kind = struct.unpack(">IIBB", found[0][1][:10])
    channels = {0: 1, 2: 3, 6: 4}[kind]
    packed = b"".join(body for name, body in found if name == "IDAT")
    return width, height, channels, depth, unfilter(packed, width, height, channels, depth), dict(found)


def exr(path):
    """(width, height, {channel: flat list}) of a single-part scan-line file in ZIP blocks."""
    data = pathlib.Path(path).read_bytes()
    assert struct.unpack("<II", data[:8])[0] == 20000630, "magic"
    at, attributes = 8, {}

    def text():
        nonlocal at
        end = data.index(b"\0", at)
        word, at = data[at:end].decode(), end + 1
        return word

    while data[at]:
        name, _ = text(), text()
        (size,) = struct.unpack("<I", data[at:at + 4])
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    at += 1
    box = struct.unpack("<4i", attributes["dataWindow"])
    width, height = box[2] + 1, box[3] + 1
    assert attributes["compression"] == b"\3" and box[:2] == (0, 0)
    names, listed, i = [], attributes["channels"], 0
    while listed[i]:
        end = listed.index(b"\0", i)
        (kind,) = struct.unpack("<I", listed[end + 1:end + 5])
        names.append((listed[i:end].decode(), {0: "I", 2: "f"}[kind]))
        i = end + 17
    assert [n for n, _ in names] == sorted(n for n, _ in names), "order of the channels"
    planes = {name: [] for name, _ in names}
    offsets = struct.unpack("<%dQ" % ((height + 15) // 16), data[at:at + 8 * ((height + 15) // 16)])
    for block, offset in enumerate(offsets):
        y, size = struct.unpack("<ii", data[offset:offset + 8])
        rows = min(16, height - y)
        packed, plain = data[offset + 8:offset + 8 + size], 4 * width * rows * len(names)
        assert y == 16 * block
        raw = packed
        if size < plain:  # deflated: halves interleaved, each byte a difference to the one before
            coded = bytearray(zlib.decompress(packed))
            for k in range(1, len(coded)):
                coded[k] = (coded[k - 1] + coded[k] - 128) & 255
            half = (len(coded) + 1) // 2
            raw = bytearray(len(coded))
            raw[0::2], raw[1::2] = coded[:half], coded[half:]
        assert len(raw) == plain
        for row in range(rows):
            for k, (name, kind) in enumerate(names):
                start = 4 * width * (row * len(names) + k)
                planes[name] += struct.unpack("<%d%s" % (width, kind), raw[start:start + 4 * width])
    return width, height, planes


def unpack_lzw(data, size):
    """Indices of GIF's variable-length codes."""
    clear, out, bits, have, width = 1 << size, [], 0, 0, size + 1
    table, before = None, None
    for byte in data:
        bits |= byte << have
        have += 8
        while have >= width:
            code, bits, have = bits & ((1 << width) - 1), bits >> width, have - width
            if code == clear:
                table = [bytes([i]) for i in range(clear)] + [b"", b""]
                width, before = size + 1, None
                continue
            if code == clear + 1:
                return out
            entry = table[code] if code < len(table) else before + before[:1]
            assert code <= len(table), "a code from the future"
            if before is not None and len(table) < 4096:
                table.append(before + entry[:1])
            if len(table) == 1 << width and width < 12:
                width += 1
            out += entry
            before = entry
    raise AssertionError("no end code")


def gif(path):
    """(width, height, [(delay in seconds, samples as RGB or None)], plays) of a GIF; frames as they are shown."""
    data = pathlib.Path(path).read_bytes()
    assert data[:6] == b"GIF89a" and data[10] == 0xf7
    width, height = struct.unpack("<HH", data[6:10])
    palette = [tuple(data[13 + 3 * i:16 + 3 * i]) for i in range(256)]
    at, frames, plays, shown, control = 13 + 768, [], None, [None] * (width * height), None

    def blocks():
        nonlocal at
        body = b""
        while data[at]:
            body += data[at + 1:at + 1 + data[at]]
            at += 1 + data[at]
        at += 1
        return body

    while data[at] != 0x3b:
        kind, at = data[at], at + 1
        if kind == 0x21:
            label, at = data[at], at + 1
            body = blocks()
            if label == 0xf9:
                control = struct.unpack("<BHB", body)
            elif label == 0xff:
                assert body[:12] == b"NETSCAPE2.0\1"
                plays = struct.unpack("<H", body[12:14])[0]
            continue
        assert kind == 0x2c
        x, y, w, h, flags = struct.unpack("<HHHHB", data[at:at + 9])
        size, at = data[at + 9], at + 10
        assert flags == 0 and x + w <= width and y + h <= height
        indices = unpack_lzw(blocks(), size)
        assert len(indices) == w * h, "%d indices of %d" % (len(indices), w * h)
        for i, index in enumerate(indices):
            if not (control[0] & 1 and index == control[2]):
                shown[(y + i // w) * width + x + i % w] = palette[index]
        frames.append((control[1] / 100, list(shown)))
        if control[0] >> 2 & 7 == 2:
            for i in range(w * h):
                shown[(y + i // w) * width + x + i % w] = None
    assert at == len(data) - 1, "bytes after the end"
    return width, height, frames, plays


def y4m(data):
    """(words of the header, width, height, [(Y, U, V)])."""
    head, data = data.split(b"\n", 1)
    words = head.decode().split()
    assert words[0] == "YUV4MPEG2"
    width, height = (int(next(w[1:] for w in words if w[0] == letter)) for letter in "WH")
    luma, chroma, frames = width * height, ((width + 1) // 2) * ((height + 1) // 2), []
    size = luma + 2 * chroma + 6
    assert len(data) % size == 0, "size"
    for at in range(0, len(data), size):
        assert data[at:at + 6] == b"FRAME\n"
        body = data[at + 6:at + size]
        frames.append((body[:luma], body[luma:luma + chroma], body[luma + chroma:]))
    return words, width, height, frames
