// Puts the page together: the list of scenes, one scene at a time, and what the address asks for:
// #summary, or #scene=article_bullet&contender=wind_back&step=10&t=0.5&layout=side&view=follow&play=3 (playing, 3
// seconds on). Without a step a replay opens at the event that matters. #study=sweep+of+paper&map=mask&cell=5,2 is the
// replay of a cell of a heat map, and with "at" instead of "cell" it is this cell in the map.

const dataOf = (id) => JSON.parse(document.getElementById(id).textContent);
const INDEX = dataOf('index');
/// Two may be called the same: the second one is called "name (2)" in addresses.
function giveKeys(list, name) {
  list.forEach((one, i) => {
    const before = list.slice(0, i).filter((other) => name(other) === name(one)).length;
    one.key = before === 0 ? name(one) : `${name(one)} (${before + 1})`;
  });
}
giveKeys(INDEX.scenes, (scene) => scene.name);
giveKeys(INDEX.studies, (study) => study.title);
for (const study of INDEX.studies) giveKeys(study.grids, (grid) => grid.title);
const main = document.getElementById('main');
/// `what` is shown: `scene 3` or `cell`. `pictures` has a `draw`, as has the replay; `back` is where Escape leads.
let open = {what: '', replay: null, pictures: null, back: null};

/// Contenders and labels in an order that is the same for all scenes: the default and the reference first.
function namesWith(runs) {
  const rows = [...INDEX.scenes.flatMap((scene) => scene.rows), ...runs];
  const leading = ['octagon_sweep', 'box2d'];
  const order = (names) => [...leading, ...[...new Set(names)].filter((name) => !leading.includes(name)).sort()];
  return {contenders: order(rows.map((row) => row.contender)), labels: order(rows.map(rowLabel))};
}

function runDetails(replay) {
  const rows = replay.runs.map((run) => {
    const facts = [replay.times.inWords(), `${grouped(run.steps.length)} steps stored`];
    if (run.box2d) facts.push(`Box2D ${run.box2d}`);
    const omitted = run.header.plan ? run.header.plan.omitted : [];
    if (omitted.length)
      facts.push(`left out by the plan: ${omitted.map(({stage, reason}) => `${stage}: ${reason}`).join('; ')}`);
    return [run.label, facts.join(', ')];
  });
  return el('details', {}, el('summary', {}, 'About the runs'), pairs(rows));
}

const replayOf = (scene) => dataOf(`replay-${INDEX.scenes.indexOf(scene)}`);

function replayNodes(replay) {
  if (!replay || !replay.runs.some((run) => run.steps.length > 0)) {
    return {shown: [el('p', {class: 'quiet'}, 'No run of this scene was stored for replay.')], details: []};
  }
  const names = namesWith(replay.runs);
  open.replay = new Replay(replay, names, noteDrawn);
  open.pictures = disagreementsSection(replay, names, (one) => open.replay.jumpTo(disagreementFocus(one)));
  return {shown: [open.replay.root, ...open.pictures.nodes], details: [runDetails(replay)]};
}

/// For whoever looks from outside (tests, above all): which step was drawn, without error, and what the first view
/// shows, as left, bottom, right and top [m].
function noteDrawn(replay) {
  const {painter} = replay.views[0];
  document.documentElement.dataset.seen =
      [painter.worldX(0), painter.worldY(painter.height), painter.worldX(painter.width), painter.worldY(0)].join(' ');
  document.documentElement.dataset.drawn = `${open.what} step ${replay.step} t ${replay.t}`;
}

/// How many colours the first canvas has: one means that nothing was drawn. Asked for with #...&check=1.
function countColours() {
  const canvas = document.querySelector('canvas');
  const data = new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer);
  document.documentElement.dataset.colours = String(new Set(data).size);
}

/// What it shows is read later, and then something else may have been opened. @return whether nothing was.
function begin(what) {
  if (open.replay) open.replay.pause();
  const begun = open = {what, replay: null, pictures: null, back: null};
  return () => open === begun;
}

async function showScene(index, wanted) {
  const scene = INDEX.scenes[index], isWanted = begin(`scene ${index}`), packed = replayOf(scene);
  const read = packed && await readReplay(packed);
  if (!isWanted()) return;
  const replay = replayNodes(read);
  main.replaceChildren(
      ...[el('h2', {}, scene.name), scene.description ? el('p', {class: 'quiet'}, scene.description) : null,
          scene.sentence ? el('p', {class: 'sentence'}, scene.sentence) : null, ...replay.shown, ...safetyTable(scene),
          ...furtherTables(scene), ...replay.details]
          .filter(Boolean));
  document.title = `${scene.name} - paperproof report`;
  if (open.replay) startReplay(open.replay, wanted);
  if (open.pictures) open.pictures.draw();
}

