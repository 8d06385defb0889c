#!/usr/bin/env python3
"""Makes the lessons of resources/lessons: sessions with captions, as resources/manual/sessions.md describes them.

    app/tools/make_lessons.py [FOLDER]

Needs only Python's standard library. The result is the same each time.
"""

import json
import math
import sys
from pathlib import Path

ROOT = Path(__file__).parent / "../.."
MESHES = ROOT / "meshes"
# Softness of the links, as in the Stiffness dock.
STANDARD = {"compression": 0.8, "stretch": 1.2, "shear": 0.1}


class Lesson:
    """A session at rest, its recorded moves, and captions over them."""

    def __init__(self, title, mesh, algorithms, ui=None):
        self.title, self.mesh, self.algorithms, self.ui = title, mesh, algorithms, ui or {}
        self.moves, self.steps = [], []

    def step(self, title, text, **shown):
        """Ends a step after the moves so far."""
        self.steps.append({"title": title, "text": text, "until": len(self.moves), **shown})

    def drag(self, elements, way, moves, release=True):
        """Drags elements along a list of displacements [x, y, z] from where they are, each in this many moves."""
        self.moves.append({"do": "grab", "elements": elements})
        before = [0, 0, 0]
        for point in way:
            for i in range(1, moves + 1):
                share = (1 - math.cos(math.pi * i / moves)) / 2 if moves > 1 else 1
                by = [round(b + (p - b) * share, 3) for b, p in zip(before, point)]
                self.moves.append({"do": "drag", "by": by})
            before = point
        if release:
            self.moves.append({"do": "release"})

    def pin(self, elements):
        self.moves.append({"do": "pin", "elements": elements})

    def soften(self, **softness):
        self.moves.append({"do": "softness", **STANDARD, **softness, "energy": "corotated"})

    def save(self, path):
        panels = [{"algorithm": name, "precision": "float", "from_rest": False, "runs": [], "held": []}
                  for name in self.algorithms]
        lines = lambda values: ",\n".join(json.dumps(value, ensure_ascii=False) for value in values)
        own = lambda value: json.dumps(value, ensure_ascii=False)
        text = f"""{{"format": "chainmail session", "version": 2, "name": {own(self.title)},
"lesson": {{"title": {own(self.title)}, "steps": [
{lines(self.steps)}]}},
"mesh": {own(self.mesh)},
"cuts": [], "pins": [],
"softness": {{{own({**STANDARD, "lateral": 1, "stiffness": 1, "exponent": -1, "energy": "corotated"})[1:-1]}, "own": []}},
"relaxation": {{"on": false, "scheme": "mean", "step": 1}},
"panels": [
{lines(panels)}],
"moves": {{"version": {4 if any(move["do"] == "split" for move in self.moves) else 1}, "commands": [
{lines(self.moves)}]}},
"moves_done": 0,
"ui": {own(self.ui)}}}
"""
        path.write_text(text, encoding="utf-8")


def looking_from(yaw, pitch):
    """Returns a view of all panels from a side, in degrees. It fits the object, as views without it do."""
    return {"cameras": [{"yaw": yaw, "pitch": pitch, "framed": True}] * 2, "linked": True}


def grid(width, height):
    """Returns a flat grid of elements one unit apart, and the function from column and row to the element."""
    at = lambda x, y: y * width + x
    rest = [c for y in range(height) for x in range(width) for c in (x, y, 0)]
    links = []
    for y in range(height):
        for x in range(width):
            links += [at(x, y), at(x + 1, y)] if x + 1 < width else []
            links += [at(x, y), at(x, y + 1)] if y + 1 < height else []
    mesh = {"elements": width * height, "space": 2, "lattice": {"size": [width, height, 1], "spacing": 1},
            "rest": rest, "links": links, "triangles": [], "polygons": [], "tetrahedra": []}
    return mesh, at


