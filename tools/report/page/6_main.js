// Each run of the page: a stage, a panel, cards. What is drawn is made when it is first shown.
'use strict';

posevote.start = (element) => {
  const make = posevote.make;
  const run = JSON.parse(document.getElementById(element.dataset.run).textContent);
  if (!run.scans.length) {
    element.append(make('p', {}, 'There is no scan to show.'));
    return;
  }
  const canvas = make('canvas');
  const shown = make('p', {className: 'shown'});
  const missing = make('p', {className: 'missing', hidden: true});
  const panel = make('div', {className: 'panel'});
  const legends = make('div', {className: 'legends'});
  const help = make('p', {className: 'help'}, 'drag: turn · wheel: nearer · right button: move');
  element.append(make('div', {className: 'view'},
      make('div', {className: 'stage'}, canvas, shown, missing, legends, help), panel));
  const hasWebGL = posevote.stage.hasWebGL();
  let stage = null;

  function legend(title, of, low, high) {
    return make('div', {}, title, make('i', {style: `background: ${posevote.colours.gradient(of)}`}),
        make('span', {}, make('small', {}, low), make('small', {}, high)));
  }

  function tellLegends(scan) {
    legends.replaceChildren(legend('confidence', posevote.colours.confidence, '0', '1'));
    if (scan.votes)
      legends.append(legend('density of votes', posevote.colours.density, '1',
                            posevote.panel.digits(scan.votes.largest, 0)));
    if ((scan.truth || []).length)
      legends.append(make('div', {}, 'true poses: ', make('b', {
        style: `color: ${posevote.colours.css(posevote.colours.truth)}`}, 'wires')));
  }

  function tell(scan) {
    const size = scan.view ? scan.view.size.map((edge) => edge.toPrecision(3)).join(' × ') : '';
    shown.textContent = scan.scan ? `${posevote.panel.shownOf(scan.scan, 'points')} shown, ${size} m` : '';
    const empty = !scan.scan && !scan.found.length && !scan.rejected.length;
    missing.textContent = hasWebGL ? (empty ? scan.note || 'There is nothing to show.' : '')
        : posevote.stage.kGone;
    missing.hidden = !missing.textContent;
    tellLegends(scan);
  }

  const thumbnails = hasWebGL ? posevote.thumbnails : null;
  const cards = new posevote.cards.Cards(run, (scan) => { open(scan); element.scrollIntoView(); }, thumbnails);

  function open(scan) {
    if (hasWebGL) stage = stage || new posevote.stage.Stage(canvas);
    const parts = stage ? stage.show(run, scan)
        : posevote.scene.parts(run, scan).map((part) => ({...part, object: null}));
    posevote.panel.fill(panel, run, scan, parts, stage);
    tell(scan);
    cards.mark(scan);
  }

  // A click that turned nothing names what is under it.
  let pressed = null;
  canvas.addEventListener('pointerdown', (event) => { pressed = [event.clientX, event.clientY]; });
  canvas.addEventListener('click', (event) => {
    if (!stage || !pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 3) return;
    const part = stage.partAt(event.clientX, event.clientY);
    stage.highlight(part);
    if (part) part.label.scrollIntoView({block: 'nearest'});
  });

  element.append(cards.element);
  const first = cards.update()[0];
  // Of several runs on one page, each is drawn when it is looked at.
  new IntersectionObserver((entries, watch) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    watch.disconnect();
    open(first);
  }).observe(element);
};

posevote.thumbnails = new posevote.stage.Thumbnails();
for (const element of document.querySelectorAll('.run')) posevote.start(element);