function startReplay(replay, wanted) {
  const named = wanted.getAll('contender');
  const alone = replay.runs.filter((run) => named.includes(run.contender) || named.includes(run.label));
  if (alone.length) replay.setVisible(alone);
  if (wanted.get('layout') === 'side') replay.setTogether(false);
  const focus = mainFocus(replay.chosen());
  if (focus) replay.focusOn(focus);
  if (wanted.has('step')) replay.goTo(Number(wanted.get('step')));
  if (wanted.has('t')) replay.t = Math.max(0, Math.min(1, Number(wanted.get('t')) || 0));
  const usual = focus && !wanted.has('step') ? 'event' : 'ways';
  replay.look(['event', 'fit', 'ways', 'follow'].includes(wanted.get('view')) ? wanted.get('view') : usual);
  if (wanted.has('step'))
    replay.root.scrollIntoView({block: 'start'});
  else
    window.scrollTo(0, 0);
  if (wanted.has('check')) countColours();
  if (wanted.has('play')) {
    replay.play();
    replay.playOn(Number(wanted.get('play')) || 0);
  }
}

async function showCell(cell, wanted) {
  const isWanted = begin('cell'), {parameters, replay} = dataOf(`cells-${cell.index}`)[cell.replay];
  const read = await readReplay(replay);
  if (!isWanted()) return;
  const {above, below} = cellNodes(cell, parameters);
  open.back = addressOfCell(cell.study, cell.grid, cell.at, 'at');
  open.replay = new Replay(read, namesWith(read.runs), noteDrawn);
  main.replaceChildren(...above, open.replay.root, ...below, runDetails(read));
  document.title = `${cell.grid.title} - ${cell.study.title}`;
  startReplay(open.replay, wanted);
}

async function showSummary(wanted) {
  const isWanted = begin('summary'), pictures = await summary();
  if (!isWanted()) return;
  open.pictures = pictures;
  main.replaceChildren(...pictures.nodes);
  document.title =
      INDEX.scenes.length || INDEX.studies.length !== 1 ? 'paperproof report' : `paperproof: ${INDEX.studies[0].title}`;
  pictures.draw();
  document.documentElement.dataset.drawn = 'summary';
  window.scrollTo(0, 0);
  pictures.show(wanted);
}

function route() {
  if (location.hash === '#main') return;
  const wanted = new URLSearchParams(location.hash.slice(1));
  const index = INDEX.scenes.findIndex((scene) => scene.key === wanted.get('scene'));
  const known = index >= 0, cell = wantedCell(wanted);
  if (known)
    showScene(index, wanted);
  else if (cell)
    showCell(cell, wanted);
  else
    showSummary(wanted);
  for (const link of document.querySelectorAll('.scene-link')) {
    const current = link.id === (known ? `scene-link-${index}` : 'summary-link');
    if (current)
      link.setAttribute('aria-current', 'page');
    else
      link.removeAttribute('aria-current');
    if (current && known) link.scrollIntoView({block: 'nearest'});
  }
}

// --- the list ---

function has(scene, verdicts) {
  return scene.rows.some((row) => verdicts.includes(row.verdict));
}

const KINDS = {
  all: () => true,
  tunnels: (scene) => scene.rows.some((row) => row.tunnels > 0),
  violates: (scene) => has(scene, ['violates']),
  disagreements: (scene) => scene.disagreements > 0,
  failed: (scene) => has(scene, ['flagged', 'failed']),
};

function markOf(scene) {
  const tunnelling = scene.rows.filter((row) => row.tunnels > 0).length;
  if (has(scene, ['violates'])) return el('span', {class: 'mark bad'}, 'violated');
  if (tunnelling > 0) return el('span', {class: 'mark'}, `${tunnelling} tunnelled`);
  return null;
}

/// A long name may go on in a new line after any of its underscores.
function breakable(name) {
  return name.split(/(?<=_)/).flatMap((part) => [part, el('wbr')]);
}

function buildList() {
  const list = document.getElementById('scene-list'), text = document.getElementById('filter-text'),
        kind = document.getElementById('filter-kind');
  const items = INDEX.scenes.map(
      (scene, i) =>
          el('li', {},
             el('a', {class: 'scene-link', id: `scene-link-${i}`, href: addressOf(scene.key)},
                el('span', {}, breakable(scene.name)), markOf(scene))));
  list.replaceChildren(...items);
  const filter = () => {
    const words = text.value.trim().toLowerCase();
    let shown = 0;
    INDEX.scenes.forEach((scene, i) => {
      items[i].hidden = !(scene.name.toLowerCase().includes(words) && KINDS[kind.value](scene));
      shown += items[i].hidden ? 0 : 1;
    });
    document.getElementById('filter-count').textContent = `${shown} of ${INDEX.scenes.length} shown`;
  };
  text.addEventListener('input', filter);
  kind.addEventListener('change', filter);
  filter();
}

function redraw() {
  if (open.replay) open.replay.draw();
  if (open.pictures) open.pictures.draw();
}

if (INDEX.scenes.length === 0) document.querySelector('.filter').hidden = true;
buildList();
route();
window.addEventListener('hashchange', route);
window.addEventListener('resize', redraw);
document.addEventListener('keydown', (event) => {
  if (open.replay) open.replay.key(event);
  if (open.back && event.key === 'Escape' && event.target.tagName !== 'SELECT') location.hash = open.back;
});
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
  route();
});
