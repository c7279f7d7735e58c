// The rod as a thing to turn: a tube for each shape of the test, tied to its force curve by a slider. Where the browser has
// no WebGL nothing of it is shown, and the page has its pictures all the same.
"use strict";
(function () {
  const figure = document.getElementById("turnable");
  const data = JSON.parse(document.getElementById("turnable-data").textContent);
  if (!document.createElement("canvas").getContext("webgl")) return;
  figure.hidden = false;

  const SIDES = 14, PIECES = 3, UNKNOWN = 255;  // around the rod; between two nodes; the place of no colour
  const part = name => figure.querySelector("." + name);
  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const points = new Uint16Array(bytes(data.points).buffer);
  const quantities = data.quantities.map(one =>
    Object.assign({}, one, {places: bytes(one.places), palette: bytes(one.palette)}));
  const shapes = data.times.length;
  let now = data.first, shown = quantities[0];

  // ---- the tube -----------------------------------------------------------------------------------------------------

  function node(shape, i) {
    const at = 3 * (shape * data.nodes + i);
    return new THREE.Vector3(...[0, 1, 2].map(k => data.low[k] + data.step[k] * points[at + k]));
  }

  // The quadratic B-spline that has the nodes for control points, as the contacts see the rod; and the node of each point.
  function line(shape, first, end) {
    const nodes = [], places = [], along = [];
    for (let i = first; i < end; ++i) nodes.push(node(shape, i));
    places.push(nodes[0]);
    along.push(first);
    for (let i = 0; i + 2 < nodes.length; ++i) {
      for (let k = 0; k < PIECES; ++k) {
        const u = k / PIECES;
        places.push(new THREE.Vector3().addScaledVector(nodes[i], 0.5 * (1 - u) * (1 - u))
          .addScaledVector(nodes[i + 1], 0.5 + u - u * u).addScaledVector(nodes[i + 2], 0.5 * u * u));
        along.push(first + Math.round(i + 0.5 + u));
      }
    }
    places.push(nodes[nodes.length - 1]);
    along.push(end - 1);
    return {places, along};
  }

  function colour(shape, i) {
    const place = shown ? shown.places[shape * data.nodes + i] : UNKNOWN;
    return place === UNKNOWN ? data.unknown : [0, 1, 2].map(k => shown.palette[3 * place + k] / 255);
  }

  // Rings around a piece of the rod, their sides carried along it without spinning, closed by a flat face at either end.
  function addPiece(mesh, shape, first, end) {
    const {places, along} = line(shape, first, end), last = places.length - 1;
    const side = new THREE.Vector3(), tangent = new THREE.Vector3();
    const ring = (i, radius, normal) => {
      const other = new THREE.Vector3().crossVectors(tangent, side), shade = colour(shape, along[i]);
      for (let k = 0; k < SIDES; ++k) {
        const angle = 2 * Math.PI * k / SIDES;
        const out = new THREE.Vector3().addScaledVector(side, Math.cos(angle)).addScaledVector(other, Math.sin(angle));
        mesh.position.push(...new THREE.Vector3().copy(places[i]).addScaledVector(out, radius).toArray());
        mesh.normal.push(...(normal || out).toArray());
        mesh.color.push(...shade);
      }
      const begin = mesh.position.length / 3 - SIDES;
      if (mesh.open) {
        for (let k = 0; k < SIDES; ++k) {
          const a = begin - SIDES + k, b = begin - SIDES + (k + 1) % SIDES;
          mesh.index.push(a, b, a + SIDES, b, b + SIDES, a + SIDES);
        }
      }
      mesh.open = true;
    };
    mesh.open = false;
    for (let i = 0; i <= last; ++i) {
      tangent.subVectors(places[Math.min(i + 1, last)], places[Math.max(i - 1, 0)]).normalize();
      if (i === 0) {
        side.set(...[0, 1, 2].map(k => Number(Math.abs(tangent.getComponent(k)) <=
          Math.min(...tangent.toArray().map(Math.abs)) + 1e-12)));
      }
      side.addScaledVector(tangent, -side.dot(tangent)).normalize();
      const outwards = i === 0 ? tangent.clone().negate() : i === last ? tangent : null;
      if (i === 0) [0, data.radius].forEach(radius => ring(i, radius, outwards));
      ring(i, data.radius, null);
      if (i === last) [data.radius, 0].forEach(radius => ring(i, radius, outwards));
    }
  }

  function meshOf(shape) {
    const mesh = {position: [], normal: [], color: [], index: [], open: false};
    (data.pieces[shape] || [[0, data.nodes]]).forEach(piece => addPiece(mesh, shape, ...piece));
    const geometry = new THREE.BufferGeometry();
    ["position", "normal", "color"].forEach(name =>
      geometry.setAttribute(name, new THREE.Float32BufferAttribute(mesh[name], 3)));
    geometry.setIndex(mesh.index);
    return geometry;
  }

  // ---- the scene ----------------------------------------------------------------------------------------------------

  const renderer = new THREE.WebGLRenderer({canvas: part("stage"), antialias: true});
  renderer.setClearColor(0xffffff);
  const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(28, 2, 1, 1e4);
  const lamp = new THREE.DirectionalLight(0xffffff, 0.6);
  lamp.position.set(-0.4, 0.8, 1);
  camera.add(lamp);
  scene.add(camera, new THREE.AmbientLight(0xffffff, 0.45));
  const rod = new THREE.Mesh(new THREE.BufferGeometry(),
    new THREE.MeshPhongMaterial({vertexColors: THREE.VertexColors, shininess: 30, specular: 0x222222}));
  scene.add(rod);
  const wheels = data.rollers[0].map(() => new THREE.Mesh(
    new THREE.CylinderBufferGeometry(data.roller_radius, data.roller_radius, 5 * data.radius, 64),
    new THREE.MeshPhongMaterial({color: 0xe3e8ec, transparent: true, opacity: 0.55})));
  wheels.forEach(wheel => scene.add(wheel));

  // As in the pictures: the load axis z from left to right, x up, y towards the eye.
  camera.up.set(1, 0, 0);
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  controls.enableZoom = false;  // a page is scrolled by the same wheel
  controls.addEventListener("change", draw);
  renderer.domElement.addEventListener("pointerdown", () => { controls.enableZoom = true; });
  renderer.domElement.addEventListener("pointerleave", () => { controls.enableZoom = false; });
  renderer.domElement.addEventListener("dblclick", event => {
    const frame = renderer.domElement.getBoundingClientRect(), ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(2 * (event.clientX - frame.left) / frame.width - 1,
      1 - 2 * (event.clientY - frame.top) / frame.height), camera);
    const hit = ray.intersectObject(rod)[0];
    if (hit) controls.target.copy(hit.point);
    controls.update();
    draw();
  });

  function lookAtAll() {
    const box = rod.geometry.boundingBox, middle = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3());
    const tall = Math.max(size.x, size.z / camera.aspect);
    controls.target.copy(middle);
    camera.position.copy(middle).add(new THREE.Vector3(0.2, 1, 0).normalize()
      .multiplyScalar(0.56 * tall / Math.tan(camera.fov * Math.PI / 360) + 0.5 * size.y));
    controls.update();
  }

  function draw() { renderer.render(scene, camera); }

  // ---- the curve ----------------------------------------------------------------------------------------------------

  const chart = part("course"), HIGH = 120, edge = {left: 62, right: 10, top: 8, bottom: 36};
  const put = (name, values, text, into) => {
    const element = document.createElementNS(chart.namespaceURI, name);
    Object.keys(values).forEach(key => element.setAttribute(key, values[key]));
    if (text !== undefined) element.textContent = text;
    return (into || chart).appendChild(element);
  };
  const place = (axis, from, to) => value => from + (value - axis.low) / (axis.high - axis.low) * (to - from);
  let across = null, markers = [];  // a mark on each pair of axes

  // Axes one below the other over the same extensions; what leaves them is not drawn.
  function drawCurve() {
    chart.textContent = "";
    const width = chart.clientWidth, curve = data.curve, right = width - edge.right;
    const low = edge.top + HIGH * curve.ys.length;
    chart.style.height = `${low + edge.bottom}px`;
    across = place(curve.x, edge.left, right);
    markers = curve.ys.map((y, i) => {
      const top = edge.top + HIGH * i, bottom = top + HIGH - 8, middle = 0.5 * (top + bottom), up = place(y, bottom, top);
      put("path", {class: "axis", d: `M${edge.left},${top}V${bottom}H${right}`});
      y.ticks.forEach(([value, text]) => put("text", {x: edge.left - 6, y: up(value) + 4, "text-anchor": "end"}, text));
      put("text", {x: 13, y: middle, "text-anchor": "middle", transform: `rotate(-90 13 ${middle})`}, y.label);
      const window = put("svg", {x: 0, y: top, width: right + 1, height: bottom - top, viewBox: `0 ${top} ${right + 1} ${bottom - top}`});
      put("polyline", {class: "load", points: curve.rows.map(([s, load]) => `${across(s)},${up(load)}`).join(" ")}, "", window);
      return {element: put("circle", {class: "marker", r: 6}), up, holds: load => load >= y.low && load <= y.high};
    });
    curve.x.ticks.forEach(([value, text]) => put("text", {x: across(value), y: low + 9, "text-anchor": "middle"}, text));
    put("text", {x: 0.5 * (edge.left + right), y: low + 27, "text-anchor": "middle"}, curve.x.label);
  }

  chart.addEventListener("click", event => {
    const at = event.clientX - chart.getBoundingClientRect().left;
    const far = data.states.map(state => state.place ? Math.abs(across(state.place[0]) - at) : Infinity);
    show(far.indexOf(Math.min(...far)));
  });

  // ---- together -----------------------------------------------------------------------------------------------------

  const slider = part("time"), choice = part("quantity");

  function show(shape) {
    now = shape;
    const geometry = meshOf(shape), state = data.states[shape];
    rod.geometry.dispose();
    rod.geometry = geometry;
    geometry.computeBoundingBox();
    geometry.computeBoundingSphere();
    wheels.forEach((wheel, i) => wheel.position.set(0, 0, data.rollers[shape][i]));
    slider.value = shape;
    part("words").textContent = state.words;
    markers.forEach(({element, up, holds}) => {
      const is_there = state.place && holds(state.place[1]);
      element.style.display = is_there ? "" : "none";
      if (!is_there) return;
      element.setAttribute("cx", across(state.place[0]));
      element.setAttribute("cy", up(state.place[1]));
    });
    draw();
  }

  function paint(quantity) {
    shown = quantity;
    const bar = part("colours");
    bar.hidden = !quantity;
    if (quantity) {
      const stops = [];
      for (let i = 0; i < UNKNOWN; i += 2) stops.push(`rgb(${quantity.palette.slice(3 * i, 3 * i + 3).join(",")})`);
      part("gradient").style.background = `linear-gradient(to right, ${stops.join(",")})`;
      part("ticks").textContent = "";
      quantity.ticks.forEach(([place, text]) => {
        const tick = part("ticks").appendChild(document.createElement("span"));
        tick.textContent = text;
        tick.style.left = `${100 * place}%`;
      });
    }
    show(now);
  }

  function fit() {
    const width = figure.clientWidth, height = Math.round(Math.max(220, Math.min(420, 0.42 * width)));
    renderer.setPixelRatio(window.devicePixelRatio);
    renderer.setSize(width, height);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    if (data.curve) drawCurve();
    show(now);
  }

  chart.style.display = data.curve ? "" : "none";
  slider.max = shapes - 1;
  slider.hidden = shapes < 2;
  slider.addEventListener("input", () => show(Number(slider.value)));
  quantities.forEach((one, i) => choice.add(new Option(one.label, i)));
  part("choice").hidden = !quantities.length;
  choice.addEventListener("change", () => paint(quantities[choice.value]));
  window.addEventListener("resize", fit);
  fit();
  paint(quantities[0]);
  lookAtAll();
  draw();
})();
