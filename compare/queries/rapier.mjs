/**
 * Rapier (npm @dimforge/rapier2d-compat) answers questions of first contact: World.castShape.
 *
 *     node compare/queries/rapier.mjs QUERIES.jsonl > ANSWERS.jsonl
 *
 * The target distance is 0: shapes that touch. Its documentation has no tolerance.
 */
import {installed} from "../peers/peer.mjs";
import {answerAll} from "./answers.mjs";

const rapier = (await installed("@dimforge/rapier2d-compat")).default;
await rapier.init();
const {ColliderDesc} = rapier;
const world = new rapier.World({x: 0, y: 0});
const flat = (points) => new Float32Array(points.flat());
const toObject = ([x, y]) => ({x, y});

/** A ring as a polygon; one that is too thin for that, so that there is no such shape, as its outline. */
function ringOf(ring) {
  const polygon = ColliderDesc.convexPolyline(flat(ring));
  return polygon?.shape.intoRaw() ? polygon : ColliderDesc.polyline(flat([...ring, ring[0]]));
}

await answerAll({method: "Rapier castShape", tolerance: 0}, ({shape, way, rings, edges}) => {
  const body = world.createRigidBody(rapier.RigidBodyDesc.fixed());
  for (const ring of rings) world.createCollider(ringOf(ring), body);
  for (const [a, b] of edges) world.createCollider(ColliderDesc.segment(toObject(a), toObject(b)), body);
  world.step();  // what casts ask is built by a step
  const cast = new rapier.ConvexPolygon(flat(shape), true);
  const [begin, velocity] = [{x: 0, y: 0}, toObject(way)];
  return {
    // Not at what the way leaves: `stopAtPenetration` is false.
    ask: () => world.castShape(begin, 0, velocity, cast, 0, 1, false)?.time_of_impact ?? null,
    close: () => world.removeRigidBody(body),
  };
});
