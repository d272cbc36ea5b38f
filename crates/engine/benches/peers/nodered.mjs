// The graphs of the benchmark on Node-RED without its editor: every procedure a function node, streams are its wires.
//
// Argument: the graph, a file of the benchmark. Each line on standard input is one order, each answer one line of JSON.
// The folder where node-red is installed is in RRP_BENCH_NODERED.
import { createRequire } from 'node:module';
import { createServer } from 'node:http';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { obey } from './orders.mjs';

const require = createRequire(join(process.env.RRP_BENCH_NODERED, 'package.json'));
const RED = require('node-red');

/** Readings on their way at once. */
const WINDOW = 20;
/** More turns than any reading needs to come through. */
const TURNS = 60;

const graph = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const clock = { now: 0 };
const turn = () => new Promise((done) => setImmediate(done));

/** The body of a connector's function node. A message names the stream that it is on. */
function text(connector) {
  const helper = graph.helpers.find(({ name }) => name === connector.helper);
  const names = connector.js ? connector.args : (helper?.params ?? []);
  const made = connector.js ?? helper?.js;
  const on = `msg.topic = ${JSON.stringify(connector.output)}; return msg;`;
  switch (connector.type) {
    case 'map': return `const ${names[0]} = msg.payload; msg.payload = (${made}); ${on}`;
    case 'filter': return `const ${names[0]} = msg.payload; if (!(${made})) return null; ${on}`;
    case 'timestamp': return `msg.payload = { v: msg.payload, t: global.get('clock').now }; ${on}`;
    case 'combineLatest': return `const known = context.get('known') ?? new Map();
      context.set('known', known);
      known.set(msg.topic, msg.payload);
      const inputs = ${JSON.stringify(connector.inputs)};
      if (known.size < inputs.length) return null;
      const [${names}] = inputs.map((id) => known.get(id));
      msg.payload = (${made}); ${on}`;
    default: return on;
  }
}

function flow() {
  const node = (id, type, rest) => ({ id, type, z: 'tab', x: 0, y: 0, ...rest });
  const sinks = (id) => (graph.leaves.includes(id) ? [`hear ${id}`] : []);
  const takers = (id) => graph.connectors.filter(({ inputs }) => inputs.includes(id)).map((taker) => `do ${taker.id}`);
  const wires = (id) => [[...takers(id), ...sinks(id)]];
  const does = (func, wires) => ({ func, outputs: 1, timeout: 0, noerr: 0, initialize: '', finalize: '', libs: [], wires });
  return [
    { id: 'tab', type: 'tab', label: 'graph' },
    ...graph.streams.filter(({ kind }) => kind === 'sensor').map(({ id }) => node(id, 'junction', { wires: wires(id) })),
    ...graph.connectors.map((it) => node(`do ${it.id}`, 'function', does(text(it), wires(it.output)))),
    ...graph.leaves.map((id) => node(`hear ${id}`, 'function', does(`global.get('hear')(msg.topic, msg.payload);`, [[]]))),
  ];
}

/** Starts it with the flow; gives what takes a reading. */
async function build(hear) {
  const userDir = mkdtempSync(join(tmpdir(), 'rrp-nodered-'));
  process.on('exit', () => rmSync(userDir, { recursive: true, force: true }));
  writeFileSync(join(userDir, 'flows.json'), JSON.stringify(flow()));
  const started = new Promise((done) => RED.events.once('flows:started', done));
  RED.init(createServer(), {
    userDir, flowFile: 'flows.json', httpAdminRoot: false, httpNodeRoot: false, disableEditor: true,
    logging: { console: { level: 'fatal', metrics: false, audit: false } },
    functionGlobalContext: { hear, clock },
  });
  await RED.start();
  await started;
  let fed = 0;
  return (id, payload) => {
    RED.nodes.getNode(id).receive({ topic: id, payload });
    fed += 1;
    return fed % WINDOW === 0 ? turn() : undefined;
  };
}

/** Waits until `done` says so; without it, until a reading must have come through. */
async function settle(done) {
  for (let turns = 0; done ? !done() : turns < TURNS; turns += 1) await turn();
}

obey(graph, clock, build, settle);
