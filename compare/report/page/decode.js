// Reads back what the report's writer packed (see run_json.hpp and scenery_json.hpp).

const SIDES = ['top', 'bottom', 'left', 'right'];
const PARTS_OF_ONE = 10000;
const FLAGS = ['grounded', 'jumping', 'respawn', 'stuck', 'displacement left over', 'capped'];
/// Events that are nobody's fault.
const HARMLESS = ['note', 'sensor', 'drop'];

function boxOf(flat, box = [Infinity, Infinity, -Infinity, -Infinity]) {
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

/// Rings relative to the shape's first vertex, in quanta; outer ones counter-clockwise, holes clockwise, so that all
/// polygons together fill as their union.
function decodeShape([kind, rings, oneWay]) {
  const absolute = rings.map((ring) => {
    let x = 0, y = 0;
    return ring.map((d, i) => (i % 2 === 0 ? (x += d) : (y += d)));
  });
  const wound = absolute.map((ring, i) => (kind === 0 && signedArea(ring) > 0 !== (i === 0) ? reversed(ring) : ring));
  return {chain: kind === 1, rings: wound, oneWay: oneWay || null};
}

function decodeScenery(packed, quantum) {
  const shapes = packed.shapes.map(decodeShape);
  const colliders = [];
  let x = 0, y = 0;
  for (let run = 0; run < packed.order.length; run += 2) {
    const shape = shapes[packed.order[run]];
    for (let n = 0; n < packed.order[run + 1]; ++n) {
      const i = colliders.length;
      x += packed.at[2 * i] * packed.unit;
      y += packed.at[2 * i + 1] * packed.unit;
      const rings = shape.rings.map((ring) => Float64Array.from(ring, (v, k) => (v + (k % 2 === 0 ? x : y)) * quantum));
      colliders.push({
        chain: shape.chain,
        oneWay: shape.oneWay,
        rings,
        box: boxOf(rings[0]),
        id: packed.ids[i] || `collider ${i}`,
        mover: -1,
        sensor: false
      });
    }
  }
  let at = 0;
  for (let run = 0; packed.movers && run < packed.movers.length; run += 2)
    for (let n = 0; n < packed.movers[run + 1]; ++n) colliders[at++].mover = packed.movers[run] - 1;
  for (const i of packed.sensors || []) colliders[i].sensor = true;
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const collider of colliders)
    if (collider.mover < 0) boxOf(collider.box, box);
  return {colliders, box};
}

function movedBox([left, bottom, right, top], [x, y]) {
  return [left + x, bottom + y, right + x, top + y];
}

/// All that a box comes to cover that turns about (0, 0).
function turnedBox(box) {
  const reach = Math.hypot(Math.max(-box[0], box[2]), Math.max(-box[1], box[3]));
  return [-reach, -reach, reach, reach];
}

/// A collider where its mover has taken it. @param offsets of the movers, [x, y, angle] each.
function placed(collider, offsets) {
  const offset = offsets[collider.mover];
  if (!offset) return collider;
  const [x, y, angle] = offset, c = Math.cos(angle), s = Math.sin(angle);
  const rings = collider.rings.map(
      (ring) => ring.map((v, i) => (i % 2 ? s * ring[i - 1] + c * v + y : c * v - s * ring[i + 1] + x)));
  return {...collider, rings, box: movedBox(angle ? turnedBox(collider.box) : collider.box, offset)};
}

/// Where the movers are at a fraction of a step, in metres.
function offsetsAt(step, t) {
  return step.movers.map(
      ({fx, fy, fa = 0, tx, ty, ta = 0}) => [fx + (tx - fx) * t, fy + (ty - fy) * t, fa + (ta - fa) * t]);
}

/// All that moving colliders come to cover in a run.
function boxOfMoving(run) {
  const box = [Infinity, Infinity, -Infinity, -Infinity], ranges = [];
  for (const step of run.steps)
    step.movers.forEach((m, i) => {
      ranges[i] = boxOf([m.fx, m.fy, m.tx, m.ty], ranges[i]);
    });
  for (const collider of run.scenery.colliders) {
    const range = ranges[collider.mover];
    if (!range) continue;
    const covered = run.steps.some((step) => step.movers[collider.mover]?.ta) ? turnedBox(collider.box) : collider.box;
    boxOf(movedBox(covered, range), box);
    boxOf(movedBox(covered, range.slice(2)), box);
  }
  return box;
}