def why_order_matters():
    at = lambda x, y: y * 24 + x
    lesson = Lesson("Why order matters", {"file": "grid.dat"}, ["generalized", "natural-queue"])
    lesson.step("One object, two algorithms",
                "Both panels show the same sheet. A link may shorten, stretch and lean only a little. "
                "Press Next: a handle pulls one element, and the algorithm of each panel moves the others.",
                colour="violation", tool="drag")
    lesson.drag([at(15, 15)], [[0.8, 0.5, 0]], 40, release=False)
    lesson.step("A short pull",
                "Each element that moves makes its neighbours candidates to move next. Panel A takes the newest "
                "candidate first, panel B the oldest. After a short pull the sheets look alike, although a few links "
                "in A are already violated.")
    for by in ([4, 5, 0], [-3, 5, 0], [-6, -3, 0], [2, -5, 0], [5, 3, 0]):
        start = lesson.moves[-1]["by"]
        for i in range(1, 9):
            lesson.moves.append({"do": "drag", "by": [round(s + (b - s) * i / 8, 3) for s, b in zip(start, by)]})
    lesson.moves.append({"do": "release"})
    lesson.step("A fast drag",
                "Now the handle runs around quickly. The coloured links are longer, shorter or more slanted than "
                "they may be: in A about a fifth of all links, in B none.")
    lesson.step("The order decides",
                "Panel A follows one chain of neighbours to its end before it returns, so far elements are placed "
                "before near ones, and the sheet tangles. Panel B works outward in rings and stays calm. "
                "B also leaves elements that are already placed out of its list. That makes it shorter, but moves "
                "nothing: the order alone decides.")
    return lesson


def waiting_list():
    mesh, at = grid(7, 7)
    lesson = Lesson("The waiting list, step by step", mesh, ["generalized", "natural-queue"])
    lesson.step("A small sheet",
                "The Propagation dock on the left shows the waiting list of each panel. "
                "Next pulls the element in the middle up and to the right, in a single move.",
                colour="violation", dock="propagation", tool="drag")
    lesson.drag([at(3, 3)], [[1.5, 1.2, 0]], 1, release=False)
    lesson.step("Only the handle has moved",
                "The handle is at its target and its four neighbours wait in the list. Nothing else has moved yet. "
                "The next candidate is in bold.", candidate=0)
    lesson.step("The first candidate",
                "The first candidate moves just far enough to be valid again. The arrow comes from its sponsor, the "
                "neighbour that moved before it. Its own neighbours now wait, too.", candidate=1)
    lesson.step("Two orders",
                "After six candidates the panels differ: Generalized ChainMail took the newest candidate each time and "
                "ran off along a chain. Natural Queue ChainMail took the oldest and served all four neighbours.",
                candidate=6)
    lesson.step("Until the list is empty",
                "The pass ends when nobody waits any more. The colours show who moved early and who late. "
                "Press the comma and period keys to step back and forth yourself.", candidate=1000)
    return lesson


def exact_and_taut():
    mesh, at = grid(12, 9)
    lesson = Lesson("Exact and taut", mesh, ["natural-queue", "exact"])
    lesson.pin([at(0, y) for y in range(9)])
    lesson.step("A pinned sheet",
                "The left edge of the sheet is pinned. Panel A runs Natural Queue ChainMail, panel B Exact ChainMail. "
                "Next pulls the middle of the right edge.", colour="violation", tool="drag")
    handle = [at(11, y) for y in range(3, 6)]
    lesson.drag(handle, [[1.5, 0, 0]], 40, release=False)
    lesson.step("Within reach",
                "Every link may stretch to 1.2 times its length at rest. As long as the handle stays within that reach, "
                "both panels follow it and all links are valid.")
    start = lesson.moves[-1]["by"]
    for i in range(1, 61):
        lesson.moves.append({"do": "drag", "by": [round(start[0] + 4.5 * i / 60, 3), 0, 0]})
    lesson.step("Taut",
                "The handle goes on. In panel B the sheet is taut, and the pins stop the handle where no valid "
                "position is left. Panel A follows the handle anyway: the coloured links are overstretched.")
    lesson.step("What Exact promises",
                "Exact ChainMail keeps every link valid, or it does not move. The order of the candidates makes no "
                "difference to its result. Drag the right edge yourself, then press Back.")
    return lesson


def read_msh(path):
    """Returns the points of a Gmsh 4.1 file in text."""
    lines = path.read_text().split("\n")
    points = []
    i = lines.index("$Nodes") + 1
    blocks = int(lines[i].split()[0])
    i += 1
    for _ in range(blocks):
        count = int(lines[i].split()[3])
        points += [tuple(map(float, line.split())) for line in lines[i + 1 + count:i + 1 + 2 * count]]
        i += 1 + 2 * count
    return points


