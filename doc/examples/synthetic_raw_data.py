#!/usr/bin/python3
"""Makes raw data as Instron's Bluehill exports it from a simulated curve: nobody measured them.

    synthetic_raw_data.py curve.csv >Specimen_RawData_1.csv

The cell is not balanced and noisy, the crosshead starts anywhere.
"""
import csv
import random
import sys

OFFSET = 3.2                 # of the load [N]
START = 12.5                 # of the crosshead [mm]
NOISE, SHARE = 0.12, 0.003   # standard deviation [N], and of the load [-]

random.seed(1)
with open(sys.argv[1], newline="", encoding="utf-8") as text:
    rows = [row for row in csv.DictReader(text) if row["phase"] == "pull"]
print('"Specimen label : Name","my rod (synthetic: simulated, with noise)",""', end="\r\n")
print('"Test rate : Rate 1","5.00","mm/s"', end="\r\n")
print(end="\r\n")
print("Time,Extension,Load\r\n(s),(mm),(N)", end="\r\n")
for row in rows:
    time, extension, load = (float(row[name]) for name in ("time", "extension", "load"))
    noisy = load + random.gauss(0.0, NOISE + SHARE * abs(load))
    print(f"{time - float(rows[0]['time']):.3f},{START + 1e3 * extension:.5f},{OFFSET + noisy:.5f}", end="\r\n")
