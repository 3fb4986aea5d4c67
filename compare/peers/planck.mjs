/**
 * Planck (npm planck), Box2D 2 rewritten in JavaScript, driven as its documentation says:
 *
 *     paperproof compare thin_platform --peer 'node compare/peers/planck.mjs'           # a body
 *     paperproof compare thin_platform --peer 'node compare/peers/planck.mjs bullet'    # the same as a bullet
 *
 * Sources: piqnt.com/planck.js/docs, its pages on bodies (bullets, fixed rotation), chains, contacts and the world ("the
 * suggested iteration count is 8 for velocity and 3 for position").
 */
import {installed, nearest, outline, serve, words} from "./peer.mjs";

async function load() {
  return {planck: await installed("planck"), clipper: (await installed("clipper-lib")).default};
}

const smooth = {friction: 0, restitution: 0};
const vector = ([x, y]) => ({x, y});

class World {
  constructor({planck, clipper}, run, parts) {
    Object.assign(this, {planck, parts});
    this.world = new planck.World({gravity: {x: 0, y: 0}, allowSleep: false});  // the wanted velocity has gravity in it
    this.bodies = parts.map((part) => this.#addPart(part, clipper));
    this.body = this.world.createDynamicBody({fixedRotation: true, bullet: words.includes("bullet"), allowSleep: false});
    this.body.createFixture({shape: new planck.Polygon(run.points.map(vector)), density: 1, ...smooth});
  }

  /** Chains around what is solid: "they are smooth", where flush boxes are not. */
  #addPart(part, clipper) {
    const {planck} = this;
    const body = part.mover ? this.world.createKinematicBody() : this.world.createBody();
    const same = (value) => value;  // its numbers are doubles
    const {loops, edges} = outline(part, clipper, planck.Settings.linearSlop * 1.01, same);
    for (const loop of loops) body.createFixture({shape: new planck.Chain(loop.map(vector), true), ...smooth});
    for (const [a, b] of edges) body.createFixture({shape: new planck.Edge(vector(a), vector(b)), ...smooth});
    for (const gate of part.gates) {
      const edge = new planck.Edge(vector(gate.a), vector(gate.b));
      edge.setPrevVertex(vector(gate.before)).setNextVertex(vector(gate.after));
      gate.fixture = body.createFixture({shape: edge, ...smooth});
    }
    for (const {circle: [x, y, radius]} of part.colliders.filter(({circle}) => circle))
      body.createFixture({shape: new planck.Circle({x, y}, radius), ...smooth});
    return body;
  }

  put(position, velocity) {
    this.body.setTransform(vector(position), 0);
    this.body.setLinearVelocity(vector(velocity));
  }

  /** "A kinematic body moves under simulation according to its velocity." */
  drive(part, {from, to, angle = [0, 0]}, dt) {
    const body = this.bodies[part.index];
    const at = body.getPosition();
    if (Math.hypot(at.x - from[0], at.y - from[1]) > 1e-9) body.setTransform(vector(from), angle[0]);
    body.setLinearVelocity({x: (to[0] - from[0]) / dt, y: (to[1] - from[1]) / dt});
    body.setAngularVelocity((angle[1] - body.getAngle()) / dt);
  }

  gate({fixture}, holds) {
    fixture.setFilterMaskBits(holds ? 0xffff : 0);
  }

  ask(wanted) {
    this.body.setLinearVelocity(vector(wanted));
  }

  advance(dt) {
    this.world.step(dt, 8, 3);
  }

  /** Distance of the shapes as they are: testOverlap counts their radii of 10 mm each. */
  overlaps(position) {
    const {Distance, Transform} = this.planck;
    const input = new Distance.Input();
    const output = new Distance.Output();
    const octagon = this.body.getFixtureList().getShape();
    input.proxyA.set(octagon, 0);
    input.transformA = new Transform(vector(position), 0);
    return this.parts.filter(({index}) => {
      input.transformB = this.bodies[index].getTransform();
      for (let fixture = this.bodies[index].getFixtureList(); fixture; fixture = fixture.getNext())
        for (let child = 0; child < fixture.getShape().getChildCount(); ++child) {
          input.proxyB.set(fixture.getShape(), child);
          Distance(output, new Distance.Cache(), input);
          if (output.distance === 0) return true;
        }
      return false;
    }).map((part) => nearest(part, position));
  }

  answer() {
    const touching = [];
    for (let edge = this.body.getContactList(); edge; edge = edge.next) {
      const {contact} = edge;
      if (!contact.isTouching()) continue;
      const {normal, points, separations, pointCount} = contact.getWorldManifold(null);
      const sign = contact.getFixtureA().getBody() === this.body ? -1 : 1;
      const part = this.parts[this.bodies.indexOf(edge.other)];
      const radii = contact.getFixtureA().getShape().getRadius() + contact.getFixtureB().getShape().getRadius();
      for (let i = 0; i < pointCount; ++i) {
        touching.push({part, normal: [sign * normal.x, sign * normal.y], point: [points[i].x, points[i].y],
          separation: separations[i] + radii});
      }
    }
    const [at, velocity] = [this.body.getPosition(), this.body.getLinearVelocity()];
    return {path: [[at.x, at.y, 1]], velocity: [velocity.x, velocity.y], touching};
  }
}

await serve({
  package: "planck",
  greeting: {name: "Planck", can: ["movers", "turning", "one_way", "circles", "conveyors"], skin: 0.02, most_way: 2, scalar: "double",
    machine: "javascript"},
  load,
  World,
});
