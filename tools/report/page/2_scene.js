// A scan, what was found in it, rejected, true and voted for, as objects of three.js.
'use strict';

posevote.scene = (() => {
  const surfaces = new Map();  // geometries of models by their element

  const discTexture = (() => {
    const size = 32;
    const canvas = posevote.make('canvas', {width: size, height: size});
    const pen = canvas.getContext('2d');
    pen.fillStyle = '#fff';
    pen.arc(size / 2, size / 2, size / 2, 0, 2 * Math.PI);
    pen.fill();
    return new THREE.CanvasTexture(canvas);
  })();

  const kFieldOfView = 32;  // of cameras, upward [deg]

  /// Discs of a size [m]: three.js takes a field of view of 90 deg for it.
  function discs(size, more) {
    return new THREE.PointsMaterial({size: size / Math.tan(kFieldOfView * Math.PI / 360),
                                     map: discTexture, alphaTest: 0.5, ...more});
  }

  /// Draws points where they are, but as if they were so much farther away [m]: a good fit lies on the
  /// scan, and both would mix at random.
  function yieldTo(material, lead) {
    material.onBeforeCompile = (shader) => {
      shader.uniforms.lead = {value: lead};
      shader.vertexShader = 'uniform float lead;\n' + shader.vertexShader.replace(
          '#include <project_vertex>', `#include <project_vertex>
          gl_Position = projectionMatrix * vec4(mvPosition.xyz * (1.0 + lead / length(mvPosition.xyz)), 1.0);`);
    };
    return material;
  }

  function cloud(packed, colourOf, material) {
    const {places, values} = posevote.decode.unpack(packed);
    const colours = new Uint8Array(places.length);
    const table = [...Array(256).keys()].map((value) => colourOf(value / 255));
    for (let i = 0; i < packed.points; ++i) colours.set(table[values[i]], 3 * i);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3, true));
    material.vertexColors = THREE.VertexColors;
    return new THREE.Points(geometry, material);
  }

  function surfaceOf(model) {
    const packed = model.surface;
    if (!surfaces.has(packed.element)) {
      const {places, corners} = posevote.decode.unpack(packed);
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
      if (corners) geometry.setIndex(new THREE.BufferAttribute(corners, 1));
      surfaces.set(packed.element, geometry);
    }
    return surfaces.get(packed.element);
  }

  const hex = (rgb) => (rgb[0] << 16) | (rgb[1] << 8) | rgb[2];

  /// A model's faces, or the points of one that has none.
  function solid(model, colour, opacity) {
    const seeThrough = {transparent: opacity < 1, opacity, depthWrite: opacity === 1};
    const geometry = surfaceOf(model);
    if (!model.surface.faces)
      return new THREE.Points(geometry, discs(model.diagonal / 60, {color: hex(colour), ...seeThrough}));
    return new THREE.Mesh(geometry, new THREE.MeshPhongMaterial(
        {color: hex(colour), flatShading: true, side: THREE.DoubleSide, shininess: 15,
         specular: 0x222222, ...seeThrough}));
  }

  function wires(model, colour) {
    if (!model.surface.faces) return solid(model, colour, 0.8);
    const geometry = surfaceOf(model);
    geometry.userData.wires = geometry.userData.wires || new THREE.WireframeGeometry(geometry);
    return new THREE.LineSegments(geometry.userData.wires, new THREE.LineBasicMaterial(
        {color: hex(colour), transparent: true, opacity: 0.55}));
  }

  function place(object, matrix) {
    object.matrixAutoUpdate = false;
    object.matrix.set(...matrix);
    return object;
  }

  /// Parts {kind, title, colour, object, visible, ...} of a scan; `object` is null where it cannot be
  /// shown.
  function parts(run, scan) {
    const list = [];
    const add = (kind, title, colour, object, visible, item) =>
        list.push({kind, title, colour, object, visible, item});
    if (scan.scan)
      add('scan', 'points', [140, 140, 140],
          cloud(scan.scan, scan.scan.in_colors ? posevote.colours.own : posevote.colours.grey,
                yieldTo(discs(1.3 * scan.scan.spacing), 2.5 * scan.scan.spacing)), true, scan.scan);
    const posed = (item, make) => {
      const model = run.models[item.model];
      return model.surface && item.T.length === 16 ? place(make(model), item.T) : null;
    };
    const name = (item) => run.models[item.model].name;
    for (const item of scan.found) {
      const colour = posevote.colours.confidence(item.confidence);
      const opacity = scan.scan && scan.scan.in_colors ? 0.6 : 1;  // the colours show through
      add('found', name(item), colour, posed(item, (model) => solid(model, colour, opacity)), true,
          item);
    }
    for (const item of scan.rejected) {
      const colour = posevote.colours.confidence(item.confidence);
      add('rejected', name(item), colour, posed(item, (model) => solid(model, colour, 0.45)), false,
          item);
    }
    // Of a scan in which nothing was found, the best candidate is what there is to see.
    const best = list.find((part) => part.kind === 'rejected');
    if (best && !scan.found.length) best.visible = true;
    for (const item of scan.truth || [])
      add('truth', name(item), posevote.colours.truth,
          posed(item, (model) => wires(model, posevote.colours.truth)), false, item);
    if (scan.votes && scan.votes.points) {
      const points = cloud(scan.votes, posevote.colours.density,
                           discs(0.7 * scan.scan.spacing, {depthTest: false}));
      points.renderOrder = 1;
      add('votes', run.models.find((model) => model.obj_id === scan.votes.obj_id).name,
          posevote.colours.density(0.8), points, true, scan.votes);
    }
    return list;
  }

  /// What of the parts belongs to this scan alone.
  function dispose(list) {
    for (const {kind, object} of list) {
      if (!object) continue;
      object.material.dispose();
      if (kind === 'scan' || kind === 'votes') object.geometry.dispose();
    }
  }

  /// The box of a scan without its outliers, and of what was found in it.
  function boxOf(run, scan, view) {
    const box = new THREE.Box3().setFromCenterAndSize(new THREE.Vector3(...view.center),
                                                      new THREE.Vector3(...view.size));
    for (const item of scan.found) {
      const model = run.models[item.model];
      if (!model.surface || item.T.length !== 16) continue;
      const geometry = surfaceOf(model);
      if (!geometry.boundingBox) geometry.computeBoundingBox();
      box.union(geometry.boundingBox.clone().applyMatrix4(new THREE.Matrix4().set(...item.T)));
    }
    return box;
  }

  /// A camera that sees the scan from its sensor's side, and what it turns about.
  function cameraFor(run, scan, aspect) {
    const camera = new THREE.PerspectiveCamera(kFieldOfView, aspect, 0.01, 100);
    const view = scan.view || posesView(scan);
    const box = boxOf(run, scan, view);
    const center = box.getCenter(new THREE.Vector3());
    const radius = Math.max(0.5 * box.getSize(new THREE.Vector3()).length(), 1e-4);
    let back = new THREE.Vector3(...view.eye).sub(center);
    if (back.length() < 0.5 * radius) back = new THREE.Vector3(...view.forward).negate();
    const half = Math.min(1, aspect) * Math.tan(0.5 * camera.fov * Math.PI / 180);
    camera.position.copy(center).addScaledVector(back.normalize(), 0.7 * radius / half);
    camera.up.set(...view.up);
    camera.near = radius / 50;
    camera.far = 40 * radius;
    camera.lookAt(center);
    camera.updateProjectionMatrix();
    return {camera, center};
  }

  /// Where there is no scan: the poses lie before a camera.
  function posesView(scan) {
    const places = [...scan.found, ...scan.rejected, ...(scan.truth || [])]
        .filter((item) => item.T.length === 16)
        .map((item) => new THREE.Vector3(item.T[3], item.T[7], item.T[11]));
    const box = new THREE.Box3().setFromPoints(places.length ? places : [new THREE.Vector3()]);
    const center = box.getCenter(new THREE.Vector3());
    const size = box.getSize(new THREE.Vector3()).addScalar(0.3);
    const upright = center.z >= 0 ? -1 : 1;
    return {eye: [0, 0, 0], forward: [0, 0, -upright], up: [0, upright, 0],
            center: center.toArray(), size: size.toArray()};
  }

  /// All of it under light from the upper left behind whoever looks.
  function assemble(list, camera) {
    const scene = new THREE.Scene();
    const lamp = new THREE.DirectionalLight(0xffffff, 0.75);
    lamp.position.set(-0.4, 0.6, 1);
    camera.add(lamp, lamp.target);
    lamp.target.position.set(0, 0, 0);
    scene.add(new THREE.AmbientLight(0xffffff, 0.42), camera);
    for (const part of list) {
      if (!part.object) continue;
      part.object.visible = part.visible;
      scene.add(part.object);
    }
    return scene;
  }

  return {parts, dispose, cameraFor, assemble};
})();