/// A reader of one column of numbers.
function reader(column) {
  let at = 0;
  return () => column[at++];
}

function decodePath(next, position) {
  const count = next();
  if (count === -1) return [];
  const corner = (t) => ({x: (position.x += next()), y: (position.y += next()), t});
  if (count === 0) return [{x: position.x, y: position.y, t: 0}, corner(1)];
  const path = [];
  for (let i = 0; i < count; ++i) {
    const point = corner(0);
    point.t = next() / PARTS_OF_ONE;
    path.push(point);
  }
  return path;
}

function decodeContacts(next, kinds, position, quantum) {
  const contacts = [];
  for (let count = next(); count > 0; --count) {
    const kind = kinds[next()];
    kind.x += next();
    kind.y += next();
    contacts.push({
      collider: kind.collider,
      side: kind.side,
      nx: kind.nx,
      ny: kind.ny,
      x: (position.x + kind.x) * quantum,
      y: (position.y + kind.y) * quantum,
      t: next() / PARTS_OF_ONE,
      separation: next()
    });
  }
  return contacts;
}

/// Contacts with other characters.
function decodeMet(flat) {
  const met = [];
  for (let i = 0; i < flat.length; i += 5) {
    const [nx, ny, t] = flat.slice(i + 2, i + 5).map((parts) => parts / PARTS_OF_ONE);
    met.push({character: flat[i], side: SIDES[flat[i + 1]], nx, ny, t});
  }
  return met;
}

function decodeKinds(flat) {
  const kinds = [];
  for (let i = 0; i < flat.length; i += 4) {
    kinds.push({
      collider: flat[i],
      side: SIDES[flat[i + 1]],
      nx: flat[i + 2] / PARTS_OF_ONE,
      ny: flat[i + 3] / PARTS_OF_ONE,
      x: 0,
      y: 0
    });
  }
  return kinds;
}

function decodeMovers(next, movers, quantum) {
  const jumped = next() === 1;
  return movers.map((mover) => {
    if (jumped) {
      mover.x += next();
      mover.y += next();
    }
    const from = {x: mover.x, y: mover.y};
    mover.x += (mover.dx += next());
    mover.y += (mover.dy += next());
    return {fx: from.x * quantum, fy: from.y * quantum, tx: mover.x * quantum, ty: mover.y * quantum};
  });
}

/// @param moverCount  0 where nothing moves.
function decodeSteps(packed, quantum, moverCount) {
  const path = reader(packed.path), velocity = reader(packed.velocity), contacts = reader(packed.contacts);
  const moved = reader(packed.movers || []),
        movers = Array.from({length: moverCount}, () => ({x: 0, y: 0, dx: 0, dy: 0}));
  const turned = packed.turns ? reader(packed.turns) : null;
  const kinds = decodeKinds(packed.kinds);
  const position = {x: 0, y: 0}, speed = {x: 0, y: 0};
  let number = 0;
  return packed.step.map((difference, i) => {
    number += difference;
    const corners = decodePath(path, position);
    speed.x += velocity();
    speed.y += velocity();
    const touched = decodeContacts(contacts, kinds, position, quantum);
    const bits = packed.flags.charCodeAt(i) - 48;
    const step = {
      step: number,
      path: corners.map((p) => ({x: p.x * quantum, y: p.y * quantum, t: p.t})),
      x: position.x * quantum,
      y: position.y * quantum,
      vx: speed.x * quantum * 10,
      vy: speed.y * quantum * 10,
      contacts: touched,
      startOverlap: packed.start_overlap[i] || [],
      crush: (packed.crush || {})[i] || [],
      drop: (packed.drop || {})[i] || [],
      met: decodeMet((packed.met || {})[i] || []),
      remainder: ((packed.remainder || {})[i] || [0, 0]).map((v) => v * quantum),
      movers: (moverCount > 0 ? decodeMovers(moved, movers, quantum) : [])
                  .map((m) => (turned ? {...m, fa: turned() * 1e-4, ta: turned() * 1e-4} : m)),
      flags: FLAGS.filter((_, bit) => bits & (1 << bit))
    };
    if (step.path.length === 0) step.path = [{x: step.x, y: step.y, t: 0}, {x: step.x, y: step.y, t: 1}];
    return step;
  });
}

