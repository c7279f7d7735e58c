#!/usr/bin/python3
"""Makes raw data as Instron's Bluehill exports it from a simulated curve: nobody measured them.

    tensile_test my_test.yaml --out out/softer --set material.stretching_stiffness=2.79e4 \\
        --set material.friction_coefficient=0.63 --set specimen.knot_distance=0.102
    synthetic_raw_data.py out/softer/curve.csv >Specimen_RawData_1.csv

The cell is not balanced and noisy. The crosshead starts anywhere, and stands there for two seconds before it moves.
"""
import csv
import random
import sys

OFFSET = 3.2                 # of the load [N]
START = 12.5                 # of the crosshead [mm]
REST = 2.0                   # before the pull [s]
NOISE, SHARE = 0.12, 0.003   # standard deviation [N], and of the load [-]


def read_pull(file):
    """Times from the zero of the pull on, extensions and loads."""
    with open(file, newline="", encoding="utf-8") as text:
        rows = list(csv.DictReader(text))
    first = next(i for i, row in enumerate(rows) if row["phase"] == "pull")
    begin = rows[first - 1]
    assert begin["phase"] == "balance", "the cell was not read as it was balanced"
    pulled = [begin] + [row for row in rows if row["phase"] == "pull"]
    return [(float(row["time"]) - float(begin["time"]), float(row["extension"]), float(row["load"])) for row in pulled]


def with_rest(readings):
    interval, load = readings[1][0], readings[0][2]
    count = round(REST / interval)
    rest = [(i * interval, 0.0, load) for i in range(count)]
    return rest + [(count * interval + time, extension, load) for time, extension, load in readings]


random.seed(1)
print('"Specimen label : Name","my rod (synthetic: simulated, with noise)",""', end="\r\n")
print('"Test rate : Rate 1","5.00","mm/s"', end="\r\n")
print(end="\r\n")
print("Time,Extension,Load\r\n(s),(mm),(N)", end="\r\n")
for time, extension, load in with_rest(read_pull(sys.argv[1])):
    noisy = load + random.gauss(0.0, NOISE + SHARE * abs(load))
    print(f"{time:.3f},{START + 1e3 * extension:.5f},{OFFSET + noisy:.5f}", end="\r\n")
