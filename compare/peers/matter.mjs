/**
 * Matter.js (npm matter-js), a body, driven as its documentation says:
 *
 *     paperproof compare thin_platform --peer 'node compare/peers/matter.mjs'
 *
 * Sources: brm.io/matter-js/docs (Engine.update, Body.create, Body.setVelocity, Body.setPosition, Vertices.centre). It has
 * no continuous collision, and says so. Its lengths are pixels, its velocities pixels in 1/60 s; a metre is 32 of them here,
 * the scenes' own scale. It knows convex polygons alone: others come in triangles, and chains and circles not at all.
 */
import {convexPieces, installed, nearest, serve} from "./peer.mjs";

const scale = 32;
const pixels = ([x, y]) => ({x: x * scale, y: y * scale});
/** No friction of any kind, no bouncing, no turning: a body without those is what the wanted velocity is for. */
const smooth = {friction: 0, frictionStatic: 0, frictionAir: 0, restitution: 0, inertia: Infinity};

async function load() {
  return {matter: (await installed("matter-js")).default, earcut: (await installed("earcut")).default};
}

class World {
  constructor({matter, earcut}, run, parts) {
    if (run.colliders.some(({chain}) => chain)) throw "a chain, and it knows convex polygons alone";
    Object.assign(this, {matter});
    this.engine = matter.Engine.create({gravity: {x: 0, y: 0, scale: 0}});  // the wanted velocity has gravity in it
    this.partOf = new Map();
    this.bodies = parts.map((part) => convexPieces(part, earcut).map(({ring}) => {
      const body = this.#polygon(ring, {isStatic: true});
      this.partOf.set(body, part);
      return {body, home: {...body.position}};
    }));
    this.body = this.#polygon(run.points, {});
    matter.Composite.add(this.engine.world, [...this.bodies.flat().map(({body}) => body), this.body]);
  }

  #polygon(ring, options) {
    const vertices = ring.map(pixels);
    return this.matter.Body.create({...smooth, ...options, vertices, position: this.matter.Vertices.centre(vertices)});
  }

  /** The octagon's centre is its position. */
  put(position, velocity) {
    this.matter.Body.setPosition(this.body, pixels(position));
    this.matter.Body.setVelocity(this.body, pixels([velocity[0] / 60, velocity[1] / 60]));
  }

  /** Static bodies that move are set, and told their velocity. */
  drive(part, {from, to}, dt) {
    const {x, y} = pixels(to);
    for (const {body, home} of this.bodies[part.index]) {
      this.matter.Body.setPosition(body, {x: home.x + x, y: home.y + y});
      this.matter.Body.setVelocity(body, pixels([0, 1].map((axis) => (to[axis] - from[axis]) / dt / 60)));
    }
  }

  ask(wanted) {
    this.matter.Body.setVelocity(this.body, pixels([wanted[0] / 60, wanted[1] / 60]));
  }

  advance(dt) {
    this.matter.Engine.update(this.engine, dt * 1000);
  }

  /** Collision.collides, as Query.collides has it: it has to say how deep, or they touch alone. */
  overlaps(position) {
    const {Body, Collision} = this.matter;
    const home = {...this.body.position};
    Body.setPosition(this.body, pixels(position));
    const found = this.bodies.flat().filter(({body}) => (Collision.collides(this.body, body)?.depth ?? 0) > 0);
    Body.setPosition(this.body, home);
    return found.map(({body}) => nearest(this.partOf.get(body), position));
  }

  answer() {
    const touching = [];
    for (const pair of this.engine.pairs.list.filter(({isActive}) => isActive)) {
      const {bodyA, bodyB, normal, depth} = pair.collision;
      if (bodyA !== this.body && bodyB !== this.body) continue;
      const other = bodyA === this.body ? bodyB : bodyA;
      const side = bodyA === this.body ? 1 : -1;  // the normal points to body A
      const point = pair.contactCount > 0 ? pair.contacts[0].vertex : this.body.position;
      touching.push({part: this.partOf.get(other), normal: [side * normal.x, side * normal.y],
        point: [point.x / scale, point.y / scale], separation: -depth / scale});
    }
    const {x, y} = this.body.position;
    const velocity = this.matter.Body.getVelocity(this.body);
    return {path: [[x / scale, y / scale, 1]], velocity: [(velocity.x / scale) * 60, (velocity.y / scale) * 60],
      touching};
  }
}

await serve({
  package: "matter-js",
  greeting: {name: "Matter.js", can: ["movers", "conveyors"], skin: 0.0016, scalar: "double",
    machine: "javascript"},  // its slop is 0.05 px: so deep it rests
  load,
  World,
});
