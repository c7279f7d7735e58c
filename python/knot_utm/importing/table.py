"""Reads what testing machines export: a text with a table of time, extension and load among others, in any order.

    characters  UTF-8, UTF-16, Shift-JIS, GB 18030, or a Windows code page (text.py)
    separator   semicolon, tab, bar, comma or blanks: the one with which a row names all three quantities
    names       those of names.py, with a number of the specimen before or behind them ("C_1_Time"), or those that the user gives, by
                number too. The row of names is the first that names all three quantities
    several     The machine's own name counts: "Extension" before "Tensile extension". A column that is called an extension and goes
                another way than the crosshead is an extensometer's. Several specimens, side by side or in tables below each other, are
                refused unless one is chosen
    units       behind the names, in a row of their own below or above them, or given by the user; never guessed
    decimals    point or comma, the same in the whole file, of which a number must show which: 1,234 alone does not

The rows are converted to SI and are otherwise as recorded. A row that repeats the one before is left out. So is a row in which all are
empty, and a single reading whose extension jumps away and back."""
import math
import re
from typing import NamedTuple

from knot_utm.errors import WrongInput
from knot_utm.importing.heads import EXTENSION, head_by_numbers, head_in, LOAD, nearest_head, TIME, without_brackets
from knot_utm.importing.names import QUANTITIES
from knot_utm.importing.text import has_digit, is_number, mark_of_decimals, number, require_text, rows_of, shown, split, texts_of

ALIKE = 0.05  # of the way: two columns go the same way
FAR = 5.0     # times the usual step: no crosshead goes there and back from one reading to the next
NAMED = 5     # rows of one kind in messages
INVERT = ("falling", "extension", "load", "both")
NAN = math.nan
# Names and units of curve.csv, of which the machine measures three.
UNITS = {"time": "s", "extension": "m", "load": "N", "knot_distance": "m", "end_to_end": "m", "load_lower": "N", "phase": "-",
         "balance_offset": "N"}


class Reading(NamedTuple):
    """What a user says of a file. `columns`: names or numbers from 1; `units`: instead of those of the file; `specimen`: from 1, 0: there
    must be only one; `invert`: whose sign is turned; `needs_time`: otherwise a file without times has NaN for them."""

    columns: tuple = ("", "", "")
    units: tuple = ("", "", "")
    specimen: int = 0
    invert: str = ""
    needs_time: bool = True


class Record(NamedTuple):
    """A curve. `columns`: {name: values}; `units`: {name: unit}; `notes`: what was read, and what was left out, in lines; `is_own`: it is
    a curve.csv, which its machine has zeroed."""

    columns: dict
    units: dict
    notes: list
    is_own: bool


def read_record(file, reading=Reading()):
    """A curve.csv, also as a spreadsheet saves it, or what a testing machine exports. Raises WrongInput, which names file and row."""
    try:
        with open(file, "rb") as opened:
            content = opened.read()
    except OSError as error:
        raise WrongInput(f"cannot read {shown(file)}: {error.strerror.lower()}") from error
    require_text(content, file)
    texts = texts_of(content)
    return _own_curve(content, texts[0], file) or _of_machine(texts, file, reading)


def parsed_columns(text, option):
    """The parts of "time=NAME,extension=NAME,load=NAME", in this order. A name may contain commas. Raises WrongInput."""
    before, *parts = re.split("(?:^|,)(time|extension|load)=", text)
    given = dict(zip(parts[::2], parts[1::2]))
    if before or not parts or not all(parts):
        raise WrongInput(f"{option} is {shown(text) or chr(34) * 2}, but must be time=NAME,extension=NAME,load=NAME, or one or two of these")
    if 2 * len(given) < len(parts):
        raise WrongInput(f"{option} is {shown(text)}, but must be a list with each of time=, extension= and load= only once")
    return tuple(given.get(quantity.name, "") for quantity in QUANTITIES)


