/**
 * Box2D 3 compiled to WebAssembly (npm box2d3-wasm), driven as its manual and samples do:
 *
 *     paperproof compare thin_platform --peer 'node compare/peers/box2d3.mjs'           # a body
 *     paperproof compare thin_platform --peer 'node compare/peers/box2d3.mjs bullet'    # the same as a bullet
 *     paperproof compare thin_platform --peer 'node compare/peers/box2d3.mjs mover'     # the geometric mover
 *
 * Sources: box2d.org/documentation, its pages Simulation (bodies, chains, bullets) and Character mover; the loop of the
 * mover is that of samples/sample_character.cpp. The mover is a capsule: the largest upright one in the octagon. The judge
 * is told, by eight points on its rim, and looks at those.
 */
import {installed, loadBox2d3, nearest, outline, serve, velocityAt, words} from "./peer.mjs";

const asMover = words.includes("mover");
const slop = 0.005;  // b2_linearSlop

async function load() {
  return {box2d: await loadBox2d3(), clipper: (await installed("clipper-lib")).default};
}

/** The largest upright capsule in a convex shape around (0, 0): `{radius, half}`, with `half` the length of its axis. */
function capsuleIn(points) {
  const room = (half) => Math.min(...points.map(([ax, ay], i) => {
    const [bx, by] = points[(i + 1) % points.length];
    return (ax * by - ay * bx - half * Math.abs(bx - ax)) / Math.hypot(bx - ax, by - ay);
  }));
  const high = Math.max(...points.map(([, y]) => y));
  const area = ({radius, half}) => radius * (Math.PI * radius + 4 * half);
  return Array.from({length: 1000}, (_, i) => (high * (i + 1)) / 1000).map((half) => ({half, radius: room(half)}))
    .reduce((best, next) => (next.radius > 0 && area(next) > area(best) ? next : best));
}

/** Of a capsule: foot, sides, what is between those, and head. b2SolvePlanes lets it sink in by the slop. */
function rimOf({half, radius: withSlop}) {
  const radius = withSlop - 1.01 * slop;
  const slant = radius * Math.SQRT1_2;
  const side = [[slant, -half - slant], [radius, -half], [radius, half]];
  return [[0, -half - radius], ...side, [0, half + radius], ...side.map(([x, y]) => [-x, y]).reverse()];
}

