#!/usr/bin/env python3
"""Makes the samples of meshes that `chainmail generate` cannot make; see meshes/README.md.

    app/tools/make_samples.py [FOLDER]

Needs only Python's standard library, and the programs gmsh (4.8 or later) to fill the organ and chainmail to make it
coarse. The result is the same each time, except for the output of gmsh, which depends on its version.
"""

import gzip
import json
import math
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path


# The organ: a closed surface like a bean, with triangles about one mesh unit wide.

def icosphere(frequency):
    """Returns points on the unit sphere and triangles: an icosahedron with each edge split into `frequency` parts."""
    golden = (1 + math.sqrt(5)) / 2
    corners = [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0), (0, -1, golden), (0, 1, golden),
               (0, -1, -golden), (0, 1, -golden), (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]
    points, number, triangles = [], {}, []

    def point_at(face, i, j):
        weights = {corner: weight for corner, weight in zip(face, (frequency - i - j, i, j)) if weight}
        key = tuple(sorted(weights.items()))
        if key not in number:
            number[key] = len(points)
            points.append(unit([sum(w * corners[c][k] for c, w in key) for k in range(3)]))
        return number[key]

    for face in faces:
        for i in range(frequency):
            for j in range(frequency - i):
                triangles.append((point_at(face, i, j), point_at(face, i + 1, j), point_at(face, i, j + 1)))
                if i + j < frequency - 1:
                    triangles.append((point_at(face, i + 1, j), point_at(face, i + 1, j + 1), point_at(face, i, j + 1)))
    return points, triangles


def unit(vector):
    length = math.sqrt(sum(x * x for x in vector))
    return [x / length for x in vector]


def on_organ(direction):
    """Returns the point of the organ's surface in a direction from its middle."""
    x, y, z = direction
    ellipsoid = 1 / math.sqrt((x / 14.3) ** 2 + (y / 9.1) ** 2 + (z / 6) ** 2)
    notch = 1 - 0.34 * math.exp(-((x / 0.42) ** 2 + ((y + 1) / 0.7) ** 2))  # where vessels enter
    lobes = 1 + 0.12 * x + 0.05 * math.cos(3 * x + 2 * y + z)
    radius = ellipsoid * notch * lobes
    return [radius * x, radius * y, radius * z]


def organ():
    points, triangles = icosphere(11)
    points = [on_organ(point) for point in points]
    neighbours = [set() for _ in points]
    for a, b, c in triangles:
        neighbours[a] |= {b, c}
        neighbours[b] |= {a, c}
        neighbours[c] |= {a, b}
    for _ in range(60):  # makes the triangles more even, along the surface
        points = [on_organ(unit([sum(points[n][k] for n in sorted(near)) / len(near) for k in range(3)]))
                  for near in neighbours]
    return [[round(x, 4) for x in point] for point in points], triangles


def write_obj(path, points, triangles):
    with open(path, "w", encoding="ascii") as out:
        for point in points:
            out.write("v " + " ".join(f"{x:g}" for x in point) + "\n")
        for triangle in triangles:
            out.write("f " + " ".join(str(corner + 1) for corner in triangle) + "\n")


def write_filled(path, points, triangles):
    """Fills the surface with gmsh. The tetrahedra are about as large as the triangles. Saves only the tetrahedra."""
    if not shutil.which("gmsh"):
        print("gmsh is not here: " + str(path) + " stays as it is")
        return
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + "/organ.stl", "w", encoding="ascii") as out:
            out.write("solid organ\n")
            for triangle in triangles:
                out.write("facet normal 0 0 0\nouter loop\n")
                for corner in triangle:
                    out.write("vertex " + " ".join(f"{x:.4f}" for x in points[corner]) + "\n")
                out.write("endloop\nendfacet\n")
            out.write("endsolid organ\n")
        Path(folder + "/organ.geo").write_text(
            'Merge "organ.stl";\nSurface Loop(1) = {1};\nVolume(1) = {1};\nPhysical Volume("organ") = {1};\n')
        subprocess.run(["gmsh", "-3", "-format", "msh41", "-o", str(path), folder + "/organ.geo", "-v", "2"], check=True)


