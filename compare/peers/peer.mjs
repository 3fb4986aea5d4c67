/**
 * What the peers beside this file share: the lines of README.md, read and answered, and the scene in the pieces that engines
 * want. A peer calls `serve` with what its engine is, and how a world of it is opened, stepped and read.
 */
import {readFileSync} from "node:fs";
import {createInterface} from "node:readline";

/** The words after the peer's file: `node compare/peers/rapier.mjs body_ccd` has one. */
export const words = process.argv.slice(2);

/** Where run.sh installs the packages of package.json: not among the sources. */
const packages = new URL("../../build/peers/", import.meta.url);
/** An installed package: what `import` of its name has in a module that stands beside the packages. */
export const installed = async (name) => (await import(new URL("engine.mjs", packages))).installed(name);
const versionOf = (name) => JSON.parse(readFileSync(new URL(`node_modules/${name}/package.json`, packages))).version;

/**
 * @param {object} engine `package` (of npm), `greeting` (README.md; its version is the package's where it has none),
 *   `load()`: the loaded engine, `World`: a class, made with the loaded engine, the run and its parts. A world has
 *   - `put(position, velocity)`: the character is there now;
 *   - `drive(part, motion, dt)`: the mover of a part goes from `motion.from` to `motion.to`, and turns by `motion.angle`;
 *   - `ask(wanted, dt)`: the wanted velocity of the step;
 *   - `advance(dt)`: the engine's own work. It alone is timed;
 *   - `gate(gate, holds)`, where it has one-way chains: whether a segment of them (`part.gates`) holds in this step;
 *   - `answer()`: what the schema calls a character, or of that `path` and `velocity`, with what is `touching` (`standing`);
 *   - `overlaps(position)`, where its engine has a query of overlap: the ids of what the character overlaps there.
 *   `sink` is how deep its character may stand in the ground [m]; none where it does not say.
 *   `own(run)`, where there is one, has what else is to be greeted with, as `points`.
 *   Where `World` or `load` throws a string, the scene is refused for this reason.
 */
export async function serve(engine) {
  const say = (what) => process.stdout.write(JSON.stringify(what) + "\n");
  let world, moving, gates, run, points, place;
  for await (const line of createInterface({input: process.stdin})) {
    const heard = JSON.parse(line);
    if (heard.run) {
      run = heard.run;
      try {
        const loaded = await engine.load().catch((error) => {
          throw error.code === "ERR_MODULE_NOT_FOUND" ? `run compare/peers/run.sh first: ${error.message}` : error;
        });
        const bodies = parts(run);
        moving = bodies.filter((part) => part.mover);
        gates = bodies.flatMap((part) => part.gates.map((gate) => ({part, gate})));
        warmUp(new engine.World(loaded, run, parts(run)), run);
        world = new engine.World(loaded, run, bodies);
        const own = engine.own?.(run);
        points = own?.points ?? run.points;
        say({version: versionOf(engine.package), ...(world.overlaps && {overlap: true}), ...engine.greeting, ...own});
      } catch (reason) {
        if (typeof reason !== "string") throw reason;
        say({refuses: reason});
        process.exit(0);
      }
      continue;
    }
    if (heard.overlap) {
      say({overlaps: overlapped(world, heard, moving, run.dt)});
      continue;
    }
    const {wanted, put, drop} = heard.characters[0];
    if (put) world.put((place = put.position), put.velocity);
    for (const part of moving) world.drive(part, (part.motion = heard.movers[part.mover]), heard.dt);
    for (const {part, gate} of gates) {
      gate.held = isAbove(gate, points, place, part.motion?.from ?? [0, 0], engine.sink ?? 0);
      const holds = gate.held && !drop;
      if (holds !== gate.holds) world.gate(gate, (gate.holds = holds));
    }
    world.ask(wanted, heard.dt);
    const began = process.hrtime.bigint();
    world.advance(heard.dt);
    const ns = Number(process.hrtime.bigint() - began);
    const {touching, ...answer} = world.answer();
    if (touching) Object.assign(answer, standing(run, touching, {wanted, dt: heard.dt}));
    const way = [place, (place = answer.path.at(-1))];
    if (drop)
      answer.dropped_through = [...new Set(gates.filter(({part, gate}) => gate.held && isNear(gate, points, way) &&
        !isAbove(gate, points, place, part.motion?.to ?? [0, 0], 0)).map(({gate}) => gate.id))];
    say({characters: [answer], ns});
  }
  process.kill(process.pid, "SIGKILL");  // its exit would wait until the engine is compiled
}

/** What the engine's own query has at a place, where movers are at the end of their ways. */
function overlapped(world, {overlap, movers}, moving, dt) {
  for (const part of moving) world.drive(part, movers[part.mover], dt);
  return [...new Set(world.overlaps(overlap))];
}