def _own_curve(content, text, file):
    """None of another file: raw data of a machine have no phases."""
    rows, where = text.split("\n"), f"{shown(file)}: row"
    separator = next((mark for mark in ",;\t" if {"time", "phase"} <= set(split(rows[0], mark))), None)
    if separator is None:
        return None
    cells = [(i + 1, [cell.replace(",", ".") for cell in split(row, separator)]) for i, row in enumerate(rows)]
    (_, names), *cells = [(row, own) for row, own in cells if any(own)]
    for row, own in cells:
        if len(own) != len(names):
            raise WrongInput(f"{where} {row} has {len(own)} columns, but must have {len(names)} as row 1 has")
    units = dict(zip(names, cells[0][1] if cells else []))
    for name, unit in UNITS.items():
        if units.get(name, unit if name == "balance_offset" else "missing") != unit:
            raise WrongInput(f"{where} 2: the unit of {name} is {shown(units.get(name, 'missing'))}, but must be {unit}")
    columns = {name: [own[i] if name == "phase" else _value(own[i], f"{where} {row}: {name}") for row, own in cells[1:]]
               for i, name in enumerate(names)}
    plain = {b"time", b"phase"} <= set(re.split(b"[\r\n]", content)[0].split(b","))
    return Record(columns, units, [] if plain else [f"{file}: read as a curve.csv that a spreadsheet saved anew"], True)


def _value(cell, where):
    try:
        return float(cell)
    except ValueError:
        raise WrongInput(f"{where} is \"{shown(cell)}\", but must be a number") from None


def _of_machine(texts, file, reading):
    nearest = ""
    for with_time in (True, False):
        if not with_time and (reading.needs_time or reading.columns[TIME]):
            break
        for text in texts:
            rows = rows_of(text, file)
            given = reading.columns, with_time
            named = (head_in(row, i, *given) for i, row in enumerate(rows))
            head = head_by_numbers(rows, *given) or next(filter(None, named), None)
            if head is None:
                nearest = nearest or nearest_head(rows, reading.columns, reading.needs_time)
                continue
            tables = _tables_from(rows, head, reading)
            return _Table(rows, *_chosen(tables, reading, file), reading, file).record(sum(one.specimens() for one, _ in tables))
    raise WrongInput(f"{shown(file)}: no row names the columns {'time, ' if reading.needs_time else ''}extension and load"
                     f"{'; ' if nearest else ''}{nearest}; --columns takes other names, or numbers, such as --columns "
                     "time=1,extension=2,load=3")


def _tables_from(rows, first, reading):
    """[(head, end)] of tables below each other, each with names of its own. Text between two of them belongs to none."""
    tables = [[first, len(rows)]]
    for row in range(first.first, len(rows) if first.names_row is not None else 0):
        if _is_reading(rows[row], first, tables[-1][0]):
            continue
        head = head_in(rows[row], row, reading.columns, bool(first.columns[TIME]))
        if head is None:
            continue
        end = row
        while end > tables[-1][0].first and not _is_reading(rows[end - 1], tables[-1][0], tables[-1][0]):
            end -= 1
        tables[-1][1] = end
        tables.append([head, len(rows)])
    return tables


def _is_reading(row, separated, head):
    cells, load = split(row, separated.separator), head.columns[LOAD][0].place
    return load < len(cells) and is_number(cells[load])


def _chosen(tables, reading, file):
    """Head and end of the table, and the place in it, of the specimen that is asked for, from 0."""
    count, wanted = sum(head.specimens() for head, _ in tables), reading.specimen
    if wanted == 0 and count > 1:
        begins = [str(head.names_row + 1) for head, _ in tables]
        where = f"in tables that begin with rows {', '.join(begins[:-1])} and {begins[-1]}" if len(tables) > 1 else "side by side"
        raise WrongInput(f"{shown(file)}: the file holds {count} specimens, {where}: choose one by --specimen 1 to {count}")
    left = max(wanted - 1, 0)
    for head, end in tables:
        if left < head.specimens():
            return head, end, left
        left -= head.specimens()
    raise WrongInput(f"{shown(file)}: --specimen is {wanted}, but the file holds {count} specimen{'s' if count > 1 else ''}")


