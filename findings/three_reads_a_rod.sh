#!/bin/bash
# A rod with readings on its nodes, opened in a browser's viewer: three.js 0.180.0 (REVISION 180) and its loaders of glTF, VTK and PLY.
#
# The same polyline of 60 nodes with a tension on each, written as each format has it: glTF 2.0 as LINE_STRIP with the attributes _TENSION and
# _contactForce (names of one's own begin with an underscore), legacy .vtk with LINES and SCALARS, .ply with elements vertex and edge.
#
# Guessed: the glTF arrives whole; .vtk and .ply lines are drawn, or refused.
# Seen: GLTFLoader makes a Line, but calls the attributes _tension and _contactforce: a shader or script that asks for _TENSION gets undefined.
# VTKLoader reads LINES as a geometry without a single point, without a word; the same points as polygons arrive. PLYLoader keeps 60 loose
# points, drops edges and tension, without a word (a property comes when setCustomPropertyNameMapping names it; edges never).
# Why it matters: of the three only glTF brings a curve into a browser, under other names; the other two show nothing or dots where ParaView
# shows the rod. Meshes (tubes) arrive in all of them.
#
# usage: findings/three_reads_a_rod.sh
# It loads an npm package into a temporary folder, needs node, installs nothing, and ends with 1 where three.js does otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --prefix . three@0.180.0
cat > rod.mjs <<'JS'
import { REVISION } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { VTKLoader } from "three/examples/jsm/loaders/VTKLoader.js";

const nodes = [...Array(60).keys()], places = nodes.map((i) => [i, (i * i) % 7, 0]), tension = nodes.map((i) => 1 + i);

Object.assign(globalThis, { self: globalThis, ProgressEvent: class {} }); // what the loader expects of a browser
const bytes = Buffer.from(new Float32Array([...places.flat(), ...tension]).buffer), split = 4 * 3 * nodes.length;
const gltf = {
  asset: { version: "2.0" },
  scene: 0,
  scenes: [{ nodes: [0] }],
  nodes: [{ mesh: 0 }],
  meshes: [{ primitives: [{ mode: 3, attributes: { POSITION: 0, _TENSION: 1, _contactForce: 1 } }] }],
  accessors: [
    { bufferView: 0, componentType: 5126, count: nodes.length, type: "VEC3", min: [0, 0, 0], max: [59, 4, 0] },
    { bufferView: 1, componentType: 5126, count: nodes.length, type: "SCALAR" },
  ],
  bufferViews: [{ buffer: 0, byteLength: split }, { buffer: 0, byteOffset: split, byteLength: 4 * nodes.length }],
  buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString("base64")}` }],
};
const scene = await new Promise((done, fail) => new GLTFLoader().parse(JSON.stringify(gltf), "", (read) => done(read.scene), fail));

const vtk = (cells) => new TextEncoder().encode(`# vtk DataFile Version 3.0\nrod\nASCII\nDATASET POLYDATA\nPOINTS ${nodes.length} float\n` +
  `${places.map((p) => p.join(" ")).join("\n")}\n${cells}\nPOINT_DATA ${nodes.length}\nSCALARS tension float 1\nLOOKUP_TABLE default\n` +
  `${tension.join("\n")}\n`).buffer;
const lines = `LINES 1 ${nodes.length + 1}\n${nodes.length} ${nodes.join(" ")}`;
const triangles = `POLYGONS 58 232\n${nodes.slice(2).map((i) => `3 ${i - 2} ${i - 1} ${i}`).join("\n")}`;

const ply = `ply\nformat ascii 1.0\nelement vertex ${nodes.length}\nproperty float x\nproperty float y\nproperty float z\nproperty float tension\n` +
  `element edge ${nodes.length - 1}\nproperty int vertex1\nproperty int vertex2\nend_header\n` +
  `${places.map((p, i) => [...p, tension[i]].join(" ")).join("\n")}\n${nodes.slice(1).map((i) => `${i - 1} ${i}`).join("\n")}\n`;

const told = (geometry) => `${geometry.attributes.position.count} points, index ${geometry.index?.count ?? "none"}`;
const seen = {
  glTF: `${scene.children[0].type}, ${Object.keys(scene.children[0].geometry.attributes)}`,
  "VTK, lines": told(new VTKLoader().parse(vtk(lines))),
  "VTK, triangles": told(new VTKLoader().parse(vtk(triangles))),
  PLY: `${told(new PLYLoader().parse(ply))}, ${Object.keys(new PLYLoader().parse(ply).attributes)}`,
};
const expected = {
  glTF: "Line, position,_tension,_contactforce",
  "VTK, lines": "0 points, index none",
  "VTK, triangles": "60 points, index 174",
  PLY: "60 points, index none, position",
};
console.log(`three.js ${REVISION}`);
for (const [key, value] of Object.entries(seen)) console.log(`${key}: ${value}${value === expected[key] ? "" : `   expected ${expected[key]}`}`);
process.exit(JSON.stringify(seen) === JSON.stringify(expected) ? 0 : 1);
JS
node rod.mjs
