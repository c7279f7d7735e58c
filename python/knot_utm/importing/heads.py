"""Where a table begins in the rows of a file, and which of its columns may have a quantity."""
import dataclasses
import difflib
import functools
import re

from knot_utm.importing.names import QUANTITIES, SET_POINT
from knot_utm.importing.text import folded, has_digit, is_number, SEPARATORS, shown, split, split_names

TIME, EXTENSION, LOAD = range(3)
BETWEEN = " _/,"        # a name and its unit
BEHIND = r" _.:\-/#"    # the number of a specimen or a channel
WORDS = re.compile(r"[^\W\d_eE]|[eE](?![-+\d])")  # more than numbers: no row without is one of names
# "load(8800 (0,3):load)" and "displacement(linear|digital position)": the quantity, a console and its channel, as WaveMatrix writes them.
CHANNEL = re.compile(r"([^(]+)\((.+)[:|]([^:|()]+)\)")
ON_SPECIMEN = re.compile("strain|extens|gau?ge|lvdt")  # a channel that is no crosshead's
RESULTS = re.compile(r"\bmax|\bmin(imum)?\b|peak|valley|break|rupture|hochst|bruch|yield|amplitude|\bfmax|\brm\b|modulus")
HANDFUL = 4             # of known names in a message


@dataclasses.dataclass(frozen=True)
class Column:
    """One that may have a quantity."""

    place: int
    label: str                # as given
    unit: str = None          # that behind the name
    rank: int = 0             # the lower, the better
    base: str = ""            # the name alone, folded, without the number of a specimen
    of_machine: bool = False  # its name says that it is the crosshead's travel


