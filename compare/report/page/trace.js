// Reads the traces that the page carries (see replay.hpp), and says where everything is at a moment of a step. A record
// is a step as a trace has it: paperproof_trace.schema.json names its keys.

/// What a record says of itself, in words.
const FLAGS = {
  grounded: 'grounded',
  jumping: 'jumping',
  respawn: 'respawn',
  stuck: 'stuck',
  dropped: 'displacement left over',
  capped: 'capped'
};
/// Keys that a record leaves out where there is nothing to say.
const UNSAID = {
  crush: [],
  drop: [],
  met: [],
  remainder: [0, 0]
};
/// Events that are nobody's fault.
const HARMLESS = ['note', 'sensor', 'drop'];
const CORNERS_OF_CIRCLE = 64;
const nothing = () => [Infinity, Infinity, -Infinity, -Infinity];

function boxOf(flat, box = nothing()) {
  for (let i = 0; i < flat.length; i += 2) {
    box[0] = Math.min(box[0], flat[i]);
    box[1] = Math.min(box[1], flat[i + 1]);
    box[2] = Math.max(box[2], flat[i]);
    box[3] = Math.max(box[3], flat[i + 1]);
  }
  return box;
}

function signedArea(flat) {
  let sum = 0;
  for (let i = 0, j = flat.length - 2; i < flat.length; j = i, i += 2) {
    sum += flat[j] * flat[i + 1] - flat[i] * flat[j + 1];
  }
  return sum / 2;
}

function reversed(flat) {
  const result = [];
  for (let i = flat.length - 2; i >= 0; i -= 2) result.push(flat[i], flat[i + 1]);
  return result;
}

/// With other rings. Outer ones are counter-clockwise, holes clockwise, so that all polygons together fill as their
/// union.
function withRings(collider, rings) {
  const wound =
      collider.chain ? rings : rings.map((ring, i) => (signedArea(ring) > 0 !== (i === 0) ? reversed(ring) : ring));
  return {...collider, rings: wound, box: boxOf(wound[0])};
}

