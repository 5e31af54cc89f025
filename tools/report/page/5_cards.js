// A card for each scan, with filters and an order.
'use strict';

posevote.cards = (() => {
  const make = posevote.make;
  const kPage = 60;  // cards that are made at once
  const confidences = (scan) =>
      scan.found.map((item) => item.confidence).filter((value) => Number.isFinite(value));
  const highest = (scan) => Math.max(-1, ...confidences(scan));
  const lowest = (scan) => Math.min(2, ...confidences(scan));
  const trouble = (scan) => scan.failure ? 0 : scan.found.length ? 2 : 1;
  const byName = new Intl.Collator(undefined, {numeric: true}).compare;

  const kOrders = {
    'as they came': (a, b) => a.number - b.number,
    'failures first': (a, b) => trouble(a) - trouble(b) || lowest(a) - lowest(b),
    'most confident first': (a, b) => highest(b) - highest(a),
    'least confident first': (a, b) => lowest(a) - lowest(b),
    'by name': (a, b) => byName(a.name, b.name),
    'slowest first': (a, b) => (b.seconds || 0) - (a.seconds || 0),
  };
  const kStates = {
    'all': () => true,
    'found': (scan, model) => scan.found.some((item) => model < 0 || item.model === model),
    'not found': (scan, model) =>
        !scan.failure && !scan.found.some((item) => model < 0 || item.model === model),
    'failed': (scan) => Boolean(scan.failure),
  };

  function choice(title, options, change) {
    const select = make('select', {}, ...options.map(([value, text]) => make('option', {value}, text)));
    select.addEventListener('change', change);
    return {select, label: make('label', {}, `${title} `, select)};
  }

  function line(run, scan) {
    if (scan.failure) return [make('span', {className: 'bad'}, `failed in ${scan.failure.node}`)];
    if (!scan.found.length) return [make('span', {className: 'faint'}, 'nothing found')];
    const swatch = (item) => make('span', {
      className: 'swatch', title: run.models[item.model].name,
      style: `background: ${posevote.colours.css(posevote.colours.confidence(item.confidence))}`});
    return [...scan.found.slice(0, 8).map(swatch),
            make('span', {className: 'faint'}, `${scan.found.length} found`)];
  }

  /// `open(scan)`: what a click does; `thumbnails`: what draws them, or null.
  class Cards {
    constructor(run, open, thumbnails) {
      Object.assign(this, {run, open, thumbnails, made: new Map(), most: kPage});
      const update = () => { this.most = kPage; this.update(); };
      this.text = make('input', {type: 'search', placeholder: 'name, file, message'});
      this.text.addEventListener('input', update);
      const same = (names) => Object.keys(names).map((name) => [name, name]);
      this.state = choice('show', same(kStates), update);
      this.model = choice('model', [[-1, 'any'], ...run.models.map((model, i) => [i, model.name])], update);
      this.order = choice('order', same(kOrders), update);
      this.count = make('span', {className: 'count'});
      this.grid = make('div', {className: 'cards'});
      this.more = make('button', {type: 'button', hidden: true}, 'show more');
      this.more.addEventListener('click', () => { this.most += kPage; this.update(); });
      this.element = make('div', {},
          make('div', {className: 'filters'}, this.text, this.state.label, this.model.label,
               this.order.label, this.count), this.grid, this.more);
    }

    chosenScans() {
      const words = this.text.value.toLowerCase();
      const model = Number(this.model.select.value);
      const holds = (scan) =>
          [scan.name, scan.file, scan.note, scan.failure && scan.failure.what,
           ...scan.found.map((item) => this.run.models[item.model].name)]
              .some((text) => text && text.toLowerCase().includes(words));
      const state = kStates[this.state.select.value];
      return this.run.scans.filter((scan) => holds(scan) && state(scan, model))
          .sort(kOrders[this.order.select.value]);
    }

    card(scan) {
      if (this.made.has(scan)) return this.made.get(scan);
      const canvas = make('canvas', {width: 256, height: 192});
      const card = make('button', {type: 'button', className: 'card', title: scan.file}, canvas,
          make('div', {}, make('b', {}, scan.name), make('div', {className: 'line'}, ...line(this.run, scan)),
               scan.scan ? null : make('span', {className: 'bad'}, 'scan not shown')));
      card.addEventListener('click', () => this.open(scan));
      if (this.thumbnails) this.thumbnails.observe(canvas, this.run, scan);
      this.made.set(scan, card);
      return card;
    }

    update() {
      const scans = this.chosenScans();
      this.grid.replaceChildren(...scans.slice(0, this.most).map((scan) => this.card(scan)));
      this.more.hidden = scans.length <= this.most;
      this.count.textContent = `${scans.length} of ${this.run.scans.length} scans`;
      return scans;
    }

    mark(chosen) {
      for (const [scan, card] of this.made) card.classList.toggle('chosen', scan === chosen);
    }
  }

  return {Cards};
})();
