// The graphs of the benchmark on RxJS: every stream a Subject, every procedure made from its text.
//
// Argument: the graph, a file of the benchmark. Each line on standard input is one order, each answer one line of JSON.
// The folder where rxjs is installed is in RRP_BENCH_RXJS.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { obey, procedure } from './orders.mjs';

const require = createRequire(join(process.env.RRP_BENCH_RXJS, 'package.json'));
const { Subject, combineLatest, filter, map, merge } = require('rxjs');

const graph = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const clock = { now: 0 };

function connect(connector, streams) {
  const inputs = connector.inputs.map((id) => streams.get(id));
  const made = procedure(graph, connector);
  switch (connector.type) {
    case 'map': return inputs[0].pipe(map((value) => made(value)));
    case 'filter': return inputs[0].pipe(filter((value) => made(value)));
    case 'timestamp': return inputs[0].pipe(map((v) => ({ v, t: clock.now })));
    case 'combineLatest': return combineLatest(inputs).pipe(map((values) => made(...values)));
    case 'merge': return merge(...inputs);
    case 'subscribe': return inputs[0];
    default: throw new Error(`no ${connector.type} here`);
  }
}

function build(hear) {
  const streams = new Map(graph.streams.map(({ id }) => [id, new Subject()]));
  for (const id of graph.leaves) streams.get(id).subscribe((value) => hear(id, value));
  for (const connector of graph.connectors) connect(connector, streams).subscribe(streams.get(connector.output));
  return (id, value) => streams.get(id).next(value);
}

obey(graph, clock, build);
