/**
 * Box2D 3 in WebAssembly (npm box2d3-wasm) answers questions of first contact: b2World_CastShape, which is b2ShapeCast
 * for what its tree finds. The package binds neither b2ShapeCast itself nor b2TimeOfImpact.
 *
 *     node compare/queries/box2d3.mjs QUERIES.jsonl > ANSWERS.jsonl
 *
 * Its sources: a cast stops where two shapes are a slop apart, or a quarter of it more; its slop is 5 mm.
 */
import {loadBox2d3} from "../peers/peer.mjs";
import {answerAll} from "./answers.mjs";

const box2d = await loadBox2d3();
const world = box2d.b2CreateWorld(box2d.b2DefaultWorldDef());
const shapeDef = box2d.b2DefaultShapeDef();
const filter = box2d.b2DefaultQueryFilter();

function addSegment(body, [a, b]) {
  const segment = new box2d.b2Segment();
  segment.point1.Set(...a);
  segment.point2.Set(...b);
  box2d.b2CreateSegmentShape(body, shapeDef, segment);
}

/** A ring with more corners than Box2D's polygons, or some that it would weld, comes as segments. */
function addRing(body, ring) {
  const hull = ring.length <= 8 ? box2d.b2ComputeHull(ring.map(([x, y]) => ({x, y}))) : {count: 0};
  if (hull.count === ring.length) box2d.b2CreatePolygonShape(body, shapeDef, box2d.b2MakePolygon(hull, 0));
  else ring.forEach((a, i) => addSegment(body, [a, ring[(i + 1) % ring.length]]));
}

await answerAll({method: "Box2D 3 b2World_CastShape", tolerance: 1.25 * 0.005}, ({shape, way, rings, edges}) => {
  const body = box2d.b2CreateBody(world, box2d.b2DefaultBodyDef());
  for (const ring of rings) addRing(body, ring);
  for (const edge of edges) addSegment(body, edge);
  const proxy = new box2d.b2ShapeProxy();
  proxy.count = shape.length;
  shape.forEach(([x, y], i) => proxy.setPoint(i, new box2d.b2Vec2(x, y)));
  proxy.radius = 0;
  const translation = new box2d.b2Vec2(...way);
  let first;
  const keep = ({fraction}) => (first = fraction);  // what is later is not looked for
  return {
    ask() {
      first = null;
      box2d.b2World_CastShape(world, proxy, translation, filter, keep);
      return first;
    },
    close: () => box2d.b2DestroyBody(body),
  };
});