def recorded_split():
    """Returns the split of the organ. The knife recorded it, so it is taken over from the lesson that exists."""
    moves = json.loads((ROOT / "resources/lessons/organ.chainmail").read_text())["moves"]["commands"]
    return next(move for move in moves if move["do"] == "split")


def cut_an_organ():
    points = read_msh(MESHES / "organ.msh")
    lesson = Lesson("Cut an organ", {"file": "organ.msh"}, ["natural-queue", "exact"],
                    looking_from(25, 40))
    near = lambda x, y, z, r: [e for e, p in enumerate(points) if math.dist(p, (x, y, z)) < r]
    lesson.pin([e for e, p in enumerate(points) if p[1] < -7.5])
    lesson.soften(compression=0.5, stretch=1.5, shear=0.5)
    lesson.step("A soft organ",
                "This kidney is a solid of 9,891 tetrahedra, not only a surface. Its underside is pinned. "
                "Next pulls at its upper side.", colour="violation", show="surface", tool="drag")
    lesson.drag(near(8, 7, 1, 3), [[3, 3, 1], [0, 0, 0]], 45)
    lesson.step("Pull and push",
                "The handle takes its surroundings along. On the way back, elements follow only as far as their links "
                "demand, so some creases stay. Next cuts the organ from above.",
                tool="cut")
    lesson.moves.append(recorded_split())
    lesson.step("A cut",
                "The blade divides the tetrahedra that it crosses, so no volume is lost. New elements get ids after "
                "all others. ChainMail itself prepares nothing, so the next drag starts at once. Next pulls both "
                "sides apart.")
    lesson.drag(near(6.5, 6.5, 0, 3.5), [[4, 0.5, 0]], 50)
    lesson.drag(near(-1.5, 6.5, 0, 3.5), [[-4, 0.5, 0]], 50, release=False)
    lesson.step("Open it",
                "The sides part and show the inside of the solid. In panel A, the coloured links exceed their "
                "limits: Natural Queue places each element within reach of one neighbour, its sponsor, but not "
                "always of the others. Exact ChainMail in panel B keeps all limits. Next lets the organ settle "
                "while the handle is held.")
    lesson.moves += [{"do": "relax", "sweeps": 300, "scheme": "equilibrium", "until": 0.01}, {"do": "release"}]
    lesson.step("Let it settle",
                "Relaxation moves the elements to the state of least energy: creases vanish, the side that nothing "
                "holds goes back, and the wound shows the inside in a colour of its own. Press K to cut further "
                "yourself.",
                colour="plain", tool="drag")
    return lesson


def against_fem():
    mesh, at = grid(25, 6)
    lesson = Lesson("ChainMail against FEM", mesh, ["natural-queue", "fem"])
    lesson.pin([at(0, y) for y in range(6)])
    lesson.step("A beam, held at the left",
                "Panel A runs Natural Queue ChainMail. Panel B runs linear FEM, the finite elements of engineers. "
                "The left end is pinned. Next bends the right end.", colour="violation", tool="drag")
    end = [at(24, y) for y in range(6)]
    lesson.drag(end, [[0, 2, 0]], 50, release=False)
    lesson.step("A small bend",
                "In FEM the whole beam shares the load and bends smoothly. FEM has no limits: the coloured links "
                "exceed those of ChainMail a little. In ChainMail, elements move only if they must, so the left of the "
                "beam does not feel the handle.")
    start = lesson.moves[-1]["by"]
    for i in range(1, 71):
        lesson.moves.append({"do": "drag", "by": [0, round(start[1] + 9 * i / 70, 3), 0]})
    lesson.step("A large bend",
                "Now ChainMail reaches the pins, and the links next to them stretch beyond their limit: it knows "
                "limits, but no forces. FEM knows forces, and spreads the bend over the whole beam.")
    lesson.step("How far from physics?",
                "The colours show how far each element is from a neo-Hookean solid, which suits large bends. ChainMail "
                "is farther off. Its gain: it works without pins and prepares nothing, not even after a cut.",
                colour="truth")
    return lesson


LESSONS = {"order": why_order_matters, "waiting-list": waiting_list, "exact": exact_and_taut, "organ": cut_an_organ,
           "physics": against_fem}


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "resources/lessons"
    for name, make in LESSONS.items():
        make().save(folder / f"{name}.chainmail")


if __name__ == "__main__":
    main()