class World {
  constructor({box2d, clipper}, run, parts) {
    Object.assign(this, {box2d, run, parts});
    // For what is copied at once: objects of WebAssembly are not collected.
    this.scratch = {vector: new box2d.b2Vec2(0, 0), transform: new box2d.b2Transform()};
    const def = box2d.b2DefaultWorldDef();
    def.gravity.Set(0, 0);  // the wanted velocity has it
    def.enableSleep = false;
    this.world = box2d.b2CreateWorld(def);
    this.bodies = parts.map((part) => this.#addPart(part, clipper));
    if (asMover) {
      this.capsule = capsuleIn(run.points);
      this.mover = new box2d.b2Capsule();
      this.mover.radius = this.capsule.radius;
      this.filter = box2d.b2DefaultQueryFilter();
      this.planes = [];
      return;
    }
    const body = box2d.b2DefaultBodyDef();
    body.type = box2d.b2BodyType.b2_dynamicBody;
    body.motionLocks.angularZ = true;
    body.isBullet = words.includes("bullet");
    this.body = box2d.b2CreateBody(this.world, body);
    const hull = box2d.b2ComputeHull(run.points.map(([x, y]) => ({x, y})));
    box2d.b2CreatePolygonShape(this.body, this.#surface(), box2d.b2MakePolygon(hull, 0));
  }

  vector([x, y]) {
    this.scratch.vector.Set(x, y);
    return this.scratch.vector;
  }

  #surface() {
    const def = this.box2d.b2DefaultShapeDef();
    def.material.friction = 0;
    def.material.restitution = 0;
    return def;
  }

  #addPart(part, clipper) {
    const {box2d} = this;
    const def = box2d.b2DefaultBodyDef();
    if (part.mover) def.type = box2d.b2BodyType.b2_kinematicBody;
    const body = box2d.b2CreateBody(this.world, def);
    const {loops, edges} = outline(part, clipper, 0.00505);  // the manual: vertices of a chain farther apart than the slop
    for (const loop of loops) {
      // A chain has four points at least; of a triangle one edge gets its middle.
      const points = loop.length > 3 ? loop : [...loop, [0, 1].map((axis) => (loop[0][axis] + loop[2][axis]) / 2)];
      const chain = box2d.b2DefaultChainDef();
      chain.SetPoints(points.map(([x, y]) => ({x, y})));
      chain.isLoop = true;
      const material = this.#surface().material;
      chain.SetMaterials([material]);
      box2d.b2CreateChain(body, chain);
    }
    const addSegment = ([a, b]) => {
      const segment = new box2d.b2Segment();
      segment.point1.Copy(this.vector(a));
      segment.point2.Copy(this.vector(b));
      return box2d.b2CreateSegmentShape(body, this.#surface(), segment);
    };
    edges.forEach(addSegment);
    for (const gate of part.gates) gate.shape = addSegment([gate.a, gate.b]);
    for (const {circle: [x, y, radius]} of part.colliders.filter(({circle}) => circle)) {
      const disc = new box2d.b2Circle();
      disc.center.Set(x, y);
      disc.radius = radius;
      box2d.b2CreateCircleShape(body, this.#surface(), disc);
    }
    return body;
  }

  #transform([x, y], angle) {
    const {transform} = this.scratch;
    transform.p.Set(x, y);
    transform.q.SetAngle(angle);
    return transform;
  }

  put(position, velocity) {
    this.place = position;
    if (!this.body) return;
    this.box2d.b2Body_SetTransform(this.body, this.vector(position), this.#transform(position, 0).q);
    this.box2d.b2Body_SetLinearVelocity(this.body, this.vector(velocity));
  }

  /** The manual: what moves kinematic bodies to where they should be is b2Body_SetTargetTransform. */
  drive(part, {from, to, angle = [0, 0]}, dt) {
    const {box2d} = this;
    const body = this.bodies[part.index];
    const at = box2d.b2Body_GetPosition(body);
    if (Math.hypot(at.x - from[0], at.y - from[1]) > 1e-3)
      box2d.b2Body_SetTransform(body, this.vector(from), this.#transform(from, angle[0]).q);
    box2d.b2Body_SetTargetTransform(body, this.#transform(to, angle[1]), dt);
  }

  gate({shape}, holds) {
    const filter = this.box2d.b2Shape_GetFilter(shape);
    filter.maskBits = holds ? 1 : 0;  // 1 is the category of all that has none
    this.box2d.b2Shape_SetFilter(shape, filter);
  }

  ask(wanted, dt) {
    this.asked = {wanted, dt};
    if (this.body) this.box2d.b2Body_SetLinearVelocity(this.body, this.vector(wanted));
  }

  advance(dt) {
    this.box2d.b2World_Step(this.world, dt, 4);  // the manual's number of sub-steps
    if (asMover) this.#moveCapsule();
  }

  /** Those of the round before end with it. */
  #findPlanes() {
    for (const {plane} of this.planes) plane.delete();
    this.planes = [];
    this.box2d.b2World_CollideMover(this.world, this.mover, this.filter, (shape, result) => {
      const plane = new this.box2d.b2CollisionPlane();
      plane.plane.offset = result.plane.offset;
      plane.plane.normal.Copy(result.plane.normal);
      plane.pushLimit = 3e38;  // rigid
      plane.push = 0;
      plane.clipVelocity = true;
      this.planes.push({plane, shape});
      return true;
    });
  }

  /** The sample's loop: five rounds, until one moves by less than a centimetre. */
  #moveCapsule() {
    const {box2d, mover, asked: {wanted, dt}, capsule: {radius, half}} = this;
    const target = [this.place[0] + wanted[0] * dt, this.place[1] + wanted[1] * dt];
    const way = [];
    this.from = this.place;
    for (let round = 0; round < 5; ++round) {
      mover.center1.Set(this.place[0], this.place[1] - half);
      mover.center2.Set(this.place[0], this.place[1] + half);
      this.#findPlanes();
      const rest = this.vector([target[0] - this.place[0], target[1] - this.place[1]]);
      const {translation} = box2d.b2SolvePlanes(rest, this.planes.map(({plane}) => plane));
      // The binding solves copies and keeps their pushes: a plane has pushed where the way ends on it, with the slop.
      for (const {plane} of this.planes) {
        const {normal, offset} = plane.plane;
        plane.push = normal.x * translation.x + normal.y * translation.y - offset + slop < 1e-4 ? 1 : 0;
      }
      const share = box2d.b2World_CastMover(this.world, mover, translation, this.filter);
      const delta = [translation.x * share, translation.y * share];
      this.place = [this.place[0] + delta[0], this.place[1] + delta[1]];
      way.push(this.place);
      if (Math.hypot(...delta) < 0.01) break;
    }
    const touching = this.planes.filter(({plane}) => plane.push > 0).map(({plane, shape}) => {
      const {normal} = plane.plane;
      const point = [this.place[0] - radius * normal.x, this.place[1] - radius * normal.y - Math.sign(normal.y) * half];
      return {part: this.#partOf(shape), normal: [normal.x, normal.y], separation: 0, point, plane};
    });
    // b2ClipVector knows no plane that moves: each clips in its own frame.
    const velocity = touching.reduce((left, {part, point, plane}) => {
      const own = velocityAt(part, point, dt);
      const {x, y} = box2d.b2ClipVector(this.vector([left[0] - own[0], left[1] - own[1]]), [plane]);
      return [x + own[0], y + own[1]];
    }, wanted);
    this.moved = {way, velocity, touching: touching.map(({plane, ...rest}) => rest)};
  }

  /** b2World_OverlapShape, of the octagon less half a millimetre (so much does it count as overlap) or the capsule without the slop. */
  overlaps(position) {
    const {box2d} = this;
    const proxy = new box2d.b2ShapeProxy();
    const points = asMover ? [[0, -this.capsule.half], [0, this.capsule.half]] :
      this.run.points.map((point) => point.map((value) => 0.9984 * value));
    points.forEach(([x, y], i) => proxy.setPoint(i, this.vector([position[0] + x, position[1] + y])));
    proxy.count = points.length;
    proxy.radius = asMover ? this.capsule.radius - 1.01 * slop : 0;
    const found = [];
    box2d.b2World_OverlapShape(this.world, proxy, box2d.b2DefaultQueryFilter(), ({shapeId: shape}) => {
      if (!this.body || box2d.b2Shape_GetBody(shape).index1 !== this.body.index1) found.push(nearest(this.#partOf(shape), position));
      return true;
    });
    return found;
  }

  answer() {
    return asMover ? this.#answerOfMover() : this.#answerOfBody();
  }

  #partOf(shape) {
    const {index1} = this.box2d.b2Shape_GetBody(shape);
    return this.parts[this.bodies.findIndex((body) => body.index1 === index1)];
  }

  #answerOfMover() {
    const {way, velocity, touching} = this.moved;
    // A round's share of the step is that of the wanted way. Where something moves it is at its end already: no corners.
    const length = Math.hypot(...this.asked.wanted) * this.asked.dt || 1;
    const path = [];
    let [from, t] = [this.from, 0];
    for (const [x, y] of this.parts.length > 1 ? [] : way) {
      const share = Math.hypot(x - from[0], y - from[1]) / length;
      if (share > 1e-9 && t + share < 1) path.push([x, y, (t += share)]);
      from = [x, y];
    }
    path.push([...this.place, 1]);
    return {path, velocity, touching};
  }

  #answerOfBody() {
    const {box2d} = this;
    const touching = [];
    for (const {manifold, shapeIdA, shapeIdB} of box2d.b2Body_GetContactData(this.body, 64)) {
      const isA = box2d.b2Shape_GetBody(shapeIdA).index1 === this.body.index1;
      const normal = [manifold.normal.x, manifold.normal.y].map((value) => (isA ? -value : value));
      for (let i = 0; i < manifold.pointCount; ++i) {
        const {point, separation, totalNormalImpulse} = manifold.GetPoint(i);
        if (totalNormalImpulse === 0) continue;  // near, and not touched
        touching.push({part: this.#partOf(isA ? shapeIdB : shapeIdA), normal, point: [point.x, point.y], separation});
      }
    }
    const [at, velocity] = [box2d.b2Body_GetPosition(this.body), box2d.b2Body_GetLinearVelocity(this.body)];
    return {path: [[at.x, at.y, 1]], velocity: [velocity.x, velocity.y], touching};
  }
}

await serve({
  package: "box2d3-wasm",
  greeting: {
    name: `Box2D 3 ${asMover ? "mover" : "body"} in WebAssembly, box2d3-wasm`, skin: slop, scalar: "float", machine: "webassembly",
    can: ["movers", "turning", "one_way", "circles", "conveyors"],
  },
  sink: asMover ? 1e-3 : 0.05,  // soft contacts sink in by centimetres
  load,
  World,
  own: (run) => (asMover ? {points: rimOf(capsuleIn(run.points))} : {}),
});
