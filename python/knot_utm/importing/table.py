"""Reads what testing machines export: a text with a table of time, extension and load among others, in any order.

    characters  UTF-8, UTF-16, Shift-JIS, GB 18030, or a Windows code page (text.py)
    separator   semicolon, tab, bar, comma or blanks: the one with which a row names all three quantities
    names       those of names.py, with a number of the specimen before or behind them ("C_1_Time"), or those that the user gives, by
                number too. The row of names is the first that names all three quantities
    several     The machine's own name counts: "Extension" before "Tensile extension". A column that is called an extension and goes
                another way than the crosshead is an extensometer's; of two load cells the user chooses one. Several specimens, side by
                side or in tables below each other, are refused unless one is chosen. Tables with like heads whose time goes on are one test
    units       behind the names, in a row of their own below or above them, or given by the user; never guessed
    decimals    point or comma, the same in the whole file, of which a number must show which: 1,234 alone does not

The rows are converted to SI and are otherwise as recorded. A row that repeats the one before is left out. So is a row in which all are
empty, and a single reading whose extension jumps away and back as no machine does (faults.py)."""
import math
import re
from typing import NamedTuple

from knot_utm.errors import refuse_if, WrongInput
from knot_utm.importing.faults import spikes, spoilt, zero_set
from knot_utm.importing.heads import EXTENSION, head_by_numbers, head_in, kind_of, LOAD, nearest_head, TIME, without_brackets, WORDS
from knot_utm.importing.load_cell import load_cell_of
from knot_utm.importing.names import QUANTITIES, TONF
from knot_utm.importing.text import folded, has_digit, is_number, mark_of_decimals, number, require_text, rows_of, shown, split, texts_of

ALIKE = 0.05  # of the way: two columns go the same way
NAMED = 5     # rows of one kind in messages
EXTREMES = re.compile(r"max\w* ?/ ?min|peak ?/ ?valley|extrem", re.IGNORECASE)
MTS = re.compile(r"MTS793(?:\|[^|]*){4}\|([.,])\|")  # what its first line says of the file: the mark of decimals
DATE = re.compile(r"[0-9]{1,4}[./-] ?([0-9]{1,2}[./-][0-9]*|[^\W\d_]{3,}.*)|[^\W\d_]{3,}\.?[ -][0-9]{2,4}|#+")
INVERT = ("falling", "extension", "load", "both")
CYCLES = re.compile("((total|elapsed) )?cycles?( count| number)?")
NAN = math.nan
# Names and units of curve.csv, of which the machine measures three.
UNITS = {"time": "s", "extension": "m", "load": "N", "knot_distance": "m", "end_to_end": "m", "load_lower": "N", "phase": "-",
         "balance_offset": "N"}


class Reading(NamedTuple):
    """What a user says of a file. `columns`: names or numbers from 1; `units`: instead of those of the file; `specimen`: from 1, 0: there
    must be only one; `invert`: whose sign is turned; `needs_time`: otherwise a file without times has NaN for them; `join`: what was
    recorded before the crosshead was set to zero is shifted to go on; `rate`: readings per second, 0: as the file says."""

    columns: tuple = ("", "", "")
    units: tuple = ("", "", "")
    specimen: int = 0
    invert: str = ""
    needs_time: bool = True
    join: bool = False
    rate: float = 0.0


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
    if log := load_cell_of(texts[0], file, reading.rate):
        return _measured(file, *log, reading.invert)
    return _own_curve(content, texts[0], file) or _of_machine(texts, file, reading)


