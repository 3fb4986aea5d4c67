// The event that matters: where a replay opens and where its jumps lead. A focus is a step, a fraction of it, and the
// box that the character and what it met fill.

/// Events that are worth the first look, the worst one first; before them all is the first contact.
const WORST_FIRST = ['tunnel', 'one-way broken', 'inside', 'hanging', 'crush'];
/// What is up to so many times as thick as the character is shown with both of its faces.
const WHOLE_UP_TO = 6;

/// When a convex outline on a straight way meets a segment: [from, to] in parts of the way, null if it does not.
/// Separating axes; each of them leaves an interval of the way (Cyrus and Beck 1978).
function meeting(hull, start, way, [x0, y0, x1, y1]) {
  const span = [0, 1], n = hull.length;
  const axes = [[y1 - y0, x0 - x1]];
  for (let i = 0; i < n; i += 2) axes.push([hull[(i + 3) % n] - hull[i + 1], hull[i] - hull[(i + 2) % n]]);
  for (const [nx, ny] of axes) {
    const along = [];
    for (let i = 0; i < n; i += 2) along.push(hull[i] * nx + hull[i + 1] * ny);
    const at = start.x * nx + start.y * ny, speed = way.x * nx + way.y * ny;
    const a = x0 * nx + y0 * ny, b = x1 * nx + y1 * ny;
    const first = Math.min(a, b) - Math.max(...along) - at, last = Math.max(a, b) - Math.min(...along) - at;
    if (speed === 0) {
      if (first > 0 || last < 0) return null;
      continue;
    }
    const times = [first / speed, last / speed];
    span[0] = Math.max(span[0], Math.min(...times));
    span[1] = Math.min(span[1], Math.max(...times));
  }
  return span[0] <= span[1] ? span : null;
}

/// When a character meets the outline of a collider in a step: [first, last] as fractions of it, null if it does not.
/// What turns is taken as it is turned half-way.
function crossing(hull, record, collider) {
  const motion = motionOf(collider, record), at = (t) => offsetAt(motion, t), [hx, hy] = at(0.5);
  const {rings} = !motion || Array.isArray(motion) ? collider : moved(placed(collider, record, 0.5), [-hx, -hy]);
  let found = null;
  for (let leg = 1; leg < record.path.length; ++leg) {
    const [[x, y, from], [nextX, nextY, to]] = record.path.slice(leg - 1), [ax, ay] = at(from), [bx, by] = at(to);
    const start = {x: x - ax, y: y - ay}, way = {x: nextX - bx - start.x, y: nextY - by - start.y};
    for (const ring of rings) {
      for (let i = 0; i < ring.length - (collider.chain ? 2 : 0); i += 2) {
        const j = (i + 2) % ring.length, span = meeting(hull, start, way, [ring[i], ring[i + 1], ring[j], ring[j + 1]]);
        if (!span) continue;
        const [first, last] = span.map((part) => from + part * (to - from));
        found = found ? [Math.min(found[0], first), Math.max(found[1], last)] : [first, last];
      }
    }
  }
  return found;
}

/// The character at a fraction of a step, and of the collider what is near.
function boxAround(run, record, t, collider) {
  const {x, y} = positionAt(record, t), box = movedBox(boxOf(run.hull), [x, y]);
  if (!collider) return box;
  const met = placed(collider, record, t).box;
  const size = Math.max(box[2] - box[0], box[3] - box[1]), thickness = Math.min(met[2] - met[0], met[3] - met[1]);
  const reach = 0.3 * size + (thickness <= WHOLE_UP_TO * size ? thickness : 0);
  const near = [
    Math.max(met[0], box[0] - reach), Math.max(met[1], box[1] - reach), Math.min(met[2], box[2] + reach),
    Math.min(met[3], box[3] + reach)
  ];
  return near[0] <= near[2] && near[1] <= near[3] ? boxOf(near, box) : box;
}

/// A box with those shown who are no farther from it than it is large.
function withNeighbours(replay, box) {
  const reach = Math.max(box[2] - box[0], box[3] - box[1]), all = [...box];
  for (const run of replay.chosen()) {
    for (const character of run.characters) {
      const {x, y} = replay.stateOf(character).position, [left, bottom, right, top] = movedBox(boxOf(run.hull), [x, y]);
      const near = left < box[2] + reach && right > box[0] - reach && bottom < box[3] + reach && top > box[1] - reach;
      if (near) boxOf([left, bottom, right, top], all);
    }
  }
  return all;
}

function eventFocus(run, event) {
  const steps = run.characters[event.character].steps, record = steps[Math.max(indexAt({steps}, event.step), 0)];
  const collider = run.scenery.byId.get(event.collider);
  // In the middle of a passage it is seen best: who holds has stopped, who does not is within.
  const passage =
      ['tunnel', 'one-way broken'].includes(event.kind) && collider ? crossing(run.hull, record, collider) : null;
  const t = passage ? Math.round((passage[0] + passage[1]) / 2 * 10000) / 10000 : 1;
  return {step: event.step, t, box: boxAround(run, record, t, collider)};
}

/// The first contact of anyone, null if nobody meets anything.
function firstContact(runs) {
  let first = null;
  for (const run of runs) {
    for (const {steps} of run.characters) {
      const record = steps.find((step) => step.contacts.length + step.met.length > 0);
      if (!record) continue;
      for (const contact of [...record.contacts, ...record.met])
        if (!first || record.step < first.record.step ||
            (record.step === first.record.step && contact.fraction < first.contact.fraction))
          first = {run, record, contact};
    }
  }
  if (!first) return null;
  const {run, record, contact} = first;
  return {
    step: record.step,
    t: contact.fraction,
    box: boxAround(run, record, contact.fraction, run.scenery.byId.get(contact.collider))
  };
}

function disagreementFocus(disagreement) {
  return {step: disagreement.step, t: 1, box: boxOfStatements(disagreement)};
}

/// The worst that happened to these runs, else their first contact, null if nothing happened.
function mainFocus(runs) {
  for (const kind of WORST_FIRST) {
    const all = runs.flatMap((run) => run.events.filter((event) => event.kind === kind).map((event) => ({run, event})));
    if (all.length === 0) continue;
    const first = all.reduce((best, one) => (one.event.step < best.event.step ? one : best));
    return eventFocus(first.run, first.event);
  }
  return firstContact(runs);
}