class Head:
    """Where a table begins. `names_row`: None where there is none; `first`: the row behind it, which may have units; `cells`: how many
    columns there are; `period`: after how many names and units come again; `columns`: those that may have each quantity, best first."""

    def __init__(self, names, names_row, separator, given):
        self.names_row, self.first, self.separator, self.cells = names_row, names_row + 1, separator, len(names)
        self.names, self.given, self.period = tuple(names), given, len(names)
        self.columns = [_columns_in(i, given[i], names) for i in range(3)]

    def repeated(self, row):
        """The same where the names stand once and a row of readings goes on with as many numbers for each further specimen, as those of
        Mecmesin do."""
        once = max((place + 1 for place, name in enumerate(self.names) if name), default=len(row) + 1)
        if len(self.names) < 2 * once or len(row) < 2 * once or not all(map(is_number, row[:2 * once])):
            return self
        head = Head(self.names[:once] * (len(row) // once), self.names_row, self.separator, self.given)
        head.period = once
        return head

    @functools.cached_property
    def places(self):
        """Of time, if it is named, extension and load of the first specimen."""
        return [column.place for column in self.of_specimen(0) if column]

    def wanted(self, cells):
        return [cells[place] if place < len(cells) else "" for place in self.places]

    def is_reading(self, cells):
        return all(map(is_number, self.wanted(cells)))

    def is_complete(self, with_time):
        return all(self.columns[i] for i in ((TIME, EXTENSION, LOAD) if with_time else (EXTENSION, LOAD)))

    def specimens(self):
        """How many stand side by side. Each has an extension and a load of its own; the time may be common."""
        loads = len(_alike(self.columns[LOAD]))
        return loads if loads == len(_alike(self.columns[EXTENSION])) else 1

    def of_specimen(self, specimen):
        """Its columns of time, extension and load; only that of time may be None."""
        count = self.specimens()
        extension, load = (_alike(self.columns[i])[specimen] if count > 1 else self.columns[i][0] for i in (EXTENSION, LOAD))
        times = _alike(self.columns[TIME])
        if not times:
            return [None, extension, load]
        if len(times) == count:
            return [times[specimen], extension, load]
        left = [time for time in times if time.place < min(extension.place, load.place)]
        return [left[-1] if left else times[0], extension, load]

    def others(self, quantity, specimen):
        """Columns that may have a quantity of this specimen beside the one that `of_specimen` gives."""
        own, count, all_ = self.of_specimen(specimen)[quantity], self.specimens(), self.columns[quantity]
        alike = {column.base: _alike(all_, column) for column in all_}
        of_another = {column for same in alike.values() if 1 < count == len(same) for column in same if column != same[specimen]}
        return [column for column in all_ if column.place != own.place and column not in of_another]


def without_brackets(text):
    return text[1:-1].strip(" \t\r") if len(text) > 1 and text[0] + text[-1] in ("()", "[]") else text


def head_in(row, index, given, with_time):
    """The head, if this row names extension and load, and time where it must."""
    for cells, separator in _rows_of_names(row):
        if len(cells) >= (3 if with_time else 2):
            head = Head(cells, index, separator, given)
            if head.is_complete(with_time):
                return head
    return None


def _rows_of_names(row):
    """[(cells, separator)]: what a row may name."""
    found = [(split_names(row, separator), separator) for separator in SEPARATORS if WORDS.search(row)]
    # Where columns are padded with blanks, as MTS 793 does, only one stands behind a long name.
    words, names = " ".join(found[-1][0]).split() if found else [], []
    while words:
        known = (count for count in (4, 3, 2, 1) if any(folded(" ".join(words[:count])) in of.ranks for of in QUANTITIES))
        count = next(known, 0)
        if not count:
            return found
        names, words = [*names, " ".join(words[:count])], words[count:]
    return [*found, (names, " ")] if names else found


def kind_of(rows):
    """What a file is that holds no readings, or not as a table of named ones, in words; empty where it may be another one."""
    if rows and rows[0].startswith("LabVIEW Measurement"):
        return "it is a measurement file of LabVIEW (lvm), which does not say what its columns are: --columns and --units may"
    for row in rows:
        names = [folded(cell) for cell in split_names(row, next((mark for mark in SEPARATORS[:-1] if mark in row), " "))]
        if sum(map(bool, map(RESULTS.search, names))) > 1:
            of = "cycle" if any("cycle" in name for name in names) else "specimen"
            return f"row \"{shown(row)}\" is the head of a table of results, one row a {of}, and of no readings: export the raw data"
    return ""


def nearest_head(rows, given, with_time):
    """A sentence about the row that names the most columns, and which it does not name; empty where there is no such row."""
    most, found = -1, ""
    for index, row in enumerate(rows):
        for cells, separator in _rows_of_names(row):
            if len(cells) < 2 or all(map(has_digit, cells)):
                continue
            head = Head(cells, index, separator, given)
            named = sum(map(bool, head.columns))
            if named > most and (named or (len(cells) > 2 and separator != " ")):
                most = named
                found = f"row {index + 1} is \"{shown(row)}\" and does not name {_missing_names(head, given, cells, with_time)}"
    return found


def head_by_numbers(rows, given, with_time):
    """The head of a table whose columns are given by their numbers: the last row of names and the first of units before its first row
    of numbers, where there are such. None where the columns are not given so."""
    wanted = given if with_time or given[TIME] else given[1:]
    places = [_number_in(text) - 1 for text in wanted]
    tables = ((i, mark) for i, row in enumerate(rows) for mark in SEPARATORS
              if all(place < len(cells) and is_number(cells[place]) for cells in [split(row, mark)] for place in places))
    index, separator = next(tables, (None, "")) if min(places) >= 0 else (None, "")
    if index is None:
        return None
    head = Head([""] * len(split(rows[index], separator)), index, separator, given)
    head.names_row, head.first = None, index
    for above in range(index - 1, max(index - 3, -1), -1):  # at most two rows of words, the upper one of names
        cells = split_names(rows[above], separator)
        own = [cells[place] if place < len(cells) else "0" for place in places]
        if any(map(is_number, own)) or not any(own):
            break
        has_units = QUANTITIES[LOAD].si(without_brackets(own[-1])) is not None
        head.columns = Head(cells, above, separator, given).columns
        head.first = above if has_units else above + 1
        head.cells = max(head.cells, len(cells))
        if not has_units:
            head.names_row, head.names = above, tuple(cells)
            break
    return head


def _number_in(given):
    """0 of what is none."""
    return int(given) if re.fullmatch("[0-9]{1,4}", given) else 0


def _columns_in(quantity, given, cells):
    """Those of a row that may have a quantity, best first: one with a unit of another kind, such as "Displacement (Strain 1)", is that
    of another channel."""
    found = [column for i, cell in enumerate(cells) if (column := _as_column(quantity, given, cell, i))]
    own = [column for column in found if column.unit is None or given or QUANTITIES[quantity].si(column.unit) is not None]
    return sorted(own or found, key=lambda column: column.rank)


@functools.lru_cache(maxsize=1024)
def _as_column(quantity, given, cell, place):
    of = QUANTITIES[quantity]
    if number := _number_in(given):
        unit = (_name_of(cell)[1] or (_name_before_unit(of, cell) or ("", None))[1])
        return Column(place, cell, unit) if place + 1 == number else None
    for text in (cell, _without_number(cell)):
        for name, unit in filter(None, (_name_of(text), (text, None), _name_before_unit(of, text))):
            whole = folded(name)
            base = _without_number(whole)
            if given and whole == folded(given):
                return Column(place, cell, unit, 0, base)
            rank = None if given else of.ranks.get(whole, of.ranks.get(base))
            if rank is not None:
                return Column(place, cell, unit, rank, base, rank >= of.machines)
            channel = None if given else CHANNEL.fullmatch(whole)
            rank = of.ranks.get(channel[1].strip()) if channel and not SET_POINT.search(whole) else None
            if rank is not None:  # no two of them are those of two specimens
                other = bool(ON_SPECIMEN.search(channel[3]))
                return Column(place, cell, unit, rank + other * len(of.names), whole, rank >= of.machines and not other)
    return None


def _name_of(cell):
    """("Load", "N") of "Load (N)"; None for its unit where there is none."""
    bracket = max(cell.rfind("("), cell.rfind("["))
    unit = cell[bracket:]
    if bracket > 0 and unit != without_brackets(unit):
        return cell[:bracket].strip(" \t\r"), without_brackets(unit)
    return cell, None


def _name_before_unit(quantity, cell):
    """Of "Time sec", "Force_kN" and "Force/kN", where what stands behind is a unit of the quantity."""
    between = max(map(cell.rfind, BETWEEN))
    name, unit = cell[:between + 1].rstrip(BETWEEN), cell[between + 1:]
    return (name, unit) if between > 0 and name and quantity.si(unit) is not None else None


def _without_number(name):
    """Without the number of a specimen or a channel: "C_1_load", "specimen 2: load", "load 1", "load (1)", "load.1"."""
    if before := re.fullmatch(rf"[^0-9]{{0,12}}[0-9]+[{BEHIND}]+([^{BEHIND}].*)", name, re.DOTALL):
        return before[1]
    behind = re.fullmatch(rf"(.*?[^{BEHIND}0-9])[{BEHIND}]*(\([0-9]*\)|[0-9]+)", name, re.DOTALL)
    return behind[1] if behind and has_digit(name) else name


def _alike(columns, like=None):
    """Those of the same name as this one, or else as the best one."""
    base = (like or columns[0]).base if columns else None
    return sorted((column for column in columns if column.base == base), key=lambda column: column.place)


def _missing_names(head, given, cells, with_time):
    """What the row does not name, and a handful of known names, those first that a cell nearly is."""
    found = []
    for quantity, columns, name in list(zip(QUANTITIES, head.columns, given))[0 if with_time else 1:]:
        near = [word for cell in cells for word in difflib.get_close_matches(_name_of(cell)[0].lower(), quantity.names, 1, 0.75)]
        some = list(dict.fromkeys([*near, *quantity.names]))[:HANDFUL]
        others = len(quantity.names) - len(some)
        known = f'"{shown(name)}" alone' if name else f"{', '.join(some)} and {others} others"
        found += [] if columns else [f"{quantity.name}, whose known names are {known}"]
    return "; ".join(found)
