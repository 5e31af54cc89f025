// Of what the page holds (tools/report/pack.hpp) typed arrays, and colours of numbers.
'use strict';
const posevote = {};

posevote.decode = (() => {
  function bytesOf(element) {
    const text = atob(document.getElementById(element).textContent);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  /// {places: Float32Array, values: Uint8Array, corners: Uint16Array}: values of points, or corners of
  /// faces.
  function unpack(packed) {
    const bytes = bytesOf(packed.element);
    const view = new DataView(bytes.buffer);
    const count = 3 * packed.points;
    const places = new Float32Array(count);
    for (let i = 0; i < count; ++i)
      places[i] = packed.corner[i % 3] + packed.step * view.getUint16(2 * i, true);
    if (!packed.faces) return {places, values: bytes.subarray(2 * count)};
    const corners = new Uint16Array(3 * packed.faces);
    for (let i = 0; i < corners.length; ++i) corners[i] = view.getUint16(2 * (count + i), true);
    return {places, corners};
  }

  return {unpack};
})();

posevote.colours = (() => {
  /// From stops [share, red, green, blue] a function of a number from 0 to 1.
  function ramp(stops) {
    return (share) => {
      const x = Math.min(1, Math.max(0, share));
      let k = 1;
      while (k < stops.length - 1 && stops[k][0] < x) ++k;
      const [a, b] = [stops[k - 1], stops[k]];
      const t = (x - a[0]) / (b[0] - a[0]);
      return [1, 2, 3].map((c) => Math.round(a[c] + t * (b[c] - a[c])));
    };
  }
  const unknown = [120, 120, 120];
  // From red to blue by way of yellow: told apart by those who see no green, too.
  const confidences =
      ramp([[0, 178, 24, 43], [0.5, 239, 138, 60], [0.75, 222, 200, 90], [1, 33, 102, 172]]);
  const confidence = (value) => (Number.isFinite(value) ? confidences(value) : unknown);
  const density =
      ramp([[0, 250, 236, 170], [0.4, 252, 165, 10], [0.7, 200, 60, 70], [0.9, 100, 20, 110], [1, 20, 5, 50]]);
  const grey = (share) => [1, 1, 1].map((c) => Math.round(255 * (0.2 + 0.58 * share)));
  /// Of a byte, as a share of 255: three bits of red, three of green, two of blue.
  function own(share) {
    const byte = Math.round(255 * share);
    return [(byte >> 5) / 7, ((byte >> 2) & 7) / 7, (byte & 3) / 3].map((c) => Math.round(255 * c));
  }
  const css = (rgb) => `rgb(${rgb.join(', ')})`;
  const gradient = (of) =>
      `linear-gradient(to right, ${[...Array(11).keys()].map((i) => css(of(i / 10))).join(', ')})`;
  return {confidence, density, grey, own, css, gradient, truth: [214, 0, 147]};
})();

/// An element with text or children, which are never read as markup.
posevote.make = (tag, properties, ...children) => {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties || {}))
    name in element ? element[name] = value : element.setAttribute(name, value);
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
};
