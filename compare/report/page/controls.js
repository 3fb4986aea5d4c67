// The replay's controls, and its read-out in words.

const SPEEDS = [[1 / 240, '1/240'], [1 / 60, '1/60'], [1 / 16, '1/16'], [1 / 4, '1/4'], [1, '1'], [4, '4'], [16, '16']];

/// Real time, or as much slower as takes two seconds.
function usualSpeed(replay) {
  const {data: {times}, timeline} = replay, whole = times.at(timeline[timeline.length - 1] + 1) - times.at(timeline[0]);
  return (SPEEDS.findLast(([speed]) => speed <= 1 && whole >= 2 * speed) || SPEEDS[0])[0];
}

function keptInWords(replay) {
  const first = replay.timeline[0], last = replay.timeline[replay.timeline.length - 1];
  const every = Math.max(...replay.runs.map((run) => run.every));
  const thinned = every > 1 ? `, all of the beginning, then every ${ordinal(every)} and those around an event` : '';
  const sampled = replay.runs.filter((run) => !run.path_exact).map((run) => run.label);
  const gliding = replay.runs.filter((run) => run.steps.some(({remainder}) => remainder.some((v) => v !== 0)))
                      .map((run) => run.label);
  return `Showing steps ${grouped(first)} to ${grouped(last)}${thinned}.` +
      (sampled.length ? ` The way within a step is sampled, not exact, for ${sampled.join(', ')} (dashed).` : '') +
      (gliding.length ? ` Of ${gliding.join(', ')} the filled figure stands in its square; dashed: drawn in between.` :
                        '');
}

function legend(replay) {
  const toggles = replay.runs.map((run) => {
    const ink = inkOf(run, replay.names);
    const style = `border-color:${ink.colour};border-top-style:${ink.dash.length ? 'dashed' : 'solid'}`;
    const title = 'Show or hide; double-click shows only this one', swatch = el('span', {class: 'swatch', style});
    const acts = {onclick: () => replay.toggle(run), ondblclick: () => replay.setVisible([run])};
    run.button = el('button', {type: 'button', 'aria-pressed': 'true', title, ...acts}, swatch, run.label);
    return run.button;
  });
  return el(
      'div', {class: 'bar legend', role: 'group', 'aria-label': 'Contenders shown'}, toggles,
      replay.runs.length > 1 ? el('button', {type: 'button', onclick: () => replay.setVisible(replay.runs)}, 'All') :
                               null);
}

function cameraBar(replay) {
  const choice = (key, words) => {
    const act = ({target}) => {
      replay.show[key] = target.checked;
      replay.draw();
    };
    return el('label', {}, el('input', {type: 'checkbox', checked: replay.show[key], onchange: act}), words);
  };
  replay.modeButtons =
      new Map([['event', 'Event'], ['fit', 'Fit scene'], ['ways', 'Fit trajectories'], ['follow', 'Follow']].map(
          ([mode, words]) =>
              [mode,
               el('button', {
                 type: 'button',
                 'aria-pressed': 'false',
                 onclick: () => (mode === 'event' && replay.focus ? replay.focusOn(replay.focus) : replay.look(mode))
               },
                  words)]));
  replay.layoutButton =
      el('button', {type: 'button', 'aria-pressed': 'false', onclick: () => replay.setTogether(!replay.together)},
         'Side by side');
  return el(
      'div', {class: 'bar', role: 'group', 'aria-label': 'View'}, replay.runs.length > 1 ? replay.layoutButton : null,
      [...replay.modeButtons.values()],
      el('button', {type: 'button', 'aria-label': 'Zoom in', onclick: () => replay.zoom(1.4)}, '+'),
      el('button', {type: 'button', 'aria-label': 'Zoom out', onclick: () => replay.zoom(1 / 1.4)}, '\u2212'),
      el('span', {class: 'gap'}), choice('trajectories', 'trajectories'), choice('start', 'start of step'),
      choice('velocity', 'velocity'));
}

function transport(replay) {
  const button = (words, label, act) =>
      el('button', {type: 'button', 'aria-label': label, title: label, onclick: act}, words);
  replay.playButton = button('Play', 'Play', () => replay.togglePlay());
  replay.slider = el('input', {
    type: 'range',
    class: 'steps',
    min: 0,
    max: Math.max(replay.timeline.length - 1, 0),
    step: 1,
    value: 0,
    'aria-label': 'Step',
    oninput: ({target}) => replay.seek(Number(target.value))
  });
  replay.within =
      el('input',
         {type: 'range', class: 'within', min: 0, max: 1, step: 0.001, value: 1, 'aria-label': 'Fraction of the step'});
  replay.within.addEventListener('input', () => {
    replay.pause();
    replay.t = Number(replay.within.value);
    replay.draw();
  });
  const setSpeed = ({target}) => {
    replay.speed = Number(target.value);
  };
  const speeds = SPEEDS.map(([value, words]) => el('option', {value, selected: value === replay.speed}, words));
  replay.clock = el('span', {class: 'clock'});
  return el(
      'div', {class: 'bar transport', role: 'group', 'aria-label': 'Transport'},
      button('\u25c0', 'One step back', () => replay.move(-1)), replay.playButton,
      button('\u25b6', 'One step forward', () => replay.move(1)), replay.slider, replay.clock,
      el('label', {}, 'within the step', replay.within),
      el('label', {}, 'speed', el('select', {onchange: setSpeed}, speeds)));
}

