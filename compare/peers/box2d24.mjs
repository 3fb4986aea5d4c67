/**
 * Box2D 2.4 compiled to WebAssembly (npm box2d-wasm): a second wiring of the contender `box2d`, in another language. The two
 * must agree. What is set, and why, is said in box2d_adapter/twin/README.md and the sources beside it.
 *
 *     paperproof compare thin_platform --peer 'node compare/peers/box2d24.mjs'
 *
 * The calls are Box2D's own (box2d.org/documentation of 2.4); npm's package documents what it adds: tuplesToVec2Array.
 */
import {installed, outline, serve} from "./peer.mjs";

async function load() {
  globalThis.fetch = undefined;  // the package of 2021 takes Node 18's for a browser's, and would fetch a file by its path
  return {box2d: await (await installed("box2d-wasm")).default(), clipper: (await installed("clipper-lib")).default};
}

class World {
  constructor({box2d, clipper}, run, parts) {
    Object.assign(this, {box2d, parts});
    this.world = new box2d.b2World(this.vector([0, 0]));
    this.world.SetAllowSleeping(false);
    this.bodies = parts.map((part) => this.#addPart(part, clipper));
    const def = this.#bodyDef(box2d.b2_dynamicBody);
    def.set_fixedRotation(true);
    def.set_bullet(true);
    this.body = this.world.CreateBody(def);
    const octagon = new box2d.b2PolygonShape();
    octagon.Set(box2d.tuplesToVec2Array(run.points)[0], run.points.length);
    this.#addShape(this.body, octagon, 1);
    const mass = new box2d.b2MassData();  // with its centre where the position is
    mass.set_mass(this.body.GetMass());
    mass.set_center(this.vector([0, 0]));
    mass.set_I(0);
    this.body.SetMassData(mass);
    this.manifold = new box2d.b2WorldManifold();
    this.goals = [];
  }

  /** A new one; `at` is for what is copied at once, as vectors of WebAssembly are not collected. */
  vector([x, y]) {
    return new this.box2d.b2Vec2(x, y);
  }

  at([x, y]) {
    this.scratch ??= this.vector([0, 0]);
    this.scratch.Set(x, y);
    return this.scratch;
  }

  #bodyDef(type) {
    const def = new this.box2d.b2BodyDef();
    def.set_type(type);
    def.set_allowSleep(false);
    return def;
  }

  /** @returns the fixture. */
  #addShape(body, shape, density = 0) {
    const def = new this.box2d.b2FixtureDef();
    def.set_shape(shape);
    def.set_density(density);
    def.set_friction(0);
    def.set_restitution(0);
    return body.CreateFixture(def);
  }

  #addPart(part, clipper) {
    const {box2d} = this;
    const body = this.world.CreateBody(this.#bodyDef(part.mover ? box2d.b2_kinematicBody : box2d.b2_staticBody));
    const {loops, edges} = outline(part, clipper, 0.00505);  // Box2D asserts more than 5 mm between vertices of a chain
    for (const loop of loops) {
      const chain = new box2d.b2ChainShape();
      chain.CreateLoop(box2d.tuplesToVec2Array(loop)[0], loop.length);
      this.#addShape(body, chain);
    }
    for (const [a, b] of edges) {
      const edge = new box2d.b2EdgeShape();
      edge.SetTwoSided(this.vector(a), this.vector(b));
      this.#addShape(body, edge);
    }
    for (const gate of part.gates) {
      const edge = new box2d.b2EdgeShape();
      edge.SetOneSided(...[gate.before, gate.a, gate.b, gate.after].map((point) => this.vector(point)));
      gate.fixture = this.#addShape(body, edge);
    }
    for (const {circle} of part.colliders.filter((collider) => collider.circle)) {
      const disc = new box2d.b2CircleShape();
      disc.get_m_p().Set(circle[0], circle[1]);
      disc.set_m_radius(circle[2]);
      this.#addShape(body, disc);
    }
    return body;
  }

  /** To drop contacts and the impulses in them a body is disabled and enabled again. */
  put(position, velocity) {
    this.body.SetEnabled(false);
    this.body.SetTransform(this.at(position), 0);
    this.body.SetLinearVelocity(this.at(velocity));
    this.body.SetEnabled(true);
  }

  /** By velocity, as Box2D sweeps nothing that is put somewhere; from where the body is, so that no rounding adds up. */
  drive(part, {from, to, angle = [0, 0]}, dt) {
    const body = this.bodies[part.index];
    const known = this.goals[part.index] ?? [];
    const begin = [...from, angle[0]].map(Math.fround);
    if (begin.some((value, i) => value !== known[i])) body.SetTransform(this.at(from), angle[0]);
    this.goals[part.index] = [...to, angle[1]].map(Math.fround);
    const at = body.GetPosition();
    const perSecond = Math.fround(1 / Math.fround(dt));
    const way = [Math.fround(Math.fround(to[0]) - at.x), Math.fround(Math.fround(to[1]) - at.y)];
    body.SetLinearVelocity(this.at([way[0] * perSecond, way[1] * perSecond]));
    body.SetAngularVelocity((Math.fround(angle[1]) - body.GetAngle()) / Math.fround(dt));
  }

  /** What does not hold collides with nothing. The contender disables the contact instead, in each step. */
  gate({fixture}, holds) {
    this.filter ??= new this.box2d.b2Filter();
    this.filter.set_categoryBits(1);
    this.filter.set_maskBits(holds ? 0xffff : 0);
    fixture.SetFilterData(this.filter);
  }

  ask(wanted) {
    this.body.SetLinearVelocity(this.at(wanted));
  }

  advance(dt) {
    this.world.Step(dt, 8, 3);  // Box2D's suggestion
  }

  answer() {
    const {box2d, manifold} = this;
    const touching = [];
    for (let edge = this.body.GetContactList(); box2d.getPointer(edge) !== 0; edge = edge.get_next()) {
      const contact = edge.get_contact();
      if (!contact.IsTouching()) continue;
      contact.GetWorldManifold(manifold);
      const isA = box2d.compare(contact.GetFixtureA().GetBody(), this.body);
      const sign = isA ? -1 : 1;
      const part = this.parts[this.bodies.findIndex((body) => box2d.compare(body, edge.get_other()))];
      const normal = [sign * manifold.get_normal().x, sign * manifold.get_normal().y];
      for (let i = 0; i < contact.GetManifold().get_pointCount(); ++i) {
        const radii = contact.GetFixtureA().GetShape().get_m_radius() + contact.GetFixtureB().GetShape().get_m_radius();
        const separation = manifold.get_separations(i) + radii;
        const point = manifold.get_points(i);
        touching.push({part, normal, point: [point.x, point.y], separation});
      }
    }
    const [at, velocity] = [this.body.GetPosition(), this.body.GetLinearVelocity()];
    return {
      path: [[at.x, at.y, 1]], velocity: [velocity.x, velocity.y],
      // Within the distance at which it begins to touch, and the slop.
      touching: touching.filter(({separation}) => separation <= 0.025),
    };
  }
}

await serve({
  package: "box2d-wasm",
  greeting: {
    name: "Box2D in WebAssembly", version: "2.4.1", can: ["movers", "turning", "one_way", "circles", "conveyors"],
    skin: 0.02, most_way: 2, scalar: "float", machine: "webassembly",
  },
  load,
  World,
});
