// The rod as a thing to turn: a tube for each shape of the test, chosen by a slider. Where the browser has
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

  function colour(shape, i) {
    const place = shown ? shown.places[shape * data.nodes + i] : UNKNOWN;
    return place === UNKNOWN ? data.unknown : [0, 1, 2].map(k => shown.palette[3 * place + k] / 255);
  }

  function coloured(geometry, shade) {
    const shades = [];
    for (let i = 0; i < geometry.attributes.position.count; ++i) shades.push(...shade(i));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(shades, 3));
    return geometry;
  }

  // A rope: a smooth line through its nodes, a tube around it, and a disc at either end.
  function piece(shape, first, end, radius) {
    const nodes = [];
    for (let i = first; i < end; ++i) nodes.push(node(shape, i));
    const line = new THREE.CatmullRomCurve3(nodes);
    line.getPointAt = line.getPoint;  // by the number of the node, which has the colour, and not by the length
    line.getTangentAt = line.getTangent;
    const tube = new THREE.TubeBufferGeometry(line, PIECES * (nodes.length - 1), radius, SIDES);
    const ends = [0, 1].map(at => {
      const disc = new THREE.CircleBufferGeometry(radius, SIDES);
      disc.lookAt(line.getTangent(at).multiplyScalar(2 * at - 1));
      disc.translate(...line.getPoint(at).toArray());
      return coloured(disc, () => colour(shape, at ? end - 1 : first));
    });
    return [coloured(tube, i => colour(shape, first + Math.round(Math.floor(i / (SIDES + 1)) / PIECES))), ...ends];
  }

  // ---- the scene ----------------------------------------------------------------------------------------------------

  const renderer = new THREE.WebGLRenderer({canvas: part("stage"), antialias: true});
  renderer.setClearColor(0xffffff);
  const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(28, 2, 1, 1e4);
  const lamp = new THREE.DirectionalLight(0xffffff, 0.6);
  lamp.position.set(-0.4, 0.8, 1);
  camera.add(lamp);
  scene.add(camera, new THREE.AmbientLight(0xffffff, 0.45));
  const rod = new THREE.Group();
  const paint_of_rod = new THREE.MeshPhongMaterial({vertexColors: THREE.VertexColors, shininess: 30, specular: 0x222222});
  scene.add(rod);
  const wheels = data.roller_radii.map(radius => new THREE.Mesh(
    new THREE.CylinderBufferGeometry(radius, radius, 5 * data.radius, 64),
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
    const hit = ray.intersectObject(rod, true)[0];
    if (hit) controls.target.copy(hit.point);
    controls.update();
    draw();
  });

  function lookAtAll() {
    const box = new THREE.Box3().setFromObject(rod), middle = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3());
    const tall = Math.max(size.x, size.z / camera.aspect);
    controls.target.copy(middle);
    camera.position.copy(middle).add(new THREE.Vector3(0.2, 1, 0).normalize()
      .multiplyScalar(0.56 * tall / Math.tan(camera.fov * Math.PI / 360) + 0.5 * size.y));
    controls.update();
  }

  function draw() { renderer.render(scene, camera); }

  // ---- together -----------------------------------------------------------------------------------------------------

  const slider = part("time"), choice = part("quantity");

  function show(shape) {
    now = shape;
    rod.children.forEach(part_of_rod => part_of_rod.geometry.dispose());
    rod.remove(...rod.children);
    data.ropes.forEach(([first, end, radius]) =>
      piece(shape, first, end, radius).forEach(geometry => rod.add(new THREE.Mesh(geometry, paint_of_rod))));
    wheels.forEach((wheel, i) => wheel.position.set(data.rollers[shape][i][1], 0, data.rollers[shape][i][0]));
    slider.value = shape;
    part("words").textContent = data.words[shape];
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
    show(now);
  }

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
