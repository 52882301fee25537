"""A closed body of random lumps as an OFF file. The same bytes on any system: nothing but sums of two, products and square roots (Python
3.12 has another sum())."""
import math

MULTIPLIER, INCREMENT = 6364136223846793005, 1442695040888963407  # Knuth (MMIX)


def random_numbers(seed):
    """Between -1 and 1."""
    state = seed
    while True:
        state = (MULTIPLIER * state + INCREMENT) % 2**64
        yield (state >> 11) * 2.0**-52 - 1.0


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def octasphere(divisions):
    """Unit vectors and triangles of an octahedron whose faces are cut into divisions² triangles each."""
    at, vertices, triangles = {}, [], []

    def vertex(x, y, z):
        if (x, y, z) not in at:
            at[x, y, z] = len(vertices)
            size = math.sqrt(dot((x, y, z), (x, y, z)))
            vertices.append((x / size, y / size, z / size))
        return at[x, y, z]

    for sx, sy, sz in [(x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)]:
        def corner(i, j):
            return vertex(sx * i, sy * j, sz * (divisions - i - j))

        for i in range(divisions):
            for j in range(divisions - i):
                cut = [(corner(i, j), corner(i + 1, j), corner(i, j + 1))]
                if i + j < divisions - 1:
                    cut.append((corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)))
                triangles += cut if sx * sy * sz > 0 else [(a, c, b) for a, b, c in cut]
    return vertices, triangles


def lumpy(seed, divisions=9, lumps=9, height=0.35):
    """The text of an OFF file: a sphere of about unit radius with `lumps` hills and hollows of up to `height`, squeezed a little."""
    numbers = random_numbers(seed)
    hills = [[next(numbers) for _ in range(4)] for _ in range(lumps)]
    squeeze = [1.0 + 0.3 * next(numbers) for _ in range(3)]
    vertices, triangles = octasphere(divisions)
    lines = ["OFF", f"{len(vertices)} {len(triangles)} 0"]
    for v in vertices:
        radius = 1.0
        for *centre, amount in hills:
            width = 1.0 + 12.0 * (1.0 - dot(v, centre) / math.sqrt(dot(centre, centre)))
            radius += height * amount / (width * width)
        lines.append(" ".join(repr(radius * s * x) for s, x in zip(squeeze, v)))
    return "\n".join(lines + [f"3 {a} {b} {c}" for a, b, c in triangles]) + "\n"
