"""Curves in space as other programs write them: VECT of Geomview, CSV, and KnotPlot's text."""
import os
import re
import stat
from collections import namedtuple

import numpy as np

from knot_utm.errors import WrongInput

MOST = 20000       # points of a file
MOST_BYTES = 16_000_000  # some hundreds for each
MOST_CURVES = 8    # each is a rope, and time grows with their square
FARTHEST = 1e100   # coordinate: squares of distances must be numbers

# `points`: N x 3; a `closed` one goes on from the last to the first. `places`: what each point is called in its file.
Curve = namedtuple("Curve", "points closed places")


def curves_of(file):
    """All curves of a file. Raises WrongInput."""
    text = text_in(file)
    read = vect if text.lstrip().startswith("VECT") else csv if "," in text else rows_of_knotplot
    curves = read(file, text)
    if len(curves) > MOST_CURVES:
        raise WrongInput(f"{file}: it holds {len(curves)} curves, but a knot may have at most {MOST_CURVES} ropes")
    if sum(len(curve.points) for curve in curves) > MOST:
        raise WrongInput(f"{file}: it has more than {MOST} points")
    for number, curve in enumerate(curves, 1):
        if len(curve.points) < 4:
            raise WrongInput(f"{file}: curve {number} has {len(curve.points)} different points, but must have 4 or more")
    if not curves:
        raise WrongInput(f"{file}: it holds no curve: give a VECT file, a CSV of x,y,z, or rows of three numbers")
    return curves


def text_in(file):
    try:
        found = os.stat(file)
        if not stat.S_ISREG(found.st_mode):
            raise WrongInput(f"{file}: it is a folder, a device or a pipe, but must be a file of text")
        if found.st_size > MOST_BYTES:
            raise WrongInput(f"{file}: it has {found.st_size:,} bytes, but may have at most {MOST_BYTES:,}")
        with open(file, encoding="utf-8") as opened:
            return opened.read(MOST_BYTES)
    except UnicodeDecodeError as error:
        raise WrongInput(f"{file}: cannot be read: it is no text in UTF-8") from error
    except OSError as error:
        raise WrongInput(f"{file}: cannot be read: {error.strerror}") from error


def vect(file, text):
    """Geomview: numbers of polylines, points and colours; of points and of colours of each polyline; points; colours. A polyline
    with a negative number of points is closed."""
    words = re.sub(r"#.*", "", text).split()[1:]
    numbers = [to_number(file, "a VECT file", word) for word in words]
    lines = whole(file, numbers[0]) if numbers else 0
    counts = [whole(file, number) for number in numbers[3:3 + lines]]
    begin = 3 + 2 * lines
    curves, read = [], 0
    for count in counts:
        end = begin + 3 * abs(count)
        if end > len(numbers):
            raise WrongInput(f"{file}: it names more points than it has")
        places = [f"point {read + i + 1}" for i in range(abs(count))]
        curves.append(curve(np.reshape(numbers[begin:end], (-1, 3)), count < 0, places))
        begin, read = end, read + abs(count)
    return curves


def csv(file, text):
    """Columns x,y,z and, of several ropes, their numbers, as final_shape.csv has them."""
    found, names = {}, ["x", "y", "z"]
    for number, line in enumerate(text.splitlines(), 1):
        cells = [cell.strip() for cell in line.split(",")]
        if not any(cells) or cells[0].startswith("#"):
            continue
        if not found and not is_number(cells[0]):
            names = cells if {"x", "y", "z"} <= set(cells) else names
            continue
        if len(cells) < len(names):
            raise WrongInput(f"{file}: row {number} is \"{line}\", but must be {','.join(names)}")
        row = {name: to_number(file, f"row {number}", cell) for name, cell in zip(names, cells) if name in ("x", "y", "z", "rope")}
        found.setdefault(row.get("rope", 1.0), []).append(([row["x"], row["y"], row["z"]], f"row {number}"))
    return [curve_of_rows(rows, False) for rows in found.values()]


def rows_of_knotplot(file, text):
    """A row a point; an empty row stands between two curves, which are closed."""
    blocks, block = [], []
    for number, line in enumerate([*text.splitlines(), ""], 1):
        cells = line.split()
        if cells and cells[0].startswith("#"):
            continue
        if not cells:
            blocks, block = blocks + [block] * bool(block), []
            continue
        if len(cells) != 3:
            raise WrongInput(f"{file}: row {number} is \"{line.strip()}\", but must be three numbers x y z")
        block.append(([to_number(file, f"row {number}", cell) for cell in cells], f"row {number}"))
    return [curve_of_rows(rows, True) for rows in blocks]


def curve_of_rows(rows, closed):
    points, places = zip(*rows)
    return curve(np.array(points), closed, list(places))


def curve(points, closed, places):
    """Without points that are where the one before is; one that ends where it begins is closed."""
    size = np.ptp(points, axis=0).max() if len(points) else 0.0
    differs = np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9 * size
    kept = np.concatenate([[True], differs]) if len(points) else []
    points, places = points[kept] if len(points) else points, [place for place, is_kept in zip(places, kept) if is_kept]
    returns = len(points) > 3 and np.linalg.norm(points[0] - points[-1]) <= 1e-9 * size
    return Curve(points[:-1], True, places[:-1]) if returns else Curve(points, closed, places)


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
    if number != int(number) or abs(number) > MOST:
        raise WrongInput(f"{file}: a VECT file: {number:g} is no number of points or polylines")
    return int(number)
