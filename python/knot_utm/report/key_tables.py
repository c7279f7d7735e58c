"""Tables of keys, which the program writes: report/*.csv."""
import csv
import os


def table(name):
    """Its rows, by column."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))