def _measured(file, values, notes, invert):
    """A record of [times, extensions, loads], their signs as the user wants them."""
    turned, count = _turned(values, invert), len(values[LOAD])
    columns = [*values, *[[NAN] * count] * 3, ["pull"] * count, [0.0] * count]
    return Record(dict(zip(UNITS, columns)), UNITS, [f"{file}: {note}" for note in [*notes, *turned]], False)


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
        if not with_time and ((reading.needs_time and not reading.rate) or reading.columns[TIME]):
            break
        for text in texts:
            rows = rows_of(text, file)
            given = reading.columns, with_time
            named = (head_in(row, i, *given) for i, row in enumerate(rows))
            head = head_by_numbers(rows, *given) or next(filter(None, named), None)
            if head is None:
                nearest = nearest or kind_of(rows) or nearest_head(rows, reading.columns, reading.needs_time)
                continue
            tests, notes = _tests_of(*_tables_from(rows, head, reading))
            table = _Table(declared_mark(rows), *_chosen(tests, reading, file), reading, file)
            return table.record(sum(blocks[0].head.specimens() for blocks in tests), notes)
    raise WrongInput(f"{shown(file)}: no row names the columns {'time, ' if reading.needs_time else ''}extension and load"
                     f"{'; ' if nearest else ''}{nearest}; --columns takes other names, or numbers, such as --columns "
                     "time=1,extension=2,load=3")


class _Block:
    """A table with names of its own. `units`: the row that may have them, below the names or else above; `cells`: [(row, cells)] of its
    readings; `times`: those that are numbers; `kind`: what tables of one kind have in common; `is_of_extremes`: the lines above say so."""

    def __init__(self, rows, head, end):
        cells = [(i, split(rows[i], head.separator)) for i in range(head.first, end)]
        self.head = head = head.repeated(next((own for _, own in cells if head.is_reading(own)), []))
        begins = next((i for i, (_, own) in enumerate(cells) if any(map(is_number, head.wanted(own)))), len(cells))
        words = next((own for _, own in cells[:begins] if any(own)), ["0"])
        above = split(rows[head.names_row - 1], head.separator) if head.names_row else []
        self.units = above if any(map(has_digit, head.wanted(words))) or words == ["0"] else words
        self.units_above = self.units is above
        self.cells, time = cells[begins:], head.columns[TIME][0].place if head.columns[TIME] else math.inf
        texts = [own[time] for _, own in self.cells if time < len(own)]
        mark = mark_of_decimals(texts)[0] or declared_mark(rows) or "."
        self.times = [value for text in texts if (value := number(text, mark)) is not None]
        self.kind = head.names, () if self.units_above else tuple(self.units)
        self.is_of_extremes = any(map(EXTREMES.search, rows[max((head.names_row or 0) - 5, 0):head.names_row or 0]))


def _tables_from(rows, first, reading):
    """Tables below each other, each with names of its own, and rows of names of other quantities. Text between belongs to none."""
    begins, latest = [(first.names_row or 0, first)], math.inf
    for row in range(first.first, len(rows) if first.names_row is not None else 0):
        cells = split(rows[row], first.separator)
        if first.is_reading(cells):
            latest = row
        elif WORDS.search(rows[row]):
            head = head_in(rows[row], row, reading.columns, bool(first.columns[TIME]) and any(reading.columns))
            # By numbers any row of words would name them.
            is_named = head and (head.names == first.names or not any(map(str.isdigit, reading.columns)))
            words = [] if any(map(is_number, cells)) else list(filter(None, cells))
            if is_named or (latest < row - 1 and (head or (len(words) > 1 and not _goes_on(rows, first, latest, row)))):
                begins.append((row, head if is_named else None))
                latest = math.inf
    blocks, others = [], []
    for (row, head), (end, _) in zip(begins, [*begins[1:], (len(rows), None)]):
        while head and head.first < end < len(rows) and not head.is_reading(split(rows[end - 1], head.separator)):
            end -= 1
        blocks += [_Block(rows, head, end)] if head else []
        others += [row] if head is None and any(is_number(split(line, first.separator)[0]) for line in rows[row:end] if line) else []
    return blocks, others


def _goes_on(rows, head, latest, row):
    """Whether readings behind a row of words continue those up to the row `latest`, so that it is one amid the record."""
    cells = [split(line, head.separator) for line in (rows[latest], *rows[row + 1:row + 4])]
    times = [own[head.places[0]] for own in cells if head.is_reading(own)]
    mark = mark_of_decimals(times)[0] or declared_mark(rows) or "."
    return len(times) > 1 and (not head.columns[TIME] or number(times[1], mark) >= number(times[0], mark))


