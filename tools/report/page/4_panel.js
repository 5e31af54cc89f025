// What is told of the scan that is shown: its parts with a tick each, and details on demand.
'use strict';

posevote.panel = (() => {
  const make = posevote.make;
  const digits = (value, count) => Number.isFinite(value) ? value.toFixed(count) : '-';
  const kTitles = {scan: 'Scan', found: 'Found', rejected: 'Best rejected', truth: 'True poses',
                   votes: 'Votes'};

  function table(rows) {
    return make('table', {}, make('tbody', {}, ...rows.map((cells) =>
        make('tr', {}, ...cells.map((cell) => make('td', {}, cell))))));
  }

  function matrixText(T) {
    return [0, 1, 2, 3].map((row) => T.slice(4 * row, 4 * row + 4)
        .map((value) => value.toFixed(6).padStart(10)).join(' ')).join('\n');
  }

  function quaternionText(T) {
    const q = new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().set(...T));
    const sign = q.w < 0 ? -1 : 1;
    return [q.w, q.x, q.y, q.z].map((value) => (sign * value).toFixed(6)).join(' ');
  }

  function pose(item) {
    if (item.T.length !== 16) return [make('p', {}, 'Its pose cannot be read.')];
    return [make('p', {}, 'T_scene_model [m]'), make('pre', {}, matrixText(item.T)),
            make('p', {}, 'quaternion w x y z'), make('pre', {}, quaternionText(item.T))];
  }

  function clues(item) {
    const names = Object.keys(item.clues || {});
    if (!names.length) return null;
    const row = (name) => [name, digits(item.clues[name], 2), digits((item.against || {})[name], 2)];
    return table([['clue', 'value', 'against it'], ...names.map(row)]);
  }

  /// Sentences on this object in this scan, as run_data.cpp's sentences() has them.
  function says(item) {
    return (item.says || []).map((sentence) => make('p', {className: 'says'}, sentence));
  }

  function detectionDetails(item) {
    return make('details', {}, make('summary', {}, 'pose, fit, clues'),
        table([['confidence', digits(item.confidence, 4)],
               ['of this very pose', digits(item.pose_confidence, 4)],
               ['score', digits(item.score, 4)],
               ['inliers', `${digits(100 * item.inlier_fraction, 1)} %`],
               ['RMSE', `${digits(1000 * item.rmse_m, 3)} mm`],
               ['density', digits(item.density, 1)],
               ['of the runner-up', digits(item.runner_up_density, 1)]]),
        ...says(item), ...pose(item), clues(item));
  }

  function details(part) {
    if (part.kind === 'found' || part.kind === 'rejected') return [detectionDetails(part.item)];
    if (part.kind === 'truth')
      return [make('details', {}, make('summary', {}, 'pose'), ...pose(part.item))];
    return [];
  }

  const count = (value) => value.toLocaleString('en').replace(/,/g, '\u202f');
  const shownOf = (packed, what) => packed.points < packed.true_points
      ? `${count(packed.points)} of ${count(packed.true_points)} ${what}`.trim()
      : `${count(packed.points)} ${what}`.trim();

  function caption(part) {
    const {kind, item} = part;
    if (kind === 'scan') return shownOf(item, '');
    if (kind === 'votes') return shownOf(item, '');
    if (kind === 'truth')
      return Number.isFinite(item.visible) ? `${digits(100 * item.visible, 0)} % visible` : '';
    return digits(item.confidence, 3);
  }

  /// `stage`: where it is drawn, or null.
  function row(part, stage) {
    const tick = make('input', {type: 'checkbox', checked: part.visible && Boolean(part.object),
                                disabled: !part.object});
    tick.addEventListener('change', () => stage.setVisible(part, tick.checked));
    const label = make('label', {}, tick,
        make('span', {className: 'swatch', style: `background: ${posevote.colours.css(part.colour)}`}),
        make('b', {}, part.title), make('span', {}, caption(part)));
    label.dataset.kind = part.kind;
    if (!part.object && part.kind !== 'scan') label.title = 'the surface of this model is not on the page';
    if (stage) {
      label.addEventListener('mouseenter', () => stage.highlight(part));
      label.addEventListener('mouseleave', () => stage.highlight(null));
    }
    Object.assign(part, {label, tick});
    // Why a candidate was not taken is told at once, all else on demand.
    const why = part.kind === 'rejected' ? says(part.item).slice(0, 1) : [];
    return make('div', {}, label, ...why, ...details(part));
  }

  /// The heading of parts of one kind; with a tick for all of them where there are several.
  function heading(kind, parts) {
    if (parts.length < 2 || !parts.some((part) => part.object)) return make('h4', {}, kTitles[kind]);
    const tick = make('input', {type: 'checkbox', checked: parts.every((part) => part.visible)});
    tick.addEventListener('change', () => {
      for (const part of parts)
        if (part.tick.checked !== tick.checked) part.tick.click();
    });
    return make('h4', {}, make('label', {}, tick, make('b', {}, kTitles[kind])));
  }

  function missing(run, scan) {
    const found = new Set(scan.found.map((item) => item.model));
    const names = run.models.filter((model, i) => !found.has(i) && !model.left_out)
        .map((model) => model.name);
    if (scan.failure || !names.length) return [];
    return [make('h4', {}, 'Not found'), make('p', {className: 'missing-models'}, names.join(', '))];
  }

  /// Why each object was found or not, where that was asked for.
  function explained(run, scan) {
    if (!scan.explained) return [];
    const of = (object) => make('details', {className: 'explained'},
        make('summary', {}, make('b', {}, run.models[object.model].name), `: ${object.cause}`),
        ...says(object));
    return [make('h4', {}, 'Why'), ...says({says: scan.explained.scan}),
            ...scan.explained.objects.map(of)];
  }

  function times(scan) {
    const stages = Object.entries(scan.stages || {}).sort((a, b) => b[1] - a[1]);
    const longest = stages.length ? stages[0][1] : 1;
    if (!stages.length) return null;
    return make('details', {}, make('summary', {}, 'time per node'), table(stages.map(([name, s]) =>
        [name, `${digits(1000 * s, 1)} ms`,
         make('i', {className: 'bar', style: `width: ${(6 * s / longest).toFixed(2)}rem`})])));
  }

  /// Fills `panel` anew.
  function fill(panel, run, scan, parts, stage) {
    const children = [make('h4', {}, scan.name), make('p', {}, scan.file)];
    if (Number.isFinite(scan.seconds)) {
      const wait = Number.isFinite(scan.latency) ? `, answered after ${digits(scan.latency, 2)} s` : '';
      children.push(make('p', {}, `${digits(scan.seconds, 2)} s${wait}`));
    }
    if (scan.failure)
      children.push(make('p', {className: 'bad'}, `Failed in ${scan.failure.node}: ${scan.failure.what}`));
    if (scan.note) children.push(make('p', {className: 'bad'}, scan.note));
    for (const warning of scan.warnings || []) children.push(make('p', {}, `Warning: ${warning}`));
    for (const kind of Object.keys(kTitles)) {
      const of = parts.filter((part) => part.kind === kind);
      if (of.length) children.push(heading(kind, of));
      for (const part of of) children.push(row(part, stage));
      if (kind === 'found' && !of.length && !scan.failure)
        children.push(make('h4', {}, 'Found'), make('p', {}, 'nothing'));
      if (kind === 'found') children.push(...missing(run, scan));
    }
    children.push(...explained(run, scan), times(scan));
    panel.replaceChildren(...children.filter((child) => child));
    panel.scrollTop = 0;
  }

  return {fill, digits, shownOf};
})();