function aroundCircle([x, y, radius]) {
  return Array.from({length: CORNERS_OF_CIRCLE}, (_, k) => {
    const angle = 2 * Math.PI * k / CORNERS_OF_CIRCLE;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
}

/// A collider of a trace, with flat rings to draw [m].
function drawable({id, polygon, chain, circle, holes = [], one_way: oneWay = null, sensor = false}) {
  const rings = [polygon || chain || aroundCircle(circle), ...holes];
  return withRings({id, chain: Boolean(chain), circle, oneWay, sensor}, rings.map((ring) => ring.flat()));
}

// --- where it is ---

function movedBox([left, bottom, right, top], [x, y]) {
  return [left + x, bottom + y, right + x, top + y];
}

function moved(collider, [x, y]) {
  const rings = collider.rings.map((ring) => ring.map((v, i) => v + (i % 2 ? y : x)));
  return {...collider, rings, box: movedBox(collider.box, [x, y])};
}

/// How a collider moves in a step; null where it stands.
function motionOf(collider, record) {
  return Object.hasOwn(record.movers, collider.id) ? record.movers[collider.id] : null;
}

const glide = (from, to, part) => from.map((v, i) => v + (to[i] - v) * part);

/// How far something is from where it is defined, at a fraction of a step. What turns has its vertices, and mostly no
/// offset.
function offsetAt(motion, t) {
  const ends = Array.isArray(motion) ? motion : motion && motion.offset;
  return ends ? glide(ends[0], ends[1], t) : [0, 0];
}

function verticesAt({k: instants, vertices}, t) {
  const next = Math.max(1, instants.findIndex((instant) => instant >= t)), before = instants[next - 1];
  const part = (t - before) / (instants[next] - before || 1);
  return vertices[next - 1].map((vertex, i) => glide(vertex, vertices[next][i], part));
}

/// A collider where it is at a fraction of a step.
function placed(collider, record, t) {
  const motion = motionOf(collider, record);
  if (!motion) return collider;
  if (Array.isArray(motion)) return moved(collider, offsetAt(motion, t));
  const vertices = verticesAt(motion, t);
  if (collider.circle)
    return moved(collider, [vertices[0][0] - collider.circle[0], vertices[0][1] - collider.circle[1]]);
  let from = 0;
  return withRings(collider, collider.rings.map((ring) => vertices.slice(from, from += ring.length / 2).flat()));
}

/// Where the character is at a fraction of a step: linear between the corners of its way.
function positionAt({path}, t) {
  const next = Math.max(1, path.findIndex((corner) => corner[2] >= t)), before = path[next - 1];
  const [x, y] =
      path.length > 1 ? glide(before, path[next], (t - before[2]) / (path[next][2] - before[2] || 1)) : before;
  return {x, y};
}

/// Where a character that goes by whole squares is drawn at a fraction of a step: it glides from where it was drawn
/// when the step began. Null where it is drawn where it is.
function drawnAt(steps, index, t) {
  const record = steps[index], before = steps[index - 1], first = record.path[0], last = record.path.at(-1);
  let from = record.remainder;  // unless the step before was stored
  if (record.step === 0 || record.respawn)
    from = [0, 0];
  else if (before && before.step === record.step - 1)
    from = before.remainder;
  if (![...from, ...record.remainder].some((v) => v !== 0)) return null;
  const [x, y] = glide(
      [first[0] + from[0], first[1] + from[1]], [last[0] + record.remainder[0], last[1] + record.remainder[1]], t);
  return {x, y};
}

/// Position in `run.steps` of the last stored step that is not later than `step`; -1 before the first.
function indexAt(run, step) {
  return run.steps.findLastIndex((stored) => stored.step <= step);
}

// --- reading, and saving ---

async function unpacked(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).text();
}

function runLabel(run) {
  return run.contender + (run.knob ? ` ${run.knob}` : '') + (run.scalar === 'double' ? '' : ` ${run.scalar}`) +
      (run.mode === 'free' ? '' : ` (${run.mode})`);
}

/// @param line of the trace's header. @param scenery `{line, byId}`: its colliders. @param notes `{every, events}`.
function beginRun(header, line, scenery, {every, events}) {
  const {contender, knob, scalar, mode, dt, box2d = ''} = header;
  const characters = Array.from({length: header.characters || 1}, () => ({steps: []}));
  const run = {header, lines: [line], scenery, every, contender, knob, scalar, mode, dt, box2d, characters};
  return Object.assign(run, {
    label: runLabel(run),
    hull: header.points.flat(),
    steps: characters[0].steps,
    events: events.map((event) => ({character: 0, ...event}))
  });
}

/// All that the colliders of a run come to cover.
function boxOfScenery({scenery, steps}) {
  const box = nothing(), first = steps[0] || {movers: {}};
  for (const collider of scenery.byId.values())
    if (!motionOf(collider, first)) boxOf(collider.box, box);
  for (const record of steps) {
    for (const [id, motion] of Object.entries(record.movers)) {
      const collider = scenery.byId.get(id);
      for (const t of [0, 1])
        boxOf(Array.isArray(motion) ? movedBox(collider.box, motion[t]) : placed(collider, record, t).box, box);
    }
  }
  return box;
}

/// Everything about one scene's replay; read when the scene is opened, not before.
async function readReplay(packed) {
  const [first, ...lines] = (await unpacked(packed)).trimEnd().split('\n');
  const notes = JSON.parse(first), sceneries = [], runs = [];
  for (const line of lines) {
    const parsed = JSON.parse(line), run = runs.at(-1);
    if (Array.isArray(parsed)) {
      sceneries.push({line, byId: new Map(parsed.map((collider) => [collider.id, drawable(collider)]))});
    } else if (parsed.paperproof_trace) {
      runs.push(beginRun(parsed, line, sceneries[parsed.colliders], notes.runs[runs.length]));
    } else {
      run.characters[parsed.character || 0].steps.push({...UNSAID, ...parsed});
      run.lines.push(line);
    }
  }
  for (const run of runs) {
    run.box = boxOfScenery(run);
    run.byStep = new Map(run.steps.map((record, i) => [record.step, i]));
    run.path_exact = run.steps.every((record) => record.path_exact !== false);
  }
  const statementOf = ({run, record}) => ({run: runs[run], record: {...UNSAID, ...record}});
  return {
    runs,
    times: new StepTimes(runs[0].dt, notes.dt_list),
    disagreementsInAll: notes.disagreements_in_all,
    disagreements: notes.disagreements.map((one) => ({...one, statements: one.statements.map(statementOf)}))
  };
}

/// Of the steps that are stored, how many from the first of the run on follow one another.
function stepsToSave(run) {
  const gap = run.steps.findIndex((record, i) => record.step !== i);
  return gap < 0 ? run.steps.length : gap;
}

/// These steps as a trace that can be judged. A header without `steps` is that of a run that may end anywhere.
function traceOf(run) {
  const {colliders, steps} = run.header, count = stepsToSave(run);
  let [header, ...records] = run.lines;
  if (count !== steps) header = header.replace(/,"steps":\d+/, '');
  header = header.replace(`"colliders":${colliders}`, () => `"colliders":${run.scenery.line}`);
  return [header, ...records.slice(0, count * run.characters.length), ''].join('\n');
}

function saveTrace(run) {
  const href = URL.createObjectURL(new Blob([traceOf(run)], {type: 'application/jsonl'}));
  el('a', {href, download: `${run.header.scene}.${run.contender}.${run.scalar}.jsonl`}).click();
  setTimeout(() => URL.revokeObjectURL(href), 60000);
}