def _tests_of(blocks, others):
    """[[block, ...]], a list for each test, and what a user should see of that: tables of one kind whose time goes on are one test, and a
    table of extremes is none. `others`: rows with the names of what is none either."""
    tests = []
    for block in blocks:
        before = [test for test in tests if test[0].kind == block.kind and test[0].times and block.times
                  and test[0].times[0] < block.times[0] >= test[-1].times[-1]]
        if block.is_of_extremes and len(blocks) > 1:
            others = [*others, block.head.names_row]
        elif before:
            max(before, key=lambda test: test[-1].times[-1]).append(block)
        else:
            tests.append([block])
    within = [test for test in tests if any(_are_extremes(test, other) for other in tests)]
    others = [*others, *(block.head.names_row for test in within for block in test)]
    tests = [test for test in tests if test not in within] or [blocks]
    notes = [f"one test in {len(test)} tables whose time goes on, with their names in rows {_listed(test)}" for test in tests if len(test) > 1]
    notes += [f"what stands below the names in row {min(others) + 1}, such as extremes, is no part of the record"] if others else []
    return tests, notes


def _are_extremes(test, other):
    """Whether a test holds but extremes of the other one: it has no times, or fewer and from their midst."""
    own, all_ = ([time for block in blocks for time in block.times] for blocks in (test, other))
    if not own or not all_:
        return bool(all_)
    is_amid = all_[0] < min(own) and max(own) <= all_[-1] if len(own) > 2 else all_[0] < max(own) and min(own) < all_[-1]
    return 2 * len(own) <= len(all_) and is_amid


def declared_mark(rows):
    """That of decimals, as the first line of MTS 793 says it; empty in other files."""
    first = MTS.match(rows[0]) if rows else None
    return first[1] if first else ""


def _listed(blocks):
    """Their rows of names."""
    rows = [str(block.head.names_row + 1) for block in blocks]
    return f"{', '.join(rows[:-1])} and {rows[-1]}"


def _chosen(tests, reading, file):
    """The blocks of the test, and the place in it, of the specimen that is asked for, from 0."""
    count, wanted = sum(blocks[0].head.specimens() for blocks in tests), reading.specimen
    if wanted == 0 and count > 1:
        where = f"in tables that begin with rows {_listed([blocks[0] for blocks in tests])}" if len(tests) > 1 else "side by side"
        raise WrongInput(f"{shown(file)}: the file holds {count} specimens, {where}: choose one by --specimen 1 to {count}")
    all_ = [(blocks, place) for blocks in tests for place in range(blocks[0].head.specimens())]
    refuse_if(wanted > count, f"{shown(file)}: --specimen is {wanted}, but the file holds {count} specimen{'s' if count > 1 else ''}")
    return all_[max(wanted - 1, 0)]


