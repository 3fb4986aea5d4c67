/** What answerers in JavaScript share: they read questions, time the answers, and write them. */
import {createReadStream} from "node:fs";
import {createInterface} from "node:readline";
import {cross} from "../peers/peer.mjs";

const times = 8;

/**
 * A question as engines of floats want it, seen from where the way begins: there a float is finest.
 * @returns `{shape, way, rings, edges}`: convex rings, counter-clockwise; and edges of all else.
 */
function fromBegin({points, position, displacement, solids}) {
  const [rings, edges] = [[], []];
  for (const {polygon, holes = [], chain} of solids) {
    const lines = [chain ?? polygon, ...holes].map((line) => line.map(([x, y]) => [x - position[0], y - position[1]]));
    const [ring] = lines;
    const turns = ring.map((a, i) => Math.sign(cross(a, ring[(i + 1) % ring.length], ring[(i + 2) % ring.length])));
    if (lines.length === 1 && polygon && turns.every((turn) => turn === turns[0])) {
      rings.push(turns[0] > 0 ? ring : ring.reverse());
      continue;
    }
    for (const line of lines)
      edges.push(...(chain ? line.slice(1) : line).map((b, i) => [line.at(chain ? i : i - 1), b]));
  }
  return {shape: points, way: displacement, rings, edges};
}

/**
 * Writes an answer for each question of the file that the command line names last.
 * @param method the first line: `method`, `tolerance` [m].
 * @param prepare makes of a question `{ask, close}`. `ask` answers: the fraction of the way, or null. It alone is timed:
 *   the mean of eight, after one that is not.
 */
export async function answerAll(method, prepare) {
  const say = (what) => process.stdout.write(JSON.stringify(what) + "\n");
  say({...method, float: true, clock: "WebAssembly"});
  for await (const line of createInterface({input: createReadStream(process.argv.at(-1))})) {
    const question = JSON.parse(line);
    const {ask, close} = prepare(fromBegin(question));
    let contact = ask();
    const began = process.hrtime.bigint();
    for (let i = 0; i < times; ++i) contact = ask();
    say({id: question.id, contact, ns: Number(process.hrtime.bigint() - began) / times});
    close();
  }
  process.exit(0);  // engines with threads would wait
}
