// The first screen: does it tunnel, and what does accuracy cost; below it every scene with every contender, and the
// studies.

/// What became of a run: a mark, words (as the terminal has them), and how it is coloured.
function outcomeOf(row) {
  if (row.verdict === 'not applicable') return {mark: '\u2013', words: 'cannot run', kind: 'not-applicable'};
  if (row.verdict === 'failed') return {mark: 'F', words: 'failed', kind: 'failed'};
  if (row.tunnels > 0) return {mark: '\u2715', words: 'through', kind: 'tunnels'};
  if (row.steps_ending_inside > 0) return {mark: 'I', words: 'ends inside', kind: 'flagged'};
  if (row.hanging_steps > 0) return {mark: 'H', words: 'hangs', kind: 'flagged'};
  const met = row.first_contact_step !== undefined && typeof row.first_contact_fraction === 'number';
  const step = row.first_contact_step > 0 ? ` of step ${row.first_contact_step}` : '';
  const words = met ? `stopped at ${row.first_contact_fraction.toFixed(3)}${step}` : 'meets nothing';
  if (row.verdict === 'violates') return {mark: 'V', words, kind: 'violates'};
  if (row.verdict !== 'holds') return {mark: '!', words, kind: 'flagged'};
  return met ? {mark: '\u2713', words, kind: 'holds'} : {mark: '\u00b7', words, kind: 'flagged'};
}

/// What a cell of the matrix shows.
function verdictMark(row) {
  if (row.verdict === 'holds') return {mark: '\u2713', words: 'holds', kind: 'holds'};
  const {mark, words, kind} = outcomeOf(row);
  return {mark, words: kind === 'violates' ? 'broke its guarantee' : mark === '!' ? 'flagged' : words, kind};
}

/// The scene that the first screen shows: the article's, else the first in which somebody tunnels.
function firstScene() {
  const drawable = INDEX.scenes.filter((scene) => scene.runs > 0);
  return drawable.find((scene) => scene.name === 'article_bullet') ||
      drawable.find((scene) => scene.rows.some((row) => row.tunnels > 0)) || drawable[0];
}

/// One small picture for each contender: the step that matters, at the same fraction for all.
class Strip {
  constructor(scene, replay) {
    this.replay = replay;
    this.names = namesWith(this.replay.runs);
    const focus = mainFocus(this.replay.runs);
    this.step = focus ? focus.step : 0;
    this.t = 1;
    this.tiles = scene.rows.map((row) => this.tile(scene, row));
    const slide = ({target}) => this.show(Number(target.value));
    this.slider = el('input', {type: 'range', min: 0, max: 1, step: 0.001, value: 1, 'aria-label': 'Fraction of the step', oninput: slide});
    this.button = el('button', {type: 'button', onclick: () => this.play()}, 'Play');
    this.clock = el('span', {class: 'clock'});
    this.nodes = [
      el('div', {class: 'strip'}, this.tiles.map((tile) => tile.root)),
      el('div', {class: 'bar'}, this.button, el('label', {class: 'fraction'}, 'fraction of the step', this.slider), this.clock)
    ];
  }

  tile(scene, row) {
    const run = this.replay.runs.find((one) => one.label === rowLabel(row)), outcome = outcomeOf(row);
    const canvas = run ? el('canvas', {'aria-hidden': 'true'}) : el('div', {class: 'no-picture', title: row.reason});
    const name = el('span', {class: 'name'}, breakable(row.contender + (row.knob ? ` ${row.knob}` : '')));
    const word = el('span', {class: `verdict ${outcome.kind}`}, `${outcome.mark} ${outcome.words}`);
    const root = el(run ? 'a' : 'span', {class: 'tile', href: run ? addressOf(scene.key, row.contender) : null}, canvas, name, word);
    return {run, root, painter: run ? new Painter(canvas) : null};
  }

  /// What all of them cover in this step, upright tiles being narrow.
  box() {
    const box = nothing();
    for (const {run} of this.tiles) {
      if (!run) continue;
      const hull = boxOf(run.hull), record = run.steps[Math.max(indexAt(run, this.step), 0)];
      for (const corner of record.path) boxOf(movedBox(hull, corner), box);
    }
    return box;
  }

  show(t) {
    this.playing = false;
    this.button.textContent = 'Play';
    this.t = t;
    this.draw();
  }

