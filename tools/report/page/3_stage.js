// The one place where a scan is shown large: its parts, the view, axes in the corner.
'use strict';

posevote.stage = (() => {
  const kGone = 'This browser shows no WebGL, so the scans cannot be drawn here. What was found is ' +
      'told beside; --use-angle=swiftshader draws in software in Chromium.';

  function hasWebGL() {
    const canvas = document.createElement('canvas');
    return Boolean(canvas.getContext('webgl2') || canvas.getContext('webgl'));
  }

  function makeRenderer(canvas, ratio) {
    const renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
    renderer.setPixelRatio(ratio);
    renderer.setClearColor(0xf4f5f7);
    renderer.autoClear = false;
    return renderer;
  }

  function letter(text, colour, at) {
    const canvas = posevote.make('canvas', {width: 64, height: 64});
    const pen = canvas.getContext('2d');
    pen.font = 'bold 52px sans-serif';
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    pen.fillStyle = colour;
    pen.fillText(text, 32, 34);
    const sprite = new THREE.Sprite(
        new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas), depthTest: false}));
    sprite.position.copy(at).multiplyScalar(1.25);
    sprite.scale.set(0.55, 0.55, 1);
    return sprite;
  }

  /// The axes of the scan's frame.
  function makeAxes() {
    const scene = new THREE.Scene();
    const origin = new THREE.Vector3();
    const names = ['x', 'y', 'z'], colours = ['#c62828', '#2e7d32', '#1565c0'];
    names.forEach((name, i) => {
      const way = new THREE.Vector3().setComponent(i, 1);
      scene.add(new THREE.ArrowHelper(way, origin, 1, new THREE.Color(colours[i]).getHex(), 0.28, 0.16),
                letter(name, colours[i], way));
    });
    return scene;
  }

  class Stage {
    constructor(canvas) {
      this.canvas = canvas;
      this.renderer = makeRenderer(canvas, Math.min(2, window.devicePixelRatio || 1));
      this.axes = makeAxes();
      this.axesCamera = new THREE.OrthographicCamera(-1.6, 1.6, 1.6, -1.6, 0.1, 10);
      this.parts = [];
      new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    }

    show(run, scan) {
      const before = this.parts;
      if (this.controls) this.controls.dispose();
      this.parts = posevote.scene.parts(run, scan);
      const {camera, center} = posevote.scene.cameraFor(run, scan, this.aspect());
      this.camera = camera;
      this.scene = posevote.scene.assemble(this.parts, camera);
      this.controls = new THREE.OrbitControls(camera, this.canvas);
      this.controls.target.copy(center);
      this.controls.enableKeys = false;
      this.controls.screenSpacePanning = true;
      this.controls.addEventListener('change', () => this.draw());
      this.controls.update();
      this.resize();
      posevote.scene.dispose(before);  // only now: shaders that the new scan uses, too, are kept
      return this.parts;
    }

    aspect() {
      const box = this.canvas.parentElement.getBoundingClientRect();
      return Math.max(0.1, box.width / Math.max(1, box.height));
    }

    resize() {
      const box = this.canvas.parentElement.getBoundingClientRect();
      if (!this.camera || box.width < 1 || box.height < 1) return;
      this.renderer.setSize(box.width, box.height, false);
      this.camera.aspect = this.aspect();
      this.camera.updateProjectionMatrix();
      this.draw();
    }

    draw() {
      const {renderer, camera} = this;
      const size = renderer.getSize(new THREE.Vector2());
      renderer.setViewport(0, 0, size.x, size.y);
      renderer.clear();
      renderer.render(this.scene, camera);
      const away = new THREE.Vector3(0, 0, 4).applyQuaternion(camera.quaternion);
      this.axesCamera.position.copy(away);
      this.axesCamera.quaternion.copy(camera.quaternion);
      renderer.setViewport(4, 4, 96, 96);
      renderer.clearDepth();
      renderer.render(this.axes, this.axesCamera);
    }

    setVisible(part, visible) {
      part.visible = visible;
      if (!part.object) return;
      part.object.visible = visible;
      this.draw();
    }

    /// Lights a part up, or none.
    highlight(chosen) {
      for (const part of this.parts)
        if (part.object && part.object.material.emissive)
          part.object.material.emissive.setHex(part === chosen ? 0x444444 : 0);
      if (this.scene) this.draw();
    }

    /// The part under a place of the window, or null.
    partAt(x, y) {
      const box = this.canvas.getBoundingClientRect();
      const at = new THREE.Vector2(2 * (x - box.left) / box.width - 1,
                                   1 - 2 * (y - box.top) / box.height);
      const ray = new THREE.Raycaster();
      ray.setFromCamera(at, this.camera);
      const solid = this.parts.filter((part) => part.object && part.object.isMesh && part.visible);
      const hit = ray.intersectObjects(solid.map((part) => part.object))[0];
      return hit ? solid.find((part) => part.object === hit.object) : null;
    }
  }

  /// Draws scans small, one at a time, when there is nothing else to do.
  class Thumbnails {
    constructor() {
      this.waiting = [];
      this.busy = false;
    }

    /// Draws into `canvas` once it is seen.
    observe(canvas, run, scan) {
      this.watch = this.watch || new IntersectionObserver((entries) => {
        for (const entry of entries) {
          if (!entry.isIntersecting || !entry.target.draw) continue;
          this.watch.unobserve(entry.target);
          this.waiting.push(entry.target);
        }
        this.next();
      }, {rootMargin: '100px'});
      canvas.draw = () => this.draw(canvas, run, scan);
      this.watch.observe(canvas);
    }

    next() {
      if (this.busy || !this.waiting.length) return;
      this.busy = true;
      setTimeout(() => {
        const canvas = this.waiting.shift();
        if (canvas.isConnected) canvas.draw();
        else this.watch.observe(canvas);
        this.busy = false;
        this.next();
      }, 15);
    }

    draw(canvas, run, scan) {
      this.canvas = this.canvas || document.createElement('canvas');
      this.renderer = this.renderer || makeRenderer(this.canvas, 1);
      const {width, height} = canvas;
      this.renderer.setSize(width, height, false);
      const parts = posevote.scene.parts(run, scan).filter((part) => part.kind !== 'votes');
      const {camera} = posevote.scene.cameraFor(run, scan, width / height);
      this.renderer.clear();
      this.renderer.render(posevote.scene.assemble(parts, camera), camera);
      canvas.getContext('2d').drawImage(this.canvas, 0, 0);
      posevote.scene.dispose(this.parts || []);  // of the last one: so its shaders serve this one
      this.parts = parts;
    }
  }

  return {Stage, Thumbnails, hasWebGL, kGone};
})();