class _Table:
    """One specimen of one table."""

    def __init__(self, rows, head, end, specimen, reading, file):
        self.head, self.reading, self.file = head, reading, file
        self.columns = head.of_specimen(specimen)
        if self.columns[EXTENSION].place == self.columns[LOAD].place:
            raise WrongInput(f"--columns is {shown(reading.columns[EXTENSION])} and {shown(reading.columns[LOAD])}, but must be another "
                             "column for the extension than for the load")
        cells = [(i, split(rows[i], head.separator)) for i in range(head.first, end)]
        while cells and not any(cells[0][1]):
            cells.pop(0)
        above = split(rows[head.names_row - 1], head.separator) if head.names_row else []
        self.below = self._row_of_units(cells, above)
        self.cells, self.notes = cells, []
        self.mark = self._decimals()
        self._prefer_crosshead(specimen)
        self.si = [column and self._si(i, column) for i, column in enumerate(self.columns)]

    def record(self, specimens):
        values, counts = self._values()
        values = self._without_jumps(*zip(*values))
        turned = _turned(values, self.reading.invert)
        count = len(values[0])
        line = f"{count} reading{'s' if count > 1 else ''}"
        line += f" of specimen {self.reading.specimen} of {specimens}" if specimens > 1 else ""
        line += ": " + ", ".join(f"{QUANTITIES[i].name} is {self._described(i)}" for i, column in enumerate(self.columns) if column)
        line += "" if self.columns[TIME] else "; no column of time"
        line += "".join(f"; {what}: {number}" for what, number in counts.items() if number)
        compressed = [f"\"{shown(column.label)}\" is the name of a test in compression; its sign is kept"
                      for column in self.columns if column and column.base.startswith("compressi")]
        none, notes = [NAN] * count, [line, *compressed, *self.notes, *turned]
        columns = [*values, none, none, none, ["pull"] * count, [0.0] * count]
        return Record(dict(zip(UNITS, columns)), UNITS, [f"{self.file}: {note}" for note in notes], False)

    def _values(self):
        """[(row, time, extension, load)] in SI, and how many rows were left out."""
        found, counts = [], {"rows left out that repeat the one before": 0, "empty rows": 0}
        for i, cells in self.cells:
            own = self._wanted(cells)
            if not own[EXTENSION] and not own[LOAD]:
                counts["empty rows"] += 1
                continue
            if any(cells[self.head.cells:]):  # a decimal comma that is not in quotes makes two cells of one
                self._refuse(i, f" has {len(cells)} cells, but must have {self.head.cells} as there are names; a number with a decimal "
                                "comma must stand in quotes")
            row = tuple(self._number(i, quantity, cell) for quantity, cell in enumerate(own))
            if found and row[TIME] < found[-1][1]:
                self._refuse(i, f": {shown(self._name(TIME))} goes back to {shown(own[TIME])}")
            if found and row[not self.columns[TIME]:] == found[-1][1:][not self.columns[TIME]:]:
                counts["rows left out that repeat the one before"] += 1
                continue
            found.append((i, *row))
        if not found:
            raise WrongInput(f"{shown(self.file)}: no row of numbers follows the names")
        return found, counts

    def _number(self, row, quantity, cell):
        if self.columns[quantity] is None:
            return NAN
        value = number(cell, self.mark)
        if value is None or not math.isfinite(value * self.si[quantity]):
            self._refuse(row, f": {shown(self._name(quantity))} is \"{shown(cell)}\", but must be a number with \"{self.mark}\" before its "
                              "decimals")
        return value * self.si[quantity]

    def _wanted(self, cells):
        return [cells[column.place] if column and column.place < len(cells) else "" for column in self.columns]

    def _row_of_units(self, cells, above):
        """Below the names, or else above them. The one below is taken out of the cells."""
        if cells and not any(map(has_digit, self._wanted(cells[0][1]))):
            return cells.pop(0)[1]
        own = self._wanted(above)
        all_known = all(QUANTITIES[i].si(without_brackets(own[i])) is not None for i, column in enumerate(self.columns) if column)
        return above if all_known else []

    def _decimals(self):
        mark, unclear = mark_of_decimals(cell for _, cells in self.cells for cell in self._wanted(cells))
        # Where commas separate the cells, a point is the mark of decimals.
        if unclear and not (self.head.separator == "," and "." in unclear):
            raise WrongInput(f"{shown(self.file)}: the number {shown(unclear)} may have decimals or thousands behind its mark, and no "
                             "other number of the file tells which: a zero more behind its decimals would")
        return mark or "."

    def _name(self, quantity):
        column = self.columns[quantity]
        return column.label or f"column {column.place + 1}"

    def _described(self, quantity):
        """"column 2, "Extension (mm)"", and its unit where its name does not have it."""
        column, given = self.columns[quantity], self.reading.units[quantity]
        label = f" \"{shown(column.label)}\"" if column.label else ""
        unit = f" in {shown(self._unit(quantity, column))}" if column.unit is None or given else ""
        return f"column {column.place + 1}{label}{unit}"

    def _below(self, column):
        return without_brackets(self.below[column.place]) if column.place < len(self.below) else ""

    def _unit(self, quantity, column):
        """As the user or the file gives it; empty where nobody does."""
        return self.reading.units[quantity] or (self._below(column) if column.unit is None else column.unit)

    def _si(self, quantity, column):
        of, given, unit = QUANTITIES[quantity], self.reading.units[quantity], self._unit(quantity, column)
        key = f"{shown(self.file)}: the unit of {'column ' if column.label else ''}{shown(self._name(quantity))}"
        if not unit:
            raise WrongInput(f"{key} is missing: give {of.allowed}, by --units {of.name}=UNIT")
        size, below = of.si(unit), self._below(column)
        if size is None:
            raise WrongInput(f"{f'--units is {of.name}={shown(unit)}' if given else f'{key} is {shown(unit)}'}, but must be {of.allowed}")
        if not given and below and of.si(below) != size:
            raise WrongInput(f"{key} is {shown(below)} below the name, but must be the same as in the name, {shown(unit)}")
        return size

    def _travel(self, column):
        """How far a column of extension goes [m]; None where it has no unit or no numbers."""
        size = QUANTITIES[EXTENSION].si(self._unit(EXTENSION, column))
        values = [value for _, cells in self.cells
                  if column.place < len(cells) and (value := number(cells[column.place], self.mark)) is not None]
        return (max(values) - min(values)) * size if values and size else None

    def _prefer_crosshead(self, specimen):
        """Where what is called an extension goes another way than the crosshead, it is that of an extensometer."""
        others = self.head.others(EXTENSION, specimen)
        own = self._travel(self.columns[EXTENSION]) if others else None
        for i, other in enumerate(others):
            way = self._travel(other)
            if own is None or way is None or self.columns[EXTENSION].of_machine or not other.of_machine:
                continue
            if abs(way - own) > ALIKE * max(way, own):
                self.columns[EXTENSION], others[i] = other, self.columns[EXTENSION]
        unread = [(EXTENSION, other, f", which goes over {_short(1e3 * way)} mm,")
                  for other in others if (way := self._travel(other)) is not None]
        for quantity, column, what in unread + [(LOAD, other, "") for other in self.head.others(LOAD, specimen)]:
            place = column.place + 1
            self.notes.append(f"column {place} \"{shown(column.label)}\"{what} is not read; --columns {QUANTITIES[quantity].name}={place} "
                              "would read it")

    def _without_jumps(self, rows, *columns):
        """Without single readings whose extension lies far off those before and behind them, on the same side."""
        s = columns[EXTENSION]
        steps = sorted(abs(b - a) for a, b in zip(s, s[1:]) if a != b)
        far = FAR * steps[len(steps) // 2] if len(steps) >= 5 else math.inf
        jumps = []
        for i in range(1, len(s) - 1):
            before, behind = s[i] - s[i - 1], s[i] - s[i + 1]
            # The one behind a jump lies far off that one only.
            if before * behind > 0.0 and min(abs(before), abs(behind)) > far and i - 1 not in jumps[-1:]:
                jumps.append(i)
        self.notes += [f"row {rows[i] + 1}, whose extension of {_short(1e3 * s[i])} mm lies far off the readings before and behind it, "
                       "is left out" for i in jumps[:NAMED]]
        if (more := len(jumps) - NAMED) > 0:
            self.notes.append(f"{more} other {'rows are' if more > 1 else 'row is'} left out for the same reason")
        left_out = set(jumps)
        return [[value for i, value in enumerate(column) if i not in left_out] for column in columns]

    def _refuse(self, row, why):
        """`why` goes on with the sentence that begins with the row."""
        raise WrongInput(f"{shown(self.file)}: row {row + 1}{why}")


def _turned(values, asked):
    """Turns the signs that are asked for, and says in a line what was turned, or what falls where nothing is asked for."""
    turned, falling = [], []
    for quantity, size, unit in ((EXTENSION, 1e-3, "mm"), (LOAD, 1.0, "N")):
        column, name = values[quantity], QUANTITIES[quantity].name
        first, low, high = column[0], min(column), max(column)
        down = first - low > max(high - first, 0.0)
        if asked in (name, "both") or (asked == "falling" and down):
            values[quantity] = [-value for value in column]
            turned.append(name)
        elif down and not asked:
            falling.append(f"the {name} falls from {_short(first / size)} to {_short(low / size)} {unit}")
    if turned:
        return [f"the sign of {' and '.join(turned)} is turned"]
    if falling:
        return [", and ".join(falling) + ", as in compression or where the sign is another one: --invert turns it"]
    return ["nothing falls, and --invert turns nothing; --invert=load, --invert=extension or --invert=both turn what they name"] \
        if asked == "falling" else []


def _short(value):
    """Three digits, and no exponent below a million: 1970 is read more easily than 1.97e+03."""
    text = f"{value + 0.0:.3g}"
    return f"{float(text):.0f}" if 1e3 <= abs(float(text)) < 1e6 else text