function runLabel(run) {
  return run.contender + (run.knob ? ` ${run.knob}` : '') + (run.scalar === 'double' ? '' : ` ${run.scalar}`) +
      (run.mode === 'free' ? '' : ` (${run.mode})`);
}

function decodeRun(packed, sceneries, quantum) {
  const run = {
    ...packed,
    label: runLabel(packed),
    scenery: sceneries[packed.scenery],
    hull: packed.hull.map((v) => v * quantum)
  };
  // A mover without a column is one whose steps say nothing about movers.
  const moverCount = packed.movers ? 1 + Math.max(...run.scenery.colliders.map((collider) => collider.mover)) : 0;
  run.steps = decodeSteps(packed, quantum, moverCount);
  // Its characters, the first one being the run itself.
  run.characters = [run, ...(packed.others || []).map((other) => ({steps: decodeSteps(other, quantum, moverCount)}))];
  run.movingBox = boxOfMoving(run);
  run.events =
      packed.events.map(([step, kind, words, character = 0, collider]) => ({step, kind, words, character, collider}));
  run.byStep = new Map(run.steps.map((step, i) => [step.step, i]));
  return run;
}

function decodeDisagreement(packed, runs, quantum) {
  const contacts = (list) => list.map(([collider, side, x, y, nx, ny, t, separation]) => ({
                                        collider,
                                        side: SIDES[side],
                                        x: x * quantum,
                                        y: y * quantum,
                                        nx: nx / PARTS_OF_ONE,
                                        ny: ny / PARTS_OF_ONE,
                                        t: t / PARTS_OF_ONE,
                                        separation
                                      }));
  const point = ([x, y]) => ({x: x * quantum, y: y * quantum});
  return {
    step: packed.step,
    whoIsRight: packed.who_is_right,
    exact: packed.exact ? contacts(packed.exact) : null,
    statements: packed.statements.map(
        (s) => ({run: runs[s.run], from: point(s.from), to: point(s.to), contacts: contacts(s.contacts)}))
  };
}

/// Everything about one scene's replay; parsed when the scene is opened, not before.
function decodeReplay(packed) {
  const sceneries = packed.sceneries.map((scenery) => decodeScenery(scenery, packed.quantum));
  const runs = packed.runs.map((run) => decodeRun(run, sceneries, packed.quantum));
  return {
    quantum: packed.quantum,
    runs,
    times: new StepTimes(runs[0] ? runs[0].dt : 0, packed.dt_list),
    disagreementsInAll: packed.disagreements_in_all,
    disagreements: packed.disagreements.map((d) => decodeDisagreement(d, runs, packed.quantum))
  };
}

/// Position in `run.steps` of the last stored step that is not later than `step`; -1 before the first.
function indexAt(run, step) {
  let low = 0, high = run.steps.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (run.steps[middle].step <= step)
      low = middle + 1;
    else
      high = middle;
  }
  return low - 1;
}

/// Where a character that goes by whole squares is drawn at a fraction of a step: it glides from where it was drawn
/// when the step began. Null where it is drawn where it is.
function drawnAt(steps, index, t) {
  const step = steps[index], before = steps[index - 1], first = step.path[0];
  let from = step.remainder;  // unless the step before was stored
  if (step.step === 0 || step.flags.includes('respawn'))
    from = [0, 0];
  else if (before && before.step === step.step - 1)
    from = before.remainder;
  if (![...from, ...step.remainder].some((v) => v !== 0)) return null;
  const glide = (begin, end) => begin + (end - begin) * t;
  return {
    x: glide(first.x + from[0], step.x + step.remainder[0]),
    y: glide(first.y + from[1], step.y + step.remainder[1])
  };
}

/// Where the character is at a fraction of a step: linear between the corners of its way.
function positionAt(step, t) {
  const path = step.path;
  for (let i = 1; i < path.length; ++i) {
    if (t <= path[i].t) {
      const span = path[i].t - path[i - 1].t;
      const part = span > 0 ? (t - path[i - 1].t) / span : 1;
      return {
        x: path[i - 1].x + (path[i].x - path[i - 1].x) * part,
        y: path[i - 1].y + (path[i].y - path[i - 1].y) * part
      };
    }
  }
  return path[path.length - 1];
}
