#!/usr/bin/python3
"""Texts that a picture of the documents carries in its PNG: what it shows, and how it was made. A test holds them against what
the program says today.

    picture_facts.py RUN COMMAND    prints those of a run, one NAME=TEXT a line
"""
import os
import sys

import yaml

READINGS = {"plateau_force": "N", "lock_extension": "m"}


def facts_of_run(folder, command):
    result, method = (read_yaml(os.path.join(folder, name)) for name in ("result.yaml", "method.yaml"))
    readings = {key: "none" if result.get(key) is None else f"{result[key]:.6g} {unit}" for key, unit in READINGS.items()}
    described = f"{method['specimen']['knot']}, {method['material'].get('name', 'own material')}"
    return {**readings, "version": str(result["version"]), "method": described, "command": command}


def read_yaml(file):
    with open(file, encoding="utf-8") as text:
        return yaml.safe_load(text)


if __name__ == "__main__":
    for name, value in facts_of_run(*sys.argv[1:]).items():
        print(f"{name}={value}")