  play() {
    if (this.playing) return this.show(this.t);
    this.playing = true;
    this.button.textContent = 'Pause';
    const from = this.t >= 1 ? 0 : this.t;
    let begin = null;
    const tick = (time) => {
      if (!this.playing) return;
      begin ??= time;
      this.t = Math.min(1, from + (time - begin) / 2500);
      if (this.t >= 1) this.show(1);
      this.draw();
      if (this.playing) requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  draw() {
    const colours = theme(), box = this.box();
    for (const {run, painter} of this.tiles) {
      if (!run) continue;
      const camera = new Camera(), {canvas} = painter, ink = inkOf(run, this.names);
      camera.fit(box, canvas.clientWidth, canvas.clientHeight, 0.05);
      const record = run.steps[Math.max(indexAt(run, this.step), 0)], [first] = record.path;
      const {x, y} = positionAt(record, this.t);
      painter.begin(camera, colours);
      painter.scenery(run.scenery, record, this.t);
      painter.trajectory([{...record, path: [...record.path.filter((corner) => corner[2] < this.t), [x, y]]}], 0, 1, {colour: ink.colour, dash: [], alpha: 1});
      painter.octagon(run.hull, first[0], first[1], {colour: ink.colour, dash: [2, 2], alpha: 0.6});
      painter.octagon(run.hull, x, y, {colour: ink.colour, fill: true});
      painter.dot(x, y, 4, ink.colour);
    }
    this.slider.value = this.t;
    this.clock.textContent = `t = ${this.t.toFixed(3)}`;
    document.documentElement.dataset.strip = `step ${this.step} t ${this.t}`;
  }
}

/// What the step of the impact costs in the first scene, or a step where none was timed alone; cheapest first.
function costBars(scene) {
  const alone = scene.rows.some((row) => row.impact_step_ns !== undefined);
  const [least, most] = alone ? ['impact_step_ns', 'impact_step_cold_ns'] : ['ns_per_step', 'ns_per_step_max'];
  const timed = scene.rows.filter((row) => row[least] > 0).sort((a, b) => a[least] - b[least]);
  if (timed.length === 0) return [];
  const longest = Math.max(...timed.map((row) => row[most]));
  const sound = timed.find((row) => row.verdict === 'holds');
  const bar = (row, key, kind) => el('span', {class: `length ${kind}`, style: `width:${100 * row[key] / longest}%`});
  const bars = timed.map((row) => {
    const {mark, kind} = outcomeOf(row);
    return el(
        'li', {}, el('span', {class: `verdict ${kind}`}, mark), el('span', {class: 'who'}, row.contender),
        el('span', {class: 'bar-box'}, bar(row, most, `${kind} spread`), bar(row, least, kind)),
        el('span', {class: 'number'}, grouped(Math.round(row[least]))));
  });
  const what = alone ? 'the step of the impact' : 'a step';
  return [
    el('h3', {}, `What does ${what} cost here?`),
    el('p', {class: 'chart-title'},
       sound ? `The cheapest that is right is ${rowLabel(sound)}: ${measure(sound[least])} ns.` : 'Nobody is right here.'),
    el('ol', {class: 'costs'}, bars),
    el('p', {class: 'quiet small'},
       `ns, from zero; the pale end is ${alone ? 'with cold caches' : 'the slowest of the runs'}; \u2713 stops, \u2715 goes through`)
  ];
}

/// Every scene with every contender; a cell leads to the replay.
function matrix(groups) {
  const {scenes} = INDEX, labels = [...groups.keys()];
  const cell = (scene, label) => {
    const row = scene.rows.find((one) => rowLabel(one) === label);
    if (!row) return el('td', {});
    const {mark, words, kind} = verdictMark(row), about = `${scene.name}, ${label}: ${words}`;
    return el(
        'td', {class: `cell ${kind}`},
        el('a', {href: addressOf(scene.key, row.contender), title: row.reason ? `${about}. ${row.reason}` : about, 'aria-label': about},
           mark));
  };
  const head = labels.map((label) => el('th', {scope: 'col', class: 'upright'}, el('span', {}, label)));
  const rows = scenes.map(
      (scene) =>
          el('tr', {}, el('th', {scope: 'row'}, el('a', {href: addressOf(scene.key)}, scene.name)), labels.map((label) => cell(scene, label))));
  return [
    el('h3', {}, 'Every scene, every contender'),
    el('p', {class: 'quiet'},
       'How to read this: \u2713 holds, \u2715 passed a solid, I ended inside one, H hung in the air, ! missed the exact ' +
           'answer or met a limit of its own, V broke its guarantee, F failed, \u2013 cannot run. Choose a cell to see the replay.'),
    tableBox('Every scene, every contender', [el('thead', {}, el('tr', {}, el('th', {scope: 'col'}, 'Scene'), head)), el('tbody', {}, rows)], 'matrix')
  ];
}

/// Who goes through, in one sentence.
function tunnelSentence(scene) {
  const ran = scene.rows.filter((row) => row.verdict !== 'not applicable'), through = ran.filter((row) => row.tunnels > 0);
  return `${through.length} of ${ran.length} contenders pass the solid` +
      (through.length ? `: ${through.map(rowLabel).join(', ')}.` : '.');
}

/// The table of a study, and what it says in words; or one of several, with a title of its own and open.
function studyTable(study, {title, heading, rows: lines} = study, open = study.charts.length + study.grids.length === 0) {
  if (lines.length === 0) return [];
  const isNumber = (text) => text !== '' && !Number.isNaN(Number(text));
  const rows = lines.map(
      (cells) => el('tr', {}, cells.map((text) => el('td', {class: isNumber(text) ? 'number' : null}, text))));
  const head = heading.map((words) => el('th', {scope: 'col'}, words));
  return [el('details', {open}, el('summary', {}, title === study.title ? 'In numbers' : title),
             tableBox(title, [el('thead', {}, el('tr', {}, head)), el('tbody', {}, rows)]))];
}

function studySection(study) {
  const maps = heatMaps(study), charts = study.charts.length ? new ChartPicture(study.charts) : null;
  const [reading, ...more] = study.paragraphs;
  return {
    nodes: [
      el('h3', {}, study.title), reading ? el('p', {class: 'quiet'}, reading) : null, charts ? charts.root : null,
      ...maps.nodes, more.length ? el('ul', {class: 'findings'}, more.map((words) => el('li', {}, words))) : null,
      ...(study.tables || []).flatMap((table) => studyTable(study, table, true)), ...studyTable(study)
    ].filter(Boolean),
    draw: () => {
      if (charts) charts.draw();
      maps.draw();
    },
    show: (wanted) => {
      if (study.key === wanted.get('study')) maps.show(wanted);
    }
  };
}

/// What the first screen has: two questions, and their answers in pictures.
function firstScreen(scene, replay, costly) {
  const strip = new Strip(scene, replay), chart = costly ? new ChartPicture(costly.charts, 'bullet') : null;
  const costs = costBars(scene);
  const accuracy = chart ? [
    el('h3', {}, costly.title), chart.root, ...folded('How to read this', costly.paragraphs.map((words) => el('p', {}, words))),
    ...studyTable(costly)
  ] : [];
  return {
    nodes: [
      el('h2', {}, 'Does it tunnel?'),
      el('p', {class: 'wide-text'}, `${scene.name}: ${scene.description}. `, el('strong', {}, tunnelSentence(scene))),
      ...strip.nodes,
      el('div', {class: 'answers'}, accuracy.length ? el('section', {}, accuracy) : null,
         costs.length ? el('section', {}, costs) : null)
    ],
    draw: () => {
      strip.draw();
      if (chart) chart.draw();
    }
  };
}

/// The whole of the page without an address: what to put there, and what draws it once it is there.
async function summary() {
  const scene = firstScene(), replay = scene && await readReplay(replayOf(scene)), groups = byContender(INDEX.scenes);
  const costly = scene && INDEX.studies.find((study) => study.charts.length > 0);
  const first = scene ? firstScreen(scene, replay, costly) : {nodes: [], draw: () => {}};
  const studies = INDEX.studies.filter((study) => study !== costly).map(studySection);
  return {
    nodes: [
      ...first.nodes, ...studies.flatMap((study) => study.nodes), ...(groups.size ? matrix(groups) : []),
      ...(groups.size ? inNumbers(INDEX, groups) : []), ...howItWasMeasured(INDEX)
    ],
    draw: () => {
      first.draw();
      studies.forEach((study) => study.draw());
    },
    /// The map that an address asks for.
    show: (wanted) => studies.forEach((study) => study.show(wanted))
  };
}