class _Table:
    """One specimen of one test."""

    def __init__(self, mark, blocks, specimen, reading, file):
        self.head, self.reading, self.file = blocks[0].head, reading, file
        self.columns = self.head.of_specimen(specimen)
        if self.columns[EXTENSION].place == self.columns[LOAD].place:
            raise WrongInput(f"--columns is {shown(reading.columns[EXTENSION])} and {shown(reading.columns[LOAD])}, but must be another "
                             "column for the extension than for the load")
        self.cells, self.notes, own = [row for block in blocks for row in block.cells], [], self._wanted(blocks[0].units)
        all_known = all(QUANTITIES[i].si(without_brackets(own[i])) is not None for i, column in enumerate(self.columns) if column)
        self.below = blocks[0].units if all_known or not blocks[0].units_above else []
        self.mark = self._decimals(mark)
        self._prefer_crosshead(specimen)
        self.si = [column and self._si(i, column) for i, column in enumerate(self.columns)]
        self._ask_for_load(specimen)
        self._judge_cycles()

    def record(self, specimens, notes):
        values, counts = self._values()
        values = self._as_one(*self._without_spikes(*zip(*values)))
        count = len(values[LOAD])
        line = f"{count} reading{'s' if count > 1 else ''}"
        line += f" of specimen {self.reading.specimen} of {specimens}" if specimens > 1 else ""
        line += ": " + ", ".join(f"{QUANTITIES[i].name} is {self._described(i)}" for i, column in enumerate(self.columns) if column)
        line += "" if self.columns[TIME] else f"; {self.reading.rate:g} of them a second" if self.reading.rate else "; no column of time"
        line += "".join(f"; {what}: {number}" for what, number in counts.items() if number)
        compressed = [f"\"{shown(column.label)}\" is the name of a test in compression; its sign is kept"
                      for column in self.columns if column and column.base.startswith("compressi")]
        return _measured(self.file, values, [line, *compressed, *notes, *self.notes], self.reading.invert)

    def _values(self):
        """[(row, time, extension, load)] in SI, and how many rows were left out."""
        self._refuse_spoilt()
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
        refuse_if(not found, f"{shown(self.file)}: no row of numbers follows the names")
        if rate := self.reading.rate:
            refuse_if(self.columns[TIME], f"{shown(self.file)}: --rate is {rate:g}, but the file has times of its own")
            found = [(row, (row - found[0][0]) / rate, s, load) for row, _, s, load in found]
        return found, counts

    def _refuse_spoilt(self):
        """Refuses a column whose mark of decimals a spreadsheet has taken for that of thousands."""
        for quantity, column in enumerate(self.columns):
            rows = [(i, cell) for i, cells in self.cells if (cell := self._wanted(cells)[quantity])]
            if column and (found := spoilt([cell for _, cell in rows], self.mark)):
                row, cell = rows[found[0]]
                self._refuse(row, f": {shown(self._name(quantity))} is {shown(cell)}, where the rows beside it lead to {found[1]:g}: a "
                                  "spreadsheet took decimals for thousands and moved the mark; export the table anew and open it in none")

    def _number(self, row, quantity, cell):
        if self.columns[quantity] is None:
            return NAN
        value = number(cell, self.mark)
        if value is None or not math.isfinite(value * self.si[quantity]):
            self._refuse(row, f": {shown(self._name(quantity))} is \"{shown(cell)}\", but must be a number with \"{self.mark}\" before its "
                              f"decimals{', of which a spreadsheet made something else' if DATE.fullmatch(cell) else ''}")
        return value * self.si[quantity]

    def _wanted(self, cells):
        return [cells[column.place] if column and column.place < len(cells) else "" for column in self.columns]

    def _decimals(self, declared):
        mark, unclear = mark_of_decimals(cell for _, cells in self.cells for cell in self._wanted(cells))
        # Where commas separate the cells, a point is the mark of decimals.
        if unclear and not declared and not (self.head.separator == "," and "." in unclear):
            raise WrongInput(f"{shown(self.file)}: the number {shown(unclear)} may have decimals or thousands behind its mark, and no "
                             "other number of the file tells which: a zero more behind its decimals would")
        return mark or declared or "."

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
        place = column.place % self.head.period
        return without_brackets(self.below[place]) if place < len(self.below) else ""

    def _unit(self, quantity, column):
        """As the user or the file gives it; empty where nobody does."""
        return self.reading.units[quantity] or (self._below(column) if column.unit is None else column.unit)

    def _si(self, quantity, column):
        of, given, unit = QUANTITIES[quantity], self.reading.units[quantity], self._unit(quantity, column)
        key = f"{shown(self.file)}: the unit of {'column ' if column.label else ''}{shown(self._name(quantity))}"
        refuse_if(not unit, f"{key} is missing: give {of.allowed}, by --units {of.name}=UNIT")
        size, below = of.si(unit), self._below(column)
        if size is None:
            raise WrongInput(f"{f'--units is {of.name}={shown(unit)}' if given else f'{key} is {shown(unit)}'}, but must be {of.allowed}")
        refuse_if(math.isnan(size), f"{key} is {shown(unit)}, which is {TONF}")
        if not given and below and of.si(below) != size:
            raise WrongInput(f"{key} is {shown(below)} below the name, but must be the same as in the name, {shown(unit)}")
        return size

    def _travel(self, column):
        """How far a column of extension goes [m]; None where it has no unit or no numbers."""
        values = [value for value in self._numbers(EXTENSION, column) if value is not None]
        return max(values) - min(values) if values else None

    def _numbers(self, quantity, column):
        """Those of a column, in SI; None where there is none, or no unit."""
        size = QUANTITIES[quantity].si(self._unit(quantity, column))
        cells = (number(own[column.place], self.mark) if size and column.place < len(own) else None for _, own in self.cells)
        return [value if value is None else value * size for value in cells]

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
        for other in others:
            if (way := self._travel(other)) is not None:
                self._leave(EXTENSION, other, f", which goes over {_short(1e3 * way)} mm,")

    def _ask_for_load(self, specimen):
        """Two columns of a load are those of two cells, unless they read the same but for the sign. Raises WrongInput."""
        own = self.columns[LOAD]
        for other in self.head.others(LOAD, specimen):
            pairs = [(a, b) for a, b in zip(self._numbers(LOAD, own), self._numbers(LOAD, other)) if a is not None and b is not None]
            (low, high), (least, most) = [(min(column), max(column)) for column in zip(*pairs)] or [(0.0, 0.0)] * 2
            if any(abs(abs(a) - abs(b)) > ALIKE * max(high - low, most - least) for a, b in pairs):
                raise WrongInput(f"{shown(self.file)}: there are two loads, column {own.place + 1} \"{shown(own.label)}\" from {_short(low)} "
                                 f"to {_short(high)} N and column {other.place + 1} \"{shown(other.label)}\" from {_short(least)} to "
                                 f"{_short(most)} N: choose one by --columns load={own.place + 1} or load={other.place + 1}")
            self._leave(LOAD, other, "")

    def _leave(self, quantity, column, what):
        place = column.place + 1
        self.notes.append(f"column {place} \"{shown(column.label)}\"{what} is not read; --columns {QUANTITIES[quantity].name}={place} "
                          "would read it")

    def _judge_cycles(self):
        """Says where a record begins behind its first cycle. Raises WrongInput where it has one row a cycle."""
        place = next((i for i, name in enumerate(self.head.names) if CYCLES.fullmatch(folded(name))), math.inf)
        cycles = [(number(own[place], self.mark), i) for i, own in self.cells if place < len(own)]
        counts = [count for count, _ in cycles if count is not None]
        if len(counts) > 3 and all(a < b and b % 1.0 == 0.0 for a, b in zip(counts, counts[1:])):
            self._refuse(cycles[0][1], ": from here on there is one row a cycle, as in a file of trends: give that of all readings (tracking)")
        if counts and counts[0] > 1.0:
            self.notes.append(f"it begins with cycle {counts[0]:g}, as a file of the last ones (Stop): what was before is in another file")

    def _without_spikes(self, rows, *columns):
        """Without single readings whose extension lies far off those before and behind them, on the same side."""
        s, load = columns[EXTENSION], columns[LOAD]
        out = spikes(*columns)
        self.notes += [f"row {rows[i] + 1}, whose extension of {_short(1e3 * s[i])} mm lies far off the readings before and behind it, "
                       f"is left out, and with it its load of {_short(load[i])} N" for i in out[:NAMED]]
        if more := out[NAMED:]:
            self.notes.append(f"{len(more)} other {'rows are' if len(more) > 1 else 'row is'} left out for the same reason, with loads from "
                              f"{_short(min(load[i] for i in more))} to {_short(max(load[i] for i in more))} N")
        left_out = set(out)
        return [[value for i, value in enumerate(column) if i not in left_out] for column in (rows, *columns)]

    def _as_one(self, rows, time, s, load):
        """The record with one zero, where the crosshead was set to zero in it and it may be joined. Raises WrongInput where not."""
        for i, by, force in zero_set(time, s, load):
            jump = f"by {_short(1e3 * by)} mm" + (f", and the load by {_short(force)} N" if force else "")
            if not self.reading.join:
                self._refuse(rows[i], f": the extension jumps {jump} from the row before, as no machine moves: it was set to zero within the "
                                      "test; --join shifts what is before, to go on there")
            self.notes.append(f"joined at row {rows[i] + 1}, where the crosshead was set to zero: the extension before it is shifted {jump}")
            s, load = ([value + shift if k < i else value for k, value in enumerate(column)] for column, shift in ((s, by), (load, force)))
        return [time, s, load]

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