def write_coarse(path, points, triangles, elements=100, scale=0.25):
    """Makes the organ smaller, simplifies its surface and fills it, so that links are about one mesh unit long again."""
    if not shutil.which("chainmail"):
        print("chainmail is not in the PATH: " + str(path) + " stays as it is")
        return
    with tempfile.TemporaryDirectory() as folder:
        surface, coarse = folder + "/organ.obj", folder + "/coarse.obj"
        write_obj(surface, [[scale * x for x in point] for point in points], triangles)
        subprocess.run(["chainmail", "simplify", surface, "--elements", str(elements), "-o", coarse], check=True)
        subprocess.run(["chainmail", "fill", coarse, "--edge", "0.9", "-o", str(path)], check=True)


# A block of tetrahedra with inner elements slightly displaced from their lattice.

def write_jittered(path, size=(11, 9, 8), jitter=0.25):
    chance = random.Random(20)
    places = [(x, y, z) for z in range(size[2]) for y in range(size[1]) for x in range(size[0])]
    points = [[x + (chance.uniform(-jitter, jitter) if 0 < x < n - 1 else 0) for x, n in zip(place, size)]
              for place in places]
    number = {place: i for i, place in enumerate(places)}
    steps = [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]  # all orders of the axes (Freudenthal)
    cells = []
    for place in places:
        if all(x < n - 1 for x, n in zip(place, size)):
            for i, order in enumerate(steps):
                corner, corners = list(place), [number[place]]
                for axis in order:
                    corner[axis] += 1
                    corners.append(number[tuple(corner)])
                cells.append(corners if i < 3 else [corners[0], corners[2], corners[1], corners[3]])
    with open(path, "w", encoding="ascii") as out:
        out.write("# vtk DataFile Version 3.0\njittered block of tetrahedra\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        out.write(f"POINTS {len(points)} double\n")
        out.writelines(" ".join(f"{x:.3f}" for x in point) + "\n" for point in points)
        out.write(f"CELLS {len(cells)} {5 * len(cells)}\n")
        out.writelines("4 " + " ".join(map(str, cell)) + "\n" for cell in cells)
        out.write(f"CELL_TYPES {len(cells)}\n" + "10\n" * len(cells))


# A soft sheet with a stiff disc inside.

def write_inclusion(path, size=(32, 24), middle=(13.5, 11.5), radius=4.6):
    width, height = size
    places = [(x, y, 0) for y in range(height) for x in range(width)]
    squares = [i for i, place in enumerate(places) if place[0] + 1 < width and place[1] + 1 < height]
    triangles = [corners for i in squares
                 for corners in ((i, i + 1, i + width + 1), (i, i + width + 1, i + width))]
    links = sorted({tuple(sorted(pair)) for a, b, c in triangles for pair in ((a, b), (b, c), (c, a))})
    stiff = [math.dist(place[:2], middle) <= radius for place in places]
    own = [[a, b, 1, 1, 0] for a, b in links if stiff[a] and stiff[b]]

    def numbers(rows):
        return "[\n" + ",\n".join(",".join(map(str, row)) for row in rows) + "]"

    lattice = json.dumps({"size": [width, height, 1], "spacing": 1})
    panels = [{"algorithm": algorithm, "precision": "float", "from_rest": algorithm == "exact", "runs": [], "held": []}
              for algorithm in ("natural-queue", "exact")]
    path.write_text(
        '{"format": "chainmail session", "version": 1, "name": "stiff inclusion",\n'
        f'"mesh": {{"elements": {len(places)}, "space": 2, "lattice": {lattice},\n"rest": {numbers(places)},\n'
        f'"links": {numbers(links)},\n"triangles": {numbers(triangles)}, "polygons": [], "tetrahedra": []}},\n'
        '"cuts": [], "pins": [],\n"softness": {"compression": 0.4, "stretch": 1.6, "shear": 0.5,\n'
        f'"own": {numbers(own)}}},\n"relaxation": {{"on": false, "scheme": "mean", "step": 1}},\n'
        f'"panels": {json.dumps(panels)},\n"ui": {{"colour": "shear"}}}}\n', encoding="utf-8")


# A picture: a face with a grid of lines, which show the warping.

def picture_colour(x, y):
    """Returns red, green and blue at a position in 400 x 300 pixels, with y downward."""
    def disc(cx, cy, rx, ry):
        return ((x - cx) / rx) ** 2 + ((y - cy) / ry) ** 2 <= 1

    def ring(cx, cy, rx, ry, width):
        return disc(cx, cy, rx, ry) and not disc(cx, cy, rx - width, ry - width)

    colour = (214 - y // 6, 226 - y // 10, 240)
    if disc(200, 150, 112, 126):
        colour = (250, 214, 150)
    if ring(200, 150, 112, 126, 5) or (ring(200, 170, 66, 60, 7) and y > 186):
        colour = (92, 52, 40)
    for side in (-1, 1):
        if disc(200 + side * 44, 118, 20, 14):
            colour = (255, 255, 255)
        if disc(200 + side * 42, 118, 9, 10):
            colour = (40, 90, 130)
        if disc(200 + side * 40, 115, 3, 3):
            colour = (255, 255, 255)
        if ring(200 + side * 44, 108, 30, 24, 5) and y < 94:
            colour = (92, 52, 40)
    if disc(200, 152, 9, 17):
        colour = (226, 150, 110)
    if x % 25 < 1 or y % 25 < 1:
        colour = tuple(int(0.72 * c) for c in colour)
    return colour


def write_picture(path, width=400, height=300):
    rows = bytearray()
    for y in range(height):
        rows.append(0)  # no filter
        for x in range(width):
            parts = [picture_colour(x + dx, y + dy) for dx in (0.25, 0.75) for dy in (0.25, 0.75)]
            rows += bytes(int(sum(part[k] for part in parts) / 4) for k in range(3))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


# Volumes: a soft body that is denser inside, with a hard core and a smaller lump.

def density(x, y, z):
    """Returns the density, 0 to 255, at a position from -1 to 1 on each axis."""
    body = (x / 0.92) ** 2 + (y / 0.86) ** 2 + (z / 0.84) ** 2
    if body > 1:
        return 0
    if math.dist((x, y, z), (-0.25, 0.1, 0)) < 0.3:
        return 230
    if math.dist((x, y, z), (0.45, -0.25, 0.15)) < 0.16:
        return 180
    return int(110 - 40 * body + 6 * math.sin(9 * x) * math.sin(8 * y) * math.sin(7 * z))


def densities(size):
    return [density(*(2 * (i + 0.5) / n - 1 for i, n in zip((x, y, z), size)))
            for z in range(size[2]) for y in range(size[1]) for x in range(size[0])]


def write_nrrd(path, size=(32, 28, 26)):
    head = (f"NRRD0004\n# a phantom: body, hard core, lump\ntype: uint8\ndimension: 3\nsizes: {' '.join(map(str, size))}\n"
            "spacings: 1 1 1\nencoding: gzip\n\n")
    path.write_bytes(head.encode() + gzip.compress(bytes(densities(size)), 9, mtime=0))


def write_mha(path, size=(26, 24, 12)):
    """Writes the same volume like a scanner: signed 16 bits, air below zero, slices two units apart."""
    head = (f"ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n"
            f"ElementSpacing = 1 1 2\nDimSize = {' '.join(map(str, size))}\nElementType = MET_SHORT\n"
            "ElementDataFile = LOCAL\n")
    path.write_bytes(head.encode() + struct.pack(f"<{size[0] * size[1] * size[2]}h",
                                                 *(8 * d if d else -1000 for d in densities(size))))


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2] / "meshes"
    points, triangles = organ()
    write_obj(folder / "organ.obj", points, triangles)
    write_filled(folder / "organ.msh", points, triangles)
    write_coarse(folder / "organ-coarse.msh", points, triangles)
    write_jittered(folder / "jittered.vtk")
    write_inclusion(folder / "inclusion.chainmail")
    write_picture(folder / "face.png")
    write_nrrd(folder / "phantom.nrrd")
    write_mha(folder / "scan.mha")


if __name__ == "__main__":
    main()