function jumps(replay) {
  const buttons = targets(replay).map(
      ({words, focus, title}) => el('button', {type: 'button', title, onclick: () => replay.jumpTo(focus)}, words));
  return buttons.length === 0 ? null :
                                el('div', {class: 'bar', role: 'group', 'aria-label': 'Jump to'},
                                   el('span', {class: 'quiet'}, 'Jump to'), buttons);
}

/// What they save can be judged: by `paperproof judge`, and by tests/compare/check_trace.py.
function traces(replay) {
  const buttons = replay.runs.filter((run) => stepsToSave(run) > 0).map((run) => {
    const count = stepsToSave(run), part = count < run.steps.length ? ` (its first ${grouped(count)} steps)` : '';
    return el('button', {type: 'button', onclick: () => saveTrace(run)}, run.label + part);
  });
  const words = 'Save the trace of';
  return buttons.length === 0 ?
      null :
      el('div', {class: 'bar', role: 'group', 'aria-label': words}, el('span', {class: 'quiet'}, words), buttons);
}

/// First contact of anyone, the first event of each kind for each contender, the first disagreement.
function targets(replay) {
  const list = [];
  const touching = firstContact(replay.runs);
  if (touching) list.push({words: 'first contact', focus: touching, title: ''});
  for (const run of replay.runs) {
    for (const kind of new Set(run.events.map((event) => event.kind))) {
      if (kind === 'note') continue;
      const event = run.events.find((candidate) => candidate.kind === kind);
      list.push({words: `${run.label}: first ${kind}`, focus: eventFocus(run, event), title: event.words});
    }
  }
  if (replay.data.disagreements.length)
    list.push({words: 'first disagreement', focus: disagreementFocus(replay.data.disagreements[0]), title: ''});
  return list;
}

function fillReadout(replay) {
  const head = [
    'Contender', 'Position [m]', 'Velocity [m/s]', 'State', 'Contacts: side, collider, normal, t, separation'
  ].map((words) => el('th', {scope: 'col'}, words));
  replay.readout.replaceChildren(el(
      'table', {}, el('caption', {}, `At the end of step ${grouped(replay.step)}`), el('thead', {}, el('tr', {}, head)),
      el('tbody', {}, replay.chosen().flatMap((run) => readoutRows(replay, run)))));
}

function readoutRows(replay, run) {
  const several = run.characters.length > 1;
  return run.characters.map((character, number) => {
    const events = run.events.filter((event) => event.character === number);
    return readoutRow(replay, run, character, several ? `${run.label}, character ${number}` : run.label, events);
  });
}

function readoutRow(replay, run, character, label, events) {
  const {record, ended} = replay.stateOf(character), {x, y} = positionAt(record, 1), [ahead, above] = record.remainder;
  const unit = unitOf(run), pair = (a, b, to) => `${fixedTo(a, to)}, ${fixedTo(b, to)}`;
  // Before each step the twin is put to the controller: that is no respawn.
  const isTwin = run.mode === 'lockstep' && run.box2d !== '';
  const flags =
      Object.keys(FLAGS).filter((key) => record[key] && !(isTwin && key === 'respawn')).map((key) => FLAGS[key]);
  const words = ended ? [`ended at step ${grouped(record.step)}`] : [
    ...flags, record.step === replay.step ? null : `as of step ${grouped(record.step)}`,
    record.start_overlap.length ? `began inside ${record.start_overlap.join(', ')}` : null,
    ahead || above ? `drawn at ${pair(x + ahead, y + above, unit)}, in between two squares` : null,
    record.crush.length ? `crushed by ${record.crush.join(', ')}` : null,
    record.drop.length ? `drops through ${record.drop.join(', ')}` : null
  ].filter(Boolean);
  const told = ['crush', 'drop'];  // by the record
  const now = events.filter((event) => event.step === record.step && !ended && !told.includes(event.kind));
  const line = ({side, normal, fraction}, whom, rest) =>
      el('div', {}, `${side}, ${whom}, (${normal.map(measure).join(', ')}), ${measure(fraction)}${rest}`);
  const contacts = ended ? [] : [
    ...record.contacts.map((contact) => line(contact, contact.collider, `, ${measure(contact.separation)} m`)),
    ...record.met.map((met) => line(met, `character ${met.character}`, ''))
  ];
  return el(
      'tr', {class: ended ? 'ended' : null}, el('th', {scope: 'row'}, label),
      el('td', {class: 'number'}, pair(x, y, unit)), el('td', {class: 'number'}, pair(...record.velocity, unit * 10)),
      el('td', {}, words.join(', '),
         now.map(
             (event) =>
                 el('div', {class: HARMLESS.includes(event.kind) ? null : 'event'},
                    event.words ? `${event.kind}: ${event.words}` : event.kind))),
      el('td', {}, contacts));
}

/// To which positions of a character are shown: about a ten-thousandth of its size [m].
function unitOf(run) {
  const [left, bottom, right, top] = boxOf(run.hull);
  return 10 ** Math.floor(Math.log10(Math.max(right - left, top - bottom) * 1e-4));
}

/// As many decimals as the unit has.
function fixedTo(value, unit) {
  const decimals = Math.max(0, Math.min(12, Math.round(-Math.log10(unit))));
  return value.toFixed(decimals).replace('-', MINUS);
}

function ordinal(n) {
  const teen = n % 100 >= 11 && n % 100 <= 13;
  return `${n}${teen ? 'th' : ['th', 'st', 'nd', 'rd'][n % 10] || 'th'}`;
}
