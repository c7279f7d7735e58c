"""Files whose character encoding nobody names, as text; their rows as cells, and cells as numbers."""
import csv
import re
import unicodedata

from knot_utm.errors import refuse_if, WrongInput

# Without a mark, and not UTF-8: the first of them in which a row names the columns.
ENCODINGS = ("cp1252", "cp1250", "cp932", "gb18030")
SEPARATORS = ";\t|, "  # in the order in which they are tried; a blank stands for any number of blanks
MOST_ROWS, MOST_LINES = 2_000_000, 8  # the latter of a cell in quotes, behind its first
LARGEST = 2**30
BLANK = " \t\r"
NO_LINE = dict.fromkeys(map(ord, "\0\r\n"), " ")
csv.field_size_limit(LARGEST)

SAVE = ": save its table as CSV (comma-separated text) and give that file"
EXPORT = ", and no text: export its raw data as text in the program that wrote it, and give that file"
NO_TEXT = {b"TDSm": "a measurement file of LabVIEW (TDMS)" + EXPORT, b"TDAT": "a test of Bluehill (id_tens and others)" + EXPORT,
           b"MATLAB 5.0": "a MAT-file" + EXPORT, b"\x89HDF": "an HDF5 file" + EXPORT,
           b"PK\x03\x04": "a workbook (xlsx, ods) or another zip archive, and no text" + SAVE,
           b"\xD0\xCF\x11\xE0": "an old workbook (xls), and no text" + SAVE,
           b"%PDF": "a PDF, and no table of text" + SAVE,
           b"\x1F\x8B": "compressed (gzip): unpack it first, for example by gunzip",
           b"SQLite format 3": "a data base (SQLite), and no text" + SAVE,
           b"#ROSBAG": "a bag, and no table of text: give the curve.csv of its run, or the raw data. compare reads a bag whose name "
                       "ends in .bag"}

# Letters that mean a plain one, though Unicode does not call them compatible, and marks without width.
SIGNS = {0x066B: ".", 0x066C: "'", 0x2212: "-", 0x2019: "'", 0x2018: "'", 0x02BC: "'", 0x3010: "[", 0x3011: "]", 0x2010: "-",
         0xFEFF: None, **dict.fromkeys(range(0x200B, 0x2010))}
has_digit = re.compile("[0-9]").search
BARE = str.maketrans("łø", "lo")  # they have no accent
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
GROUPED = {mark: re.compile(rf"[+-]?[1-9][0-9]{{0,2}}({re.escape(mark)}[0-9]{{3}})+") for mark in ",. '"}


def shown(text):
    """In one line of a message."""
    line = "".join(" " if ord(c) < 0x20 or ord(c) == 0x7f else c for c in text[:500])
    return line if len(text) <= 500 else line + "..."


def require_text(content, file):
    """Raises WrongInput where the bytes of a file are no text, such as those of a workbook, and says what to do about it."""
    kind = next((what for mark, what in NO_TEXT.items() if content.startswith(mark)), "")
    if content.startswith(b"\x1F\x8B") and file.lower().endswith(".zs2"):
        kind = "a test of testXpert (zs2)" + EXPORT
    if content[:512].lstrip(b" \r\n\t\xEF\xBB\xBF").startswith(b"<"):
        kind = "XML or HTML, as some programs write for a workbook, and no table of text" + SAVE
    elif not content.strip(b" \r\n\t"):
        kind = "empty"
    elif len(content) > LARGEST:
        kind = "larger than 1 GiB, which is too large for a table of text"
    refuse_if(kind, f"{shown(file)}: the file is {kind}")
    if content.count(b"\r") > 2 * content.count(b"\n") and content.find(b"\r") + 1 < len(content):
        raise WrongInput(f"{shown(file)}: the lines of the file end with a carriage return alone, as on old Macs: give it the usual line "
                         r"ends first, for example by tr '\r' '\n' <FILE >NEW_FILE")


def texts_of(content):
    """What the bytes may mean, the most likely first: one text where there is a mark, or where they are UTF-16 or UTF-8."""
    if content[:2] in (b"\xFF\xFE", b"\xFE\xFF"):
        encodings = ["utf-16"]
    elif utf16 := _unmarked_utf16(content[:4096]):
        encodings = [utf16]
    else:
        try:
            return [_plain(content.decode("utf-8"))]
        except UnicodeDecodeError:
            encodings = ENCODINGS
    return [_plain(content.decode(encoding, "replace")) for encoding in encodings]


