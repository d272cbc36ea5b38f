// What the peers that run on Node have in common: procedures from text, and the orders of the benchmark.
import { createInterface } from 'node:readline';

/** The function of a connector's body or helper, made from its text. */
export function procedure(graph, connector) {
  if (connector.js) return new Function(...connector.args, `return (${connector.js});`);
  const helper = graph.helpers.find(({ name }) => name === connector.helper);
  return helper && new Function(...helper.params, `return (${helper.js});`);
}

const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

/** Runs orders. `build` takes what hears the leaves and gives what takes a reading; both may also answer later. */
export async function obey(graph, clock, build, settle = () => {}) {
  const { readings } = graph;
  let at = 0;
  let outputs = 0;
  let kept = null;
  const feed = await build((id, value) => {
    outputs += 1;
    if (kept) (kept[id] ??= []).push(value);
  });
  const next = () => {
    clock.now = at + 1;
    const [stream, value] = readings[at % readings.length];
    at += 1;
    return feed(stream, value);
  };
  const orders = {
    /** Readings one after the other, as fast as it goes. */
    async run(count, expected) {
      const [before, heard] = [process.cpuUsage(), outputs];
      for (let done = 0; done < count; done += 1) {
        const wait = next();
        if (wait) await wait;
      }
      const wait = settle(() => outputs - heard >= expected);
      if (wait) await wait;
      const { user, system } = process.cpuUsage(before);
      return { cpu_ns: (user + system) * 1000, outputs: outputs - heard };
    },
    /** What the leaves hear of the first readings. */
    async check(count) {
      kept = {};
      for (let done = 0; done < count; done += 1) {
        await next();
        await settle(null);
      }
      const heard = kept;
      kept = null;
      return heard;
    },
    /** A reading a millisecond; how long each took, in nanoseconds. */
    async paced(count) {
      const took = [];
      for (let done = 0; done < count; done += 1) {
        await sleep(1);
        const before = process.hrtime.bigint();
        next();
        took.push(Number(process.hrtime.bigint() - before));
      }
      return took;
    },
  };
  for await (const line of createInterface({ input: process.stdin })) {
    const [order, ...numbers] = line.split(' ');
    console.log(JSON.stringify(await orders[order](...numbers.map(Number))));
  }
}
