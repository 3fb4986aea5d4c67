/**
 * Rapier (npm @dimforge/rapier2d-compat), driven as its user guide says:
 *
 *     paperproof compare thin_platform --peer 'node compare/peers/rapier.mjs'             # its character controller
 *     paperproof compare thin_platform --peer 'node compare/peers/rapier.mjs snap'        # the same, following the ground
 *     paperproof compare thin_platform --peer 'node compare/peers/rapier.mjs body'        # a dynamic body, as it comes
 *     paperproof compare thin_platform --peer 'node compare/peers/rapier.mjs body_ccd'    # with CCD on
 *     paperproof compare thin_platform --peer 'node compare/peers/rapier.mjs body_no_ccd' # with none in the world
 *     paperproof compare flush_tiles --peer 'node compare/peers/rapier.mjs outline'       # scenery as one-sided polylines
 *
 * As it comes a body that is fast is swept against what is fixed; CCD on sweeps it against the rest as well.
 *
 * Sources: rapier.rs/docs/user_guides/javascript, its pages on the character controller, on rigid-bodies (CCD, locked
 * rotations, kinematic bodies) and on colliders; rapier.rs/javascript2d for each call.
 */
import {convexPieces, installed, nearest, outline, serve, standing, twoSidedEdges, velocityAt, words} from "./peer.mjs";

const asBody = words.some((word) => word.startsWith("body"));
const asOutline = words.includes("outline");
/** What is kept free [m]: the controller's offset, as in the guide ("must not be zero"), and a body's contact skin. */
const gap = 0.01;
const follows = words.includes("snap");
/** Distance to the ground that it follows where the scene has none, and the least room on a step [m]: the guide's. */
const [guidesSnap, leastStep] = [0.5, 0.2];
const flat = (points) => new Float32Array(points.flat());
const vector = ([x, y]) => ({x, y});

async function load() {
  const rapier = (await installed("@dimforge/rapier2d-compat")).default;
  await rapier.init();
  return {rapier, earcut: (await installed("earcut")).default, clipper: (await installed("clipper-lib")).default};
}

class World {
  constructor({rapier, earcut, clipper}, run, parts) {
    Object.assign(this, {rapier, run, parts});
    this.world = new rapier.World({x: 0, y: 0});  // the wanted velocity has gravity in it
    if (words.includes("body_no_ccd")) this.world.integrationParameters.maxCcdSubsteps = 0;
    this.owner = new Map();  // of a collider: its part, and its id where it has one for itself
    this.bodies = parts.map((part) => this.#addPart(part, earcut, clipper));
    const kind = asBody ? rapier.RigidBodyDesc.dynamic() : rapier.RigidBodyDesc.kinematicPositionBased();
    kind.lockRotations().setCanSleep(false).setCcdEnabled(words.includes("body_ccd"));
    this.body = this.world.createRigidBody(kind);
    const shape = smooth(rapier.ColliderDesc.convexPolyline(flat(run.points)));
    // A body of Rapier rests micrometres inside what it rests on, unless it has a contact skin, which keeps it off.
    if (asBody) shape.setContactSkin(gap);
    this.character = this.world.createCollider(shape, this.body);
    if (asBody) return;
    // Angles, steps and snapping as the scene has them; pushing is off.
    this.controller = this.world.createCharacterController(gap);
    this.controller.setMaxSlopeClimbAngle((run.max_climb_degrees * Math.PI) / 180);
    this.controller.setMinSlopeSlideAngle((run.max_climb_degrees * Math.PI) / 180);
    const {step_height: step, snap} = run.character;
    this.controller.disableAutostep();
    this.controller.disableSnapToGround();
    if (step > 0) this.controller.enableAutostep(step, leastStep, false);
    if (snap > 0 || follows) this.controller.enableSnapToGround(snap || guidesSnap);
    this.controller.setApplyImpulsesToDynamicBodies(false);
    this.world.step();  // what the controller asks for obstacles is built by a step
  }

  #addPart(part, earcut, clipper) {
    const {ColliderDesc, PolylineFlags, RigidBodyDesc} = this.rapier;
    // Movers by velocity: the controller asks a kinematic body for its velocity, and would hear the last step's otherwise.
    const body = this.world.createRigidBody(part.mover ? RigidBodyDesc.kinematicVelocityBased() : RigidBodyDesc.fixed());
    const add = (shape, id) => {
      const collider = this.world.createCollider(smooth(shape), body);
      this.owner.set(collider.handle, {part, collider: id});
      return collider;
    };
    const {loops, edges} = asOutline ? outline(part, clipper, 0) : {loops: [], edges: twoSidedEdges(part)};
    for (const loop of loops) add(ColliderDesc.polyline(flat([...loop, loop[0]]), null, PolylineFlags.ORIENTED));
    for (const {id, ring} of asOutline ? [] : convexPieces(part, earcut)) add(ColliderDesc.convexPolyline(flat(ring)), id);
    for (const [a, b] of edges) add(ColliderDesc.segment(vector(a), vector(b)));
    for (const gate of part.gates) gate.collider = add(ColliderDesc.segment(vector(gate.a), vector(gate.b)), gate.id);
    for (const {circle: [x, y, radius]} of part.colliders.filter(({circle}) => circle))
      add(ColliderDesc.ball(radius).setTranslation(x, y));
    return body;
  }

