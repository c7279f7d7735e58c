"""Curves in space as other programs write them: VECT of Geomview, CSV, JSON, KnotPlot's text, and codes of diagrams."""
import itertools
import json
import os
import re
import stat
from collections import namedtuple

import numpy as np

from knot_utm.errors import refuse_if, WrongInput
from knot_utm.knot_diagram import diagram_in

MOST = 20000       # points of a file
MOST_BYTES = 16_000_000  # some hundreds for each
MOST_CURVES = 8    # each is a rope, and time grows with their square
FARTHEST = 1e100   # coordinate: squares of distances must be numbers

# `points`: N x 3; a `closed` one goes on from the last to the first. `places`: what each point is called in its file. `is_flat`: it
# is a diagram, and no shape in space.
Curve = namedtuple("Curve", "points closed places is_flat", defaults=[False])


def curves_of(file):
    """All curves of a file. Raises WrongInput."""
    text = text_in(file)
    try:
        curves = read(file, text)
    except RecursionError as error:
        raise WrongInput(f"{file}: its brackets stand too deep in each other") from error
    refuse_if(len(curves) > MOST_CURVES, f"{file}: it holds {len(curves)} curves, but a knot may have at most {MOST_CURVES} ropes")
    refuse_if(sum(len(curve.points) for curve in curves) > MOST, f"{file}: it has more than {MOST} points")
    for number, curve in enumerate(curves, 1):
        refuse_if(len(curve.points) < 4, f"{file}: curve {number} has {len(curve.points)} different points, but must have 4 or more")
    if not curves:
        raise WrongInput(f"{file}: it holds no curve: give VECT, CSV of x,y,z, JSON of points, rows of three numbers, or a PD or Gauss code")
    return curves


def read(file, text):
    bare = re.sub(r"#.*", "", text).strip()
    if "VECT" in bare:
        return vects(file, blocks(iter(re.findall(r"[{}]|[^\s{}()]+", bare))), np.eye(4))
    diagram = None if re.search(r"\d\.", bare) else diagram_in(file, bare)
    if diagram is not None:
        return [Curve(points, True, places, True) for points, places in diagram]
    if bare.startswith(("[", "{")):
        try:
            return json_curves(file, json.loads(bare))
        except json.JSONDecodeError as error:
            raise WrongInput(f"{file}: it is neither JSON nor the code of a diagram: {error}") from error
    return table(file, text, "," not in bare)


def text_in(file):
    try:
        found = os.stat(file)
        refuse_if(not stat.S_ISREG(found.st_mode), f"{file}: it is a folder, a device or a pipe, but must be a file of text")
        refuse_if(found.st_size > MOST_BYTES, f"{file}: it has {found.st_size:,} bytes, but may have at most {MOST_BYTES:,}")
        with open(file, encoding="utf-8-sig") as opened:
            return opened.read(MOST_BYTES)
    except UnicodeDecodeError as error:
        raise WrongInput(f"{file}: cannot be read: it is no text in UTF-8") from error
    except OSError as error:
        raise WrongInput(f"{file}: cannot be read: {error.strerror}") from error


def blocks(words):
    """The words of a file of Geomview, those between { and } as a list of their own."""
    found = []
    for word in words:
        if word == "}":
            break
        found.append(blocks(words) if word == "{" else word)
    return found


def words_in(block):
    for one in block:
        yield from words_in(one) if isinstance(one, list) else [one]


def vects(file, block, moved):
    """The polylines of a block of Geomview and of those within it. `moved`: by all INST around it, rows x y z 1 times a matrix."""
    moves, curves = np.eye(4)[None], []
    for k, word in enumerate(block[:-1]):
        if word in ("transform", "transforms"):
            given = block[k + 1] if isinstance(block[k + 1], list) else block[k + 1:k + 17]
            numbers = [float(one) for one in words_in(given) if is_number(one)]
            moves = np.reshape(numbers, (-1, 4, 4)) if numbers and len(numbers) % 16 == 0 else moves
    for move in moves @ moved:
        for k, word in enumerate(block):
            if isinstance(word, list):
                curves += vects(file, word, move)
            elif word == "VECT":
                curves += vect(file, list(itertools.takewhile(lambda one: isinstance(one, str), block[k + 1:])), move)
    return curves


