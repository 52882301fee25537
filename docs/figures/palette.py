#!/usr/bin/env python3
"""Rewrites a PNG of 8-bit RGB or RGBA with a palette of at most 256 colours (standard library only): palette.py FILE.png"""
import struct
import sys
import zlib


def chunks(data):
    at = 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        yield kind, data[at + 8:at + 8 + size]
        at += 12 + size


def unfiltered(raw, height, stride, step):
    rows, before = [], bytearray(stride)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            a, b, c = row[i - step] if i >= step else 0, before[i], before[i - step] if i >= step else 0
            if kind == 4:
                pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                predicted = a if pa <= pb and pa <= pc else b if pb <= pc else c
            else:
                predicted = (0, a, b, (a + b) // 2)[kind]
            row[i] = (row[i] + predicted) & 255
        rows.append(row)
        before = row
    return rows


def main(path):
    data = open(path, "rb").read()
    parts = list(chunks(data))
    width, height, depth, colour = struct.unpack(">IIBB", dict(parts)[b"IHDR"][:10])
    assert depth == 8 and colour in (2, 6), "8-bit RGB or RGBA only"
    step = 3 if colour == 2 else 4
    rows = unfiltered(zlib.decompress(b"".join(d for k, d in parts if k == b"IDAT")), height, width * step, step)
    rounded = bytes(min(255, (v + 8) // 17 * 17) for v in range(256))  # 16 levels a channel
    pixels = [[bytes(row[i:i + 3]).translate(rounded) for i in range(0, len(row), step)] for row in rows]
    count = {}
    for row in pixels:
        for p in row:
            count[p] = count.get(p, 0) + 1
    palette = sorted(count, key=lambda p: (-count[p], p))[:256]
    index = {p: i for i, p in enumerate(palette)}
    for p in count:
        if p not in index:
            index[p] = min(range(len(palette)), key=lambda i: sum((x - y) ** 2 for x, y in zip(p, palette[i])))
    body = zlib.compress(b"".join(b"\0" + bytes(index[p] for p in row) for row in pixels), 9)
    out = data[:8]
    for kind, d in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)), (b"PLTE", b"".join(palette)), (b"IDAT", body), (b"IEND", b"")):
        out += struct.pack(">I", len(d)) + kind + d + struct.pack(">I", zlib.crc32(kind + d))
    open(path, "wb").write(out)


main(sys.argv[1])
