"""Saved time steps of an older layout, written anew in the present one (scripts/resave-steps).

A saved time step is one archive (include/knot_utm/numeric/archive.hpp). Each of its sections begins with a mark of four
letters, and whoever changes what a section holds gives it another mark. CONVERSIONS says below how a section of the old
mark becomes one of the new mark.
"""
import struct
import zlib

from knot_utm.report.commands import OneLineParser, refuse

HEADING = b"knot_utm time step, version "
NEWEST = (b"PRO3", b"SET5", b"BND3")


class Unknown(Exception):
    """What keeps a file from being rewritten."""


class Reader:
    """Where the parts of an archive end that begin at a place."""

    def __init__(self, payload, place):
        self.payload, self.place = payload, place

    def words(self, count=1):
        """Numbers, whole ones, and choices take eight bytes each."""
        self.place += 8 * count

    def length(self):
        (length,) = struct.unpack_from("<Q", self.payload, self.place)
        self.words()
        return length

    def text(self):
        length = self.length()
        self.place += length

    def numbers(self):
        self.words(self.length())

    def optional(self):
        self.words(self.length())


def laws_of_the_rod(payload):
    """The bending law moves from the settings to the rod's laws, and a twisting law, the only one, stands behind it. Of the
    material only what a time step takes from it stays."""
    if not payload.startswith(b"PRO2"):
        return payload
    material = Reader(payload, len(b"PRO2"))
    material.text()  # name
    taken = material.place
    material.words(5)  # radius, density, stiffnesses
    taken = payload[taken:material.place]
    material.words()  # friction coefficient
    for _ in range(3):  # contact stiffness, pre-load, breaking force
        material.optional()
    for _ in range(2):  # load cell, notes
        material.text()
    rod = Reader(payload, material.place)
    for _ in range(4):  # rest and Voronoi lengths, masses, natural twist
        rod.numbers()
    rod.words()  # stretching law, without parameters
    boundary = payload.index(b"BND3", rod.place)
    if payload[rod.place:rod.place + 4] != b"SET4":
        raise Unknown("its settings are not of the layout SET4")
    # Behind the bending law: iterations, twist, curved, time and length of the step.
    law = boundary - 6 * 8
    if payload[law:law + 8] != bytes(8):
        raise Unknown("it bends by a law with parameters")
    settings = payload[rod.place + 4:law] + payload[law + 8:]
    return b"PRO3" + taken + payload[material.place:rod.place] + payload[law:law + 8] + bytes(8) + b"SET5" + settings


CONVERSIONS = [laws_of_the_rod]  # the oldest first; each leaves what is not of its old mark as it is


def resaved(content):
    heading, line, rest = content.partition(b"\n")
    if not heading.startswith(HEADING) or len(rest) < 12 or zlib.crc32(content[:-4]) != int.from_bytes(content[-4:], "little"):
        raise Unknown("it is no saved time step, or damaged")
    payload = rest[8:-4]
    for convert in CONVERSIONS:
        payload = convert(payload)
    for mark in NEWEST:
        if mark not in payload:
            raise Unknown(f"it has no section {mark.decode()}")
    out = heading + line + struct.pack("<Q", len(payload)) + payload
    return out + struct.pack("<I", zlib.crc32(out))


def main():
    parser = OneLineParser(prog="resave-steps", description="Rewrites saved time steps in the present layout.")
    parser.add_argument("files", metavar="FILE", nargs="+", help="a saved time step")
    for name in parser.parse_args().files:
        try:
            with open(name, "rb") as file:
                content = file.read()
            out = resaved(content)
        except (OSError, Unknown, ValueError, OverflowError, struct.error) as error:
            refuse("resave-steps", f"{name}: {error}")
        if out != content:
            with open(name, "wb") as file:
                file.write(out)


if __name__ == "__main__":
    main()