def _unmarked_utf16(head):
    """Digits, separators and line ends have one byte that is 0."""
    head = head[:len(head) // 2 * 2]
    zeros = [head[i::2].count(0) for i in (0, 1)]
    for high, name in ((1, "utf-16-le"), (0, "utf-16-be")):
        if 8 * zeros[high] > len(head) > 8 and 8 * zeros[1 - high] < zeros[high]:
            return name
    return None


def _plain(text):
    """Compatible letters as the plain ones, digits of any script as ours, and without the padding of old programs."""
    if not text.isascii():
        text = unicodedata.normalize("NFKC", text)
        digits = {ord(c): str(unicodedata.decimal(c)) for c in set(text) if c > "\x7f" and unicodedata.decimal(c, None) is not None}
        text = text.translate({**SIGNS, **digits})
    kept = text.rstrip("\0\x1A \r\n")
    return kept + "\n" if kept and re.search("[\0\x1A]", text[len(kept):]) else text


def folded(text):
    """By which names are compared: small letters without accents, without dots behind abbreviations, one blank between words. An
    underscore is a blank."""
    if not text.isascii():
        apart = unicodedata.normalize("NFKD", unicodedata.normalize("NFKC", text).casefold())
        text = "".join(c for c in apart if unicodedata.category(c) != "Mn").translate(BARE)
    once = re.sub(" +", " ", text.lower().replace("_", " ")).lstrip(" ")
    return once[:1] + once[1:].rstrip(". ")


def rows_of(text, file):
    """The rows. A cell in quotes may go over some lines, as names in spreadsheets do: they become the first of these rows, and the
    others are empty, so that all rows keep their numbers. Raises WrongInput where there are too many."""
    rows = text.split("\n")
    if not rows[-1]:
        rows.pop()
    refuse_if(len(rows) > MOST_ROWS, f"{shown(file)}: there are more than {MOST_ROWS} rows")
    for i, row in enumerate(rows):
        if not _is_open(row):
            continue
        for j in range(i + 1, min(i + 1 + MOST_LINES, len(rows))):
            row += " " + rows[j].strip(BLANK)
            if not _is_open(row):
                rows[i:j + 1] = [row] + [""] * (j - i)
                break
    return rows


def _is_open(row):
    """Whether a quote that begins a cell is not closed. An inch, as in "Extension (")", begins none."""
    opened, i = False, row.find('"')
    while i >= 0:
        if opened and row[i + 1:i + 2] == '"':
            i += 1
        else:
            opened = not opened and (i == 0 or row[i - 1] in ",;|\t ")
        i = row.find('"', i + 1)
    return opened


def split(row, separator):
    """The cells of a row, without blanks around them. A quoted cell may contain the separator, and two quotes for one."""
    if separator == " ":
        return [word for word in row.strip(BLANK).split(" ") if word]
    cells = row.split(separator)
    if '"' in row:
        cells = next(csv.reader([row.translate(NO_LINE)], delimiter=separator, skipinitialspace=True), [""])
    return [cell.strip(BLANK) for cell in cells]


def split_names(row, separator):
    """The same of a row of names, which may begin with the mark of a comment. Blanks separate names by two or more where there are
    such, else by one, where a unit in brackets belongs to the name before it."""
    row = re.sub("^ *[#%][#% ]*", "", row)
    if separator != " ":
        return split(row, separator)
    row = row.strip(BLANK)
    return re.split(" {2,}", row) if "  " in row else re.split(r" (?![(\[])", row) if row else []


def number(cell, mark):
    """A number with this mark before its decimals; the other mark, blanks or apostrophes may separate groups of three digits. None
    where it is none."""
    whole, point, decimals = cell.partition(mark)
    for groups in ("," if mark == "." else ".", " ", "'"):
        if groups in whole:
            if not GROUPED[groups].fullmatch(whole):
                return None
            whole = whole.replace(groups, "")
    text = whole + "." + decimals if point else whole
    return float(text) if NUMBER.fullmatch(text) else None


def is_number(cell):
    return number(cell, ".") is not None or number(cell, ",") is not None


def mark_of_decimals(cells):
    """The mark, which the first cell that tells it tells for all; empty where none does, and then the first number of three digits
    behind a mark, which may be decimals or not."""
    unclear = ""
    for cell in cells:
        point, comma = cell.rfind("."), cell.rfind(",")
        if point == comma:  # it has neither
            continue
        mark, other = (".", ",") if point > comma else (",", ".")
        if min(point, comma) < 0 and cell.count(mark) > 1:
            return other, ""
        if min(point, comma) >= 0 or not GROUPED[mark].fullmatch(cell):
            return mark, ""
        unclear = unclear or cell
    return "", unclear
