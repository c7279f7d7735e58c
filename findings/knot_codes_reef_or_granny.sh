#!/bin/bash
# A reef knot written as a code and read again, by Regina 7.3, the library of knots and 3-manifolds.
#
# The reef (square) knot is a trefoil and its mirror image in one line, the granny two trefoils of one hand. Both are the same curve on paper
# but for crossings that one of them changes; one of the two holds. Gauss codes, Dowker-Thistlethwaite (DT) codes and Regina's signature are
# the short ways to pass a knot on; PD, oriented Gauss and Jenkins' codes are the longer ones.
#
# Guessed: a Gauss or DT code may lose which mirror image it was, but a reef comes back as a reef or a mirror image of it, and a granny as a granny.
# Seen: Gauss and DT codes of reef and granny are the same strings. Read as Gauss code both are granny knots, read as DT code both are reefs:
# each of the two ways changes one of the knots into the other, without a word. Oriented Gauss, PD, Jenkins and signature keep them apart.
# The signature forgets the hand of a single trefoil, as Gauss and DT do (all read as the right-handed one); PD and oriented Gauss keep it.
# Why it matters: knots that people tie are sums more often than not (reef, granny, most bends when closed to a loop), and a simulated pull of
# the wrong one is a wrong answer with a right picture. Pass such knots on as PD code or as coordinates.
#
# usage: findings/knot_codes_reef_or_granny.sh
# It loads Debian packages into a temporary folder, installs nothing, and ends with 1 where Regina does otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -qq download regina-normal=7.3-2 libtokyocabinet9 libgvc6 libcgraph6 libcdt5 libpathplan4 libjansson4 libgmpxx4ldbl libltdl7 2>/dev/null
for package in *.deb; do dpkg -x "$package" tree; done
export LD_LIBRARY_PATH=tree/usr/lib:tree/usr/lib/x86_64-linux-gnu PYTHONPATH=tree/usr/lib/python3/dist-packages
/usr/bin/python3 - <<'PYTHON'
import regina
from regina import ExampleLink, Link


def joined(first, second):
    first.composeWith(second)
    return first


knots = {
    "right trefoil": ExampleLink.trefoilRight(),
    "left trefoil": ExampleLink.trefoilLeft(),
    "granny": joined(ExampleLink.trefoilRight(), ExampleLink.trefoilRight()),
    "reef": joined(ExampleLink.trefoilRight(), ExampleLink.trefoilLeft()),
}
# The Jones polynomial tells these four apart.
names = {str(knot.jones()): name for name, knot in knots.items()}
ways = {
    "Gauss": lambda knot: Link.fromGauss(knot.gauss()),
    "DT": lambda knot: Link.fromDT(knot.dt()),
    "signature": lambda knot: Link.fromKnotSig(knot.knotSig()),
    "oriented Gauss": lambda knot: Link.fromOrientedGauss(knot.orientedGauss()),
    "PD": lambda knot: Link.fromPD(knot.pd()),
    "Jenkins": lambda knot: Link.fromJenkins(knot.jenkins()),
}
kept = ["right trefoil", "left trefoil", "granny", "reef"]
expected = {
    "Gauss": ["right trefoil", "right trefoil", "granny", "granny"],
    "DT": ["right trefoil", "right trefoil", "reef", "reef"],
    "signature": ["right trefoil", "right trefoil", "granny", "reef"],
    "oriented Gauss": kept,
    "PD": kept,
    "Jenkins": kept,
}
wrong = regina.versionString() != "7.3" or len(names) != 4
print(f"Regina {regina.versionString()}; reef and granny, Gauss: {knots['reef'].gauss()} | {knots['granny'].gauss()}, "
      f"DT: {knots['reef'].dt()} | {knots['granny'].dt()}")
for code, way in ways.items():
    seen = [names[str(way(knot).jones())] for knot in knots.values()]
    wrong |= seen != expected[code]
    print(f"{code}: {', '.join(f'{a} -> {b}' for a, b in zip(knots, seen))}" + ("" if seen == expected[code] else f"   expected {expected[code]}"))
raise SystemExit(wrong)
PYTHON