def vect(file, words, move):
    """Numbers of polylines, points and colours; of points and of colours of each polyline; points; colours. A polyline with a
    negative number of points is closed."""
    numbers = [to_number(file, "a VECT file", word) for word in itertools.takewhile(lambda one: one not in ("geom", "transform"), words)]
    lines = whole(file, numbers[0]) if numbers else 0
    counts = [whole(file, number) for number in numbers[3:3 + lines]]
    begin = 3 + 2 * lines
    curves, done = [], 0
    for count in counts:
        end = begin + 3 * abs(count)
        refuse_if(end > len(numbers), f"{file}: it names more points than it has")
        places = [f"point {done + i + 1}" for i in range(abs(count))]
        points = np.reshape(numbers[begin:end], (-1, 3)) @ move[:3, :3] + move[3, :3]
        curves.append(curve(points, True if count < 0 else None, places, lines == 1))
        begin, done = end, done + abs(count)
    return curves


def json_curves(file, found, closed=None):
    """All lists of points [x, y, z] or {x, y, z}, wherever they stand. One whose ends are near is closed unless it says it is not."""
    if isinstance(found, dict):
        if not all(isinstance(found.get(name), list) for name in "xyz"):
            return [one for part in found.values() for one in json_curves(file, part, found.get("closed", closed))]
        found = [list(point) for point in zip(found["x"], found["y"], found["z"])]
    if not isinstance(found, list):
        return []
    rows = [[row.get(name) for name in "xyz"] if isinstance(row, dict) else row for row in found]
    if not rows or not all(isinstance(row, list) and len(row) == 3 and all(is_number(str(one)) for one in row) for row in rows):
        return [one for part in found for one in json_curves(file, part, closed)]
    points = np.array(rows, dtype=float)
    if closed is None:
        closed = np.linalg.norm(points[0] - points[-1]) < 1.5 * np.linalg.norm(np.diff(points, axis=0), axis=1).max(initial=0.0)
    return [curve(points, bool(closed), [f"point {k}" for k in range(1, len(points) + 1)])]


def table(file, text, spaced):
    """Rows of x,y,z and, of several ropes, their numbers, as final_shape.csv has them; or of three numbers with spaces between them, as
    KnotPlot writes them, with an empty row between curves, which are closed."""
    found, names, block = {}, ["x", "y", "z"], 0
    for number, line in enumerate(text.splitlines(), 1):
        cells = line.split() if spaced else [cell.strip() for cell in line.split(",")]
        if not any(cells):
            block += spaced
        elif not spaced and not found and not is_number(cells[0]):
            names = cells if {"x", "y", "z"} <= set(cells) else names
        elif not cells[0].startswith("#"):
            if len(cells) < len(names) or spaced and len(cells) > 3:
                raise WrongInput(f"{file}: row {number} is \"{line.strip()}\", but must be "
                                 f"{'three numbers x y z' if spaced else ','.join(names)}")
            row = {name: to_number(file, f"row {number}", cell) for name, cell in zip(names, cells) if name in ("x", "y", "z", "rope")}
            found.setdefault((block, row.get("rope")), []).append(([row["x"], row["y"], row["z"]], f"row {number}"))
    curves = [zip(*rows) for rows in found.values()]
    return [curve(np.array(points), True if spaced else None, list(places), len(found) == 1) for points, places in curves]


def curve(points, closed, places, alone=False):
    """Without points that are where the one before is; one that ends where it begins is closed. So is one of which nothing else is known
    (None) whose ends are no further from each other than its points: than any of them if it is `alone`, else than half of them."""
    size = np.ptp(points, axis=0).max() if len(points) else 0.0
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    kept = np.concatenate([[True], steps > 1e-9 * size]) if len(points) else []
    points, places = points[kept] if len(points) else points, [place for place, is_kept in zip(places, kept) if is_kept]
    gap = np.linalg.norm(points[0] - points[-1]) if len(points) > 3 else np.inf
    if gap <= 1e-9 * size:
        return Curve(points[:-1], True, places[:-1])
    if closed is None:
        closed = len(points) > 5 and gap <= 1.001 * (np.max if alone else np.median)(steps)
    return Curve(points, closed, places)


def is_number(word):
    try:
        return abs(float(word)) <= FARTHEST
    except ValueError:
        return False


def to_number(file, where, word):
    if not is_number(word):
        raise WrongInput(f"{file}: {where}: {word[:40]} is no number, but must be one of at most {FARTHEST:g}")
    return float(word)


def whole(file, number):
    refuse_if(number != int(number) or abs(number) > MOST, f"{file}: a VECT file: {number:g} is no number of points or polylines")
    return int(number)