/** Compilers of JavaScript and WebAssembly start slowly; what is timed is a warm engine. This world is not used again. */
function warmUp(world, {starts, dt}) {
  for (let i = 0; i < 300; ++i) {
    if (i % 100 === 0) world.put(starts[0].position, [0, 0]);
    world.ask([1, -1], dt);
    world.advance(dt);
  }
}

/**
 * What stands, then what each mover takes along: each is one body. `mover` is the id by which a step names the motion.
 * What is a sensor stops nobody, and is left out.
 */
function parts(run) {
  const solid = run.colliders.filter((collider) => !collider.sensor);
  const groups = (run.movers ?? []).map((mover) => solid.filter(({id}) => mover.colliders.includes(id)));
  const still = solid.filter((collider) => !groups.flat().includes(collider));
  return [{colliders: still}, ...groups.map((colliders) => ({colliders, mover: colliders[0]?.id}))]
    .map((part, index) => ({...part, index, gates: part.colliders.flatMap(gatesOf)}));
}

/**
 * The segments of what is one-way, each with its two neighbours where those block the same way, and its own continuation
 * where not; in the direction in which they block on the right, as Box2D's one-sided edges do. `normal` is on that side.
 */
function gatesOf({id, chain, polygon, one_way: way}) {
  if (!way) return [];
  const line = chain ?? [...polygon, polygon[0]];
  const right = ([ax, ay], [bx, by]) => [by - ay, ax - bx];
  const segments = line.slice(1).map((b, i) => ({a: line[i], b})).map(({a, b}) => {
    const along = right(a, b)[0] * way[0] + right(a, b)[1] * way[1];
    return along === 0 || (polygon && along * ringArea(polygon) < 0) ? {} : along > 0 ? {a, b, ahead: true} : {a: b, b: a};
  });
  return segments.map(({a, b, ahead}, i) => {
    if (!a) return undefined;
    const [last, next] = ahead ? [segments[i - 1], segments[i + 1]] : [segments[i + 1], segments[i - 1]];
    const beyond = (from, to) => [2 * to[0] - from[0], 2 * to[1] - from[1]];
    const same = (other) => other?.a && other.ahead === ahead;
    const [before, after] = [same(last) ? last.a : beyond(b, a), same(next) ? next.b : beyond(a, b)];
    return {id, a, b, before, after, normal: right(a, b)};
  }).filter((gate) => gate);
}

/** Whether a way comes by a segment, to its left or right. */
const isNear = ({a, b}, points, way) => {
  const reach = way.flatMap(([x]) => points.map((point) => x + point[0]));
  return Math.max(...reach) >= Math.min(a[0], b[0]) && Math.min(...reach) <= Math.max(a[0], b[0]);
};

/** A one-way segment holds who is wholly on its side when a step begins, as the contender `box2d` has it. */
function isAbove({a, normal}, points, place, offset, sink) {
  const length = Math.hypot(...normal);
  return points.every(([x, y]) =>
    normal[0] * (place[0] + x - a[0] - offset[0]) + normal[1] * (place[1] + y - a[1] - offset[1]) >= -sink * length);
}

export const cross = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
const ringArea = (ring) => ring.reduce((sum, a, i) => sum + cross(ring[0], a, ring[(i + 1) % ring.length]), 0) / 2;
const counterClockwise = (ring) => (ringArea(ring) < 0 ? [...ring].reverse() : ring);

/**
 * The polygons of a part as convex ones, counter-clockwise: each as it is where it is convex, in triangles where not.
 * @param earcut the function of npm's earcut.
 */
export function convexPieces(part, earcut) {
  return part.colliders.filter(({polygon, one_way: way}) => polygon && !way).flatMap(({id, polygon, holes = []}) => {
    const ring = counterClockwise(polygon);
    const convex = ring.every((a, i) => cross(a, ring[(i + 1) % ring.length], ring[(i + 2) % ring.length]) >= 0);
    if (convex && holes.length === 0) return [{id, ring}];
    const points = [polygon, ...holes].flat();
    const starts = holes.map((_, i) => [polygon, ...holes.slice(0, i)].flat().length);
    const corners = earcut(points.flat(), starts);
    return Array.from({length: corners.length / 3}, (_, i) =>
      ({id, ring: counterClockwise(corners.slice(3 * i, 3 * i + 3).map((corner) => points[corner]))}));
  });
}

/** The edges of a part's chains that block from both sides. */
export const twoSidedEdges = (part) => part.colliders.filter(({chain, one_way: way}) => chain && !way)
  .flatMap(({chain}) => chain.slice(1).map((b, i) => [chain[i], b]));

/**
 * The outline of all polygons of a part, as chains of Box2D want it: counter-clockwise, holes clockwise; vertices are
 * dropped until they are farther apart than `spacing`. What is too thin for that comes as edges, with the part's chains.
 * @param clipper npm's clipper-lib, the library of box2d_adapter/twin/src/solid_union.hpp. It takes integers of 28 bits
 *   here; vertices of the scene come back as they were, and only crossings are rounded to the grid.
 * @param round to what the engine's numbers are; floats of 32 bits where it does not say.
 */
