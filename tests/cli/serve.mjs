// node serve.mjs RINGCRAFT FOLDER: `ringcraft serve` before hostile requests, from raw sockets. The
// server must refuse each, and still answer a good one after it.
import { spawn, spawnSync } from 'node:child_process';
import { mkdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { connect } from 'node:net';
import { join } from 'node:path';

const [, , program, folder] = process.argv;
const results = join(folder, 'results');
rmSync(folder, { recursive: true, force: true });
mkdirSync(join(results, 'duel'), { recursive: true });
writeFileSync(join(folder, 'secret.txt'), 'secret');
writeFileSync(join(results, 'duel', 'fight.html'), '<p>fight</p>');
const big = Buffer.alloc(3 * 1024 * 1024, 'ringcraft');
writeFileSync(join(results, 'duel', 'fight.glb'), big);
symlinkSync('../secret.txt', join(results, 'link.txt'));
symlinkSync('..', join(results, 'up'));

let faults = 0;
const check = (right, what) => {
  if (!right) {
    console.log(`FAULT: ${what}`);
    ++faults;
  }
};
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

const started = () => new Promise((done, failed) => {
  const server = spawn(program, ['serve', results, '--port', '0'], { stdio: ['ignore', 'pipe', 'ignore'] });
  server.stdout.once('data', (line) => done({ server, port: Number(/:(\d+)\//.exec(line)[1]) }));
  server.once('error', failed);
  server.ended = new Promise((end) => server.once('exit', (code, signal) => end(code ?? signal)));
});
const { server, port } = await started();

// Sends bytes as they are; what comes back until the server closes or `ms` have gone by.
const raw = (bytes, { ms = 5000, end = false } = {}) => new Promise((done) => {
  const chunks = [];
  const socket = connect(port, '127.0.0.1', () => (end ? socket.end(bytes) : socket.write(bytes)));
  const finish = () => {
    clearTimeout(timer);
    socket.destroy();
    done(Buffer.concat(chunks));
  };
  const timer = setTimeout(finish, ms);
  socket.on('data', (chunk) => chunks.push(chunk));
  socket.on('error', finish);
  socket.on('close', finish);
});
const host = `Host: 127.0.0.1:${port}\r\n`;
const get = async (target, headers = '', method = 'GET') => {
  const answer = await raw(`${method} ${target} HTTP/1.1\r\n${host}${headers}Connection: close\r\n\r\n`);
  const at = answer.indexOf('\r\n\r\n');
  const head = answer.subarray(0, at).toString();
  return { status: Number(/^HTTP\/1.1 (\d+)/.exec(head)?.[1]), head, body: answer.subarray(at + 4) };
};
const statusOf = (answer) => Number(/^HTTP\/1.1 (\d+)/.exec(answer.toString('latin1'))?.[1]);

// What is there, whole and in parts.
const index = await get('/');
check(index.status === 200 && index.body.includes('href="/duel/fight.html"'), 'the index names the fight');
const page = await get('/duel/fight.html');
check(page.status === 200 && /Content-Type: text\/html/.test(page.head), 'the page is HTML');
const glb = await get('/duel/fight.glb');
check(/Content-Type: model\/gltf-binary/.test(glb.head) && glb.body.equals(big), 'the GLB comes whole');
const part = await get('/duel/fight.glb', 'Range: bytes=1000000-2000000\r\n');
check(part.status === 206 && part.body.equals(big.subarray(1000000, 2000001)), 'a range');
check(/Content-Range: bytes 1000000-2000000\/3145728/.test(part.head), 'says which range');
check((await get('/duel/fight.glb', 'Range: bytes=3145728-\r\n')).status === 416, 'a range beyond the end');
const head = await get('/duel/fight.glb', '', 'HEAD');
check(head.status === 200 && head.body.length === 0 && /Content-Length: 3145728/.test(head.head), 'HEAD');
const two = await raw(`GET /duel/fight.html HTTP/1.1\r\n${host}\r\nGET /nothing HTTP/1.1\r\n${host}Connection: close\r\n\r\n`);
check(/200 OK[^]*fight<\/p>HTTP\/1.1 404/.test(two.toString()), 'two requests on one connection');

// What must not be had.
for (const target of ['/../secret.txt', '/%2e%2e/secret.txt', '/duel/..%2f..%2fsecret.txt', '/link.txt',
  '/up/secret.txt', '/up/', '//etc/passwd', '/%2fetc/passwd', '/%00', '/%', '/..%5csecret.txt', '/.%2e/']) {
  const answer = await get(target);
  check(answer.status === 403 && !answer.body.includes('secret'), `${target}: ${answer.status}`);
}
check((await get('/%252e%252e/secret.txt')).status === 404, 'decoded once only');
for (const method of ['POST', 'PUT', 'DELETE', 'OPTIONS', 'TRACE', 'PATCH']) {
  const answer = await get('/', 'Content-Length: 0\r\n', method);
  check(answer.status === 405 && /Allow: GET, HEAD/.test(answer.head), `${method}: ${answer.status}`);
}
check(statusOf(await raw(`CONNECT example.org:80 HTTP/1.1\r\n${host}\r\n`)) === 405, 'CONNECT');
check(statusOf(await raw(`POST / HTTP/1.1\r\n${host}Content-Length: 999999999999\r\n\r\nabc`)) === 405, 'a huge body');
check((await get('/', 'Content-Length: 5\r\n')).status === 400, 'a GET with a body');
check((await get('/', 'Transfer-Encoding: chunked\r\n')).status === 400, 'a GET in chunks');
check(statusOf(await raw(`GET / HTTP/1.1\r\nHost: example.org\r\n\r\n`)) === 421, "another host's name");
check(statusOf(await raw(`GET / HTTP/1.1\r\n\r\n`)) === 421, 'no host');
check(statusOf(await raw('GET http://example.org/ HTTP/1.1\r\n' + host + '\r\n', { ms: 1000 })) === 403, 'a proxy request');
check(statusOf(await raw(`GET / HTTP/1.1\r\n${host}X: ${'x'.repeat(100000)}\r\n\r\n`)) === 431, 'a huge header');
check(statusOf(await raw(`GET /${'x'.repeat(100000)} HTTP/1.1\r\n${host}\r\n`)) === 431, 'a huge target');
check(statusOf(await raw(Array(20000).fill('X: y\r\n').join('').replace(/^/, `GET / HTTP/1.1\r\n`))) === 431, 'very many headers');
for (const bytes of ['\r\n\r\n\r\n', 'no HTTP at all\r\n\r\n', '\x16\x03\x01\x02\x00\x01\x00', '\0'.repeat(5000), 'GET / HTTP/9.9\r\n\r\n']) {
  const status = statusOf(await raw(bytes, { end: true }));
  check(!(status < 400), `${JSON.stringify(bytes.slice(0, 20))}: ${status}`);
}

// Clients that send or take nothing do not keep others waiting, and are sent away in the end.
const idle = Array.from({ length: 200 }, () => {
  const socket = connect(port, '127.0.0.1', () => socket.write('GET /duel/fight.html HT'));
  socket.on('error', () => {});
  socket.on('close', () => { socket.gone = true; });
  return socket;
});
const drip = setInterval(() => idle.forEach((socket) => { if (!socket.gone && socket.writable) socket.write('T'); }), 500);
await pause(12500);
clearInterval(drip);
check(idle.every((socket) => socket.gone), 'slow clients are sent away');
const greedy = connect(port, '127.0.0.1', () => greedy.write(`GET /duel/fight.glb HTTP/1.1\r\n${host}\r\n`));
greedy.on('error', () => {});
greedy.pause();
check((await get('/duel/fight.html')).status === 200, 'answers after all that');

// Another server cannot have the port; each signal ends one, at once, with 130.
const second = spawnSync(program, ['serve', results, '--port', String(port)], { encoding: 'utf8', timeout: 20000 });
check(second.status === 2 && /port/.test(second.stderr), `a taken port: ${second.status} ${second.stderr}`);
server.kill('SIGTERM');
check((await Promise.race([server.ended, pause(3000)])) === 130, 'SIGTERM ends with 130');
const again = await started();
again.server.kill('SIGINT');
check((await Promise.race([again.server.ended, pause(3000)])) === 130, 'SIGINT ends with 130');
server.kill('SIGKILL');
greedy.destroy();
rmSync(folder, { recursive: true, force: true });
console.log(faults ? `${faults} faults` : 'no fault');
process.exit(faults ? 1 : 0);