  put(position, velocity) {
    this.body.setTranslation(vector(position), true);
    if (asBody) this.body.setLinvel(vector(velocity), true);
    this.world.propagateModifiedBodyPositionsToColliders();
  }

  drive(part, {from, to, angle = [0, 0]}, dt) {
    const body = this.bodies[part.index];
    const at = body.translation();
    if (Math.hypot(at.x - from[0], at.y - from[1]) > 1e-3) body.setTranslation(vector(from), true);
    const begin = body.translation();
    body.setLinvel({x: (to[0] - begin.x) / dt, y: (to[1] - begin.y) / dt}, true);
    body.setAngvel((angle[1] - body.rotation()) / dt, true);
  }

  gate({collider}, holds) {
    collider.setEnabled(holds);
  }

  ask(wanted, dt) {
    this.asked = {wanted, dt};
    this.world.timestep = dt;
    if (asBody) this.body.setLinvel(vector(wanted), true);
  }

  advance() {
    if (this.controller) {
      const {wanted, dt} = this.asked;
      this.controller.computeColliderMovement(this.character, {x: wanted[0] * dt, y: wanted[1] * dt});
      const moved = this.controller.computedMovement();
      const at = this.body.translation();
      this.body.setNextKinematicTranslation({x: at.x + moved.x, y: at.y + moved.y});
    }
    this.world.step();
  }

  /** Collider.intersectsShape, of each collider. */
  overlaps(position) {
    this.world.propagateModifiedBodyPositionsToColliders();
    return [...this.owner].filter(([handle]) =>
      this.world.getCollider(handle).intersectsShape(this.character.shape, vector(position), 0))
      .map(([, {part, collider}]) => collider ?? nearest(part, position));
  }

  answer() {
    const at = this.body.translation();
    return this.controller ? this.#answerOfController(at) : this.#answerOfBody(at);
  }

  #answerOfBody(at) {
    const velocity = this.body.linvel();
    const touching = [];
    this.world.contactPairsWith(this.character, (other) =>
      this.world.contactPair(this.character, other, (manifold, flipped) => {
        const {x, y} = manifold.normal();
        const normal = flipped ? [x, y] : [-x, -y];
        for (let i = 0; i < manifold.numSolverContacts(); ++i) {
          if (manifold.contactImpulse(i) === 0) continue;  // near, and not touched
          const point = manifold.solverContactPoint(i);
          touching.push({...this.owner.get(other.handle), normal, point: [point.x, point.y],
            separation: manifold.solverContactDist(i)});
        }
      }));
    return {path: [[at.x, at.y, 1]], velocity: [velocity.x, velocity.y], touching};
  }

  /**
   * The controller has no velocity; the guide leaves it to the game. Here walkable ground takes what falls, and everything
   * else what leads into it. The controller takes along what stands on a mover by itself, so such ground is not named, and
   * what is said is the velocity on it.
   */
  #answerOfController(at) {
    const touching = Array.from({length: this.controller.numComputedCollisions()}, (_, i) => {
      const {collider, normal1: {x, y}} = this.controller.computedCollision(i);
      // Its witness points are not where the contact is where a cast begins within the offset. This corner is.
      const corner = this.run.points.reduce((low, next) => ((next[0] - low[0]) * x + (next[1] - low[1]) * y < 0 ? next : low));
      const point = [at.x + corner[0] - gap * x, at.y + corner[1] - gap * y];
      return {...this.owner.get(collider.handle), normal: [x, y], point, separation: gap};
    });
    const {ground, contacts} = standing(this.run, touching, this.asked);
    let [vx, vy] = this.asked.wanted;
    for (const {part, normal: [x, y], point} of touching) {
      const steep = Math.acos(y) > this.controller.maxSlopeClimbAngle();
      const [ownX, ownY] = steep ? velocityAt(part, point, this.asked.dt) : [0, 0];
      const into = Math.min(0, (vx - ownX) * x + (vy - ownY) * y);
      const highest = Math.max(vy, ownY);
      if (steep) vx -= into * x;
      vy = Math.min(highest, vy - into * y);
    }
    const said = {path: [[at.x, at.y, 1]], velocity: [vx, vy], grounded: this.controller.computedGrounded(), contacts};
    const moves = this.parts.some((part) => part.mover && part.colliders.some(({id}) => id === ground?.collider));
    return ground && !moves ? {...said, ground} : said;
  }
}

/** Of all shapes, so that whichever rule combines two of them there is none. */
const smooth = (shape) => shape.setFriction(0).setRestitution(0);

await serve({
  package: "@dimforge/rapier2d-compat",
  greeting: {
    name: `Rapier ${asBody ? "body" : "character controller"}`, skin: gap, scalar: "float", machine: "webassembly",
    can: ["movers", "turning", "one_way", "circles", "conveyors"],
  },
  sink: asBody ? 0.05 : 1e-3,  // a body that lands sinks in by centimetres
  load,
  World,
});