export function outline(part, clipper, spacing, round = Math.fround) {
  const rings = part.colliders.filter(({polygon, one_way: way}) => polygon && !way).flatMap(({polygon, holes = []}) =>
    [counterClockwise(polygon), ...holes.map((hole) => [...counterClockwise(hole)].reverse())]);
  const farthest = Math.max(...rings.flat(2).map(Math.abs), 1);
  const unit = 2 ** (28 - Math.ceil(Math.log2(farthest)));
  const joined = new clipper.Clipper();
  const known = new Map();
  const toGrid = ([x, y]) => {
    const grid = {X: Math.round(x * unit), Y: Math.round(y * unit)};
    known.set(`${grid.X} ${grid.Y}`, [round(x), round(y)]);
    return grid;
  };
  for (const ring of rings) joined.AddPath(ring.map(toGrid), clipper.PolyType.ptSubject, true);
  const found = [];
  const {pftNonZero} = clipper.PolyFillType;
  joined.Execute(clipper.ClipType.ctUnion, found, pftNonZero, pftNonZero);
  const loops = [];
  const edges = twoSidedEdges(part);
  const tooNear = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) <= spacing;
  for (const path of found) {
    const loop = path.map(({X, Y}) => known.get(`${X} ${Y}`) ?? [round(X / unit), round(Y / unit)]);
    const kept = [];
    for (const point of loop) if (kept.length === 0 || !tooNear(kept.at(-1), point)) kept.push(point);
    while (kept.length > 1 && tooNear(kept.at(-1), kept[0])) kept.pop();
    if (kept.length > 2 && ringArea(kept) * ringArea(loop) > 0) loops.push(kept);
    else if (ringArea(loop) > 0) edges.push(...loop.map((a, i) => [a, loop[(i + 1) % loop.length]]));
  }
  return {loops, edges};
}

const toSegment = ([x, y], a, b) => {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const t = Math.min(1, Math.max(0, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(x - a[0] - t * dx, y - a[1] - t * dy);
};

/** The collider of a part that has its edge nearest to a point, for engines that know the part alone. */
export function nearest(part, point) {
  const distance = ({polygon, holes = [], chain, circle}) => {
    if (circle) return Math.abs(Math.hypot(point[0] - circle[0], point[1] - circle[1]) - circle[2]);
    const lines = chain ? [chain] : [polygon, ...holes].map((ring) => [...ring, ring[0]]);
    return Math.min(...lines.flatMap((line) => line.slice(1).map((b, i) => toSegment(point, line[i], b))));
  };
  return part.colliders.reduce((best, next) => (distance(next) < distance(best) ? next : best)).id;
}

/** How fast a part goes in this step, where it is touched. */
export function velocityAt({motion}, [x, y], dt) {
  if (!motion) return [0, 0];
  const {from, to, angle: [before, after] = [0, 0]} = motion;
  const turn = (after - before) / dt;
  return [(to[0] - from[0]) / dt - turn * (y - to[1]), (to[1] - from[1]) / dt + turn * (x - to[0])];
}

/** Box2D 3, loaded: npm box2d3-wasm. Its integration test fills in for what Node has since 21. */
export async function loadBox2d3() {
  globalThis.navigator ??= {hardwareConcurrency: 1};
  return (await installed("box2d3-wasm")).default();
}

/**
 * What touches, as an answer has it. A contact is what the wanted motion leads into; ground is the most level of what is
 * walkable and not left by it. This is how the contender `box2d` reads Box2D (box2d_adapter/twin/src/reference_world.cpp).
 * @param touching `{part, normal, point, separation}` each, and `collider` where it is known; the normal points to the
 *   character.
 * @param wanted velocity, and `dt`, of the step.
 */
export function standing(run, touching, {wanted, dt}) {
  const leastUp = Math.fround(Math.cos((run.max_climb_degrees * Math.PI) / 180 + 1e-5));
  const approach = ({part, normal}) => {
    const {from, to} = part.motion ?? {from: [0, 0], to: [0, 0]};
    return normal[0] * (wanted[0] * dt - to[0] + from[0]) + normal[1] * (wanted[1] * dt - to[1] + from[1]);
  };
  const named = ({part, collider, ...rest}) => ({collider: collider ?? nearest(part, rest.point), ...rest});
  const [ground] = touching.filter((touch) => touch.normal[1] >= leastUp && approach(touch) <= 1e-7)
    .sort((a, b) => b.normal[1] - a.normal[1]).map(named);
  const sides = new Map(touching.filter((touch) => approach(touch) < -1e-7).map(named).map((touch) =>
    [`${touch.collider} ${touch.normal.map((value) => value.toFixed(2))}`, touch]));
  const said = {contacts: [...sides.values()], grounded: ground !== undefined};
  if (ground) said.ground = {collider: ground.collider, normal: ground.normal};
  return said;
}
